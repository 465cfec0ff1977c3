// How far a pixel may be off: 95 % confidence intervals.
//
// A pixel's own variance estimate is not enough. It has few degrees of freedom (one with Sobol' points), and most of a
// pixel's noise may come from paths so rare that it has not seen one yet, its samples then agreeing on a value that is too
// low. Its neighbours have seen some. So each variance is moderated by those around it, as Smyth does with the variances
// of many genes (Linear Models and Empirical Bayes Methods for Assessing Differential Expression, 2004, section 3); the
// error is then taken as normal.
//
// The constants are fitted: of the choices that were measured on the hexagon room and on gallery scenes, with both samplers
// and 16 and 64 samples per pixel, these hold 95 % best (tests/calibration).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace norrsken {

/// The neighbours by which a variance is moderated.
struct Neighbors {
  std::uint32_t reach;  ///< how far they are away at most, in pixels
  float share;          ///< of their variance in a pixel's
};
/// Where a pixel has two replicates, its own variance says little.
inline constexpr Neighbors kNeighborsOfReplicates{.reach = 7, .share = 0.9f};
inline constexpr Neighbors kNeighborsOfSamples{.reach = 5, .share = 0.85f};

/// Of one channel, row by row: half the width of each pixel's interval; NaN where not even the neighbours' variances are
/// known. `variances` are those of the pixels' means, NaN where unknown, and `samples` how many are in each, by which
/// variances of means compare.
std::vector<float> confidence_intervals(std::uint32_t width, std::uint32_t height, std::span<const float> variances,
                                        std::span<const float> samples, const Neighbors& neighbors);

/// Of the error of a whole image, which is estimated as the root of its pixels' added up variances: how many times too small
/// or too large that may be, with a probability of 95 % or more that it is no worse. `pixels` is the square of the sum of
/// the variances over the sum of their squares: as many equally noisy pixels as would make the same noise.
///
/// Both the true squared error and the estimate are sums over those pixels, taken as chi-square with so many degrees of
/// freedom each (Satterthwaite, An Approximate Distribution of Estimates of Variance Components, 1946): F with equal
/// degrees on both sides. For normal noise and two replicates that is so; independent samples would give the estimate more
/// degrees, but where a few pixels have most of the noise it is not normal, and the greatest variance may be
/// underestimated and not show. On the safe side for ordinary images, where it is narrow anyway (tests/calibration).
double error_uncertainty(double pixels);

}  // namespace norrsken
