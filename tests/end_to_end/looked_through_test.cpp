// BSDFs that stand before others, against plain surfaces that look the same and against closed forms.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "norrsken/image.h"
#include "tests/closed_form/closed_form.h"
#include "tests/end_to_end/scene_folder.h"

namespace norrsken::end_to_end {
namespace {

constexpr int kSize = 16;
constexpr double kIntensity = 50, kReflectance = 0.6;
const closed_form::Vec kLight{1, 2, 3};

/// Of a smooth picture of a thousand and more samples a pixel, the mean is far better known than this.
constexpr double kTolerance = 3e-3;

class LookedThrough : public SceneFolder {
 protected:
  /// A plane of this material, seen from straight above and lit by a point or by what else `more` holds.
  statistics::Picture render(const std::string& bsdf, const std::string& more, RenderOptions options = {},
                             const std::string& integrator = "path") const {
    if (!options.samples_per_pixel) options.samples_per_pixel = 1024;
    options.threads = kThreads;
    const std::string plane = R"(<shape type="rectangle"><transform name="to_world"><scale value="10"/></transform>)";
    return picture_of(render_image(load_elements("<integrator type=\"" + integrator + "\">" + integer("max_depth", 3) +
                                                 "</integrator>" + camera(kSize) + plane + bsdf + "</shape>" + more),
                                   options));
  }
  statistics::Picture under_point(const std::string& bsdf) const { return render(bsdf, kPoint); }
  static inline const std::string kPoint = R"(<emitter type="point"><point name="position" value="1, 2, 3"/>
    <float name="intensity" value="50"/></emitter>)";
};

std::array<double, 3> mean(const statistics::Picture& picture) {
  std::array<double, 3> sum{};
  for (const auto& pixel : picture.pixels) {
    for (std::size_t k = 0; k < 3; ++k) sum[k] += pixel[k] / static_cast<double>(picture.pixels.size());
  }
  return sum;
}

void expect_mean(const statistics::Picture& picture, const std::array<double, 3>& wanted) {
  const auto got = mean(picture);
  for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(got[k], wanted[k], kTolerance * wanted[k]) << "channel " << k;
}

/// Radiance of the plane z = 0 with this shading normal, averaged over the picture; `weight(w)` is a factor on the light
/// from direction w.
template <class Weight>
double tilted_plane(const closed_form::Vec& normal, const Weight& weight) {
  constexpr int kFine = 256;
  double sum = 0;
  for (int y = 0; y < kFine; ++y) {
    for (int x = 0; x < kFine; ++x) {
      const closed_form::Vec p{4.0 * (x + 0.5) / kFine - 2, 4.0 * (y + 0.5) / kFine - 2, 0};
      const closed_form::Vec w = normalize(kLight - p);
      sum += weight(w) * closed_form::reflected_radiance(
                             kReflectance, closed_form::point_light_irradiance(kIntensity, kLight, p, normal));
    }
  }
  return sum / (kFine * kFine);
}

std::string weighted(const std::string& type, const std::string& name, const std::string& value,
                     const std::string& inside) {
  return "<bsdf type=\"" + type + "\"><float name=\"" + name + "\" value=\"" + value + "\"/>" + inside + "</bsdf>";
}

TEST_F(LookedThrough, ABlendIsTheWeightedMean) {
  const auto plain = mean(under_point(diffuse("0.6, 0.3, 0.9")));
  expect_mean(under_point(weighted("blendbsdf", "weight", "0.25", diffuse("0.5, 0.4, 1") + diffuse("0.9, 0, 0.6"))),
              plain);
  expect_mean(under_point(weighted("blendbsdf", "weight", "0", diffuse("0.6, 0.3, 0.9") + diffuse("0"))), plain);
  expect_mean(under_point(weighted("blendbsdf", "weight", "1", diffuse("0") + diffuse("0.6, 0.3, 0.9"))), plain);
}

TEST_F(LookedThrough, NestedChoicesShareOneNumber) {
  const auto plain = mean(under_point(diffuse("0.6, 0.3, 0.9")));
  // 0.5 (0.75 a + 0.25 b) + 0.5 (0.8 c), each probability its own.
  const std::string left = weighted("blendbsdf", "weight", "0.25", diffuse("0.8, 0.2, 1") + diffuse("0.4, 0.2, 0.8"));
  const std::string right = weighted("mask", "opacity", "0.8", diffuse("0.625, 0.5, 1"));
  const double expected[] = {0.5 * 0.7 + 0.25, 0.5 * 0.2 + 0.2, 0.5 * 0.95 + 0.4};
  expect_mean(under_point(weighted("blendbsdf", "weight", "0.5", left + right)),
              {plain[0] * expected[0] / 0.6, plain[1] * expected[1] / 0.3, plain[2] * expected[2] / 0.9});
}

TEST_F(LookedThrough, LightIsSampledForEverythingBehind) {
  // One sample a pixel, and no noise: what chance would pick is black in half of all cases.
  const std::string nested = weighted(
      "blendbsdf", "weight", "0.5",
      diffuse("0") + weighted("mask", "opacity", "0.5",
                              weighted("blendbsdf", "weight", "0.25", diffuse("0.4, 0.2, 0.8") + diffuse("0"))));
  const std::string light = R"(<emitter type="point"><point name="position" value="1, 2, 3"/></emitter>)";
  const auto got = render(nested, light, {.samples_per_pixel = 1});
  const auto plain = render(diffuse("0.4, 0.2, 0.8"), light, {.samples_per_pixel = 1});
  for (std::size_t i = 0; i < plain.pixels.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      const double wanted = 0.5 * 0.5 * 0.75 * plain.pixels[i][k];
      EXPECT_NEAR(got.pixels[i][k], wanted, 1e-5 * wanted) << i << ", channel " << k;
    }
  }
}

TEST_F(LookedThrough, ManyChoicesAreLeftToChance) {
  const auto plain = mean(under_point(diffuse("0.6, 0.3, 0.9")));
  std::string nested = diffuse("0.6, 0.3, 0.9");
  for (int i = 0; i < 4; ++i) nested = weighted("blendbsdf", "weight", "0.1", nested + diffuse("0"));
  const double share = 0.9 * 0.9 * 0.9 * 0.9;
  expect_mean(under_point(nested), {plain[0] * share, plain[1] * share, plain[2] * share});
}

TEST_F(LookedThrough, EveryInstructionSetChoosesAlike) {
  const std::string bsdf = weighted(
      "blendbsdf", "weight", "0.3",
      R"(<bsdf type="mask"><texture name="opacity" type="checkerboard"><transform name="to_uv"><scale value="40"/></transform></texture>)" +
          diffuse("0.6, 0.3, 0.9") + "</bsdf>" +
          R"(<bsdf type="normalmap"><rgb name="normalmap" value="0.7, 0.4, 0.9"/>)" + diffuse("0.2, 0.8, 0.4") +
          "</bsdf>");
  const std::string sky = R"(<emitter type="constant"/>)";
  const auto wanted = render(bsdf, sky, {.samples_per_pixel = 16, .isa = "scalar"});
  const auto got = render(bsdf, sky, {.samples_per_pixel = 16});
  int different = 0;
  for (std::size_t i = 0; i < wanted.pixels.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k)
      different += !(std::abs(got.pixels[i][k] - wanted.pixels[i][k]) <= 1e-4 * wanted.pixels[i][k]);
  }
  // Where rounding takes a number across a choice's edge.
  EXPECT_LE(different, 3 * 4);
}

TEST_F(LookedThrough, AMaskShowsWhatIsBehindIt) {
  const std::string glow =
      R"(<shape type="rectangle"><transform name="to_world"><scale value="10"/><translate z="-1"/></transform>
    <emitter type="area"><rgb name="radiance" value="4, 2, 1"/></emitter></shape>)";
  expect_mean(render(weighted("mask", "opacity", "0.25", diffuse("0")), glow), {3, 1.5, 0.75});
  expect_mean(render(R"(<bsdf type="null"/>)", glow), {4, 2, 1});
  // Half of it, by a texture: the first of the two colours covers two of a checkerboard's four squares.
  expect_mean(render(R"(<bsdf type="mask"><texture name="opacity" type="checkerboard"><float name="color0" value="1"/>
    <float name="color1" value="0"/></texture><bsdf type="diffuse"><float name="reflectance" value="0"/></bsdf></bsdf>)",
                     glow),
              {2, 1, 0.5});
}

std::string normal_map(bool shadowing, const closed_form::Vec& n) {
  return "<bsdf type=\"normalmap\"><texture name=\"normalmap\" type=\"rawconstant\"><vector name=\"value\" value=\"" +
         std::to_string((n.x + 1) / 2) + ", " + std::to_string((n.y + 1) / 2) + ", " + std::to_string((n.z + 1) / 2) +
         "\"/></texture><boolean name=\"use_shadowing_function\" value=\"" + (shadowing ? "true" : "false") + "\"/>" +
         diffuse("0.6") + "</bsdf>";
}

TEST_F(LookedThrough, NormalMapsTurnTheNormal) {
  // (0.3, -0.2, 1) as a colour; the rectangle's u runs along x.
  const double length = std::sqrt(0.09 + 0.04 + 1);
  const closed_form::Vec n{0.3 / length, -0.2 / length, 1 / length};
  const auto map = [&](bool shadowing, double x, double y, double z) {
    return under_point(normal_map(shadowing, {x, y, z}));
  };
  const double plain = tilted_plane({0, 0, 1}, [](const closed_form::Vec&) { return 1.0; });
  expect_mean(map(true, 0, 0, 1), {plain, plain, plain});
  const double turned = tilted_plane(n, [](const closed_form::Vec&) { return 1.0; });
  ASSERT_GT(std::abs(turned - plain), 0.02 * plain);
  expect_mean(map(false, n.x, n.y, n.z), {turned, turned, turned});
  // A steep one, or there would be too little shadow to see.
  const double steep_length = std::sqrt(0.64 + 0.25 + 1);
  const closed_form::Vec steep{0.8 / steep_length, -0.5 / steep_length, 1 / steep_length};
  const double alpha2 = 0.125 * (steep.x * steep.x + steep.y * steep.y) / (steep.z * steep.z);
  const double lit = tilted_plane(steep, [](const closed_form::Vec&) { return 1.0; });
  const double shadowed = tilted_plane(steep, [&](const closed_form::Vec& w) {
    return 2 / (1 + std::sqrt(1 + alpha2 * (1 - w.z * w.z) / (w.z * w.z)));
  });
  ASSERT_LT(shadowed, 0.99 * lit);
  expect_mean(map(true, steep.x, steep.y, steep.z), {shadowed, shadowed, shadowed});
}

/// Paths from the light need the correction for shading normals (Veach 1997, equation 5.19) to show the same.
TEST_F(LookedThrough, NormalMapsTurnTheNormalForPathsFromTheLightToo) {
  const double length = std::sqrt(0.09 + 0.04 + 1);
  const closed_form::Vec n{0.3 / length, -0.2 / length, 1 / length};
  const double turned = tilted_plane(n, [](const closed_form::Vec&) { return 1.0; });
  expect_mean(render(normal_map(false, n), kPoint, {.samples_per_pixel = 8192}, "ptracer"), {turned, turned, turned});
}

TEST_F(LookedThrough, BumpMapsFollowTheSlopeOfTheirTexture) {
  Image ramp;
  ramp.width = 64;
  ramp.height = 2;
  for (const char* name : {"R", "G", "B"}) {
    auto& values = ramp.channel(name).values;
    for (int i = 0; i < 128; ++i) values[static_cast<std::size_t>(i)] = static_cast<float>(i % 64) / 64.0f;
  }
  ASSERT_TRUE(write_image(path("ramp.exr"), ramp));
  // Heights of 10 u on a plane of side 20: the slope is a half, towards +x.
  const double length = std::sqrt(1.25);
  const double wanted = tilted_plane({-0.5 / length, 0, 1 / length}, [](const closed_form::Vec&) { return 1.0; });
  const auto picture = under_point(R"(<bsdf type="bumpmap"><texture name="any" type="bitmap">
    <string name="filename" value="ramp.exr"/><boolean name="raw" value="true"/></texture><float name="scale" value="10"/>
    <boolean name="use_shadowing_function" value="false"/><boolean name="flip_invalid_normals" value="false"/>)" +
                                   diffuse("0.6") + "</bsdf>");
  expect_mean(picture, {wanted, wanted, wanted});
}

}  // namespace
}  // namespace norrsken::end_to_end
