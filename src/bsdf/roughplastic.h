// Model       Rough plastic: a dielectric coat of tiny mirrors over a diffuse base.
// Measure     pdf_sa, from the normals that are visible and cosine-weighted for the base; chosen by how much the coat
//             lets through and by the reflectances
// Source      Walter et al., "Microfacet Models for Refraction through Rough Surfaces", 2007, equation 20; see
//             microfacet.h; the base: coat.h, with the transmittance of the rough coat from a table over the cosine
// Departures  roughness below 1e-4 counts as 1e-4, as in Mitsuba
#pragma once

#include "bsdf/bsdf.h"
#include "bsdf/coat.h"
#include "bsdf/fresnel.h"
#include "bsdf/microfacet.h"

namespace norrsken::NORRSKEN_ISA {

/// Entries of the table of transmittances, for cosines evenly from 0 to 1.
inline constexpr std::uint32_t kTransmittances = 64;

struct RoughPlastic {
  static constexpr bool kDelta = false;
  static constexpr bool kUsesLobe = true;

  struct Parameters {
    Coat coat;
    Microfacet facets;
    const float* table;  ///< of transmittances, at `entry` in each lane
    UInt entry;
    Mask active;
  };

  struct Stored {
    static constexpr BsdfKind kKind = BsdfKind::roughplastic;
    CoatSlots coat;
    float alpha;
    float ggx;                              ///< 1, or 0 for Beckmann
    float transmittances[kTransmittances];  ///< of the coat, for cosines evenly from 0 to 1
  };

  static NORRSKEN_INLINE Parameters load(const ParameterReader& p) {
    const Float alpha = max(p.get(&Stored::alpha), Float(kMinAlpha));
    const Mask ggx = p.get(&Stored::ggx) > 0.5f;
    const UInt entry = p.offset + UInt(floats_before(&Stored::transmittances));
    return {load_coat(p, &Stored::coat), {alpha, alpha, ggx}, p.scene.parameters, entry, p.active};
  }

  static NORRSKEN_INLINE Color evaluate(const Parameters& p, const Vec3f& wo, const Vec3f& wi) {
    return evaluate(p, wo, wi, transmittance(p, wo.z));
  }

  static NORRSKEN_INLINE Float pdf_sa(const Parameters& p, const Vec3f& wo, const Vec3f& wi) {
    return pdf_sa(p, wo, wi, p.coat.specular_prob(1.0f - transmittance(p, wo.z)));
  }

  static NORRSKEN_INLINE BsdfSample sample(const Parameters& p, const Vec3f& wo, Float lobe, Vec2f direction) {
    const Float through = transmittance(p, wo.z), specular_prob = p.coat.specular_prob(1.0f - through);
    const Vec3f m = p.facets.sample_visible(wo, direction);
    const Vec3f wi = select(lobe < specular_prob, reflect(wo, m, dot(wo, m)), warp_to_cosine_hemisphere(direction));
    const Float pdf = pdf_sa(p, wo, wi, specular_prob);
    return {wi, evaluate(p, wo, wi, through) * (1.0f / pdf), pdf, pdf > 0.0f};
  }

  static NORRSKEN_INLINE Color albedo(const Parameters& p) { return p.coat.diffuse_reflectance; }

 private:
  static NORRSKEN_INLINE Mask are_above(const Vec3f& wo, const Vec3f& wi) { return min(wo.z, wi.z) > 0.0f; }

  static NORRSKEN_INLINE Color evaluate(const Parameters& p, const Vec3f& wo, const Vec3f& wi, Float through) {
    const Vec3f m = normalize(wo + wi);
    const Float masking = p.facets.masking(wo, m) * p.facets.masking(wi, m);
    const Float reflectance = fresnel_dielectric(dot(wo, m), p.coat.eta).reflectance;
    const Float specular = reflectance * p.facets.density(m) * masking / (4.0f * wo.z);
    const Float crossing = through * transmittance(p, wi.z) * cosine_hemisphere_pdf_sa(wi.z);
    const Mask above = are_above(wo, wi);
    return fma(p.coat.specular_reflectance, zero_unless(above, specular), p.coat.inside * zero_unless(above, crossing));
  }

  static NORRSKEN_INLINE Float pdf_sa(const Parameters& p, const Vec3f& wo, const Vec3f& wi, Float specular_prob) {
    const Vec3f m = normalize(wo + wi);
    // Walter et al. 2007, equations 14 and 17: 1 / (4 cos).
    const Float specular = p.facets.visible_pdf_sa(wo, m) / (4.0f * dot(wo, m));
    const Float diffuse = cosine_hemisphere_pdf_sa(wi.z);
    return zero_unless(are_above(wo, wi), fma(specular_prob, specular - diffuse, diffuse));
  }

  static NORRSKEN_INLINE Float transmittance(const Parameters& p, Float cos_theta) {
    const Float x = min(max(cos_theta, 0.0f), 1.0f) * Float(kTransmittances - 1);
    const Float below = min(floor(x), Float(kTransmittances - 2));
    const UInt entry = p.entry + to_uint(below);
    const Float a = gather(p.table, entry, p.active), b = gather(p.table + 1, entry, p.active);
    return fma(b - a, x - below, a);
  }
};

}  // namespace norrsken::NORRSKEN_ISA
