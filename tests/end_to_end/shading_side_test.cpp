// Which side of a surface is seen is told by its shading normal, where the geometric normal says otherwise too.
#include <cmath>
#include <numbers>
#include <sstream>

#include "norrsken/image.h"
#include "tests/closed_form/closed_form.h"
#include "tests/end_to_end/scene_folder.h"

namespace norrsken::end_to_end {
namespace {

using closed_form::Vec;

constexpr int kSize = 8;
constexpr double kIrradiance = 3, kFront = 0.6, kBack = 0.25;
const Vec kNormal = normalize(Vec{0.98, 0, 0.2});  ///< of shading; the plane is z = 0, its front up
const Vec kToLight = normalize(Vec{-0.5, 0.3, 0.8}), kToLightBelow = normalize(Vec{0.5, 0.3, -0.3});
const View kAboveThePlane{.origin = "-4, 0, 2", .up = "0, 0, 1", .fov = "10"};   ///< but below the shading normal
const View kBelowThePlane{.origin = "4, 0, -0.4", .up = "0, 0, 1", .fov = "5"};  ///< but above the shading normal

const std::string kTwosided = "<bsdf type=\"twosided\">" + diffuse("0.6") + diffuse("0.25") + "</bsdf>";

std::string light_from(const Vec& w) {
  return "<emitter type=\"directional\"><vector name=\"direction\" value=\"" + std::to_string(-w.x) + ", " +
         std::to_string(-w.y) + ", " + std::to_string(-w.z) + "\"/><float name=\"irradiance\" value=\"3\"/></emitter>";
}

class ShadingSide : public SceneFolder {
 protected:
  /// The plane z = 0, seen by `view`.
  double mean(const std::string& inside, const View& view, const std::string& more, RenderOptions options = {},
              const std::string& integrator = "path") const {
    std::ostringstream obj;
    obj << "v -9 -9 0\nv 9 -9 0\nv 9 9 0\nv -9 9 0\nvn " << kNormal.x << " 0 " << kNormal.z
        << "\nf 1//1 2//1 3//1\nf 1//1 3//1 4//1\n";
    write("plane.obj", obj.str());
    options.threads = kThreads;
    if (!options.samples_per_pixel) options.samples_per_pixel = 4;
    const auto picture =
        picture_of(render_image(load_elements("<integrator type=\"" + integrator + "\">" + integer("max_depth", 3) +
                                              "</integrator>" + camera(kSize, view) + "<shape type=\"obj\">" +
                                              text("filename", "plane.obj") + inside + "</shape>" + more),
                                options));
    double sum = 0;
    for (const auto& pixel : picture.pixels) sum += pixel[1] / (kSize * kSize);
    return sum;
  }
};

double shown(double reflectance, double cosine) { return reflectance / std::numbers::pi * kIrradiance * cosine; }

TEST_F(ShadingSide, TheBackIsSeenWhereTheNormalTurnsAway) {
  const double wanted = shown(kBack, -dot(kNormal, kToLight));
  ASSERT_GT(wanted, 0.05);
  for (const char* accelerator : {"planes", "moller_trumbore", "bvh", "embree"}) {
    EXPECT_NEAR(mean(kTwosided, kAboveThePlane, light_from(kToLight), {.accelerator = accelerator}), wanted,
                1e-4 * wanted)
        << accelerator;
  }
  EXPECT_NEAR(mean(kTwosided, kAboveThePlane, light_from(kToLight), {.isa = "scalar"}), wanted, 1e-4 * wanted);
  EXPECT_EQ(mean(diffuse("0.6"), kAboveThePlane, light_from(kToLight)), 0) << "one-sided";
}

TEST_F(ShadingSide, TheFrontIsSeenFromBelowWhereTheNormalTurnsThere) {
  const double wanted = shown(kFront, dot(kNormal, kToLightBelow));
  ASSERT_GT(wanted, 0.05);
  EXPECT_NEAR(mean(diffuse("0.6"), kBelowThePlane, light_from(kToLightBelow)), wanted, 1e-4 * wanted);
  EXPECT_NEAR(mean(kTwosided, kBelowThePlane, light_from(kToLightBelow)), wanted, 1e-4 * wanted);
}

TEST_F(ShadingSide, PathsFromTheLightSeeTheSameSide) {
  const std::string lamp = R"(<emitter type="point"><point name="position" value="-1, 0.6, 1.6"/>
    <float name="intensity" value="20"/></emitter>)";
  const double by_path = mean(kTwosided, kAboveThePlane, lamp, {.samples_per_pixel = 16});
  ASSERT_GT(by_path, 0.01);
  EXPECT_NEAR(mean(kTwosided, kAboveThePlane, lamp, {.samples_per_pixel = 65536}, "ptracer"), by_path, 0.02 * by_path);
}

TEST_F(ShadingSide, WhatEmitsGoesByTheGeometricNormal) {
  const std::string glow = R"(<emitter type="area"><float name="radiance" value="2"/></emitter>)";
  EXPECT_NEAR(mean(glow, kAboveThePlane, ""), 2, 1e-5);
  EXPECT_EQ(mean(glow, kBelowThePlane, ""), 0);
  // One side emits, the other scatters; the tolerance is for the choice between two lights.
  EXPECT_NEAR(mean(glow + kTwosided, kAboveThePlane, light_from(kToLight), {.samples_per_pixel = 1024}),
              2 + shown(kBack, -dot(kNormal, kToLight)), 4e-3);
}

/// As `rings` by 2 `rings` triangles with the normals of a sphere.
std::string coarse_ball(int rings) {
  std::ostringstream obj;
  for (int j = 0; j <= rings; ++j) {
    for (int i = 0; i < 2 * rings; ++i) {
      const double theta = std::numbers::pi * j / rings, phi = std::numbers::pi * i / rings;
      for (const char* kind : {"v ", "vn "}) {
        obj << kind << std::sin(theta) * std::cos(phi) << ' ' << std::cos(theta) << ' '
            << std::sin(theta) * std::sin(phi) << '\n';
      }
    }
  }
  const auto corner = [&](int j, int i) {
    const std::string k = std::to_string(j * 2 * rings + i % (2 * rings) + 1);
    return k + "//" + k;
  };
  for (int j = 0; j < rings; ++j) {
    for (int i = 0; i < 2 * rings; ++i) {
      const std::string a = corner(j, i), b = corner(j, i + 1), c = corner(j + 1, i + 1), d = corner(j + 1, i);
      if (j > 0) obj << "f " << a << ' ' << b << ' ' << c << '\n';
      if (j < rings - 1) obj << "f " << a << ' ' << c << ' ' << d << '\n';
    }
  }
  return obj.str();
}

class CoarseBall : public SceneFolder {
 protected:
  statistics::Picture render(const std::string& bsdf, RenderOptions options = {}, int rr_depth = 1000) const {
    write("ball.obj", coarse_ball(6));
    options.threads = kThreads;
    if (!options.samples_per_pixel) options.samples_per_pixel = 256;
    return picture_of(render_image(
        load_elements("<integrator type=\"path\">" + integer("max_depth", 200) + integer("rr_depth", rr_depth) +
                      "</integrator>" +
                      camera(32, {.origin = "0, 0, 5", .fov = "26"}, "<rfilter type=\"box\"/>", "independent") +
                      "<shape type=\"obj\">" + text("filename", "ball.obj") + bsdf + "</shape>" +
                      R"(<emitter type="constant"/>)"),
        options));
  }
};

double least(const statistics::Picture& picture) {
  double least = picture.pixels[0][1];
  for (const auto& pixel : picture.pixels) least = std::min(least, pixel[1]);
  return least;
}

double mean_of(const statistics::Picture& picture) {
  double sum = 0;
  for (const auto& pixel : picture.pixels) sum += pixel[1];
  return sum / static_cast<double>(picture.pixels.size());
}

TEST_F(CoarseBall, OfGlassIsHardlySeenInAFurnace) {
  const auto picture = render(R"(<bsdf type="dielectric"/>)");
  EXPECT_GE(mean_of(picture), 0.999);
  EXPECT_GT(least(picture), 0.5);
}

TEST_F(CoarseBall, HasNoBlackRim) {
  const auto of = [](const std::string& type) {
    return "<bsdf type=\"twosided\"><bsdf type=\"" + type + "\"/></bsdf>";
  };
  EXPECT_GT(least(render(of("conductor"))), 0.99) << "cannot be seen at all";
  EXPECT_GT(least(render(of("roughconductor"))), 0.85) << "rays end where two facets meet, but not at the rim alone";
}

/// Radiance is less inside of glass; paths that will leave it again must not be ended for that.
TEST_F(CoarseBall, RouletteKnowsThatGlassCompressesRadiance) {
  const auto picture =
      render(R"(<bsdf type="roughdielectric"><float name="alpha" value="0.2"/></bsdf>)", {.samples_per_pixel = 1}, 1);
  const double mean = mean_of(picture);
  double variance = 0;
  for (const auto& pixel : picture.pixels) variance += (pixel[1] - mean) * (pixel[1] - mean);
  variance /= static_cast<double>(picture.pixels.size());
  // The survival probability is 0.95 at most; without eta^2 it was 0.44 on the way in, which alone makes it 1.27.
  EXPECT_LT(variance, 0.5);
}

}  // namespace
}  // namespace norrsken::end_to_end
