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
                             const std::string& integrator = "path", const std::string& placed = "") const {
    if (!options.samples_per_pixel) options.samples_per_pixel = 1024;
    options.threads = kThreads;
    const std::string plane =
        R"(<shape type="rectangle"><transform name="to_world"><scale value="10"/>)" + placed + "</transform>";
    return picture_of(render_image(load_elements("<integrator type=\"" + integrator + "\">" + integer("max_depth", 3) +
                                                 "</integrator>" + camera(kSize) + plane + bsdf + "</shape>" + more),
                                   options));
  }
  statistics::Picture under_point(const std::string& bsdf) const { return render(bsdf, kPoint); }
  /// The plane shows its back.
  statistics::Picture back_under_point(const std::string& bsdf) const {
    return render(bsdf, kPoint, {}, "path", R"(<rotate y="1" angle="180"/>)");
  }
  /// Heights that rise by 1 with u. What bumps of them look like, `scale` times as high, around `inside`.
  std::string ramp_around(double scale, const std::string& inside) const {
    Image ramp;
    ramp.width = 64;
    ramp.height = 2;
    for (const char* name : {"R", "G", "B"}) {
      auto& values = ramp.channel(name).values;
      for (int i = 0; i < 128; ++i) values[static_cast<std::size_t>(i)] = static_cast<float>(i % 64) / 64.0f;
    }
    EXPECT_TRUE(write_image(path("ramp.exr"), ramp));
    return R"(<bsdf type="bumpmap"><texture name="any" type="bitmap"><string name="filename" value="ramp.exr"/>
      <boolean name="raw" value="true"/></texture><float name="scale" value=")" +
           std::to_string(scale) + R"("/><boolean name="use_shadowing_function" value="false"/>
      <boolean name="flip_invalid_normals" value="false"/>)" +
           inside + "</bsdf>";
  }
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

std::string normal_map(bool shadowing, const closed_form::Vec& n, const std::string& inside = diffuse("0.6")) {
  return "<bsdf type=\"normalmap\"><texture name=\"normalmap\" type=\"rawconstant\"><vector name=\"value\" value=\"" +
         std::to_string((n.x + 1) / 2) + ", " + std::to_string((n.y + 1) / 2) + ", " + std::to_string((n.z + 1) / 2) +
         "\"/></texture><boolean name=\"use_shadowing_function\" value=\"" + (shadowing ? "true" : "false") + "\"/>" +
         inside + "</bsdf>";
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
  const std::string kUnfolded = R"(<boolean name="flip_invalid_normals" value="false"/>)";
  const double length = std::sqrt(0.09 + 0.04 + 1);
  const closed_form::Vec n{0.3 / length, -0.2 / length, 1 / length};
  const double turned = tilted_plane(n, [](const closed_form::Vec&) { return 1.0; });
  expect_mean(render(normal_map(false, n, kUnfolded + diffuse("0.6")), kPoint, {.samples_per_pixel = 8192}, "ptracer"),
              {turned, turned, turned});
}

TEST_F(LookedThrough, BumpMapsFollowTheSlopeOfTheirTexture) {
  // Heights of 10 u on a plane of side 20: the slope is a half, towards +x.
  const double length = std::sqrt(1.25);
  const double wanted = tilted_plane({-0.5 / length, 0, 1 / length}, [](const closed_form::Vec&) { return 1.0; });
  const auto picture = under_point(ramp_around(10, diffuse("0.6")));
  expect_mean(picture, {wanted, wanted, wanted});
}

double tilted_plane(const closed_form::Vec& normal) {
  return tilted_plane(normal, [](const closed_form::Vec&) { return 1.0; });
}
std::string twosided(const std::string& inside) { return "<bsdf type=\"twosided\">" + inside + "</bsdf>"; }

/// Turned by half a turn about y, the plane has u along -x and its normal along -z.
TEST_F(LookedThrough, WhatStandsAroundAMapDecidesHowItsBackLooks) {
  const closed_form::Vec n = normalize(closed_form::Vec{0.3, -0.2, 1});
  const double mirrored = tilted_plane({-n.x, n.y, n.z}), turned = tilted_plane({n.x, -n.y, n.z});
  ASSERT_GT(std::abs(mirrored - turned), 0.02 * turned);
  // twosided mirrors directions before the map sees them; inside of the map it turns the map's normal to the viewer.
  expect_mean(back_under_point(twosided(normal_map(false, n))), {mirrored, mirrored, mirrored});
  expect_mean(back_under_point(normal_map(false, n, twosided(diffuse("0.6")))), {turned, turned, turned});
  expect_mean(back_under_point(twosided(weighted("mask", "opacity", "1", normal_map(false, n)))),
              {mirrored, mirrored, mirrored});
  expect_mean(back_under_point(twosided(normal_map(false, n, twosided(diffuse("0.6"))))),
              {mirrored, mirrored, mirrored});
  // Heights of 10 u on a plane of side 20, u along -x: it rises towards -x, from the back too if it is mirrored.
  const closed_form::Vec hill = normalize(closed_form::Vec{0.5, 0, 1});
  const double out = tilted_plane({hill.x, 0, hill.z}), in = tilted_plane({-hill.x, 0, hill.z});
  ASSERT_GT(std::abs(out - in), 0.02 * out);
  expect_mean(back_under_point(twosided(ramp_around(10, diffuse("0.6")))), {out, out, out});
  expect_mean(back_under_point(ramp_around(10, twosided(diffuse("0.6")))), {in, in, in});
  // With two inside, the back is the second one's.
  expect_mean(back_under_point(twosided(normal_map(false, {0, 0, 1}, diffuse("0.1")) + normal_map(false, n))),
              {mirrored, mirrored, mirrored});
}

TEST_F(LookedThrough, MapsInsideEachOtherWorkOnTheFrameAround) {
  const closed_form::Vec first = normalize(closed_form::Vec{0.4, 0.3, 1}),
                         second = normalize(closed_form::Vec{-0.2, 0.5, 1});
  const auto within = [](const closed_form::Vec& n, const closed_form::Vec& local) {
    const closed_form::Vec s = normalize(closed_form::Vec{1, 0, 0} - n * n.x), t = cross(n, s);
    return s * local.x + t * local.y + n * local.z;
  };
  const auto bumped = [](const closed_form::Vec& n, double height) {
    const auto moved = [&](const closed_form::Vec& tangent, double slope) {
      return tangent + n * (slope - dot(n, tangent));
    };
    return normalize(cross(moved({20, 0, 0}, height), moved({0, 20, 0}, 0)));
  };
  const auto expect_normal = [&](const std::string& bsdf, const closed_form::Vec& n) {
    const double wanted = tilted_plane(n);
    expect_mean(under_point(bsdf), {wanted, wanted, wanted});
  };
  expect_normal(normal_map(false, first, normal_map(false, second)), within(first, second));
  expect_normal(normal_map(false, first, ramp_around(10, diffuse("0.6"))), bumped(first, 10));
  const closed_form::Vec slope = bumped({0, 0, 1}, 10);
  expect_normal(ramp_around(10, normal_map(false, second)), within(slope, second));
  ASSERT_GT(std::abs(tilted_plane(bumped(second, 10)) - tilted_plane(within(slope, second))), 5e-3);
  // Where two normals that follow each other see the light from different sides there is none, at each of them.
  const std::string steep = normal_map(false, normalize(closed_form::Vec{0.9, 0, 0.3}));
  const double least = mean(under_point(normal_map(false, {0, 0, 1}, steep)))[0];
  EXPECT_NEAR(least, mean(under_point(steep))[0], 1e-3 * least);
}

}  // namespace
}  // namespace norrsken::end_to_end
