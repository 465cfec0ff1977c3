// Multiple importance sampling of light: shadow rays to sampled lights against sampled directions that find lights.
// Source: Veach, "Robust Monte Carlo Methods for Light Transport Simulation", 1997, eq. 9.13 (power heuristic, beta 2).
#pragma once

#include "light/sample_lights.h"
#include "wave/slots.h"

namespace norrsken::NORRSKEN_ISA {

/// Weight of a sample drawn from `count` samples of density `pdf` where `other_count` samples of `other` compete.
NORRSKEN_INLINE Float power_heuristic(Float count, Float pdf, Float other_count, Float other) {
  // As a ratio, so that squares of large densities do not overflow.
  const Float ratio = (other_count * other) / (count * pdf);
  return 1.0f / fma(ratio, ratio, 1.0f);
}

/// The lanes whose ray may find what light sampling finds too.
NORRSKEN_INLINE Mask competed(const Ray& ray, Mask active) { return active & (ray.pdf_sa > 0.0f); }

/// Where light was sampled that a ray may find: where its path last scattered, however many boundaries of media lie between.
NORRSKEN_INLINE Vec3f light_reference(const SceneView& scene, const Ray& ray) {
  return scene.volumetric ? fma(ray.direction, -ray.travelled, ray.origin) : ray.origin;
}

/// The weight of what a ray found that light sampling finds with this density: 1 where it does not compete.
NORRSKEN_INLINE Float weight_of_found(const SceneView& scene, const Ray& ray, Float light_pdf, Mask competed) {
  const Float light_samples(static_cast<float>(scene.integrator.emitter_samples));
  const Float bsdf_samples(static_cast<float>(scene.integrator.bsdf_samples));
  return select(competed, power_heuristic(bsdf_samples, ray.pdf_sa, light_samples, light_pdf), 1.0f);
}

}  // namespace norrsken::NORRSKEN_ISA
