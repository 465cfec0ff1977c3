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

/// The weight of what a ray found on `light`, `distance` away: 1 where no light sampling competes with it.
NORRSKEN_INLINE Float weight_of_found(const SceneView& scene, UInt light, const Ray& ray, Float distance, Mask active) {
  const Mask competed = active & (ray.pdf_sa > 0.0f);
  if (none(competed)) return 1.0f;
  const Float light_samples(static_cast<float>(scene.integrator.emitter_samples));
  const Float bsdf_samples(static_cast<float>(scene.integrator.bsdf_samples));
  // Light was sampled where the path last scattered, however many boundaries of media lie between.
  Vec3f reference = ray.origin;
  if (scene.volumetric) {
    reference = fma(ray.direction, -ray.travelled, reference);
    distance = distance + ray.travelled;
  }
  const Float light_pdf = light_pdf_sa(scene, light, copied(reference), copied(ray.direction), distance, competed);
  return select(competed, power_heuristic(bsdf_samples, ray.pdf_sa, light_samples, light_pdf), 1.0f);
}

}  // namespace norrsken::NORRSKEN_ISA
