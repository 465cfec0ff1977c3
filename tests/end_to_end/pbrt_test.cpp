// Scenes in pbrt's language, by what pbrt defines: units, exposure, falloff, and where things are.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <map>
#include <numbers>
#include <string>
#include <vector>

#include "norrsken/image.h"
#include "tests/end_to_end/rendering.h"

namespace norrsken::end_to_end {
namespace {

constexpr double kPi = std::numbers::pi;
using Files = std::map<std::string, std::string>;
using Pixel = std::array<double, 3>;

/// An image of floats as a PFM file; rows from the top.
std::string pfm(int width, int height, const std::vector<Pixel>& pixels) {
  std::string bytes = "PF\n" + std::to_string(width) + " " + std::to_string(height) + "\n-1\n";
  for (int y = height; y-- > 0;) {
    for (int x = 0; x < width; ++x) {
      for (const double component : pixels[static_cast<std::size_t>(y * width + x)]) {
        const auto value = static_cast<float>(component);
        char raw[sizeof value];
        std::memcpy(raw, &value, sizeof value);
        bytes.append(raw, sizeof value);
      }
    }
  }
  return bytes;
}

std::vector<Pixel> render(const std::string& text, const Files& files = {}, int samples = 16) {
  auto scene = Scene::load(SceneSource::memory("scene.pbrt", text, files));
  for (const Diagnostic& diagnostic : scene.diagnostics().all())
    EXPECT_EQ(to_text(diagnostic), "warning: the scene has no shape");
  if (!scene) return std::vector<Pixel>(64);
  RenderOptions options;
  options.samples_per_pixel = samples;
  const Image image = render_image(*scene, options);
  std::vector<Pixel> pixels;
  for (std::size_t i = 0; i < image.find("R")->values.size(); ++i)
    pixels.push_back({image.find("R")->values[i], image.find("G")->values[i], image.find("B")->values[i]});
  return pixels;
}

/// A camera at the origin that looks along +z and sees 45 degrees to each side.
std::string view(int size, const std::string& film = {}) {
  const std::string n = std::to_string(size);
  return "Camera \"perspective\" \"float fov\" 90\nFilm \"rgb\" \"integer xresolution\" " + n +
         " \"integer yresolution\" " + n + " " + film +
         "\nPixelFilter \"box\"\nIntegrator \"path\" \"integer maxdepth\" 1\n";
}

/// A tiny view straight ahead, where a plane at z = 1 is white.
std::string lit_plane(const std::string& light, const std::string& film = {}) {
  return "Camera \"perspective\" \"float fov\" 0.01\nFilm \"rgb\" \"integer xresolution\" 1 \"integer yresolution\" "
         "1 " +
         film + "\nIntegrator \"path\" \"integer maxdepth\" 1\nWorldBegin\n" + light +
         "\nMaterial \"diffuse\" \"rgb reflectance\" [ 1 1 1 ]\n"
         "Shape \"bilinearmesh\" \"point3 P\" [ -9 -9 1  9 -9 1  -9 9 1  9 9 1 ]";
}

double luminance(const Pixel& pixel) { return 0.2126 * pixel[0] + 0.7152 * pixel[1] + 0.0722 * pixel[2]; }

void expect_near(const Pixel& pixel, const Pixel& expected, double tolerance) {
  for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(pixel[c], expected[c], tolerance) << "channel " << c;
}

const std::string kQuarters = pfm(2, 2, {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 0}});

TEST(Pbrt, TheCameraHasXToTheRightAndImagesStandUpright) {
  const auto pixels = render(view(2) + R"(WorldBegin
    AreaLightSource "diffuse" "string filename" "quarters.pfm" "float scale" 2
    ReverseOrientation
    Shape "bilinearmesh" "point3 P" [ -1 -1 1  1 -1 1  -1 1 1  1 1 1 ])",
                             {{"quarters.pfm", kQuarters}}, 64);
  // Bilinear between four texels: each pixel's mean is mostly its own.
  EXPECT_GT(pixels[0][0], 1.0);
  EXPECT_LT(pixels[0][2], 0.5);
  EXPECT_GT(pixels[1][1], 1.0);
  EXPECT_LT(pixels[1][0], 0.8);
  EXPECT_GT(pixels[2][2], 1.0);
  EXPECT_GT(pixels[3][0], 1.0);
  EXPECT_LT(pixels[3][2], 0.5);
}

TEST(Pbrt, LookAtAndMirroringPutThingsWherePbrtDoes) {
  const std::string world = R"(WorldBegin
    AreaLightSource "diffuse" "bool twosided" false
    Translate 1 0 5
    Shape "sphere" "float radius" .5)";
  const std::string seen = "LookAt 0 0 0  0 0 1  0 1 0\n" + view(4);
  EXPECT_GT(render(seen + world)[10][1], 0.02);
  EXPECT_EQ(render(seen + world)[9][1], 0);
  EXPECT_EQ(render("Scale -1 1 1\n" + seen + world)[10][1], 0);
  EXPECT_GT(render("Scale -1 1 1\n" + seen + world)[9][1], 0.02);
}

TEST(Pbrt, OnlyTheFrontShinesUnlessBothSidesDo) {
  const auto square = [](const std::string& light, const std::string& before = {}) {
    return render(view(1) + "WorldBegin\nAreaLightSource \"diffuse\" " + light + "\n" + before +
                  "Shape \"bilinearmesh\" \"point3 P\" [ -9 -9 1  9 -9 1  -9 9 1  9 9 1 ]")[0][1];
  };
  EXPECT_EQ(square(R"("rgb L" [ 2 3 4 ])"), 0);
  EXPECT_NEAR(square(R"("rgb L" [ 2 3 4 ])", "ReverseOrientation\n"), 3, 1e-5);
  // Mirroring alone leaves the front where it was.
  EXPECT_NEAR(square(R"("rgb L" [ 2 3 4 ])", "ReverseOrientation\nScale -1 1 1\n"), 3, 1e-5);
  EXPECT_NEAR(square(R"("rgb L" [ 2 3 4 ] "bool twosided" true)"), 3, 1e-5);
  EXPECT_NEAR(square(R"("rgb L" [ 2 3 4 ] "bool twosided" true)", "ReverseOrientation\n"), 3, 1e-5);
}

TEST(Pbrt, RoundShapesFaceOutUntilTheyAreReversedOrMirrored) {
  const auto seen = [](const std::string& before, const std::string& shape) {
    return render(view(1) + "WorldBegin\nAreaLightSource \"diffuse\"\n" + before + "\nTranslate 0 0 3\n" + shape, {},
                  64)[0][1] > 0.01;
  };
  for (const char* shape :
       {"Shape \"sphere\"", "Rotate 90 0 1 0 Shape \"cylinder\"",
        "Rotate 90 0 1 0 Shape \"cylinder\" \"float phimax\" 359.99", "Rotate 180 0 1 0 Shape \"disk\"",
        "Rotate 180 0 1 0 Shape \"disk\" \"float innerradius\" .1"}) {
    EXPECT_TRUE(seen("", shape)) << shape;
    EXPECT_FALSE(seen("ReverseOrientation", shape)) << shape;
    EXPECT_FALSE(seen("Scale -1 1 1", shape)) << shape;
    EXPECT_TRUE(seen("ReverseOrientation\nScale -1 1 1", shape)) << shape;
  }
}

TEST(Pbrt, AlphaIsTheShareThatIsThere) {
  const auto seen = [](const std::string& alpha) {
    return render(
        view(1) + "WorldBegin\nLightSource \"infinite\"\nMaterial \"diffuse\" \"rgb reflectance\" [ 0 0 0 ]\n" + alpha,
        {}, 4096)[0][1];
  };
  const std::string patch = "Shape \"bilinearmesh\" \"point3 P\" [ -1 -1 1  1 -1 1  -1 1 1  1 1 1 ] ";
  EXPECT_NEAR(seen(patch + "\"float alpha\" .25"), 0.75, 0.02);
  EXPECT_NEAR(seen("Texture \"a\" \"float\" \"checkerboard\" \"float uscale\" 4 \"float vscale\" 4\n" + patch +
                   "\"texture alpha\" \"a\""),
              0.5, 0.02);
}

TEST(Pbrt, ALightWithoutAColourHasLuminanceOne) {
  EXPECT_NEAR(render(view(1) + "WorldBegin\nLightSource \"infinite\"")[0][0], 1, 1e-5);
  expect_near(render(view(1) + "WorldBegin\nLightSource \"infinite\" \"rgb L\" [ 1 2 3 ] \"float scale\" 2")[0],
              {2, 4, 6}, 1e-4);
  for (const char* spectrum :
       {"\"blackbody L\" 3000", "\"spectrum L\" [ 400 1 500 3 700 2 ]", "\"spectrum L\" \"stdillum-A\""})
    EXPECT_NEAR(luminance(render(view(1) + "WorldBegin\nLightSource \"infinite\" \"float scale\" 5 " + spectrum)[0]), 5,
                1e-3)
        << spectrum;
}

TEST(Pbrt, LightsAroundTheSceneAddUp) {
  const std::string two = "WorldBegin\nLightSource \"infinite\" \"rgb L\" [ 1 2 3 ]\nLightSource \"infinite\" ";
  expect_near(render(view(1) + two + "\"rgb L\" [ 1 1 1 ]")[0], {2, 3, 4}, 1e-4);
  expect_near(render(view(1) + two + "\"string filename\" \"half.pfm\" \"float scale\" 2",
                     {{"half.pfm", pfm(1, 1, {{.5, .5, 1}})}})[0],
              {2, 3, 5}, 1e-4);
}

TEST(Pbrt, ExposureIsTimeTimesSensitivity) {
  const std::string sky = "WorldBegin\nLightSource \"infinite\" \"rgb L\" [ 1 1 1 ]";
  EXPECT_NEAR(render(view(1, "\"float iso\" 400") + sky)[0][0], 4, 1e-4);
  EXPECT_NEAR(render("Camera \"perspective\" \"float shutterclose\" .25\nFilm \"rgb\" \"integer xresolution\" 1 "
                     "\"integer yresolution\" 1\n" +
                     sky)[0][0],
              0.25, 1e-5);
}

TEST(Pbrt, PointLightsFollowTheirDefinitions) {
  const double at_one = 1 / kPi;  // radiance of white paper by an intensity of 1 at distance 1
  EXPECT_NEAR(render(lit_plane(R"(LightSource "point" "rgb I" [ 2 2 2 ])"))[0][0], 2 * at_one, 1e-4);
  EXPECT_NEAR(render(lit_plane(R"(LightSource "point" "float power" 12.566371)"))[0][0], at_one, 1e-4);
  EXPECT_NEAR(render(lit_plane(R"(LightSource "point" "point3 from" [ 0 0 -1 ])"))[0][0], at_one / 4, 1e-4);
  EXPECT_NEAR(render(lit_plane(R"(LightSource "distant" "rgb L" [ 3 3 3 ])"))[0][0], 3 / kPi, 1e-4);
  EXPECT_NEAR(render(lit_plane(R"(LightSource "distant" "float illuminance" 2)"))[0][0], 2 / kPi, 1e-4);
  EXPECT_NEAR(render(lit_plane(R"(LightSource "infinite" "float illuminance" 2)"), {}, 1 << 12)[0][0], 2 / kPi, 0.02);
}

TEST(Pbrt, SpotsHaveASmoothEdgeAndTheirPower) {
  const auto seen_at = [](double degrees, const std::string& more = {}) {
    const double tangent = std::tan(degrees * kPi / 180);
    const std::string to = std::to_string(-tangent);
    // The point straight ahead is so many degrees off the axis.
    return render(lit_plane("LightSource \"spot\" \"point3 to\" [ " + to +
                            " 0 1 ] \"float coneangle\" 40 \"float conedeltaangle\" 20 " + more))[0][0] *
           kPi;
  };
  const double outer = std::cos(40 * kPi / 180), inner = std::cos(20 * kPi / 180);
  EXPECT_NEAR(seen_at(0), 1, 1e-3);
  EXPECT_NEAR(seen_at(19), 1, 1e-3);
  EXPECT_EQ(seen_at(41), 0);
  for (const double degrees : {25.0, 30.0, 35.0}) {
    const double t = (std::cos(degrees * kPi / 180) - outer) / (inner - outer);
    EXPECT_NEAR(seen_at(degrees), t * t * (3 - 2 * t), 2e-3) << degrees;
  }
  EXPECT_NEAR(seen_at(0, "\"float power\" 1"), 1 / (2 * kPi * (1 - inner + (inner - outer) / 2)), 1e-3);
}

TEST(Pbrt, EqualAreaImagesAreInTheirDirections) {
  // Red for +x, green for +y, blue for +z, each as the direction's component.
  constexpr int kSize = 64;
  std::vector<Pixel> pixels;
  for (int y = 0; y < kSize; ++y) {
    for (int x = 0; x < kSize; ++x) {
      const double u = 2 * (x + 0.5) / kSize - 1, v = 2 * (y + 0.5) / kSize - 1;
      const double inside = 1 - std::abs(u) - std::abs(v), r = 1 - std::abs(inside);
      const double phi = ((std::abs(v) - std::abs(u)) / r + 1) * kPi / 4, s = r * std::sqrt(2 - r * r);
      pixels.push_back({std::max(std::copysign(std::cos(phi) * s, u), 0.0),
                        std::max(std::copysign(std::sin(phi) * s, v), 0.0),
                        std::max(std::copysign(1 - r * r, inside), 0.0)});
    }
  }
  const Files files = {{"sky.pfm", pfm(kSize, kSize, pixels)}};
  const auto seen = [&](const std::string& to, const std::string& turn = {}) {
    const std::string up = to == "0 1 0" ? "1 0 0" : "0 1 0";
    return render("LookAt 0 0 0 " + to + " " + up +
                      "\nCamera \"perspective\" \"float fov\" 1\nFilm \"rgb\" \"integer xresolution\" 1 \"integer "
                      "yresolution\" 1\nWorldBegin\n" +
                      turn + "\nLightSource \"infinite\" \"string filename\" \"sky.pfm\"",
                  files)[0];
  };
  expect_near(seen("1 0 0"), {1, 0, 0}, 0.05);
  expect_near(seen("0 1 0"), {0, 1, 0}, 0.05);
  expect_near(seen("0 0 1"), {0, 0, 1}, 0.05);
  expect_near(seen("0 0 -1"), {0, 0, 0}, 0.05);
  expect_near(seen("1 1 0"), {std::sqrt(.5), std::sqrt(.5), 0}, 0.05);
  // z up in the light's space.
  expect_near(seen("0 1 0", "Rotate -90 1 0 0"), {0, 0, 1}, 0.05);
  expect_near(seen("-1 0 0", "Scale -1 1 1"), {1, 0, 0}, 0.05);
}

TEST(Pbrt, GoniometricAndProjectionLightsThrowTheirImages) {
  const Files files = {{"half.pfm", pfm(1, 1, {{.5, .5, .5}})}, {"quarters.pfm", kQuarters}};
  EXPECT_NEAR(render(lit_plane(R"(LightSource "goniometric" "string filename" "half.pfm" "float scale" 4)"), files,
                     1 << 12)[0][0],
              2 / kPi, 0.02);
  EXPECT_NEAR(
      render(lit_plane(R"(LightSource "projection" "string filename" "half.pfm" "float scale" 4)"), files)[0][0],
      2 / kPi, 1e-3);
  const auto seen = render(view(8) + R"(WorldBegin
    LightSource "projection" "string filename" "quarters.pfm"
    Material "diffuse" "rgb reflectance" [ 1 1 1 ]
    Shape "bilinearmesh" "point3 P" [ -9 -9 1  9 -9 1  -9 9 1  9 9 1 ])",
                           files);
  EXPECT_GT(seen[9][0], 10 * seen[9][1]);    // red, upper left
  EXPECT_GT(seen[14][1], 10 * seen[14][2]);  // green, upper right
  EXPECT_GT(seen[49][2], 10 * seen[49][1]);  // blue, lower left
}

TEST(Pbrt, TexturesLieOnSurfacesAsInPbrt) {
  const auto seen = [](const std::string& texture, const Files& files = {}) {
    return render(view(4) + "WorldBegin\nLightSource \"infinite\"\n" + texture +
                      "\nMaterial \"diffuse\" \"texture reflectance\" \"t\"\n"
                      "Shape \"bilinearmesh\" \"point3 P\" [ -1 -1 1  1 -1 1  -1 1 1  1 1 1 ]",
                  files, 256);
  };
  auto pixels =
      seen("Texture \"t\" \"spectrum\" \"imagemap\" \"string filename\" \"quarters.pfm\" \"string filter\" \"point\"",
           {{"quarters.pfm", kQuarters}});
  expect_near(pixels[0], {1, 0, 0}, 0.05);
  expect_near(pixels[3], {0, 1, 0}, 0.05);
  expect_near(pixels[12], {0, 0, 1}, 0.05);
  // With v upwards the square of (0, 0) is the lower left one.
  pixels = seen(
      "Texture \"t\" \"spectrum\" \"checkerboard\" \"rgb tex1\" [ .8 0 0 ] \"rgb tex2\" [ 0 0 .4 ] \"float uscale\" 2 "
      "\"float vscale\" 2");
  expect_near(pixels[12], {.8, 0, 0}, 0.05);
  expect_near(pixels[15], {0, 0, .4}, 0.05);
  expect_near(pixels[0], {0, 0, .4}, 0.05);
  pixels = seen(
      "Texture \"c\" \"float\" \"checkerboard\" \"float uscale\" 2 \"float vscale\" 2\n"
      "Texture \"t\" \"spectrum\" \"mix\" \"rgb tex1\" [ 0 .5 0 ] \"rgb tex2\" [ 1 0 0 ] \"texture amount\" \"c\"");
  expect_near(pixels[12], {1, 0, 0}, 0.05);
  expect_near(pixels[0], {0, .5, 0}, 0.05);
}

TEST(Pbrt, PowerIsThatOfEachPrimitive) {
  const auto seen = [](const std::string& points, const std::string& indices) {
    return render(view(1) +
                      "WorldBegin\nAreaLightSource \"diffuse\" \"float power\" 10\nReverseOrientation\nShape "
                      "\"trianglemesh\" \"point3 P\" [ " +
                      points + " ] \"integer indices\" [ " + indices + " ]",
                  {}, 1024)[0][1];
  };
  // Of two triangles of area 2 that fill the view.
  EXPECT_NEAR(seen("-1 -1 1 1 -1 1 1 1 1 -1 1 1", "0 1 2 0 2 3"), 10 / (kPi * 2), 1e-3);
  // Of one that is half of it and one of twice its area behind the camera.
  EXPECT_NEAR(seen("-1 -1 1 1 -1 1 1 1 1  0 0 -9 2 0 -9 0 4 -9", "0 1 2 3 4 5"), 10 / (kPi * 2) / 2, 0.03);
}

TEST(Pbrt, PowerIsThatOfEachPatch) {
  // Two patches of area 4 and 1, the small one behind the camera.
  const auto pixels = render(view(1) + R"(WorldBegin
    AreaLightSource "diffuse" "float power" 10
    ReverseOrientation
    Shape "bilinearmesh" "point3 P" [ -1 -1 1  1 -1 1  -1 1 1  1 1 1  0 0 -9  1 0 -9  0 1 -9  1 1 -9 ]
      "integer indices" [ 0 1 2 3 4 5 6 7 ])");
  EXPECT_NEAR(pixels[0][1], 10 / (kPi * 4), 1e-4);
}

TEST(Pbrt, InstancesStandWhereTheyArePut) {
  const auto pixels = render(view(4) + R"(WorldBegin
    LightSource "infinite"
    ObjectBegin "square"
      Material "diffuse" "rgb reflectance" [ 0 0 0 ]
      Shape "bilinearmesh" "point3 P" [ -1 -1 4  1 -1 4  -1 1 4  1 1 4 ]
    ObjectEnd
    Translate 1 1 0
    ObjectInstance "square")");
  EXPECT_NEAR(pixels[6][1], 0, 1e-5);
  EXPECT_NEAR(pixels[5][1], 1, 1e-5);
  EXPECT_NEAR(pixels[10][1], 1, 1e-5);
}

}  // namespace
}  // namespace norrsken::end_to_end
