// Model       Rough dielectric: tiny interfaces that reflect and refract, as ground glass does.
// Measure     pdf_sa, from the normals that are visible and each facet's share of reflected light
// Source      Walter et al., "Microfacet Models for Refraction through Rough Surfaces", 2007, equations 20 and 21; see
//             microfacet.h
// Departures  roughness below 1e-4 counts as 1e-4, and Beckmann's masking is Walter's rational approximation, both as
//             in Mitsuba; the density, though, has the exact masking of what is sampled
#pragma once

#include "bsdf/bsdf.h"
#include "bsdf/fresnel.h"
#include "bsdf/microfacet.h"

namespace norrsken::NORRSKEN_ISA {

struct RoughDielectric {
  static constexpr bool kDelta = false;
  static constexpr bool kUsesLobe = true;

  struct Parameters {
    Color specular_reflectance, specular_transmittance;
    Microfacet facets;
    Float eta;  ///< of the other side over this side
  };

  struct Stored {
    static constexpr BsdfKind kKind = BsdfKind::roughdielectric;
    ColorSlot specular_reflectance, specular_transmittance;
    RoughnessSlots facets;
    float eta;
  };

  static NORRSKEN_INLINE Parameters load(const ParameterReader& p) {
    return {p.get(&Stored::specular_reflectance), p.get(&Stored::specular_transmittance),
            load_microfacet(p, &Stored::facets), p.get(&Stored::eta)};
  }

  static NORRSKEN_INLINE Color evaluate(const Parameters& p, const Vec3f& wo, const Vec3f& wi) {
    const Facet f = facet_between(p, wo, wi);
    const Float masking = p.facets.masking(wo, f.m) * p.facets.masking(wi, f.m);
    // Radiance loses the eta^2 that the solid angle gains.
    const Float factor = select(f.reflects, 1.0f, 1.0f / (p.eta * p.eta));
    const Float value = masking * factor * scattered_density(p, wo, f);
    return tint(p, f.reflects) * zero_unless((wo.z > 0.0f) & (masking > 0.0f), value);
  }

  static NORRSKEN_INLINE Float pdf_sa(const Parameters& p, const Vec3f& wo, const Vec3f& wi) {
    const Facet f = facet_between(p, wo, wi);
    const Mask seen = (wo.z > 0.0f) & (f.cos_o > 0.0f) & (f.cos_i * wi.z > 0.0f);
    return zero_unless(seen, p.facets.exact_masking(wo) * scattered_density(p, wo, f));
  }

  static NORRSKEN_INLINE BsdfSample sample(const Parameters& p, const Vec3f& wo, Float lobe, Vec2f direction) {
    Facet f;
    f.m = p.facets.sample_visible(wo, direction);
    f.cos_o = dot(wo, f.m);
    const FresnelDielectric fresnel = fresnel_dielectric(f.cos_o, p.eta);
    f.reflectance = fresnel.reflectance;
    f.reflects = lobe < f.reflectance;
    f.cos_i = select(f.reflects, f.cos_o, -fresnel.cos_t);
    const Vec3f wi = select(f.reflects, reflect(wo, f.m, f.cos_o), refract(wo, f.m, f.cos_o, fresnel.cos_t, p.eta));
    const Float exact = p.facets.exact_masking(wo);
    const Float masking = p.facets.masking(wo, f.m) * p.facets.masking(wi, f.m) / exact;
    const Float factor = select(f.reflects, 1.0f, 1.0f / (p.eta * p.eta));
    const Float pdf = exact * scattered_density(p, wo, f);
    const Mask seen = (wo.z > 0.0f) & (f.cos_o > 0.0f) & (f.cos_i * wi.z > 0.0f);
    return {wi, tint(p, f.reflects) * (masking * factor), pdf, seen & (pdf > 0.0f), select(f.reflects, 1.0f, p.eta)};
  }

  static NORRSKEN_INLINE Float refracted_eta(const Parameters& p) { return p.eta; }
  static NORRSKEN_INLINE Mask transmits(const Parameters&) { return !Mask::none(); }

  static NORRSKEN_INLINE Color albedo(const Parameters& p) { return p.specular_transmittance; }

 private:
  /// A facet that sends light from wi to wo.
  struct Facet {
    Vec3f m;
    Mask reflects;
    Float cos_o, cos_i;  ///< of wo and wi to m; that of wi is negative for refraction
    Float reflectance;
  };

  static NORRSKEN_INLINE Facet facet_between(const Parameters& p, const Vec3f& wo, const Vec3f& wi) {
    Facet f;
    f.reflects = wi.z > 0.0f;
    const Vec3f m = normalize(fma(wi, select(f.reflects, 1.0f, p.eta), wo));
    f.m = m * copysign(1.0f, m.z);
    f.cos_o = dot(wo, f.m), f.cos_i = dot(wi, f.m);
    f.reflectance = fresnel_dielectric(f.cos_o, p.eta).reflectance;
    return f;
  }

  /// Density of wi if no facet masked another: that of m as seen from wo, times the facet's share of reflected or
  /// refracted light, times the solid angle of m over that of wi (Walter et al. 2007, equations 14 and 17).
  static NORRSKEN_INLINE Float scattered_density(const Parameters& p, const Vec3f& wo, const Facet& f) {
    const Float sum = fma(p.eta, f.cos_i, f.cos_o), ratio = p.eta / sum;
    const Float share = select(f.reflects, f.reflectance, 1.0f - f.reflectance);
    const Float seen_jacobian = select(f.reflects, 0.25f, ratio * ratio * abs(f.cos_i) * f.cos_o);
    return p.facets.density(f.m) * share * seen_jacobian / wo.z;
  }

  static NORRSKEN_INLINE Color tint(const Parameters& p, Mask reflects) {
    return select(reflects, p.specular_reflectance, p.specular_transmittance);
  }
};

}  // namespace norrsken::NORRSKEN_ISA
