// How much memory a film takes.
#pragma once

#include <bit>
#include <cstdint>

#include "tables/layers.h"
#include "tables/scene_tables.h"
#include "tables/wave_types.h"

namespace norrsken {

/// The features whose planes a film has, one bit each.
inline std::uint32_t feature_mask(const FilmSettings& settings, const SceneLayers& layers) {
  std::uint32_t mask = settings.has_alpha() ? 1u << kFeatureCoverage : 0u;
  for (const FeatureLayer& layer : layers.features) mask |= 1u << layer.feature;
  return mask;
}

/// Bytes per pixel, with the sampler that needs more: a count, and two doubles for each sum.
inline std::uint64_t film_bytes_per_pixel(const FilmSettings& settings, const SceneLayers& layers, bool from_lights) {
  constexpr std::uint64_t kImages = 3 * kReplicates;
  const auto features = static_cast<std::uint64_t>(std::popcount(feature_mask(settings, layers)));
  const std::uint64_t sums = kImages + features + (layers.moments.empty() ? 0 : 3) + (from_lights ? kImages : 0);
  return sizeof(std::uint32_t) + 2 * sizeof(double) * sums;
}

}  // namespace norrsken
