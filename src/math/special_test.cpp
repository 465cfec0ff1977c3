// The lane functions of special.h on every instruction set that this processor runs, against the C library in double.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <vector>

#include "base/aligned.h"
#include "isa/entry.h"
#include "math/special_testing.h"

namespace norrsken {

#define NORRSKEN_BUILT_ISA(space)          \
  namespace space {                        \
  extern const SpecialCheck kSpecialCheck; \
  }
#include "isa/built.def"
#undef NORRSKEN_BUILT_ISA

namespace {

constexpr float kInf = std::numeric_limits<float>::infinity();

std::vector<const SpecialCheck*> usable_checks() {
  std::vector<const SpecialCheck*> checks;
  for (const SpecialCheck* check : {
#define NORRSKEN_BUILT_ISA(space) &space::kSpecialCheck,
#include "isa/built.def"
#undef NORRSKEN_BUILT_ISA
       }) {
    if (find_kernels(check->name) != nullptr) checks.push_back(check);
  }
  return checks;
}

std::vector<float> evaluate(const SpecialCheck& check, SpecialFunction f, const std::vector<float>& a,
                            const std::vector<float>& b) {
  const std::size_t padded = (a.size() + 15) / 16 * 16;
  AlignedVector<float> in(padded), in2(padded), out(padded);
  for (std::size_t i = 0; i < a.size(); ++i) in[i] = a[i], in2[i] = b.empty() ? 0.0f : b[i];
  check.evaluate(f, in.data(), in2.data(), out.data(), static_cast<std::uint32_t>(padded));
  return {out.begin(), out.begin() + static_cast<std::ptrdiff_t>(a.size())};
}

/// Distance from `wanted` in units of its last place as a float.
double ulps(float got, double wanted) {
  if (std::isnan(wanted) || std::isinf(static_cast<float>(wanted)) || std::isinf(got)) {
    return got == static_cast<float>(wanted) || (std::isnan(got) && std::isnan(wanted)) ? 0.0 : 1e30;
  }
  const double size = std::max(std::abs(wanted), 0x1p-126);
  return std::abs(double(got) - wanted) / std::ldexp(1.0, std::ilogb(size) - 23);
}

/// Every instruction set stays within `bound` ulps of the double function, which may depend on the arguments.
void expect_close(SpecialFunction f, const std::vector<float>& a, const std::vector<float>& b,
                  const std::function<double(double, double)>& wanted,
                  const std::function<double(double, double)>& bound) {
  for (const SpecialCheck* check : usable_checks()) {
    const std::vector<float> got = evaluate(*check, f, a, b);
    double worst = -1;
    std::size_t at = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
      const double x = double(a[i]), y = b.empty() ? 0.0 : double(b[i]);
      const double error = ulps(got[i], wanted(x, y));
      if (error - bound(x, y) > worst) worst = error - bound(x, y), at = i;
    }
    EXPECT_LE(worst, 0.0) << check->name << ": at " << a[at] << (b.empty() ? "" : " and ") << (b.empty() ? 0.0f : b[at])
                          << " got " << got[at];
  }
}
void expect_close(SpecialFunction f, const std::vector<float>& a, const std::function<double(double)>& wanted,
                  double bound) {
  expect_close(
      f, a, {}, [&](double x, double) { return wanted(x); }, [&](double, double) { return bound; });
}

std::vector<float> range(double from, double to, int count = 1'000'000) {
  std::vector<float> values;
  for (int i = 0; i <= count; ++i) values.push_back(static_cast<float>(from + (to - from) * i / count));
  return values;
}
/// Positive floats of every exponent.
std::vector<float> all_magnitudes(std::uint32_t first, std::uint32_t last, std::uint32_t step) {
  std::vector<float> values;
  for (std::uint32_t word = first; word <= last - step; word += step) values.push_back(std::bit_cast<float>(word));
  return values;
}
const std::vector<float> kMagnitudes = all_magnitudes(1u, 0x7f800000u, 1009u);

std::vector<float> with_negatives(std::vector<float> values) {
  const std::size_t n = values.size();
  for (std::size_t i = 0; i < n; ++i) values.push_back(-values[i]);
  return values;
}

TEST(Special, Exp) {
  const auto wanted = [](double x) { return std::exp(x); };
  expect_close(SpecialFunction::exp, range(-87.3, 88.72), wanted, 1);
  expect_close(SpecialFunction::exp, range(-1, 1), wanted, 1);
  expect_close(SpecialFunction::exp, range(-120, -87.3), wanted, 1);
  expect_close(SpecialFunction::exp, {0.0f, 88.8f, 1e10f, kInf, -105.0f, -1e30f, -kInf, NAN}, wanted, 0.5);
}

TEST(Special, Log) {
  const auto wanted = [](double x) { return std::log(x); };
  expect_close(SpecialFunction::log, kMagnitudes, wanted, 1);
  expect_close(SpecialFunction::log, range(0.5, 2), wanted, 1);
  expect_close(SpecialFunction::log, {0.0f, -0.0f, 1.0f, kInf, -1.0f, -1e-40f, -kInf, NAN}, wanted, 0);
}

TEST(Special, Pow) {
  std::vector<float> x, y;
  for (const float base : all_magnitudes(1u, 0x7f800000u, 1000003u)) {
    for (double exponent = -3; exponent <= 3; exponent += 0.0137) {
      x.push_back(base), y.push_back(static_cast<float>(exponent));
    }
  }
  const auto wanted = [](double a, double b) { return std::pow(a, b); };
  expect_close(SpecialFunction::pow, x, y, wanted,
               [](double a, double b) { return 1 + 2 * std::abs(b * std::log(a)); });
  expect_close(SpecialFunction::pow, {0.0f, 0.0f, 0.0f, 1.0f, 7.0f, kInf}, {2.0f, 0.0f, -1.0f, 9.0f, 0.0f, 0.5f},
               wanted, [](double, double) { return 0.0; });
}

TEST(Special, Atan2) {
  const auto wanted = [](double y, double x) { return std::atan2(y, x); };
  const auto bound = [](double, double) { return 3.0; };
  std::vector<float> y, x;
  for (int i = 0; i < 2'000'000; ++i) {
    const double phi = 2 * M_PI * i / 2e6;
    y.push_back(static_cast<float>(std::sin(phi))), x.push_back(static_cast<float>(std::cos(phi)));
  }
  expect_close(SpecialFunction::atan2, y, x, wanted, bound);
  const std::vector<float> scales = with_negatives(all_magnitudes(0x00800000u, 0x7e800000u, 5'000'011u));
  y.clear(), x.clear();
  for (const float a : scales) {
    // Quotients below the smallest normal number round to it.
    for (const float b : scales) {
      if (b > 0 && std::abs(a) < b * 0x1p-126f) continue;
      y.push_back(a), x.push_back(b);
    }
  }
  expect_close(SpecialFunction::atan2, y, x, wanted, bound);
  expect_close(SpecialFunction::atan2, {0.0f, 0.0f, 0.0f, 1.0f, -1.0f}, {0.0f, 1.0f, -1.0f, 0.0f, 0.0f}, wanted,
               [](double, double) { return 0.5; });
}

TEST(Special, Arccosine) {
  const auto wanted = [](double x) { return std::acos(x); };
  expect_close(SpecialFunction::acos, range(-1, 1), wanted, 1.5);
  expect_close(SpecialFunction::acos, range(0.999, 1), wanted, 1.5);
  expect_close(
      SpecialFunction::acos, {1.0000001f, 1.5f, -1.0000001f, -7.0f, kInf, -kInf},
      [](double x) { return x > 0 ? 0.0 : M_PI; }, 0.5);
  expect_close(SpecialFunction::acos, {NAN}, wanted, 0);
}

TEST(Special, Arcsine) {
  const auto wanted = [](double x) { return std::asin(x); };
  expect_close(SpecialFunction::asin, range(-1, 1), wanted, 3);
  expect_close(SpecialFunction::asin, {1e-30f, -1e-10f, 1e-3f}, wanted, 3);
  expect_close(
      SpecialFunction::asin, {1.0000001f, 3.0f, -1.0000001f}, [](double x) { return std::copysign(M_PI / 2, x); }, 0.5);
}

TEST(Special, Erf) {
  const auto wanted = [](double x) { return std::erf(x); };
  expect_close(SpecialFunction::erf, range(-5, 5), wanted, 1.5);
  expect_close(SpecialFunction::erf, with_negatives(all_magnitudes(0x00800000u, 0x7f800000u, 10007u)), wanted, 1.5);
  expect_close(SpecialFunction::erf, {0.0f, 4.0f, 1e10f, -kInf, kInf, NAN}, wanted, 0.5);
}

TEST(Special, InverseErf) {
  // Newton's method in double on the C library's erf and erfc.
  const auto wanted = [](double y) {
    if (std::abs(y) >= 1) return std::copysign(INFINITY, y);
    const double a = std::abs(y);
    double x = a < 0.9 ? 0.886 * a : std::sqrt(-std::log1p(-a));
    for (int i = 0; i < 12; ++i) {
      const double error = a < 0.5 ? std::erf(x) - a : (1 - a) - std::erfc(x);
      x -= error / (2 / std::sqrt(M_PI) * std::exp(-x * x));
    }
    return std::copysign(x, y);
  };
  expect_close(SpecialFunction::erf_inv, range(-1, 1, 200'000), wanted, 4);
  expect_close(SpecialFunction::erf_inv, all_magnitudes(0x3f7f0000u, 0x3f800000u, 1u), wanted, 4);
  expect_close(SpecialFunction::erf_inv, all_magnitudes(0x00800000u, 0x3f800000u, 500'021u), wanted, 4);
  expect_close(SpecialFunction::erf_inv, {1.0f, -1.0f}, wanted, 0);
}

}  // namespace
}  // namespace norrsken
