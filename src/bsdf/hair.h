// Model       A hair: a rough dielectric cylinder around the local y axis, tiled with scales, that absorbs inside. Light is
//             reflected (R), passes through (TT), or is reflected inside once (TRT) or more often.
// Measure     pdf_sa; one of the four is chosen by its share of the light
// Source      Chiang, Bitterli, Tappan, Burley, "A Practical and Controllable Hair and Fur Model for Production Path
//             Tracing", 2016; d'Eon, Francois, Hill, Letteri, Aubry, "An Energy-Conserving Hair Reflectance Model", 2011;
//             Pharr, "The Implementation of a Hair Scattering Model", 2016; Bessel's I0: Abramowitz and Stegun 9.8.1, 9.8.2
// Departures  the offset from the hair's middle follows from the direction to the viewer, as in Mitsuba, not from the
//             curve's width. Bessel's function is not cut off: up to 0.6 % from Mitsuba's values, which add up to 1.01
#pragma once

#include "bsdf/bsdf.h"
#include "bsdf/fresnel.h"
#include "math/special.h"

namespace norrsken::NORRSKEN_ISA {

/// log of the modified Bessel function I0(x), x >= 0.
NORRSKEN_INLINE Float log_bessel_i0(Float x) {
  const Float small = x * (1.0f / 3.75f), inverse = 3.75f / max(x, 3.75f);
  const Float near =
      polynomial(small * small, 1.0f, 3.5156229f, 3.0899424f, 1.2067492f, 0.2659732f, 0.0360768f, 0.0045813f);
  const Float far = polynomial(inverse, 0.39894228f, 0.01328592f, 0.00225319f, -0.00157565f, 0.00916281f, -0.02057706f,
                               0.02635537f, -0.01647633f, 0.00392377f);
  return select(x < 3.75f, log(near), x - 0.5f * log(max(x, 3.75f)) + log(far));
}

struct Hair {
  static constexpr bool kDelta = false;
  static constexpr bool kUsesLobe = true;
  static constexpr int kLobes = 4;

  struct Parameters {
    Color absorption;  ///< per radius
    Float eta;
    Float variance;         ///< of R along the hair; TT has a quarter, the others four times as much
    Float azimuthal_scale;  ///< of the logistic distribution around the hair
    Float sin_tilt, cos_tilt;
    Mask along_u;  ///< the hair runs along x instead of y
  };

  struct Stored {
    static constexpr BsdfKind kKind = BsdfKind::hair;
    ColorSlot absorption;
    float absorption_scale, eta, variance, azimuthal_scale, sin_tilt, cos_tilt;
    std::uint32_t along_u;
  };

  static NORRSKEN_INLINE Parameters load(const ParameterReader& p) {
    return {p.get(&Stored::absorption) * p.get(&Stored::absorption_scale),
            p.get(&Stored::eta),
            p.get(&Stored::variance),
            p.get(&Stored::azimuthal_scale),
            p.get(&Stored::sin_tilt),
            p.get(&Stored::cos_tilt),
            p.get(&Stored::along_u) != 0u};
  }

  static NORRSKEN_INLINE Color evaluate(const Parameters& p, const Vec3f& wo, const Vec3f& wi) {
    return sum(p, view_from(p, to_hair(p, wo)), to_hair(p, wi)).value * zero_unless(wo.z > 0.0f, 1.0f);
  }

  static NORRSKEN_INLINE Float pdf_sa(const Parameters& p, const Vec3f& wo, const Vec3f& wi) {
    return zero_unless(wo.z > 0.0f, sum(p, view_from(p, to_hair(p, wo)), to_hair(p, wi)).pdf_sa);
  }

  static NORRSKEN_INLINE BsdfSample sample(const Parameters& p, const Vec3f& wo, Float lobe, Vec2f direction) {
    const View view = view_from(p, to_hair(p, wo));
    // What is left of `lobe` is as good as new.
    Float begin(0.0f), end = view.prob[0], sin_o = view.sin_tilted[0], cos_o = view.cos_tilted[0],
                       variance = variance_of(p, 0), middle = view.azimuth[0];
    Mask around = Mask::none();
    for (int k = 1; k < kLobes; ++k) {
      const Mask beyond = lobe >= end;
      begin = select(beyond, end, begin);
      end = select(beyond, end + view.prob[k], end);
      sin_o = select(beyond, view.sin_tilted[k], sin_o), cos_o = select(beyond, view.cos_tilted[k], cos_o);
      variance = select(beyond, variance_of(p, k), variance);
      if (k < kLobes - 1) middle = select(beyond, view.azimuth[k], middle);
      if (k == kLobes - 1) around = beyond;
    }
    const Float u = min(max((lobe - begin) / max(end - begin, 1e-20f), 0.0f), 1.0f);

    const Float v = variance;
    const Float cos_cone =
        max(fma(v, log(max(direction.x + (1.0f - direction.x) * exp(max(-2.0f / v, -80.0f)), 1e-30f)), 1.0f), -1.0f);
    const Float sin_cone = sqrt(max(fnma(cos_cone, cos_cone, 1.0f), 0.0f));
    const Float sin_i = min(max(fma(sin_cone * sin_cos_turns(direction.y).cos, cos_o, -cos_cone * sin_o), -1.0f), 1.0f);
    const Float cos_i = sqrt(max(fnma(sin_i, sin_i, 1.0f), 0.0f));

    const Float s = p.azimuthal_scale, first = 1.0f / (1.0f + exp(min(kPi / s, 80.0f)));
    const Float share = min(max(fma(u, 1.0f - (first + first), first), 1e-30f), 1.0f - 0x1p-24f);
    const Float off = -s * log(1.0f / share - 1.0f);
    const Float turn = select(around, u, (view.phi + middle + min(max(off, -kPi), kPi)) * (0.5f * kInvPi));
    const SinCos phi = sin_cos_turns(turn - floor(turn));
    const Vec3f wi = normalize(Vec3f{cos_i * phi.cos, sin_i, cos_i * phi.sin});
    const Sum found = sum(p, view, wi);
    const Mask valid = (wo.z > 0.0f) & (found.pdf_sa > 0.0f);
    return {from_hair(p, wi), found.value * (1.0f / select(valid, found.pdf_sa, 1.0f)), found.pdf_sa, valid};
  }

  static NORRSKEN_INLINE Color albedo(const Parameters& p) { return transmitted(p, 2.0f); }

 private:
  /// All that follows from the direction to the viewer alone.
  struct View {
    Float phi;                  ///< around the hair, from x to z
    Color attenuation[kLobes];  ///< what is left of the light
    Float prob[kLobes];
    Float sin_tilted[kLobes], cos_tilted[kLobes];  ///< along the hair, as tilted by the scales
    Float azimuth[kLobes - 1];                     ///< where light is thrown to, from phi
  };
  struct Sum {
    Color value;
    Float pdf_sa;
  };

  /// To the space in which the hair runs along y, and back.
  static NORRSKEN_INLINE Vec3f to_hair(const Parameters& p, const Vec3f& w) {
    return {select(p.along_u, -w.y, w.x), select(p.along_u, w.x, w.y), w.z};
  }
  static NORRSKEN_INLINE Vec3f from_hair(const Parameters& p, const Vec3f& w) {
    return {select(p.along_u, w.y, w.x), select(p.along_u, -w.x, w.y), w.z};
  }

  static NORRSKEN_INLINE Float variance_of(const Parameters& p, int lobe) {
    return p.variance * (lobe == 0 ? 1.0f : lobe == 1 ? 0.25f : 4.0f);
  }
  /// Of a way through the hair, in radii.
  static NORRSKEN_INLINE Color transmitted(const Parameters& p, Float length) {
    return {exp(-p.absorption.r * length), exp(-p.absorption.g * length), exp(-p.absorption.b * length)};
  }

  static inline View view_from(const Parameters& p, const Vec3f& wo) {
    View view;
    const Float sin_o = wo.y, across = sqrt(fma(wo.x, wo.x, wo.z * wo.z)), cos_o = max(across, 1e-6f);
    view.phi = atan2(wo.z, wo.x);
    // The offset h from the middle, and the angle of incidence, whose sine it is.
    const Float h = -wo.x / cos_o, gamma_o = atan2(-wo.x, wo.z), cos_gamma_o = abs(wo.z) / cos_o;
    const Float sin_t = sin_o / p.eta, cos_t = sqrt(max(fnma(sin_t, sin_t, 1.0f), 1e-6f));
    // Bravais' index of refraction is that of the section across the hair.
    const Float bravais = sqrt(max(fnma(sin_o, sin_o, p.eta * p.eta), 1e-6f)) / cos_o;
    const Float sin_gamma_t = min(max(h / bravais, -1.0f), 1.0f),
                cos_gamma_t = sqrt(max(fnma(sin_gamma_t, sin_gamma_t, 1.0f), 0.0f)), gamma_t = asin(sin_gamma_t);
    const Color inside = transmitted(p, (cos_gamma_t + cos_gamma_t) / cos_t);
    const Float f = fresnel_dielectric(cos_o * cos_gamma_o, p.eta).reflectance, through = 1.0f - f;
    view.attenuation[0] = grey(f);
    view.attenuation[1] = inside * (through * through);
    view.attenuation[2] = view.attenuation[1] * inside * f;
    const auto rest = [&](Float before, Float t) { return before * f * t / max(fnma(f, t, 1.0f), 1e-6f); };
    view.attenuation[3] = {rest(view.attenuation[2].r, inside.r), rest(view.attenuation[2].g, inside.g),
                           rest(view.attenuation[2].b, inside.b)};
    Float whole(0.0f);
    for (const Color& a : view.attenuation) whole += sum_of(a);
    for (int k = 0; k < kLobes; ++k) view.prob[k] = sum_of(view.attenuation[k]) / max(whole, 1e-20f);

    // R is tilted by twice the scales' angle one way, TT by the angle and TRT by four times as much the other way.
    const Float sin2 = 2.0f * p.sin_tilt * p.cos_tilt, cos2 = fms(p.cos_tilt, p.cos_tilt, p.sin_tilt * p.sin_tilt);
    const Float sin4 = 2.0f * sin2 * cos2, cos4 = fms(cos2, cos2, sin2 * sin2);
    const Float sines[] = {-sin2, p.sin_tilt, sin4, Float(0.0f)}, cosines[] = {cos2, p.cos_tilt, cos4, Float(1.0f)};
    for (int k = 0; k < kLobes; ++k) {
      view.sin_tilted[k] = fma(sin_o, cosines[k], across * sines[k]);
      view.cos_tilted[k] = abs(fms(across, cosines[k], sin_o * sines[k]));
    }
    for (int k = 0; k < kLobes - 1; ++k) {
      const auto times = static_cast<float>(k);
      view.azimuth[k] = fma(gamma_t, 2.0f * times, fma(gamma_o, -2.0f, times * kPi));
    }
    return view;
  }

  static inline Sum sum(const Parameters& p, const View& view, const Vec3f& wi) {
    const Float sin_i = wi.y, cos_i = sqrt(fma(wi.x, wi.x, wi.z * wi.z));
    const Float phi = atan2(wi.z, wi.x) - view.phi;
    const Float s = p.azimuthal_scale, first = 1.0f / (1.0f + exp(min(kPi / s, 80.0f)));
    const Float scale = 1.0f / (s * (1.0f - (first + first)));
    Sum result{black(), Float(0.0f)};
    for (int k = 0; k < kLobes; ++k) {
      const Float v = variance_of(p, k), inverse = 1.0f / v;
      // d'Eon's distribution along the hair, all of it in logarithms.
      const Float along = log_bessel_i0(cos_i * view.cos_tilted[k] * inverse) - sin_i * view.sin_tilted[k] * inverse;
      const Float norm = inverse + log(v * (1.0f - exp(max(-2.0f * inverse, -80.0f))));
      Float density = exp(along - norm);
      if (k < kLobes - 1) {
        const Float off = phi - view.azimuth[k];
        const Float wrapped = fnma(floor(fma(off, 0.5f * kInvPi, 0.5f)), 2.0f * kPi, off);
        const Float e = exp(max(-abs(wrapped) / s, -80.0f));
        density *= e * scale / ((1.0f + e) * (1.0f + e));
      } else {
        density *= 0.5f * kInvPi;
      }
      result.value = fma(view.attenuation[k], density, result.value);
      result.pdf_sa = fma(view.prob[k], density, result.pdf_sa);
    }
    return result;
  }
};

}  // namespace norrsken::NORRSKEN_ISA
