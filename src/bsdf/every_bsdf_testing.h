// For tests: every model of lists/bsdf.def under every set of parameters of bsdf_test_cases.def.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <ostream>
#include <string>
#include <string_view>
#include <vector>

#include "bsdf/bsdf_testing.h"
#include "tests/statistics/case_name.h"
#include "tests/statistics/random.h"

namespace norrsken::isa_host {

using statistics::Random;

/// A set of parameters.
struct BsdfCase {
  std::string_view plugin, name, inside;
  double most = 1;                     ///< share of the light that may come back
  double least = 0;                    ///< share of the light that has to
  std::string_view one_way_because{};  ///< why what goes through is not reciprocal; empty where it is
  bool also_reflected = false;         ///< that what is thrown back is not reciprocal either
};
inline void PrintTo(const BsdfCase& c, std::ostream* out) { *out << c.plugin << ", " << c.name; }

inline constexpr BsdfCase kBsdfCaseTable[] = {
#define NORRSKEN_BSDF_CASE(kind, name, most, inside) {#kind, name, inside, most},
#define NORRSKEN_BSDF_CASE_ONE_WAY(kind, name, most, because, inside) {#kind, name, inside, most, 0, because},
#define NORRSKEN_BSDF_CASE_NOT_RECIPROCAL(kind, name, most, because, inside) \
  {#kind, name, inside, most, 0, because, true},
#define NORRSKEN_BSDF_FURNACE(...)
#include "bsdf/bsdf_test_cases.def"
#undef NORRSKEN_BSDF_FURNACE
#undef NORRSKEN_BSDF_CASE_NOT_RECIPROCAL
#undef NORRSKEN_BSDF_CASE_ONE_WAY
#undef NORRSKEN_BSDF_CASE
};

inline constexpr BsdfCase kFurnaceTable[] = {
#define NORRSKEN_BSDF_CASE(...)
#define NORRSKEN_BSDF_CASE_ONE_WAY(...)
#define NORRSKEN_BSDF_CASE_NOT_RECIPROCAL(...)
#define NORRSKEN_BSDF_FURNACE(kind, name, least, most, inside) {#kind, name, inside, most, least},
#include "bsdf/bsdf_test_cases.def"
#undef NORRSKEN_BSDF_FURNACE
#undef NORRSKEN_BSDF_CASE_NOT_RECIPROCAL
#undef NORRSKEN_BSDF_CASE_ONE_WAY
#undef NORRSKEN_BSDF_CASE
};

/// Whether the table has the plugin.
template <std::size_t n>
constexpr bool is_tested(const BsdfCase (&table)[n], std::string_view plugin) {
  return std::any_of(table, table + n, [&](const BsdfCase& c) { return c.plugin == plugin; });
}
#define NORRSKEN_BSDF(kind, Model)                                                                             \
  static_assert(is_tested(kBsdfCaseTable, #kind), "bsdf_test_cases.def needs a NORRSKEN_BSDF_CASE of " #kind); \
  static_assert(is_tested(kFurnaceTable, #kind), "bsdf_test_cases.def needs a NORRSKEN_BSDF_FURNACE of " #kind);
#include "lists/bsdf.def"
#undef NORRSKEN_BSDF

inline Vec3f direction(double cos_theta, double phi) {
  const double r = std::sqrt(std::max(0.0, 1 - cos_theta * cos_theta));
  return {static_cast<float>(r * std::cos(phi)), static_cast<float>(r * std::sin(phi)), static_cast<float>(cos_theta)};
}
inline Vec3f other_side(const Vec3f& v) { return {v.x, v.y, -v.z}; }
inline std::array<double, 3> components(const Vec3f& v) { return {double{v.x.v}, double{v.y.v}, double{v.z.v}}; }
inline std::array<double, 3> components(const Color& c) { return {double{c.r.v}, double{c.g.v}, double{c.b.v}}; }
inline Vec3f lanes(const std::array<double, 3>& v) { return {float(v[0]), float(v[1]), float(v[2])}; }

struct View {
  const char* name;
  Vec3f wo;
};
inline const View kViews[] = {{"from above", direction(1, 0)},
                              {"at 37 degrees", direction(0.8, 1)},
                              {"at 73 degrees", direction(0.3, 4)},
                              {"grazing", direction(0.02, 2)}};

inline BsdfSample sample(const LoadedBsdf& bsdf, const Vec3f& wo, Random& random) {
  const float lobe = random(), x = random(), y = random();
  return bsdf.sample(wo, lobe, {Float(x), Float(y)});
}

class EveryBsdf : public ::testing::TestWithParam<BsdfCase> {
 protected:
  void SetUp() override {
    sides_ = load_bsdf(std::string(GetParam().plugin), std::string(GetParam().inside));
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
  bool has_back() const { return sides_.back != nullptr; }
  bool is_listed_as_refracting() const { return (sides_.compiled.tables().bsdf_kinds & kRefractingKinds) != 0; }
  /// For captions: model, parameters, side and angle.
  std::string configuration(const LoadedBsdf& bsdf, const View& view) const {
    std::string text = std::string(GetParam().plugin) + ", " + std::string(GetParam().name);
    return text + (&bsdf == sides_.front.get() ? ", front, " : ", back, ") + view.name;
  }

 private:
  LoadedSides sides_;
};

/// The white sets.
class WhiteFurnace : public EveryBsdf {};

inline std::string test_name(const ::testing::TestParamInfo<BsdfCase>& tested) {
  return statistics::case_name(tested.param.plugin, tested.param.name);
}

}  // namespace norrsken::isa_host
