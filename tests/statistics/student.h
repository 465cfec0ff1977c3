// Student's t distribution and Sidak's correction: what a deviation measured in standard errors is worth.
#pragma once

namespace norrsken::statistics {

/// Regularized incomplete beta function I_x(a, b) for x in [0, 1] and a, b > 0.
double incomplete_beta(double a, double b, double x);

/// Probability that |t| exceeds `t` >= 0 with `freedom` > 0 degrees of freedom, which need not be whole.
double student_two_sided(double t, double freedom);

/// The t that is exceeded, in absolute value, with probability `level` in (0, 1).
double student_critical(double level, double freedom);

/// The level of one of `comparisons` independent tests such that all of them together falsely reject with
/// probability `level` (Sidak 1967).
double sidak_level(double level, int comparisons);

}  // namespace norrsken::statistics
