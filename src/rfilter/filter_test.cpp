// Filters: parameters, tables, and what sampling them does to an image, against convolution with the formulas.
#include "rfilter/filter.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <optional>

#include "compile/compile_testing.h"
#include "tests/statistics/statistical_test.h"

namespace norrsken::isa_host {
namespace {

using norrsken::testing::Compiled;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

Compiled compile(const std::string& type, const std::string& inside = "", const std::string& film = "") {
  return norrsken::testing::compile_film(R"(<integer name="width" value="9"/><integer name="height" value="5"/>)" +
                                         film + "<rfilter type=\"" + type + "\">" + inside + "</rfilter>");
}
std::string number(const std::string& name, const std::string& value) {
  return "<float name=\"" + name + "\" value=\"" + value + "\"/>";
}

/// A filter as its documentation has it, along one axis.
struct Known {
  std::string type, parameters;
  double radius;
  std::function<double(double)> value;
};

double mitchell(double x, double b, double c) {
  x = std::abs(x);
  const double x2 = x * x, x3 = x2 * x;
  if (x < 1) return ((12 - 9 * b - 6 * c) * x3 + (-18 + 12 * b + 6 * c) * x2 + 6 - 2 * b) / 6;
  if (x < 2) return ((-b - 6 * c) * x3 + (6 * b + 30 * c) * x2 + (-12 * b - 48 * c) * x + 8 * b + 24 * c) / 6;
  return 0;
}

double lanczos(double x, double lobes) {
  const double a = std::numbers::pi * std::abs(x);
  if (a == 0) return 1;
  return std::abs(x) < lobes ? std::sin(a) / a * std::sin(a / lobes) / (a / lobes) : 0;
}

double gaussian(double x, double stddev) {
  return std::max(0.0, std::exp(-x * x / (2 * stddev * stddev)) - std::exp(-8.0));
}

std::vector<Known> known_filters() {
  return {{"tent", "", 1, [](double x) { return std::max(0.0, 1 - std::abs(x)); }},
          {"tent", number("radius", "2.5"), 2.5, [](double x) { return std::max(0.0, 1 - std::abs(x) / 2.5); }},
          {"gaussian", "", 2, [](double x) { return gaussian(x, 0.5); }},
          {"gaussian", number("stddev", "0.8"), 3.2, [](double x) { return gaussian(x, 0.8); }},
          {"mitchell", "", 2, [](double x) { return mitchell(x, 1.0 / 3, 1.0 / 3); }},
          {"mitchell", number("B", "0.1") + number("C", "0.9"), 2, [](double x) { return mitchell(x, 0.1, 0.9); }},
          {"catmullrom", "", 2, [](double x) { return mitchell(x, 0, 0.5); }},
          {"lanczos", "", 3, [](double x) { return lanczos(x, 3); }},
          {"lanczos", R"(<integer name="lobes" value="5"/>)", 5, [](double x) { return lanczos(x, 5); }}};
}

/// The integral of g from a to b.
double integral(const std::function<double(double)>& g, double a, double b) {
  const int steps = std::max(100, static_cast<int>((b - a) * 10000));
  double sum = 0;
  for (int i = 0; i < steps; ++i) sum += g(a + (b - a) * (i + 0.5) / steps);
  return sum * (b - a) / steps;
}

/// Sampled along x at the middle of equal parts of the unit interval; y is the axis's median. Where the weight changes
/// its sign the sum is off by half a part at most.
constexpr int kParts = 100000;
constexpr double kPartsError = 2e-4;

struct Row {
  Compiled compiled;
  SceneView view;

  explicit Row(Compiled c) : compiled(std::move(c)) {
    view.film = compiled.tables().film;
    view.filter = compiled.tables().filter.data();
  }
  /// The mean of weight * g(offset from the pixel's centre).
  double mean(std::uint32_t x, const std::function<double(double)>& g) const {
    const TabulatedFilter filter(view);
    const auto at = [&](float u) { return filter.sample(UInt(x), UInt(2u), {Float(u), Float(0.5f)}, Mask{true}); };
    double sum = 0;
    for (int i = 0; i < kParts; ++i) {
      const FilterSample s = at((static_cast<float>(i) + 0.5f) / kParts);
      sum += static_cast<double>(s.weight.v) * g(static_cast<double>(s.dx.v) - 0.5);
    }
    return sum / kParts / y_weight();
  }
  /// What the middle of the y axis contributes to the weight: the filter's scale along one axis.
  double y_weight() const {
    const FilterRecord& f = view.film.filter;
    const float* integrals = view.filter + 3 * f.nodes + f.cells + 1;
    const auto edge = [&](std::uint32_t pixels) {
      return view.film.sample_border ? f.edges : std::min(pixels, f.edges);
    };
    const std::uint32_t before = edge(2), after = edge(2);
    const double all = static_cast<double>(integrals[before]) + static_cast<double>(integrals[after]);
    return all /
           (static_cast<double>(integrals[f.edges + 1 + before]) + static_cast<double>(integrals[f.edges + 1 + after]));
  }
};

TEST(Filter, AnImageOfAKnownFunctionIsItsConvolution) {
  const auto image = [](double x) { return 1 + std::sin(1.3 * x + 0.4) + 0.2 * x; };
  for (const Known& known : known_filters()) {
    SCOPED_TRACE(known.type + known.parameters);
    for (const bool border : {false, true}) {
      Row row(compile(known.type, known.parameters, border ? R"(<boolean name="sample_border" value="true"/>)" : ""));
      ASSERT_THAT(row.compiled.messages(), IsEmpty());
      for (const std::uint32_t pixel : {0u, 1u, 4u, 7u, 8u}) {
        const double centre = pixel + 0.5;
        const double low = border ? -known.radius : std::max(-known.radius, -centre);
        const double high = border ? known.radius : std::min(known.radius, 9 - centre);
        const double expected = integral([&](double x) { return known.value(x) * image(centre + x); }, low, high) /
                                integral(known.value, low, high);
        EXPECT_NEAR(row.mean(pixel, [&](double x) { return image(centre + x); }), expected, kPartsError)
            << "pixel " << pixel << (border ? ", border" : "");
        EXPECT_NEAR(row.mean(pixel, [](double) { return 1.0; }), 1, kPartsError) << "mean weight of pixel " << pixel;
      }
    }
  }
}

TEST(Filter, OffsetsHaveTheFiltersDensity) {
  for (const Known& known : known_filters()) {
    SCOPED_TRACE(known.type + known.parameters);
    const Row row(compile(known.type, known.parameters, R"(<boolean name="sample_border" value="true"/>)"));
    const double all = integral([&](double x) { return std::abs(known.value(x)); }, -known.radius, known.radius);
    const double scale = integral(known.value, -known.radius, known.radius) / all;
    const TabulatedFilter filter(row.view);
    double worst = 0, previous = -known.radius;
    for (int i = 1; i < 512; ++i) {
      const FilterSample s =
          filter.sample(UInt(4u), UInt(2u), {Float(static_cast<float>(i) / 512), Float(0.5f)}, Mask{true});
      const double x = static_cast<double>(s.dx.v) - 0.5;
      // As many samples up to there as the absolute value of the filter covers.
      worst = std::max(
          worst, std::abs(integral([&](double t) { return std::abs(known.value(t)); }, previous, x) / all - 1.0 / 512));
      previous = x;
      const double sign = known.value(x) < 0 ? -1 : 1;
      if (std::abs(known.value(x)) > 1e-3) {
        EXPECT_NEAR(static_cast<double>(s.weight.v) / row.y_weight() * scale, sign, 1e-4) << "at " << x;
      }
    }
    EXPECT_LT(worst, 1e-5);
  }
}

/// Where samples lie, beside all other pixels and in a corner of the film; and their mean weight.
TEST(Filter, SamplesFollowTheAbsoluteValue) {
  statistics::StatisticalTest test;
  std::vector<Known> filters = known_filters();
  filters.push_back({"box", "", 0.5, [](double x) { return std::abs(x) <= 0.5 ? 1.0 : 0.0; }});
#define NORRSKEN_RFILTER(name)                                                              \
  EXPECT_TRUE(std::ranges::any_of(filters, [](const Known& k) { return k.type == #name; })) \
      << "known_filters() needs " << #name;
#include "lists/rfilter.def"
#undef NORRSKEN_RFILTER
  for (const Known& known : filters) {
    for (const bool border : {true, false}) {
      const Row row(
          compile(known.type, known.parameters, border ? R"(<boolean name="sample_border" value="true"/>)" : ""));
      ASSERT_THAT(row.compiled.messages(), IsEmpty());
      const std::uint32_t x = border ? 4 : 0, y = border ? 2 : 0;
      const auto draw = [&](statistics::Random& random) {
        const float u = random(), v = random();
        const Vec2f square{Float(u), Float(v)};
        if (known.type == "box") return BoxFilter{}.sample(UInt(x), UInt(y), square, Mask{true});
        return TabulatedFilter(row.view).sample(UInt(x), UInt(y), square, Mask{true});
      };
      const double r = known.radius;
      const statistics::Rectangle domain =
          border ? statistics::Rectangle{{-r, -r}, {r, r}}
                 : statistics::Rectangle{{-0.5, -0.5}, {std::min(r, 8.5), std::min(r, 4.5)}};
      const auto absolute = [&](double t) { return std::abs(known.value(t)); };
      const double all =
          integral(absolute, domain.low[0], domain.high[0]) * integral(absolute, domain.low[1], domain.high[1]);
      const statistics::Sampling sampling{
          domain,
          {"pixels to the right", "pixels down"},
          [&](statistics::Random& random) {
            const FilterSample s = draw(random);
            return std::optional(statistics::Point{double{s.dx.v} - 0.5, double{s.dy.v} - 0.5});
          },
          [&](const statistics::Point& p) { return absolute(p[0]) * absolute(p[1]) / all; }};
      const std::string what = known.type + " " + known.parameters + (border ? "" : ", in the corner");
      EXPECT_TRUE(test.follows_density(sampling, what));
      statistics::Random random(3);
      statistics::Mean weight;
      for (int i = 0; i < 200'000; ++i) weight.add(double{draw(random).weight.v});
      EXPECT_TRUE(test.agree(weight.estimate(), 1, what + ", mean weight", kPartsError));
    }
  }
}

TEST(Filter, PiecesAreLinearWithinATenthOfAThousandth) {
  for (const Known& known : known_filters()) {
    const Row row(compile(known.type, known.parameters));
    const std::uint32_t n = row.view.film.filter.nodes;
    const float *position = row.view.filter, *value = position + n;
    const double scale = static_cast<double>(value[0]) / known.value(0);
    EXPECT_FLOAT_EQ(position[n - 1], static_cast<float>(known.radius)) << known.type;
    for (std::uint32_t i = 0; i + 1 < n; ++i) {
      const double middle = (static_cast<double>(position[i]) + static_cast<double>(position[i + 1])) / 2;
      const double linear = (static_cast<double>(value[i]) + static_cast<double>(value[i + 1])) / 2;
      ASSERT_NEAR(linear, scale * known.value(middle), 1e-4 * std::abs(scale)) << known.type << " at " << middle;
    }
  }
}

TEST(Filter, GaussianIsTheDefaultAndBoxHasNoTable) {
  const Compiled standard = norrsken::testing::compile_film(""),
                 gaussian = norrsken::testing::compile_film(R"(<rfilter type="gaussian"/>)");
  ASSERT_THAT(standard.messages(), IsEmpty());
  EXPECT_EQ(standard.tables().film.filter.kind, FilterKind::tabulated);
  EXPECT_EQ(standard.tables().filter, gaussian.tables().filter);
  EXPECT_FALSE(standard.tables().film.filter.signs);
  EXPECT_TRUE(compile("lanczos").tables().film.filter.signs);
  EXPECT_EQ(compile("box").tables().film.filter.kind, FilterKind::box);
  EXPECT_THAT(compile("box").tables().filter, IsEmpty());
}

TEST(Filter, RefusesWhatIsOutOfRange) {
  EXPECT_THAT(compile("tent", number("radius", "0")).messages(),
              ElementsAre("error: 'radius' is 0 [a number above 0 and at most 100]"));
  EXPECT_THAT(compile("gaussian", number("stddev", "26")).messages(),
              ElementsAre("error: 'stddev' is 26 [a number above 0 and at most 25]"));
  EXPECT_THAT(compile("mitchell", number("B", "-0.1") + number("C", "1.5")).messages(),
              ElementsAre("error: 'B' is -0.1 [a number from 0 to 1]", "error: 'C' is 1.5 [a number from 0 to 1]"));
  EXPECT_THAT(compile("lanczos", R"(<integer name="lobes" value="0"/>)").messages(),
              ElementsAre("error: 'lobes' is 0 [an integer from 1 to 16]"));
  EXPECT_THAT(compile("lanczos", number("lobes", "3")).messages(), ElementsAre("error: 'lobes' is a float [integer]"));
}

TEST(Filter, RefusesOtherParametersAndFilters) {
  const std::map<std::string, std::string> accepted = {{"box", "no parameters"}, {"catmullrom", "no parameters"},
                                                       {"gaussian", "stddev"},   {"lanczos", "lobes"},
                                                       {"mitchell", "B, C"},     {"tent", "radius"}};
  for (const auto& [type, names] : accepted) {
    EXPECT_THAT(compile(type, number("width", "2")).messages(),
                ElementsAre("error: unused parameter 'width' of rfilter '" + type + "' [" + names + "]"));
  }
  EXPECT_THAT(compile("gauss").messages(), ElementsAre("error: unknown rfilter 'gauss' [box, catmullrom, gaussian, "
                                                       "lanczos, mitchell, tent]"));
}

}  // namespace
}  // namespace norrsken::isa_host
