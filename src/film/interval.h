// How far a pixel may be off: 95 % confidence intervals.
//
// A pixel's own variance estimate is not enough. It has few degrees of freedom (three with Sobol' points), and most of a
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

/// Of one channel, row by row: half the width of each pixel's interval; NaN where not even the neighbours' variances are
/// known. `variances` are those of the pixels' means, NaN where unknown, and `samples` how many are in each, by which
/// variances of means compare.
std::vector<float> confidence_intervals(std::uint32_t width, std::uint32_t height, std::span<const float> variances,
                                        std::span<const float> samples);

}  // namespace norrsken
