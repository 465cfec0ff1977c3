// Every model of list.def under every set of parameters of bsdf_test_cases.def: what it samples against its density and
// its value. A new model is tested by being listed in both.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <functional>
#include <iterator>
#include <ostream>
#include <string>
#include <vector>

#include "bsdf/bsdf_testing.h"

namespace norrsken::isa_host {
namespace {

struct Case {
  const char* plugin;
  const char* name;
  double energy_limit;
  const char* inside;
  bool reciprocal;
};
void PrintTo(const Case& c, std::ostream* out) { *out << c.plugin << ", " << c.name; }

constexpr Case kCases[] = {
#define NORRSKEN_BSDF_CASE(kind, name, energy_limit, inside) {#kind, name, energy_limit, inside, true},
#define NORRSKEN_BSDF_CASE_ONE_WAY(kind, name, energy_limit, inside) {#kind, name, energy_limit, inside, false},
#include "bsdf/bsdf_test_cases.def"
#undef NORRSKEN_BSDF_CASE_ONE_WAY
#undef NORRSKEN_BSDF_CASE
};

Vec3f direction(double cos_theta, double phi) {
  const double r = std::sqrt(std::max(0.0, 1 - cos_theta * cos_theta));
  return {static_cast<float>(r * std::cos(phi)), static_cast<float>(r * std::sin(phi)), static_cast<float>(cos_theta)};
}
Vec3f other_side(const Vec3f& v) { return {v.x, v.y, -v.z}; }
std::array<double, 3> components(const Vec3f& v) { return {double(v.x.v), double(v.y.v), double(v.z.v)}; }

struct View {
  const char* name;
  Vec3f wo;
};
const View kViews[] = {{"from above", direction(1, 0)},
                       {"at 37 degrees", direction(0.8, 1)},
                       {"at 73 degrees", direction(0.3, 4)},
                       {"grazing", direction(0.02, 2)}};

/// Independent numbers in [0, 1). Source: Steele et al., "Fast Splittable Pseudorandom Number Generators", 2014.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}
  float operator()() {
    std::uint64_t z = (state_ += 0x9e3779b97f4a7c15u);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return static_cast<float>((z ^ (z >> 31)) >> 40) * 0x1p-24f;
  }

 private:
  std::uint64_t state_;
};

BsdfSample sample(const LoadedBsdf& bsdf, const Vec3f& wo, Random& random) {
  const float lobe = random(), x = random(), y = random();
  return bsdf.sample(wo, lobe, {Float(x), Float(y)});
}

class EveryBsdf : public ::testing::TestWithParam<Case> {
 protected:
  void SetUp() override {
    sides_ = load_bsdf(GetParam().plugin, GetParam().inside);
    ASSERT_EQ(sides_.compiled.messages(), std::vector<std::string>());
    ASSERT_TRUE(sides_.front);
  }
  /// check(bsdf, the one beyond the surface or null)
  void on_each_side(const std::function<void(const LoadedBsdf&, const LoadedBsdf*)>& check) {
    {
      SCOPED_TRACE("front");
      check(*sides_.front, sides_.back.get());
    }
    if (sides_.back) {
      SCOPED_TRACE("back");
      check(*sides_.back, sides_.front.get());
    }
  }

 private:
  LoadedSides sides_;
};

TEST_P(EveryBsdf, WeightIsValueOverDensity) {
  on_each_side([](const LoadedBsdf& bsdf, const LoadedBsdf*) {
    for (const View& view : kViews) {
      SCOPED_TRACE(view.name);
      Random random(1);
      for (int i = 0; i < 10'000; ++i) {
        const BsdfSample s = sample(bsdf, view.wo, random);
        if (!s.valid.v) continue;
        ASSERT_NEAR(double(dot(s.wi, s.wi).v), 1.0, 1e-4);
        ASSERT_GT(s.eta.v, 0.0f);
        if (s.wi.z.v > 0) {
          ASSERT_EQ(s.eta.v, 1.0f);
        }
        if (bsdf.is_delta()) {
          ASSERT_EQ(s.pdf_sa.v, 0.0f);
        }
        if (s.pdf_sa.v == 0) continue;
        const double pdf = double(bsdf.pdf_sa(view.wo, s.wi));
        ASSERT_NEAR(double(s.pdf_sa.v), pdf, 3e-3 * pdf + 1e-6) << "wi.z " << s.wi.z.v;
        const auto value = components(bsdf.evaluate(view.wo, s.wi)), weight = components(s.weight);
        for (std::size_t k = 0; k < 3; ++k) {
          ASSERT_GE(weight[k], 0.0);
          ASSERT_NEAR(weight[k] * pdf, value[k], 3e-3 * value[k] + 1e-6) << "channel " << k << ", wi.z " << s.wi.z.v;
        }
      }
    }
  });
}

TEST_P(EveryBsdf, NothingIsScatteredFromBelow) {
  if (GetParam().plugin == std::string("null")) return;  // it knows no below: what it is put on may have normals
  on_each_side([](const LoadedBsdf& bsdf, const LoadedBsdf*) {
    Random random(2);
    for (const View& view : kViews) {
      SCOPED_TRACE(view.name);
      for (const Vec3f& wo : {other_side(view.wo), Vec3f{Float(0.6f), Float(0.8f), Float(0.0f)}}) {
        for (int i = 0; i < 100; ++i) {
          EXPECT_FALSE(sample(bsdf, wo, random).valid.v);
          const Vec3f wi = direction(2 * double(random()) - 1, 2 * M_PI * double(random()));
          EXPECT_EQ(components(bsdf.evaluate(wo, wi)), (std::array<double, 3>{}));
          EXPECT_EQ(bsdf.pdf_sa(wo, wi), 0.0f);
        }
      }
    }
  });
}

/// The white furnace: surroundings of radiance 1, and eta^2 beyond an interface, show at most 1.
TEST_P(EveryBsdf, ReflectsNoMoreThanArrives) {
  constexpr int kSamples = 50'000;
  on_each_side([this](const LoadedBsdf& bsdf, const LoadedBsdf*) {
    for (const View& view : kViews) {
      SCOPED_TRACE(view.name);
      Random random(3);
      std::array<double, 3> sum{}, squares{};
      for (int i = 0; i < kSamples; ++i) {
        const BsdfSample s = sample(bsdf, view.wo, random);
        if (!s.valid.v) continue;
        const auto weight = components(s.weight);
        for (std::size_t k = 0; k < 3; ++k) {
          const double w = weight[k] * double(s.eta.v) * double(s.eta.v);
          sum[k] += w / kSamples, squares[k] += w * w / kSamples;
        }
      }
      for (std::size_t k = 0; k < 3; ++k) {
        const double deviation = std::sqrt(std::max(0.0, squares[k] - sum[k] * sum[k]) / kSamples);
        EXPECT_GT(sum[k], 0.0) << "channel " << k;
        EXPECT_LE(sum[k], GetParam().energy_limit + 5 * deviation + 1e-5) << "channel " << k;
      }
    }
  });
}

/// Radiance changes by the square of the indices' ratio as it crosses: Veach 1997, equation 5.14.
TEST_P(EveryBsdf, Reciprocity) {
  on_each_side([this](const LoadedBsdf& bsdf, const LoadedBsdf* beyond) {
    Random random(4);
    int pairs = 0;
    for (int i = 0; i < 4000; ++i) {
      const Vec3f wo = direction(0.05 + 0.95 * double(random()), 2 * M_PI * double(random()));
      const BsdfSample s = sample(bsdf, wo, random);
      if (!s.valid.v || s.pdf_sa.v == 0 || std::abs(s.wi.z.v) < 0.05f) continue;
      const bool crosses = s.wi.z.v < 0;
      if (crosses && !GetParam().reciprocal) continue;
      ++pairs;
      ASSERT_TRUE(!crosses || beyond) << "light comes from a side that scatters none";
      const auto there = components(bsdf.evaluate(wo, s.wi));
      const auto back =
          components(crosses ? beyond->evaluate(other_side(s.wi), other_side(wo)) : bsdf.evaluate(s.wi, wo));
      for (std::size_t k = 0; k < 3; ++k) {
        // evaluate() includes the cosine of its second direction.
        const double a = there[k] / std::abs(double(s.wi.z.v)) * double(s.eta.v) * double(s.eta.v);
        const double b = back[k] / double(wo.z.v);
        ASSERT_NEAR(a, b, 3e-3 * std::max(a, b) + 1e-5)
            << "channel " << k << ", wo.z " << wo.z.v << ", wi.z " << s.wi.z.v << ", eta " << s.eta.v;
      }
    }
    EXPECT_TRUE(pairs > 500 || bsdf.is_delta());
  });
}

// --- sampling against density ----------------------------------------------------------------------------------------

/// A place on the sphere: turn in [-1/2, 1/2) of the azimuth, and sqrt(1 - |z|) with the sign of z, which is as precise
/// at the poles as directions are. Solid angle per area: 4 pi |height|.
struct Place {
  double height, turn;
};
Place place_of(const Vec3f& v) {
  const double x = double(v.x.v), y = double(v.y.v), z = double(v.z.v);
  return {std::copysign(std::min(1.0, std::sqrt((x * x + y * y) / (1 + std::abs(z)))), z),
          std::atan2(y, x) / (2 * M_PI)};
}
Vec3f direction_of(const Place& p) {
  const double h2 = p.height * p.height, r = std::abs(p.height) * std::sqrt(2 - h2), phi = 2 * M_PI * p.turn;
  return {float(r * std::cos(phi)), float(r * std::sin(phi)), float(std::copysign(1 - h2, p.height))};
}

struct Cell {
  double low[2], high[2];  ///< height, turn
  double expected = 0, observed = 0;
  int below = -1, above = -1, axis = 0;  ///< halves, -1 if this is a leaf
};

/// The sphere in cells, small where samples are many.
class Cells {
 public:
  explicit Cells(std::vector<Place> pilots) {
    cells_.push_back({{-1, -0.5}, {1, 0.5}});
    split(0, pilots.data(), pilots.data() + pilots.size(), 0);
  }
  Cell& find(const Place& p) {
    int i = 0;
    while (cells_[i].below >= 0) {
      const Cell& c = cells_[i];
      const double middle = (c.low[c.axis] + c.high[c.axis]) / 2;
      i = (c.axis == 0 ? p.height : p.turn) < middle ? c.below : c.above;
    }
    return cells_[i];
  }
  template <class Function>
  void for_each(const Function& f) {
    for (Cell& c : cells_) {
      if (c.below < 0) f(c);
    }
  }

 private:
  void split(std::size_t i, Place* begin, Place* end, int depth) {
    constexpr int kMaxDepth = 48, kPilotsPerCell = 60;
    Cell& c = cells_[i];
    // First the hemispheres: densities jump at the horizon.
    if (depth > 0 && (end - begin < kPilotsPerCell || depth == kMaxDepth)) return;
    const int axis = c.high[0] - c.low[0] >= c.high[1] - c.low[1] ? 0 : 1;
    const double middle = (c.low[axis] + c.high[axis]) / 2;
    Cell below = c, above = c;
    below.high[axis] = above.low[axis] = middle;
    c.axis = axis, c.below = int(cells_.size()), c.above = c.below + 1;
    const auto first = std::size_t(c.below);
    cells_.push_back(below), cells_.push_back(above);
    Place* const parting =
        std::partition(begin, end, [&](const Place& p) { return (axis == 0 ? p.height : p.turn) < middle; });
    split(first, begin, parting, depth + 1);
    split(first + 1, parting, end, depth + 1);
  }

  std::vector<Cell> cells_;
};

/// The integral of the density over a cell: Gauss' rule of 4 x 4 points, refined until its quarters agree.
double integrate(const std::function<double(const Place&)>& density, const Cell& c, double whole, int depth) {
  constexpr double kNodes[] = {-0.8611363115940526, -0.3399810435848563, 0.3399810435848563, 0.8611363115940526};
  constexpr double kWeights[] = {0.3478548451374538, 0.6521451548625461, 0.6521451548625461, 0.3478548451374538};
  const auto rule = [&](const Cell& part) {
    double sum = 0;
    for (int i = 0; i < 4; ++i) {
      for (int k = 0; k < 4; ++k) {
        const Place p{part.low[0] + (part.high[0] - part.low[0]) * (kNodes[i] + 1) / 2,
                      part.low[1] + (part.high[1] - part.low[1]) * (kNodes[k] + 1) / 2};
        sum += kWeights[i] * kWeights[k] * density(p) * std::abs(p.height);
      }
    }
    return sum * M_PI * (part.high[0] - part.low[0]) * (part.high[1] - part.low[1]);
  };
  if (whole < 0) whole = rule(c);
  Cell parts[4];
  double values[4], sum = 0;
  for (int i = 0; i < 4; ++i) {
    parts[i] = c;
    for (int axis = 0; axis < 2; ++axis) {
      ((i >> axis & 1) ? parts[i].low : parts[i].high)[axis] = (c.low[axis] + c.high[axis]) / 2;
    }
    sum += values[i] = rule(parts[i]);
  }
  constexpr double kTolerance = 1e-6;  // of an integral that is one in all
  if (std::abs(sum - whole) < kTolerance || depth == 10) return sum;
  sum = 0;
  for (int i = 0; i < 4; ++i) sum += integrate(density, parts[i], values[i], depth + 1);
  return sum;
}

/// How many standard deviations chi-square may be off so that one of `comparisons` right ones in a hundred suites is
/// complained about (Sidak).
double allowed_deviation(int comparisons) {
  const double share = 1 - std::pow(0.99, 1.0 / comparisons);
  double low = 0, high = 40;
  for (int i = 0; i < 60; ++i) {
    const double middle = (low + high) / 2;
    (std::erfc(middle / std::sqrt(2.0)) / 2 > share ? low : high) = middle;
  }
  return high;
}

/// Wilson and Hilferty 1931: the cube root of chi-square over its freedom is nearly normal.
double deviation_of(double chi2, double freedom) {
  const double variance = 2 / (9 * freedom);
  return (std::cbrt(chi2 / freedom) - 1 + variance) / std::sqrt(variance);
}

constexpr int kComparisons = int(std::size(kCases) * std::size(kViews) * 2);

void compare_samples_with_density(const LoadedBsdf& bsdf, const Vec3f& wo) {
  constexpr int kSamples = 250'000, kPilots = 20'000;
  std::vector<Place> pilots;
  Random pilot_random(6);
  for (int i = 0; i < kPilots; ++i) {
    const BsdfSample s = sample(bsdf, wo, pilot_random);
    if (s.valid.v && s.pdf_sa.v > 0) pilots.push_back(place_of(s.wi));
  }
  Cells cells(pilots);
  double smooth = 0;
  Random random(5);
  for (int i = 0; i < kSamples; ++i) {
    const BsdfSample s = sample(bsdf, wo, random);
    if (!s.valid.v || s.pdf_sa.v == 0) continue;
    ++smooth, ++cells.find(place_of(s.wi)).observed;
  }
  const auto density = [&](const Place& p) { return double(bsdf.pdf_sa(wo, direction_of(p))); };
  double integral = 0, chi2 = 0, freedom = 0, worst = 0;
  Cell pooled{}, worst_cell{};
  const auto compare = [&](const Cell& c) {
    const double term = (c.observed - c.expected) * (c.observed - c.expected) / c.expected;
    chi2 += term, ++freedom;
    if (term > worst) worst = term, worst_cell = c;
  };
  cells.for_each([&](Cell& c) {
    c.expected = integrate(density, c, -1, 0) * kSamples;
    integral += c.expected / kSamples;
    if (c.expected >= 10) return compare(c);
    pooled.expected += c.expected, pooled.observed += c.observed;
  });
  // Deltas and what falls off the surface are a cell too.
  pooled.expected += (1 - integral) * kSamples, pooled.observed += kSamples - smooth;
  if (pooled.expected >= 10) compare(pooled);
  const double share = smooth / kSamples;
  EXPECT_NEAR(integral, share, 5 * std::sqrt(share * (1 - share) / kSamples) + 5e-4) << "the density's integral";
  EXPECT_LE(integral, 1 + 5e-4);
  EXPECT_LT(deviation_of(chi2, freedom - 1), allowed_deviation(kComparisons))
      << "chi-square " << chi2 << " of " << freedom << " cells; the worst has wi.z from "
      << direction_of({worst_cell.low[0], 0}).z.v << " to " << direction_of({worst_cell.high[0], 0}).z.v
      << ", turns from " << worst_cell.low[1] << " to " << worst_cell.high[1] << ", " << worst_cell.observed
      << " samples where " << worst_cell.expected << " are expected";
}

TEST_P(EveryBsdf, DirectionsFollowTheDensity) {
  on_each_side([](const LoadedBsdf& bsdf, const LoadedBsdf*) {
    if (bsdf.is_delta()) return;  // WeightIsValueOverDensity saw that nothing else is sampled
    for (const View& view : kViews) {
      SCOPED_TRACE(view.name);
      compare_samples_with_density(bsdf, view.wo);
    }
  });
}

std::string test_name(const ::testing::TestParamInfo<Case>& tested) {
  std::string name = std::string(tested.param.plugin) + "_" + tested.param.name;
  for (char& c : name) {
    if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
  }
  return name;
}
INSTANTIATE_TEST_SUITE_P(Cases, EveryBsdf, ::testing::ValuesIn(kCases), test_name);

TEST(BsdfList, EveryModelHasParametersToBeTestedWith) {
#define NORRSKEN_BSDF(kind, Model)                                                  \
  EXPECT_TRUE(std::any_of(std::begin(kCases), std::end(kCases), [](const Case& c) { \
    return std::string(c.plugin) == #kind;                                          \
  })) << "bsdf_test_cases.def has no line for " #kind;
#include "bsdf/list.def"
#undef NORRSKEN_BSDF
}

TEST(Conductor, ReflectsAboutTheNormal) {
  const LoadedSides sides = load_bsdf("conductor", R"(<rgb name="specular_reflectance" value="0.8, 0.5, 0.3"/>)");
  const Vec3f wo = direction(0.3, 1);
  const BsdfSample s = sides.front->sample(wo, 0.5f, {Float(0.5f), Float(0.5f)});
  EXPECT_EQ(components(s.wi), components({-wo.x, -wo.y, wo.z}));
  EXPECT_EQ(s.weight.y.v, 0.5f);
}

}  // namespace
}  // namespace norrsken::isa_host
