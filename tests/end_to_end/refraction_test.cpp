// What is seen through the surface of glass, from either side, against Snell's and Fresnel's laws.
#include <algorithm>
#include <array>
#include <cmath>

#include "tests/end_to_end/param_name.h"
#include "tests/end_to_end/scene_folder.h"

namespace norrsken::end_to_end {
namespace {

constexpr int kSize = 16;
constexpr double kIor = 2, kRadiance = 3;
/// The lamp: a square at this depth, from kLampBegin to kLampEnd in x.
constexpr double kLampDepth = 2, kLampBegin = 0.7, kLampEnd = 20.7, kLampHalfWidth = 10;

struct Side {
  std::string name;
  double eta;  ///< index of refraction beyond the surface over that before it
};
std::ostream& operator<<(std::ostream& out, const Side& side) { return out << side.name; }

/// Radiance along a ray from (0, 0, 4) through (x, y, 0), beyond which the lamp is.
/// Source: Born and Wolf, section 1.5.2; radiance over squared index: Veach 1997, section 5.2.
double seen_through(double x, double y, double eta) {
  const double r = std::hypot(x, y), cos_i = 4 / std::hypot(r, 4.0), sin_t = std::sqrt(1 - cos_i * cos_i) / eta;
  if (sin_t >= 1) return 0;
  const double cos_t = std::sqrt(1 - sin_t * sin_t), beside = kLampDepth * sin_t / (cos_t * r);
  const double lamp_x = x + beside * x, lamp_y = y + beside * y;
  if (lamp_x < kLampBegin || lamp_x > kLampEnd || std::abs(lamp_y) > kLampHalfWidth) return 0;
  const double s = (cos_i - eta * cos_t) / (cos_i + eta * cos_t), p = (eta * cos_i - cos_t) / (eta * cos_i + cos_t);
  return (1 - (s * s + p * p) / 2) / (eta * eta) * kRadiance;
}

/// Means of the quarters of the picture, from left to right.
using Quarters = std::array<double, 4>;

class Refraction : public SceneFolder, public ::testing::WithParamInterface<Side> {};

TEST_P(Refraction, MovesAndWeakensWhatIsBehind) {
  const double eta = GetParam().eta;
  Quarters wanted{}, got{};
  constexpr int kFine = 64;
  for (int row = 0; row < kSize * kFine; ++row) {
    for (int column = 0; column < kSize * kFine; ++column) {
      const double x = 4 * ((column + 0.5) / (kSize * kFine) - 0.5), y = 4 * ((row + 0.5) / (kSize * kFine) - 0.5);
      wanted[static_cast<std::size_t>(4 * column / (kSize * kFine))] +=
          seen_through(x, y, eta) * 4 / std::pow(kSize * kFine, 2);
    }
  }
  const std::string turned = eta > 1 ? "" : R"(<rotate x="1" angle="180"/>)";
  const Scene scene = load_elements(
      "<integrator type=\"path\">" + integer("max_depth", 3) + "</integrator>" + camera(kSize) +
      R"(<shape type="rectangle"><transform name="to_world"><scale value="10"/>)" + turned +
      R"(</transform><bsdf type="dielectric"><float name="int_ior" value="2"/><float name="ext_ior" value="1"/></bsdf></shape>
      <shape type="rectangle"><transform name="to_world"><scale value="10"/><translate x="10.7" z="-2"/></transform>
      <bsdf type="diffuse"><float name="reflectance" value="0"/></bsdf>
      <emitter type="area"><float name="radiance" value="3"/></emitter></shape>)");
  const auto picture = picture_of(render_image(scene, {.samples_per_pixel = 1024, .threads = kThreads}));
  for (int row = 0; row < kSize; ++row) {
    for (int column = 0; column < kSize; ++column) {
      got[static_cast<std::size_t>(4 * column / kSize)] += picture.at(column, row)[0] * 4 / (kSize * kSize);
    }
  }
  EXPECT_GT(wanted[2], 0);
  for (std::size_t k = 0; k < 4; ++k) EXPECT_NEAR(got[k], wanted[k], 4e-3 * wanted[3]) << "quarter " << k;
}

INSTANTIATE_TEST_SUITE_P(, Refraction, ::testing::Values(Side{"into", kIor}, Side{"out_of", 1 / kIor}), kParamName);

}  // namespace
}  // namespace norrsken::end_to_end
