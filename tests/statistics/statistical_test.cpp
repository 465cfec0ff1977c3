#include "tests/statistics/statistical_test.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <utility>

#include "tests/statistics/plot.h"
#include "tests/statistics/student.h"
#include "tests/statistics/suite.h"

namespace norrsken::statistics {

namespace {

/// The name that all instances of a test share: PREFIX/Suite.Name/VALUE of values, Suite/TYPE.Name of types.
std::string entry_name(const ::testing::TestInfo& test) {
  std::string suite = test.test_suite_name(), name = test.name();
  if (test.type_param()) {
    suite.resize(suite.find('/'));
  } else if (test.value_param()) {
    suite.erase(0, suite.find('/') + 1);
    name.resize(name.find('/'));
  }
  return suite + "." + name;
}

int instances_of(const std::string& entry) {
  const ::testing::UnitTest& all = *::testing::UnitTest::GetInstance();
  int instances = 0;
  for (int i = 0; i < all.total_test_suite_count(); ++i) {
    const ::testing::TestSuite& suite = *all.GetTestSuite(i);
    for (int k = 0; k < suite.total_test_count(); ++k) instances += entry_name(*suite.GetTestInfo(k)) == entry ? 1 : 0;
  }
  return instances;
}

std::string full_name(const ::testing::TestInfo& test) {
  return std::string(test.test_suite_name()) + "." + test.name();
}

}  // namespace

StatisticalTest::StatisticalTest()
    : StatisticalTest(entry_name(*::testing::UnitTest::GetInstance()->current_test_info())) {
  const std::string entry = std::exchange(name_, full_name(*::testing::UnitTest::GetInstance()->current_test_info()));
  reports_ = true;
  const int entered = family_of(entry).tests, found = instances_of(entry);
  EXPECT_EQ(found, entered) << entry << " has " << found << " instances, suite.h says " << entered;
}

StatisticalTest::StatisticalTest(const std::string& family)
    : name_(family),
      planned_(family_of(family).comparisons),
      level_(sidak_level(kSuiteLevel, suite_comparisons())),
      reports_(false) {}

StatisticalTest::~StatisticalTest() {
  if (!reports_ || ::testing::Test::HasFatalFailure() || ::testing::Test::IsSkipped()) return;
  EXPECT_EQ(made_, planned_) << name_ << " made " << made_ << " statistical comparisons, suite.h says " << planned_;
}

::testing::AssertionResult StatisticalTest::chi_square(std::span<const Cell> cells,
                                                       const std::array<std::string, 2>& axes,
                                                       const std::string& what) {
  ++made_;
  const ChiSquare result = statistics::chi_square(cells);
  const std::string verdict =
      fmt::format("chi-square {:.2f} with {} degrees of freedom, probability {:.3g}, level {:.3g}", result.statistic,
                  result.freedom, result.tail_prob, level_);
  if (result.tail_prob > level_) return ::testing::AssertionSuccess() << verdict;
  const std::string path = save_plot(name_, heat_maps_svg(cells, axes, {name_, what, verdict}));
  const Rectangle& w = result.worst.bounds;
  return ::testing::AssertionFailure() << fmt::format(
             "{}: {}\n  most wrong from ({:.6g}, {:.6g}) to ({:.6g}, {:.6g}) ({}; {}): {:.0f} samples where {:.1f} are "
             "expected\n  plot: {}",
             what, verdict, w.low[0], w.low[1], w.high[0], w.high[1], axes[0], axes[1], result.worst.observed,
             result.worst.expected, path);
}

::testing::AssertionResult StatisticalTest::follows_density(const Sampling& sampling, const std::string& what) {
  const Counted counted = count(sampling);
  const auto places = chi_square(counted.cells, sampling.axes, what);
  const auto amount =
      agree({counted.share, counted.share * (1 - counted.share) / sampling.samples, sampling.samples}, counted.integral,
            what + ": share of samples that came, against the density's integral", kQuadratureError);
  auto result = places && amount ? ::testing::AssertionSuccess() : ::testing::AssertionFailure();
  if (!places) result << places.message() << "\n";
  if (!amount) result << amount.message() << "\n";
  return result << fmt::format("the density's integral is {:.6f}", counted.integral);
}

::testing::AssertionResult StatisticalTest::agree(const Estimate& tested, const Estimate& reference,
                                                  const std::string& what, double rounding) {
  ++made_;
  constexpr double kAny = std::numeric_limits<double>::infinity();
  return verdict(compare(tested, reference, kAny, level_, rounding), tested, reference, what);
}

::testing::AssertionResult StatisticalTest::agree_to(double resolution, const Estimate& tested,
                                                     const Estimate& reference, const std::string& what) {
  ++made_;
  return verdict(compare(tested, reference, resolution, level_, 0), tested, reference, what);
}

::testing::AssertionResult StatisticalTest::agree_to(double resolution, const PairedMeans& pairs,
                                                     const std::string& what) {
  ++made_;
  const Estimate reference = pairs.reference();
  return verdict(compare_paired(pairs.difference(), reference.mean, resolution, level_, 0), pairs.tested(), reference,
                 what);
}

::testing::AssertionResult StatisticalTest::verdict(const Comparison& c, const Estimate& tested,
                                                    const Estimate& reference, const std::string& what) const {
  if (!c.agrees()) {
    return ::testing::AssertionFailure() << fmt::format(
               "{}: {:.6g} where {:.6g} is expected, off by {:.1f} sigma where {:.1f} are allowed", what, tested.mean,
               reference.mean, c.sigmas, c.critical);
  }
  if (!c.resolves()) {
    return ::testing::AssertionFailure() << fmt::format("{}: shows a bias of {:.2f} %, which should be {:.2f} %", what,
                                                        100 * c.smallest_bias, 100 * c.resolution);
  }
  return ::testing::AssertionSuccess();
}

::testing::AssertionResult StatisticalTest::at_most(const Estimate& tested, double limit, const std::string& what,
                                                    double rounding) {
  if (tested.mean > limit) return agree(tested, limit, what, rounding);
  ++made_;
  if (!std::isnan(tested.mean)) return ::testing::AssertionSuccess();
  return ::testing::AssertionFailure() << what << ": not a number";
}

::testing::AssertionResult StatisticalTest::uncorrelated(std::span<const double> x, std::span<const double> y,
                                                         const std::string& what) {
  const auto n = static_cast<double>(x.size());
  double mx = 0, my = 0, xx = 0, yy = 0, xy = 0;
  for (std::size_t i = 0; i < x.size(); ++i) mx += x[i] / n, my += y[i] / n;
  for (std::size_t i = 0; i < x.size(); ++i) {
    xx += (x[i] - mx) * (x[i] - mx), yy += (y[i] - my) * (y[i] - my), xy += (x[i] - mx) * (y[i] - my);
  }
  // Of independent numbers the coefficient is nearly normal with variance 1 / n.
  return agree({xy / std::sqrt(xx * yy), 1 / n, static_cast<int>(x.size())}, 0, what + ": correlation");
}

}  // namespace norrsken::statistics
