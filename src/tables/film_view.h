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
};

/// In a pixel's count: a sample was left out, so the count does not tell any more which replicates hold how many.
inline constexpr std::uint32_t kSomeDropped = 0x80000000u;

/// Planes of width * height values. What the sum planes hold depends on the sampler:
///   independent: sums of R, G, B, then sums of their squares (6 planes);
///   Sobol': for each replicate r the sums of R, G, B in planes 3 r, 3 r + 1, 3 r + 2 (3 * kReplicates planes).
/// Every pixel's samples are added one after the other in the order of their index, so the bits do not depend on how
/// the work was cut.
struct FilmView {
  double* sums = nullptr;
  std::uint32_t* counts = nullptr;  ///< samples that were added, per pixel; kSomeDropped says that others were not
  float* features = nullptr;  ///< 8 planes or null: depth, normal XYZ, albedo RGB (sums), object id (first sample)
  std::uint32_t width = 0, height = 0;
  bool weighted = false;  ///< samples carry weights of the reconstruction filter

  std::size_t pixels() const { return static_cast<std::size_t>(width) * height; }
  double* sum_plane(std::uint32_t k) const { return sums + k * pixels(); }
};

}  // namespace norrsken
