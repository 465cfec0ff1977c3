// Model       Disney's material for thin sheets, such as leaves and paper: light passes without being bent, both sides alike.
// Measure     pdf_sa: cosine-weighted on either side, and from visible normals on either side
// Source      Burley 2012 and 2015 (roughness behind the sheet: figure 15), see principled_lobes.h
// Departures  none from Mitsuba 3: sheen may give back more than arrives, and so may a white base at slanting angles, by up
//             to 2 %; specular transmission is not reciprocal, since facets that face away from where light really goes
//             transmit none
#pragma once

#include "bsdf/bsdf.h"
#include "bsdf/principled_lobes.h"

namespace norrsken::NORRSKEN_ISA {

struct PrincipledThin {
  static constexpr bool kDelta = false;
  static constexpr bool kUsesLobe = true;

  struct Parameters {
    Color base_color;
    Microfacet facets, facets_behind;
    Float roughness, spec_trans, spec_tint, sheen, sheen_tint, flatness, eta;
    Float reflected, transmitted;  ///< weights of what is diffuse
    Float specular_reflection_prob, specular_transmission_prob, reflection_prob, transmission_prob;
  };

  struct Stored {
    static constexpr BsdfKind kKind = BsdfKind::principledthin;
    ColorSlot base_color;
    NumberSlot roughness, anisotropic, spec_trans, spec_tint, sheen, sheen_tint, flatness, eta, diff_trans;
    float specular_reflection_rate, specular_transmission_rate, reflection_rate, transmission_rate;
  };

  static NORRSKEN_INLINE Parameters load(const ParameterReader& r) {
    Parameters p;
    p.base_color = r.get(&Stored::base_color), p.roughness = r.get(&Stored::roughness), p.eta = r.get(&Stored::eta);
    const Float anisotropic = r.get(&Stored::anisotropic);
    p.facets = facets_of(p.roughness, anisotropic);
    p.facets_behind = facets_of(p.roughness * fma(p.eta, 0.65f, -0.35f), anisotropic);
    p.spec_trans = r.get(&Stored::spec_trans), p.spec_tint = r.get(&Stored::spec_tint);
    p.sheen = r.get(&Stored::sheen), p.sheen_tint = r.get(&Stored::sheen_tint);
    p.flatness = r.get(&Stored::flatness);
    const Float through = r.get(&Stored::diff_trans) * 0.5f, diffuse = 1.0f - p.spec_trans;
    p.reflected = diffuse * (1.0f - through), p.transmitted = diffuse * through;
    const Float half = 0.5f * p.spec_trans;
    const Float probs[] = {
        half * r.get(&Stored::specular_reflection_rate), half * r.get(&Stored::specular_transmission_rate),
        p.reflected * r.get(&Stored::reflection_rate), p.transmitted * r.get(&Stored::transmission_rate)};
    const Float scale = 1.0f / max(probs[0] + probs[1] + probs[2] + probs[3], 1e-20f);
    p.specular_reflection_prob = probs[0] * scale, p.specular_transmission_prob = probs[1] * scale;
    p.reflection_prob = probs[2] * scale, p.transmission_prob = probs[3] * scale;
    return p;
  }

  static NORRSKEN_INLINE Color evaluate(const Parameters& p, const Vec3f& wo, const Vec3f& wi) {
    const Facet f = facet_between(wo, wi);
    const Microfacet facets = facets_on_side(p, f.reflects);
    const Float fresnel = fresnel_dielectric(f.cos_o, p.eta).reflectance;
    const Float masked = facets.density(f.m) * facets.masking(wo, f.m) * facets.masking(wi, f.m);
    const Float specular = zero_unless(f.possible, p.spec_trans * masked * 0.25f / wo.z);
    const Color transmittance = p.base_color * (1.0f - fresnel);
    const Color value = select(f.reflects, reflectance(p, f.cos_o, fresnel), transmittance) * specular;

    const Float cos_i = abs(wi.z);
    const Float cos_d = dot(wi, f.m);
    const Float shape = diffuse_shape(p.roughness, p.flatness, wo.z, cos_i, cos_d);
    const Float diffuse = select(f.reflects, p.reflected * shape, p.transmitted) * kInvPi;
    const Color sheen = sheen_color(p.base_color, zero_unless(f.reflects, p.sheen * p.reflected), p.sheen_tint, cos_d);
    const Float lit = zero_unless(wo.z > 0.0f, cos_i);
    return fma(fma(p.base_color, diffuse, sheen), lit, value);
  }

  static NORRSKEN_INLINE Float pdf_sa(const Parameters& p, const Vec3f& wo, const Vec3f& wi) {
    const Facet f = facet_between(wo, wi);
    const Float prob = select(f.reflects, p.specular_reflection_prob, p.specular_transmission_prob);
    // Walter et al. 2007, equation 14.
    const Float specular = prob * facets_on_side(p, f.reflects).visible_pdf_sa(wo, f.m) * 0.25f / f.cos_o;
    const Float diffuse = select(f.reflects, p.reflection_prob, p.transmission_prob) * abs(wi.z) * kInvPi;
    return zero_unless(f.possible & (prob > 0.0f), specular) + zero_unless(wo.z > 0.0f, diffuse);
  }

  static NORRSKEN_INLINE BsdfSample sample(const Parameters& p, const Vec3f& wo, Float lobe, Vec2f direction) {
    const Float specular = p.specular_reflection_prob + p.specular_transmission_prob;
    const Mask from_facets = lobe < specular;
    const Mask reflects =
        select(from_facets, p.specular_reflection_prob - lobe, specular + p.reflection_prob - lobe) > 0.0f;
    const Vec3f m = facets_on_side(p, reflects).sample_visible(wo, direction);
    const Vec3f mirrored = reflect(wo, m, dot(wo, m));
    const Vec3f above = select(from_facets, mirrored, warp_to_cosine_hemisphere(direction));
    const Vec3f wi{above.x, above.y, select(reflects, above.z, -above.z)};
    const Float pdf = pdf_sa(p, wo, wi);
    // Facets that face away may lead where the diffuse lobe has a density.
    const Mask possible = (!from_facets) | facet_between(wo, wi).possible;
    const Mask valid = (pdf > 0.0f) & possible & (above.z > 0.0f);
    return {wi, evaluate(p, wo, wi) * (1.0f / select(valid, pdf, 1.0f)), pdf, valid};
  }

  static NORRSKEN_INLINE Mask transmits(const Parameters&) { return !Mask::none(); }

  static NORRSKEN_INLINE Color albedo(const Parameters& p) { return p.base_color; }

 private:
  /// The facet that reflects wi, or what it came from before it was turned to the other side, to wo.
  struct Facet {
    Vec3f m;
    Mask reflects, possible;
    Float cos_o;
  };

  static NORRSKEN_INLINE Facet facet_between(const Vec3f& wo, const Vec3f& wi) {
    Facet f;
    f.m = normalize(wo + Vec3f{wi.x, wi.y, abs(wi.z)});
    f.reflects = wi.z > 0.0f;
    f.cos_o = dot(wo, f.m);
    f.possible = (wo.z > 0.0f) & (f.cos_o > 0.0f) & (dot(wi, f.m) * wi.z > 0.0f);
    return f;
  }

  static NORRSKEN_INLINE Microfacet facets_on_side(const Parameters& p, Mask reflects) {
    return {select(reflects, p.facets.alpha_u, p.facets_behind.alpha_u),
            select(reflects, p.facets.alpha_v, p.facets_behind.alpha_v), p.facets.ggx};
  }

  static NORRSKEN_INLINE Color reflectance(const Parameters& p, Float cos_o, Float fresnel) {
    const Float weight = schlick_weight(cos_o, fresnel_dielectric(cos_o, p.eta).cos_t, p.eta);
    const Color tinted = mix(tint_of(p.base_color) * normal_reflectance(p.eta), white(), weight);
    return mix(grey(fresnel), tinted, p.spec_tint);
  }
};

}  // namespace norrsken::NORRSKEN_ISA
