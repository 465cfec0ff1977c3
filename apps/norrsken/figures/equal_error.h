// How many samples a rendering needs to be as right as another one.
#pragma once

#include <functional>
#include <vector>

namespace norrsken::cli {

/// A rendering's samples per pixel and its measured error, in any unit.
struct SppError {
  int spp = 0;
  double error = 0;
};

/// The samples per pixel at which `target` is expected, from at least one measurement with an error above 0. Takes
/// error = c spp^k through the two measurements nearest to the target; k = -1/2, the rate of independent samples, if
/// there is only one or if the two contradict each other (k outside [-1.5, -0.25]).
int predict_spp(std::vector<SppError> measured, double target);

/// Predicts and measures in turn, until the error is within `tolerance` (relative) of the target, `max_measurements`
/// are spent, or whole numbers of samples allow nothing better; gives the nearest measurement. `measured` must not be
/// empty and also counts.
SppError find_equal_error(double target, std::vector<SppError> measured, const std::function<double(int)>& measure,
                          double tolerance = 0.05, int max_measurements = 4);

}  // namespace norrsken::cli
