// The one table of random dimensions. A random number is addressed by (pixel, sample, dimension) and never streamed.
// A set that is used together (a point of the light, a direction) takes as many dimensions as it has numbers.
#pragma once

#include <cstdint>

namespace norrsken {

namespace camera_dimension {
inline constexpr std::uint32_t kFilm = 0;  // 2: where in the pixel
inline constexpr std::uint32_t kLens = 2;  // 2: where on the lens
}  // namespace camera_dimension

/// In place of the camera's, for paths that start at a light.
namespace emission_dimension {
inline constexpr std::uint32_t kLight = 0;      // 2: which light
inline constexpr std::uint32_t kPosition = 2;   // 2: where on it
inline constexpr std::uint32_t kDirection = 4;  // 2
}  // namespace emission_dimension

/// Per surface hit; hit 1 is that of the path's first ray.
namespace hit_dimension {
inline constexpr std::uint32_t kLight = 0;          // 2: which light
inline constexpr std::uint32_t kLightPosition = 2;  // 2: where on it
inline constexpr std::uint32_t kLens = 2;           // 2: where on the lens; paths from lights sample no lights
inline constexpr std::uint32_t kBsdfLobe = 4;       // 1: which part of the BSDF
inline constexpr std::uint32_t kBsdfDirection = 5;  // 2
inline constexpr std::uint32_t kRoulette = 7;       // 1
inline constexpr std::uint32_t kMaterial = 8;       // 1: which of the BSDFs behind a mask or a blend
inline constexpr std::uint32_t kDistance = 9;       // 1: how far to the next place in a medium that scatters
inline constexpr std::uint32_t kCount = 10;         // even: pairs stay pairs
}  // namespace hit_dimension

constexpr std::uint32_t first_dimension_of_hit(std::uint32_t hit) { return hit * hit_dimension::kCount; }

/// What is gone straight through on the way to a hit is met in rounds, each with a set of dimensions of its own: those of
/// the ray itself are first, those of its hit's shadow rays behind kShadowRounds.
inline constexpr std::uint32_t kMostRounds = 1u << 12, kShadowRounds = kMostRounds;
constexpr std::uint32_t first_dimension_of_round(std::uint32_t hit, std::uint32_t round) {
  return first_dimension_of_hit(hit) + (round << 18);
}

}  // namespace norrsken
