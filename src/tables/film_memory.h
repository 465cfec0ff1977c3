// How much memory a film and its image take.
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

/// Sums that a film has of each pixel's samples: with their squares, or by replicate.
constexpr std::uint32_t radiance_planes(SamplerKind sampler) {
  return sampler == SamplerKind::independent ? 6 : 3 * kReplicates;
}

/// Bytes per pixel: a count, and two doubles for each sum.
inline std::uint64_t film_bytes_per_pixel(const FilmSettings& settings, SamplerKind sampler, const SceneLayers& layers,
                                          bool from_lights) {
  const auto features = static_cast<std::uint64_t>(std::popcount(feature_mask(settings, layers)));
  const std::uint64_t sums =
      radiance_planes(sampler) + features + (layers.moments.empty() ? 0 : 3) + (from_lights ? 3 * kLightReplicates : 0);
  return sizeof(std::uint32_t) + 2 * sizeof(double) * sums;
}

/// Bytes per pixel of the image that a film becomes, with every layer that may be asked for, and of writing it.
inline std::uint64_t image_bytes_per_pixel(const FilmSettings& settings, const SceneLayers& layers) {
  // R, G, B, their variances, errors and intervals, and the number of samples.
  const std::uint64_t channels = 13 + (settings.has_alpha() ? 1 : 0) + layers.features.size() +
                                 4 * layers.image_copies.size() + 6 * layers.moments.size();
  // Three other floats or four halves for an EXR file, three bytes for others.
  constexpr std::uint64_t kWriting = 3 * sizeof(float) + 3;
  return channels * sizeof(float) + kWriting;
}

}  // namespace norrsken
