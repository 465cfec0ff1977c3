// The film as the accumulation stage writes it: sums in double precision, one plane after the other.
#pragma once

#include <cstddef>
#include <cstdint>

namespace norrsken {

/// Samples that were left out because their radiance was not finite: the first few, and how many in all.
struct DroppedSamples {
  static constexpr std::uint32_t kKept = 16;
  std::uint32_t pixel[kKept] = {};
  std::uint32_t sample[kKept] = {};
  std::uint64_t count = 0;

  void add(const DroppedSamples& other) {
    for (std::uint64_t i = 0; i < other.count && i < kKept && count + i < kKept; ++i) {
      pixel[count + i] = other.pixel[i];
      sample[count + i] = other.sample[i];
    }
    count += other.count;
  }
};

/// In a pixel's count: a sample was left out, so the count does not tell any more which replicates hold how many.
inline constexpr std::uint32_t kSomeDropped = 0x80000000u;

/// What is known of samples' first hits: planes of numbers, zero where nothing is hit. The first eight are those that
/// any scene can be asked for; the others are for scenes that name them.
enum Feature : std::uint32_t {
  kFeatureDepth,    ///< along the camera's axis
  kFeatureNormalX,  ///< shading normal on the side that is seen
  kFeatureNormalY,
  kFeatureNormalZ,
  kFeatureAlbedoRed,
  kFeatureAlbedoGreen,
  kFeatureAlbedoBlue,
  kFeatureObject,    ///< index of the shape, counted from 1
  kFeatureCoverage,  ///< 1 where something is hit
  kFeatureDistance,  ///< from the camera
  kFeaturePositionX,
  kFeaturePositionY,
  kFeaturePositionZ,
  kFeatureU,
  kFeatureV,
  kFeatureGeometricX,  ///< normal as the shape has it, whichever side is seen
  kFeatureGeometricY,
  kFeatureGeometricZ,
  kFeatureShadingX,  ///< shading normal, the same
  kFeatureShadingY,
  kFeatureShadingZ,
  kFeatureDpDuX,
  kFeatureDpDuY,
  kFeatureDpDuZ,
  kFeatureDpDvX,
  kFeatureDpDvY,
  kFeatureDpDvZ,
  kFeaturePrimitive,  ///< index within the shape
  kFeatureCount
};
/// Numbers that have no mean: those of the pixel's first sample are kept.
inline constexpr std::uint32_t kDiscreteFeatures = 1u << kFeatureObject | 1u << kFeaturePrimitive;
/// Those that need texture coordinates or tangents.
inline constexpr std::uint32_t kUvFeatures = (1u << kFeatureU | 1u << kFeatureV) | 63u << kFeatureDpDuX;
/// Normals that point as the shape has them, which is known where there are texture coordinates.
inline constexpr std::uint32_t kNormalFeatures = 63u << kFeatureGeometricX;

/// Planes of sums, each of two doubles: see base/exact_sum.h.
struct SumPlanes {
  double* high = nullptr;
  double* low = nullptr;
};

/// Planes of width * height values. What the sum planes hold depends on the sampler:
///   independent: sums of R, G, B, then sums of their squares (6 planes);
///   Sobol': for each replicate r the sums of R, G, B in planes 3 r, 3 r + 1, 3 r + 2 (3 * kReplicates planes).
/// Every pixel's samples are added one after the other in the order of their index, so the bits do not depend on how
/// the work was cut. Addends have 24 bits, so that ranges of samples can be added up as exactly.
struct FilmView {
  SumPlanes sums;
  std::uint32_t* counts = nullptr;  ///< samples that were added, per pixel; kSomeDropped says that others were not
  SumPlanes moments;                ///< 3 planes or none: weighted sums of the squares of X, Y and Z
  SumPlanes features;               ///< weighted sums, one plane for each bit of `feature_mask`
  std::uint32_t feature_mask = 0;
  std::uint32_t width = 0, height = 0;
  bool weighted = false;  ///< samples carry weights of the reconstruction filter

  std::size_t pixels() const { return static_cast<std::size_t>(width) * height; }
  double* sum_plane(std::uint32_t k) const { return sums.high + k * pixels(); }
};

}  // namespace norrsken
