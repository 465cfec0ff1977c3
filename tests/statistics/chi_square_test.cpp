// The chi-square test: its distribution against tables, its error rate, what it sees, and the plot that it leaves.
#include <gtest/gtest-spi.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <iterator>
#include <pugixml.hpp>
#include <set>
#include <string>

#include "tests/statistics/plot.h"
#include "tests/statistics/statistical_test.h"
#include "tests/temporary_folder.h"

namespace norrsken::statistics {
namespace {

TEST(ChiSquare, TailMatchesPublishedQuantiles) {
  // As in any table of the distribution.
  EXPECT_NEAR(chi_square_tail(3.841, 1), 0.05, 5e-5);
  EXPECT_NEAR(chi_square_tail(18.307, 10), 0.05, 5e-6);
  EXPECT_NEAR(chi_square_tail(63.691, 40), 0.01, 5e-6);
  EXPECT_NEAR(chi_square_tail(149.449, 100), 0.001, 5e-7);
  EXPECT_NEAR(chi_square_tail(70.065, 100), 0.99, 5e-6);
}

TEST(ChiSquare, TailOfTwoDegreesOfFreedomIsExponential) {
  for (const double x : {0.1, 1.0, 2.0, 5.0, 30.0, 100.0}) {
    EXPECT_NEAR(chi_square_tail(x, 2) / std::exp(-x / 2), 1, 1e-12);
  }
  EXPECT_EQ(chi_square_tail(0, 5), 1);
}

Cell cell(double expected, double observed) { return {{{0, 0}, {1, 1}}, expected, observed}; }

TEST(ChiSquare, PoolsWhatIsTooRareToBeCompared) {
  const Cell cells[] = {cell(100, 110), cell(100, 90), cell(4, 6), cell(4, 2), cell(3, 5)};
  const ChiSquare result = chi_square(cells);
  EXPECT_NEAR(result.statistic, 1 + 1 + 4.0 / 11, 1e-12);
  EXPECT_EQ(result.freedom, 2);
  EXPECT_NEAR(result.tail_prob, std::exp(-result.statistic / 2), 1e-12);
}

TEST(ChiSquare, RareCellsThatAreFewGoWithTheNext) {
  const Cell cells[] = {cell(100, 100), cell(50, 50), cell(2, 12)};
  EXPECT_NEAR(chi_square(cells).statistic, 100.0 / 52, 1e-12);
  EXPECT_EQ(chi_square(cells).freedom, 1);
}

TEST(ChiSquare, SamplesWhereNoneCanBeAreSeen) {
  std::vector<Cell> cells(20, cell(50, 45));
  cells.push_back(cell(0, 100));
  EXPECT_LT(chi_square(cells).tail_prob, 1e-6);
}

TEST(ChiSquare, RejectsARightDensityAtTheNominalRate) {
  StatisticalTest test;
  Random random(1);
  Mean at_5, at_1;
  for (int i = 0; i < 4000; ++i) {
    EvenCells cells({{0, 0}, {1, 1}}, 8, 8);
    for (int k = 0; k < 3000; ++k) {
      const double x{random()}, y{random()};
      cells.add({x, y});
    }
    const double tail = chi_square(cells.cells()).tail_prob;
    at_5.add(tail < 0.05 ? 1 : 0), at_1.add(tail < 0.01 ? 1 : 0);
  }
  // The distribution is that of the limit of many samples.
  EXPECT_TRUE(test.agree(at_5.estimate(), 0.05, "5 %"));
  EXPECT_TRUE(test.agree(at_1.estimate(), 0.01, "1 %"));
}

TEST(Integrate, FindsEdgesAndPeaks) {
  const Rectangle square{{-1, -1}, {1, 1}};
  EXPECT_NEAR(integrate([](const Point& p) { return std::hypot(p[0], p[1]) < 1 ? 1 / M_PI : 0; }, square), 1, 2e-4);
  const auto peak = [](const Point& p) { return std::exp(-50 * (p[0] * p[0] + p[1] * p[1])) * 50 / M_PI; };
  EXPECT_NEAR(integrate(peak, square), 1, 1e-5);
}

TEST(SphereMap, KeepsDirectionsAndSolidAngle) {
  Random random(2);
  for (int i = 0; i < 1000; ++i) {
    const Point p{double{random()} - 0.5, 2 * double{random()} - 1};
    const Direction d = sphere_direction(p);
    const Point q = sphere_point(d);
    EXPECT_NEAR(q[0], p[0], 1e-12);
    EXPECT_NEAR(q[1], p[1], 1e-12);
    EXPECT_NEAR(d[0] * d[0] + d[1] * d[1] + d[2] * d[2], 1, 1e-12);
  }
  const Sampling uniform = sampling_of_directions(nullptr, [](const Direction&) { return 1 / (4 * M_PI); });
  EXPECT_NEAR(integrate(uniform.density, {{-0.5, -1}, {0.5, 0}}), 0.5, 1e-12);
  // The zone from z = 1/2 to 1 is a quarter of the sphere, and so is that from 0 to 1/2.
  EXPECT_NEAR(integrate(uniform.density, {{-0.5, 0}, {0.5, std::sqrt(0.5)}}), 0.25, 1e-12);
}

/// x and y with density 2 x, and what claims to be it.
Sampling ramp(double tilt, double scale) {
  return {{{0, 0}, {1, 1}},
          {"x", "y"},
          [](Random& random) {
            const double x = std::sqrt(double{random()}), y{random()};
            return std::optional(Point{x, y});
          },
          [=](const Point& p) { return scale * (tilt * 2 * p[0] + 1 - tilt); },
          200'000};
}

TEST(FollowsDensity, ARightOneIsAccepted) {
  StatisticalTest test("FollowsDensity.tests_of_itself");
  EXPECT_TRUE(test.follows_density(ramp(1, 1), "right"));
}

TEST(FollowsDensity, AWrongShapeAWrongScaleAndLostSamplesAreSeen) {
  StatisticalTest test("FollowsDensity.tests_of_itself");
  EXPECT_FALSE(test.follows_density(ramp(0.9, 1), "too flat"));
  EXPECT_FALSE(test.follows_density(ramp(1, 1.001), "too large"));
  Sampling lossy = ramp(1, 1);
  lossy.sample = [right = lossy.sample](Random& random) { return random() < 0.001f ? std::nullopt : right(random); };
  EXPECT_FALSE(test.follows_density(lossy, "lossy"));
}

/// Sets a variable of the environment for as long as it lives.
struct Environment {
  Environment(const char* variable, const std::string& value) : name(variable) { setenv(name, value.c_str(), 1); }
  ~Environment() { unsetenv(name); }
  const char* name;
};

TEST(FollowsDensity, AWrongOneLeavesAPlotThatCanBeRead) {
  const TemporaryFolder temporary;
  const std::filesystem::path folder = temporary / "plots" / "new";
  const Environment environment("NORRSKEN_TEST_PLOTS", folder.string());
  StatisticalTest test("FollowsDensity.tests_of_itself");
  const auto verdict = test.follows_density(ramp(0.5, 1), "ramp <1>, a & b, 37 degrees");
  ASSERT_FALSE(verdict);

  const std::string message = verdict.message();
  const std::size_t begin = message.find("plot: ") + 6;
  const std::string path = message.substr(begin, message.find('\n', begin) - begin);
  EXPECT_EQ(std::filesystem::path(path).parent_path(), folder) << message;
  pugi::xml_document svg;
  const pugi::xml_parse_result parsed = svg.load_file(path.c_str());
  ASSERT_TRUE(parsed) << path << ": " << parsed.description();

  std::string text;
  for (const auto& node : svg.select_nodes("//text")) text += std::string(node.node().text().get()) + "\n";
  for (const char* said : {"ramp <1>, a & b, 37 degrees", "chi-square ", "degrees of freedom", "level", "expected\n",
                           "observed\n", "to the right: x, 0 to 1; upwards: y, 0 to 1"}) {
    EXPECT_NE(text.find(said), std::string::npos) << said << " in\n" << text;
  }
  // Three maps of as many cells: of what is expected and found in many shades, of the difference in blue and red.
  const auto maps = svg.select_nodes("/svg/g");
  ASSERT_EQ(maps.size(), 3u);
  std::set<std::string> colours[3];
  std::size_t cells[3];
  for (std::size_t i = 0; i < 3; ++i) {
    const auto rects = maps[i].node().children("rect");
    cells[i] = static_cast<std::size_t>(std::distance(rects.begin(), rects.end()));
    for (const auto& rect : rects) colours[i].insert(rect.attribute("fill").value());
  }
  EXPECT_GT(cells[0], 100u);
  EXPECT_EQ(cells[0], cells[1]);
  EXPECT_EQ(cells[0], cells[2]);
  EXPECT_GT(colours[0].size(), 5u);
  EXPECT_GT(colours[1].size(), 5u);
  EXPECT_TRUE(colours[2].contains("#ff0000") && colours[2].contains("#0000ff"));
}

TEST(StatisticalTest, RefusesAnotherNumberOfComparisons) {
  EXPECT_NONFATAL_FAILURE({ StatisticalTest none_made; }, "made 0 statistical comparisons, suite.h says 1");
  const Estimate one{1, 0, 4};
  EXPECT_NONFATAL_FAILURE(
      {
        StatisticalTest too_many;
        EXPECT_TRUE(too_many.agree(one, 1, ""));
        EXPECT_TRUE(too_many.agree(one, 1, ""));
      },
      "made 2 statistical comparisons, suite.h says 1");
  StatisticalTest right;
  right.skip(1);
}

TEST(StatisticalTest, RefusesAnotherNumberOfInstances) {
  EXPECT_NONFATAL_FAILURE({ StatisticalTest alone; }, "has 1 instances, suite.h says 2");
}

TEST(StatisticalTest, RefusesATestThatIsNotEntered) { EXPECT_THROW(StatisticalTest(), std::invalid_argument); }

TEST(StatisticalTest, JudgesMeansCorrelationsAndLimits) {
  StatisticalTest test("StatisticalTest.tests_of_itself");
  EXPECT_TRUE(test.agree({1.004, 1e-6, 100'000}, 1, "4 sigma"));
  EXPECT_FALSE(test.agree({1.007, 1e-6, 100'000}, 1, "7 sigma"));
  EXPECT_TRUE(test.agree({1.007, 1e-6, 100'000}, 1, "", 0.004));
  EXPECT_FALSE(test.agree({std::nan(""), 1e-6, 100'000}, 1, "not a number"));
  EXPECT_TRUE(test.at_most({0.5, 1e-6, 100'000}, 1, "far below"));
  EXPECT_TRUE(test.at_most({1.004, 1e-6, 100'000}, 1, "hardly above"));
  EXPECT_FALSE(test.at_most({1.007, 1e-6, 100'000}, 1, "above"));
  EXPECT_FALSE(test.at_most({std::nan(""), 1e-6, 100'000}, 1, "not a number"));
  std::vector<double> x, y, mostly_x;
  Random random(3);
  for (int i = 0; i < 100'000; ++i) {
    x.push_back(double{random()}), y.push_back(double{random()});
    mostly_x.push_back(0.02 * x.back() + y.back());
  }
  EXPECT_TRUE(test.uncorrelated(x, y, "independent"));
  EXPECT_FALSE(test.uncorrelated(x, mostly_x, "a fiftieth"));
}

}  // namespace
}  // namespace norrsken::statistics
