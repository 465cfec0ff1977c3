// Model       Specular flakes that lie in all directions, some more than others.
// Measure     solid angle
// Source      Heitz, Dupuy, Crassin, Dachsbacher, "The SGGX Microflake Distribution", 2015: equations 10 and 16, and the
//             sampling of visible normals of its supplement
// Departures  none
#pragma once

#include "medium/flakes.h"
#include "medium/phase.h"

namespace norrsken::NORRSKEN_ISA {

struct Sggx {
  struct Stored {
    static constexpr PhaseKind kKind = PhaseKind::sggx;
    std::uint32_t volume;
  };
  struct Parameters {
    Flakes flakes;
  };

  static NORRSKEN_INLINE Parameters load(const PhaseReader& p) {
    return {flakes_at(p.scene, p.get(&Stored::volume), copied(p.position), p.active)};
  }

  /// D(h) / (4 area(wo)), h being the normal of the flakes that reflect the one to the other.
  static NORRSKEN_INLINE Float of_normal(const Flakes& s, const Vec3f& wo, const Vec3f& h) {
    const Float determinant = s.determinant(), form = s.adjugate_form(h) / determinant;
    const Float density = kInvPi / (sqrt(determinant) * form * form);
    return 0.25f * density / projected_area(s, wo);
  }

  static NORRSKEN_INLINE Float pdf_sa(const Parameters& p, const Vec3f& wo, const Vec3f& wi) {
    const Vec3f sum = wo + wi;
    const Float length2 = dot(sum, sum);
    const Vec3f h = sum * (1.0f / sqrt(max(length2, 1e-20f)));
    return zero_unless(length2 > 0.0f, of_normal(p.flakes, wo, h));
  }

  static NORRSKEN_INLINE PhaseSample sample(const Parameters& p, const Vec3f& wo, Vec2f u) {
    const Frame frame = make_frame(wo);
    const Flakes& s = p.flakes;
    const Float kk = s.form(frame.s, frame.s), jj = s.form(frame.t, frame.t), ii = max(s.form(wo, wo), 1e-20f);
    const Float kj = s.form(frame.s, frame.t), ki = s.form(frame.s, wo), ji = s.form(frame.t, wo);
    const Flakes local{kk, jj, ii, kj, ki, ji};
    const Float root = sqrt(local.determinant()), inverse = 1.0f / sqrt(ii);
    const Float width = sqrt(max(jj * ii - ji * ji, 1e-20f));
    const Vec2f d = warp_to_disk(u);
    const Float w = sqrt(max(fnma(d.x, d.x, fnma(d.y, d.y, 1.0f)), 0.0f));
    const Float x = fma(d.x, root / width, fma(d.y, inverse * (kj * ii - ki * ji) / width, w * inverse * ki));
    const Float y = fma(d.y, inverse * width, w * inverse * ji);
    const Vec3f h = normalize(frame.to_world({x, y, w * inverse * ii}));
    const Vec3f wi = normalize(h * (2.0f * dot(wo, h)) - wo);
    return {wi, of_normal(s, wo, h)};
  }
};

}  // namespace norrsken::NORRSKEN_ISA
