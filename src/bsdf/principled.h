// Model       Disney's artist-friendly material: metal, plastic and glass in one, with sheen and a clear coat.
// Measure     pdf_sa: cosine-weighted, from the clear coat's normals, and from visible normals with each facet's share of
//             reflected light; each lobe as often as its part of what the viewer gets, by the reflectance head on to it
// Source      Burley 2012 and 2015, see principled_lobes.h; microfacets: Walter et al. 2007, equations 20 and 21
// Departures  from Mitsuba 3 how often lobes are sampled; as there, neither subsurface scattering nor absorption inside;
//             sheen and clear coat may give back more than arrives; what has nothing diffuse (metallic or spec_trans 1) has
//             no sheen; an interface that reflects nothing (specular 0) has no metal either
#pragma once

#include "bsdf/bsdf.h"
#include "bsdf/principled_lobes.h"

namespace norrsken::NORRSKEN_ISA {

struct Principled {
  static constexpr bool kDelta = false;
  static constexpr bool kUsesLobe = true;

  struct Parameters {
    Color base_color;
    Microfacet facets;
    ClearcoatNormals coat;
    Float roughness, metallic, spec_tint, sheen, sheen_tint, flatness, clearcoat;
    Float base, glass;                                  ///< weights of what is diffuse and what transmits
    Float eta;                                          ///< of the other side over this side
    Float diffuse_rate, clearcoat_rate, specular_rate;  ///< factors on how often each lobe is sampled
    Mask front;                                         ///< else inside, where there are facets only
  };

  struct Stored {
    static constexpr BsdfKind kKind = BsdfKind::principled;
    ColorSlot base_color;
    NumberSlot roughness, anisotropic, metallic, spec_trans, spec_tint, sheen, sheen_tint, flatness, clearcoat,
        clearcoat_gloss;
    float eta;
    float is_back;  ///< 1 if it is
    float diffuse_rate, specular_rate, clearcoat_rate;
  };

  static NORRSKEN_INLINE Parameters load(const ParameterReader& r) {
    Parameters p;
    p.base_color = r.get(&Stored::base_color), p.roughness = r.get(&Stored::roughness);
    p.facets = facets_of(p.roughness, r.get(&Stored::anisotropic));
    p.metallic = r.get(&Stored::metallic);
    const Float spec_trans = r.get(&Stored::spec_trans), dielectric = 1.0f - p.metallic;
    p.base = dielectric * (1.0f - spec_trans), p.glass = dielectric * spec_trans;
    p.spec_tint = r.get(&Stored::spec_tint), p.sheen = r.get(&Stored::sheen);
    p.sheen_tint = r.get(&Stored::sheen_tint), p.flatness = r.get(&Stored::flatness);
    p.clearcoat = r.get(&Stored::clearcoat);
    const Float coat_alpha = mix(0.1f, 0.001f, r.get(&Stored::clearcoat_gloss));
    p.coat = {coat_alpha * coat_alpha};
    p.eta = r.get(&Stored::eta), p.front = r.get(&Stored::is_back) == 0.0f;
    p.diffuse_rate = r.get(&Stored::diffuse_rate), p.clearcoat_rate = r.get(&Stored::clearcoat_rate);
    p.specular_rate = select(p.front, r.get(&Stored::specular_rate), 1.0f);
    return p;
  }

  static NORRSKEN_INLINE Color evaluate(const Parameters& p, const Vec3f& wo, const Vec3f& wi) {
    return evaluate(p, wo, wi, facet_between(p, wo, wi));
  }

  static NORRSKEN_INLINE Float pdf_sa(const Parameters& p, const Vec3f& wo, const Vec3f& wi) {
    return pdf_sa(p, lobe_probs(p, wo), wo, wi, facet_between(p, wo, wi));
  }

  static NORRSKEN_INLINE BsdfSample sample(const Parameters& p, const Vec3f& wo, Float lobe, Vec2f direction) {
    const LobeProbs probs = lobe_probs(p, wo);
    const Float above_coat = probs.diffuse + probs.clearcoat;
    const Mask diffuse = lobe < probs.diffuse, clearcoat = (!diffuse) & (lobe < above_coat);
    Vec3f m = p.facets.sample_visible(wo, direction);
    if (any(clearcoat)) m = select(clearcoat, p.coat.sample(direction), m);
    const Float cos_o = dot(wo, m);
    const FresnelDielectric fresnel = fresnel_dielectric(cos_o, p.eta);
    const Float among_facets = (lobe - above_coat) / max(probs.specular, 1e-20f);
    const Mask refracts = (!(diffuse | clearcoat)) & (among_facets < transmitted_share(p, fresnel.reflectance));
    Vec3f wi = select(refracts, refract(wo, m, cos_o, fresnel.cos_t, p.eta), reflect(wo, m, cos_o));
    wi = select(diffuse, warp_to_cosine_hemisphere(direction), wi);

    const Facet f = facet_between(p, wo, wi);
    const Float pdf = pdf_sa(p, probs, wo, wi, f);
    // Facets that face away may lead where another lobe has a density.
    const Mask valid = (pdf > 0.0f) & (diffuse | f.possible) & (refracts ^ (wi.z > 0.0f));
    return {wi, evaluate(p, wo, wi, f) * (1.0f / select(valid, pdf, 1.0f)), pdf, valid, select(refracts, p.eta, 1.0f)};
  }

  static NORRSKEN_INLINE Float refracted_eta(const Parameters& p) { return p.eta; }
  static NORRSKEN_INLINE Mask transmits(const Parameters& p) { return p.glass > 0.0f; }

  static NORRSKEN_INLINE Color albedo(const Parameters& p) { return p.base_color; }

 private:
  /// A facet that sends light from wi to wo.
  struct Facet {
    Vec3f m;
    Mask reflects, possible;
    Float cos_o, cos_i;  ///< of wo and wi to m; that of wi is negative for refraction
    Float cos_t, reflectance, jacobian;
  };

  static NORRSKEN_INLINE Facet facet_between(const Parameters& p, const Vec3f& wo, const Vec3f& wi) {
    Facet f;
    f.reflects = wi.z > 0.0f;
    const Vec3f m = normalize(fma(wi, select(f.reflects, 1.0f, p.eta), wo));
    f.m = m * copysign(1.0f, m.z);
    f.cos_o = dot(wo, f.m), f.cos_i = dot(wi, f.m);
    f.possible = (wo.z > 0.0f) & (f.cos_o > 0.0f) & (f.cos_i * wi.z > 0.0f);
    const FresnelDielectric fresnel = fresnel_dielectric(f.cos_o, p.eta);
    f.reflectance = fresnel.reflectance, f.cos_t = fresnel.cos_t;
    // Walter et al. 2007, equations 14 and 17.
    const Float sum = fma(p.eta, f.cos_i, f.cos_o), cos_i = abs(f.cos_i);
    f.jacobian = select(f.reflects, 0.25f / cos_i, p.eta * p.eta * cos_i / (sum * sum));
    return f;
  }

  static NORRSKEN_INLINE Float transmitted_share(const Parameters& p, Float reflectance) {
    return select(p.front, p.glass, 1.0f) * (1.0f - reflectance);
  }

  struct LobeProbs {
    Float diffuse, clearcoat, specular;
  };

  /// By what each lobe sends to the viewer, were all facets turned to the surface's normal.
  static NORRSKEN_INLINE LobeProbs lobe_probs(const Parameters& p, const Vec3f& wo) {
    const FresnelDielectric fresnel = fresnel_dielectric(wo.z, p.eta);
    Facet flat;
    flat.reflectance = fresnel.reflectance, flat.cos_t = fresnel.cos_t, flat.cos_o = wo.z;
    const Float through = p.glass * (1.0f - flat.reflectance);
    // Not less than of glass: towards the rim all facets reflect, also those of a metal that is black.
    const Float outside = max(luminance(reflectance(p, flat)) + through, 0.04f);
    const Float facets = select(p.front, outside, zero_unless(p.glass > 0.0f, 1.0f));
    // Sheen is strongest where light grazes; a fifth of it is more than the mean anywhere but there.
    const Float color = fma(p.sheen * (1.0f - p.metallic), 0.2f, luminance(p.base_color));
    const Float coat = 0.25f * p.clearcoat * mix(schlick_weight(flat.cos_o, flat.cos_t, p.eta), 1.0f, 0.04f);
    const Float diffuse = zero_unless(p.front, p.base * color * p.diffuse_rate);
    const Float clearcoat = zero_unless(p.front, coat * p.clearcoat_rate), specular = facets * p.specular_rate;
    const Float scale = 1.0f / max(diffuse + clearcoat + specular, 1e-20f);
    return {diffuse * scale, clearcoat * scale, specular * scale};
  }

  static NORRSKEN_INLINE Float pdf_sa(const Parameters& p, const LobeProbs& probs, const Vec3f& wo, const Vec3f& wi,
                                      const Facet& f) {
    const Float transmitted = transmitted_share(p, f.reflectance);
    const Float share = probs.specular * select(f.reflects, 1.0f - transmitted, transmitted);
    Float facets = share * p.facets.visible_pdf_sa(wo, f.m);
    const Mask coated = f.reflects & (probs.clearcoat > 0.0f);
    if (any(coated)) facets += zero_unless(coated, probs.clearcoat * p.coat.density(f.m) * f.m.z);
    const Float diffuse = zero_unless(wo.z > 0.0f, probs.diffuse * cosine_hemisphere_pdf_sa(wi.z));
    return zero_unless(f.possible & (facets > 0.0f), facets * f.jacobian) + diffuse;
  }

  static NORRSKEN_INLINE Color evaluate(const Parameters& p, const Vec3f& wo, const Vec3f& wi, const Facet& f) {
    const Float masked = p.facets.density(f.m) * p.facets.masking(wo, f.m) * p.facets.masking(wi, f.m);
    const Mask reflects = f.possible & f.reflects & (p.eta != 1.0f);
    const Float reflected = zero_unless(reflects, masked * 0.25f / wo.z);
    Color value = reflectance(p, f) * reflected;

    const Mask refracts = f.possible & !f.reflects & (p.glass > 0.0f);
    if (any(refracts)) {
      // Radiance loses the eta^2 that the Jacobian gains.
      const Float facing = f.cos_o * f.jacobian / (p.eta * p.eta * wo.z);
      const Float through = zero_unless(refracts, p.glass * (1.0f - f.reflectance) * masked * facing);
      value = fma(Color{sqrt(p.base_color.r), sqrt(p.base_color.g), sqrt(p.base_color.b)}, through, value);
    }

    const Mask coated = f.possible & f.reflects & p.front & (p.clearcoat > 0.0f);
    if (any(coated)) {
      const Microfacet masks{0.25f, 0.25f, p.facets.ggx};
      const Float fresnel = mix(schlick_weight(f.cos_o, f.cos_t, p.eta), 1.0f, 0.04f);
      const Float coat =
          0.25f * p.clearcoat * fresnel * p.coat.density(f.m) * masks.masking(wo, f.m) * masks.masking(wi, f.m) * wi.z;
      value = value + grey(zero_unless(coated, coat));
    }

    const Mask above = (wo.z > 0.0f) & f.reflects & p.front & (p.base > 0.0f);
    const Float diffuse = p.base * kInvPi * diffuse_shape(p.roughness, p.flatness, wo.z, wi.z, f.cos_i);
    const Color sheen = sheen_color(p.base_color, p.sheen * (1.0f - p.metallic), p.sheen_tint, f.cos_i);
    return select(above, fma(fma(p.base_color, diffuse, sheen), wi.z, value), value);
  }

  /// Dielectric, metal by Schlick's approximation, and a tinted dielectric by the same.
  static NORRSKEN_INLINE Color reflectance(const Parameters& p, const Facet& f) {
    const Float weight = schlick_weight(f.cos_o, f.cos_t, p.eta), dielectric = 1.0f - p.metallic;
    const Color tinted = mix(tint_of(p.base_color) * normal_reflectance(p.eta), white(), weight);
    const Color mixed = mix(grey(f.reflectance), tinted, p.spec_tint) * dielectric;
    const Color outside = fma(mix(p.base_color, white(), weight), p.metallic, mixed);
    return select(p.front, outside, grey(p.glass * f.reflectance));
  }
};

}  // namespace norrsken::NORRSKEN_ISA
