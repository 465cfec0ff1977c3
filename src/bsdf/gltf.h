// Model       The layers of glTF's materials: a clear coat over sheen over a mixture of metal and dielectric, which is diffuse
//             or lets light through below its reflection.
// Measure     pdf_sa: cosine-weighted, and from visible normals of the coat and of the facets, each as often as it is
//             bright from where the surface is seen
// Source      glTF 2.0, appendix B, and its extensions KHR_materials_specular, _ior, _transmission, _volume, _clearcoat and
//             _sheen, with the visibility of Ashikhmin and Premoze, "Distribution-based BRDFs", 2007
// Departures  what the coat takes from what is below is the more of both directions, so that the model is reciprocal, as
//             the specification has it for sheen; sheen's albedo is a fit, within 0.06; light inside is reflected by the
//             angle outside, all of it beyond the critical one; facets have a slope of at least 0.001. As in the
//             specification dielectrics, smooth ones most, and sheen give back more than arrives at grazing angles
#pragma once

#include "bsdf/bsdf.h"
#include "bsdf/principled_lobes.h"

namespace norrsken::NORRSKEN_ISA {

struct Gltf {
  static constexpr bool kDelta = false;
  static constexpr bool kUsesLobe = true;

  struct Parameters {
    Color base_color, f0;  ///< f0, f90: what the dielectric reflects head on and at grazing angles
    Float f90;
    Microfacet facets, coat;
    Color sheen;
    Float sheen_roughness;
    Float metallic, transmission, clearcoat;
    Float eta;  ///< of the other side over this side
    Mask thin;  ///< what passes goes straight on, and both sides are the same
    Mask front;
  };

  struct Stored {
    static constexpr BsdfKind kKind = BsdfKind::gltf;
    ColorSlot base_color, vertex_color, specular_color, sheen_color;
    NumberSlot metallic, roughness, specular, transmission, clearcoat, clearcoat_roughness, sheen_roughness;
    float f0;  ///< by the index of refraction alone
    float eta;
    float is_thin, is_back;  ///< 1 if it is
  };

  static NORRSKEN_INLINE Parameters load(const ParameterReader& r) {
    Parameters p;
    p.base_color = r.get(&Stored::base_color) * r.get(&Stored::vertex_color);
    const Float specular = r.get(&Stored::specular);
    const Color f0 = r.get(&Stored::specular_color) * r.get(&Stored::f0);
    p.f0 = Color{min(f0.r, 1.0f), min(f0.g, 1.0f), min(f0.b, 1.0f)} * specular, p.f90 = specular;
    p.facets = facets_of(r.get(&Stored::roughness), 0.0f);
    p.coat = facets_of(r.get(&Stored::clearcoat_roughness), 0.0f);
    p.thin = r.get(&Stored::is_thin) != 0.0f, p.front = r.get(&Stored::is_back) == 0.0f;
    p.metallic = r.get(&Stored::metallic), p.clearcoat = r.get(&Stored::clearcoat);
    p.sheen = r.get(&Stored::sheen_color), p.sheen_roughness = max(r.get(&Stored::sheen_roughness), 0.07f);
    p.transmission = r.get(&Stored::transmission);
    p.eta = r.get(&Stored::eta);
    return p;
  }

  static NORRSKEN_INLINE Color evaluate(const Parameters& p, const Vec3f& wo, const Vec3f& wi) {
    return evaluate(p, wo, wi, facet_between(p, wo, wi));
  }
  static NORRSKEN_INLINE Float pdf_sa(const Parameters& p, const Vec3f& wo, const Vec3f& wi) {
    return pdf_sa(p, wo, wi, facet_between(p, wo, wi), probs_of(p, wo));
  }

  static NORRSKEN_INLINE BsdfSample sample(const Parameters& p, const Vec3f& wo, Float lobe, Vec2f direction) {
    const Probs probs = probs_of(p, wo);
    const Mask diffuse = lobe < probs.diffuse;
    const Mask coat = (!diffuse) & (lobe < probs.diffuse + probs.coat);
    const Mask through = (!(diffuse | coat)) & (lobe < probs.diffuse + probs.coat + probs.through);
    Vec3f m = p.facets.sample_visible(wo, direction);
    if (any(coat)) m = select(coat, p.coat.sample_visible(wo, direction), m);
    const Float cos_o = dot(wo, m);
    Vec3f wi = reflect(wo, m, cos_o);
    Mask is_there = !Mask::none();  // a direction to refract to
    if (any(through)) {
      const FresnelDielectric fresnel = fresnel_dielectric(cos_o, p.eta);
      wi = select(through & p.thin, Vec3f{wi.x, wi.y, -wi.z}, wi);
      wi = select(through & !p.thin, refract(wo, m, cos_o, fresnel.cos_t, p.eta), wi);
      is_there = p.thin | (fresnel.cos_t > 0.0f);
    }
    wi = select(diffuse, warp_to_cosine_hemisphere(direction), wi);

    const Facet f = facet_between(p, wo, wi);
    const Float pdf = pdf_sa(p, wo, wi, f, probs);
    const Mask valid = (pdf > 0.0f) & (diffuse | f.possible) & (through ^ (wi.z > 0.0f)) & (is_there | !through);
    const Mask bends = through & !p.thin;
    return {wi, evaluate(p, wo, wi, f) * (1.0f / select(valid, pdf, 1.0f)), pdf, valid, select(bends, p.eta, 1.0f)};
  }

  static NORRSKEN_INLINE Float refracted_eta(const Parameters& p) { return select(p.thin, 1.0f, p.eta); }

  static NORRSKEN_INLINE Color albedo(const Parameters& p) { return p.base_color; }

 private:
  struct Probs {
    Float diffuse, coat, through;  ///< diffuse: and sheen; the rest is reflection by facets
  };
  /// A facet that sends light from wi to wo.
  struct Facet {
    Vec3f m;
    Mask reflects, possible;
    Float cos_o, jacobian;
    Color dielectric;  ///< share of the light that it reflects
    Float below;       ///< and that it does not: of all colours the same
  };

  static NORRSKEN_INLINE Float coat_reflectance(Float cosine) { return mix(0.04f, 1.0f, schlick_weight(cosine)); }

  /// Share of the light that white sheen gives back. Fitted to the integral over roughness from 0.15 on.
  static NORRSKEN_INLINE Float sheen_albedo(const Parameters& p, Float cosine) {
    const Float r = max(p.sheen_roughness, 0.15f), inv_r = 1.0f / r;
    const auto over_roughness = [&](float constant, float linear, float inverse) {
      return fma(r, linear, fma(inv_r, inverse, constant));
    };
    const Float exponent =
        fma(cosine, fma(cosine, over_roughness(-1.1149f, 1.0026f, 0.2867f), over_roughness(0.0966f, -0.1524f, -1.381f)),
            over_roughness(-0.2035f, -0.5763f, 0.1798f));
    return min(exp(exponent), 1.0f);
  }

  /// Sheen's f over its colour, for the normal m halfway: Charlie's distribution, with its visibility.
  static NORRSKEN_INLINE Float sheen_lobe(const Parameters& p, const Vec3f& m, Float cos_o, Float cos_i) {
    const Float inv_alpha = 1.0f / (p.sheen_roughness * p.sheen_roughness);
    const Float sin2 = max(fnma(m.z, m.z, 1.0f), 1e-7f);
    const Float density = (2.0f + inv_alpha) * pow(sin2, 0.5f * inv_alpha) * (0.5f * kInvPi);
    return density * 0.25f / max(fnma(cos_o, cos_i, cos_o + cos_i), 1e-6f);
  }

  static NORRSKEN_INLINE Color dielectric_reflectance(const Parameters& p, Float cos_i) {
    const FresnelDielectric fresnel = fresnel_dielectric(cos_i, p.eta);
    const Mask inside = !(p.front | p.thin);
    const Float cosine = select(inside & (p.eta < 1.0f), fresnel.cos_t, cos_i);
    const Color part = mix(p.f0, grey(p.f90), schlick_weight(cosine));
    return select(inside & !(fresnel.cos_t > 0.0f), white(), part);
  }

  static NORRSKEN_INLINE Color metal_reflectance(const Parameters& p, Float cosine) {
    return mix(p.base_color, white(), schlick_weight(cosine));
  }

  static NORRSKEN_INLINE Probs probs_of(const Parameters& p, const Vec3f& wo) {
    const Color reflected = dielectric_reflectance(p, wo.z);
    const Float metal = select(p.front, p.metallic, 0.0f), dielectric = 1.0f - p.metallic;
    // Facets that are met less obliquely than the surface reflect less.
    const Float below = dielectric * max_component(p.base_color) * max(1.0f - max_component(reflected), 0.1f);
    const Float sheen = zero_unless(p.front, max_component(p.sheen) * sheen_albedo(p, wo.z));
    const Float diffuse = fma(below, 1.0f - p.transmission, sheen), through = below * p.transmission;
    const Float coat = zero_unless(p.front, p.clearcoat * coat_reflectance(wo.z));
    const Float facets = fma(metal, max_component(metal_reflectance(p, wo.z)), dielectric * max_component(reflected));
    const Float others = diffuse + through + coat;
    const Float scale = 1.0f / (others + max(facets, fma(others, 0.1f, 1e-4f)));
    return {diffuse * scale, coat * scale, through * scale};
  }

  static NORRSKEN_INLINE Facet facet_between(const Parameters& p, const Vec3f& wo, const Vec3f& wi) {
    Facet f;
    f.reflects = wi.z > 0.0f;
    const Mask straight = f.reflects | p.thin;
    const Vec3f mirrored{wi.x, wi.y, select(p.thin, abs(wi.z), wi.z)};
    const Vec3f m = normalize(fma(mirrored, select(straight, 1.0f, p.eta), wo));
    f.m = m * copysign(1.0f, m.z);
    f.cos_o = dot(wo, f.m);
    const Float cos_i = dot(mirrored, f.m);
    f.possible = (wo.z > 0.0f) & (f.cos_o > 0.0f) & (cos_i * mirrored.z > 0.0f);
    // Walter et al. 2007, equations 14 and 17.
    const Float sum = fma(p.eta, cos_i, f.cos_o), facing = abs(cos_i);
    f.jacobian = select(straight, 0.25f / facing, p.eta * p.eta * facing / (sum * sum));
    f.dielectric = dielectric_reflectance(p, f.cos_o);
    f.below = max(1.0f - max_component(f.dielectric), 0.0f);
    return f;
  }

  static NORRSKEN_INLINE Float pdf_sa(const Parameters& p, const Vec3f& wo, const Vec3f& wi, const Facet& f,
                                      const Probs& probs) {
    const Float reflected = 1.0f - probs.diffuse - probs.coat - probs.through;
    Float facets = select(f.reflects, reflected, probs.through) * p.facets.visible_pdf_sa(wo, f.m);
    const Mask coated = f.reflects & (probs.coat > 0.0f);
    if (any(coated)) facets += zero_unless(coated, probs.coat * p.coat.visible_pdf_sa(wo, f.m));
    const Float diffuse = zero_unless(wo.z > 0.0f, probs.diffuse * cosine_hemisphere_pdf_sa(wi.z));
    return zero_unless(f.possible & (facets > 0.0f), facets * f.jacobian) + diffuse;
  }

  static NORRSKEN_INLINE Color evaluate(const Parameters& p, const Vec3f& wo, const Vec3f& wi, const Facet& f) {
    const Vec3f other{wi.x, wi.y, select(p.thin, abs(wi.z), wi.z)};
    const Float masked = p.facets.density(f.m) * p.facets.masking(wo, f.m) * p.facets.masking(other, f.m);
    const Float metal = select(p.front, p.metallic, 0.0f), dielectric = 1.0f - p.metallic;
    const Float mirrored = zero_unless(f.possible & f.reflects, masked * 0.25f / wo.z);
    Color value = fma(metal_reflectance(p, f.cos_o), metal, f.dielectric * dielectric) * mirrored;

    const Mask above = (wo.z > 0.0f) & f.reflects;
    const Float below = dielectric * f.below;
    const Float diffuse = zero_unless(above, below * (1.0f - p.transmission) * kInvPi * wi.z);
    value = fma(p.base_color, diffuse, value);

    const Mask through = f.possible & !f.reflects & (p.transmission > 0.0f);
    if (any(through)) {
      // Radiance loses the eta^2 that the Jacobian gains.
      const Float bent = f.cos_o * f.jacobian / (p.eta * p.eta * wo.z);
      const Float shape = masked * select(p.thin, 0.25f / wo.z, bent);
      value = fma(p.base_color, zero_unless(through, below * p.transmission * shape), value);
    }

    // What lies above is met from outside alone.
    const Mask covered = p.front | !f.reflects;
    const Float both = min(wo.z, abs(wi.z)), one = select(p.front, wo.z, abs(wi.z));
    const Float outside = select(f.reflects | p.thin, both, one);
    const Mask has_sheen = covered & (max_component(p.sheen) > 0.0f);
    if (any(has_sheen)) {
      const Float taken = max_component(p.sheen) * sheen_albedo(p, outside);
      value = select(has_sheen, value * max(1.0f - taken, 0.0f), value);
      const Float sheen = sheen_lobe(p, f.m, wo.z, wi.z) * wi.z;
      value = fma(p.sheen, zero_unless(has_sheen & above, sheen), value);
    }
    const Mask coated = covered & (p.clearcoat > 0.0f);
    if (any(coated)) {
      value = select(coated, value * fnma(p.clearcoat, coat_reflectance(outside), 1.0f), value);
      const Float coat = p.clearcoat * coat_reflectance(f.cos_o) * p.coat.density(f.m) * p.coat.masking(wo, f.m) *
                         p.coat.masking(wi, f.m) * 0.25f / wo.z;
      value = value + grey(zero_unless(coated & f.possible & f.reflects, coat));
    }
    return value;
  }
};

}  // namespace norrsken::NORRSKEN_ISA
