// Model       Rough conductor: tiny mirrors of metal, their normals distributed as Beckmann or GGX say.
// Measure     pdf_sa, from the normals that are visible
// Source      Walter et al., "Microfacet Models for Refraction through Rough Surfaces", 2007, equation 20; see
//             microfacet.h
// Departures  roughness below 1e-4 counts as 1e-4, and Beckmann's masking is Walter's rational approximation, both as
//             in Mitsuba; the density, though, has the exact masking of what is sampled
#pragma once

#include "bsdf/bsdf.h"
#include "bsdf/fresnel.h"
#include "bsdf/microfacet.h"

namespace norrsken::NORRSKEN_ISA {

struct RoughConductor {
  static constexpr bool kDelta = false;
  static constexpr bool kUsesLobe = false;

  struct Parameters {
    Color specular_reflectance, eta, k;
    Microfacet facets;
  };

  struct Stored {
    static constexpr BsdfKind kKind = BsdfKind::roughconductor;
    ColorSlot specular_reflectance, eta, k;
    RoughnessSlots facets;
  };

  static NORRSKEN_INLINE Parameters load(const ParameterReader& p) {
    return {p.get(&Stored::specular_reflectance), p.get(&Stored::eta), p.get(&Stored::k),
            load_microfacet(p, &Stored::facets)};
  }

  static NORRSKEN_INLINE Color evaluate(const Parameters& p, const Vec3f& wo, const Vec3f& wi) {
    const Vec3f m = normalize(wo + wi);
    const Float masking = p.facets.masking(wo, m) * p.facets.masking(wi, m);
    const Float value = p.facets.density(m) * masking / (4.0f * wo.z);
    return tint(p, dot(wo, m)) * zero_unless(are_above(wo, wi), value);
  }

  static NORRSKEN_INLINE Float pdf_sa(const Parameters& p, const Vec3f& wo, const Vec3f& wi) {
    const Vec3f m = normalize(wo + wi);
    return zero_unless(are_above(wo, wi), reflected_pdf_sa(p, wo, m));
  }

  static NORRSKEN_INLINE BsdfSample sample(const Parameters& p, const Vec3f& wo, Float, Vec2f direction) {
    const Vec3f m = p.facets.sample_visible(wo, direction);
    const Float cos_i = dot(wo, m);
    const Vec3f wi = reflect(wo, m, cos_i);
    const Float masking = p.facets.masking(wo, m) * p.facets.masking(wi, m) / p.facets.exact_masking(wo);
    const Float pdf = reflected_pdf_sa(p, wo, m);
    return {wi, tint(p, cos_i) * masking, pdf, are_above(wo, wi) & (pdf > 0.0f)};
  }

  static NORRSKEN_INLINE Color albedo(const Parameters& p) { return tint(p, 1.0f); }

 private:
  static NORRSKEN_INLINE Mask are_above(const Vec3f& wo, const Vec3f& wi) { return min(wo.z, wi.z) > 0.0f; }
  static NORRSKEN_INLINE Color tint(const Parameters& p, Float cos_i) {
    return p.specular_reflectance * fresnel_conductor(cos_i, p.eta, p.k);
  }
  /// Walter et al. 2007, equations 14 and 17, with the density of visible normals: the cosines to m cancel.
  static NORRSKEN_INLINE Float reflected_pdf_sa(const Parameters& p, const Vec3f& wo, const Vec3f& m) {
    return p.facets.density(m) * p.facets.exact_masking(wo) / (4.0f * wo.z);
  }
};

}  // namespace norrsken::NORRSKEN_ISA
