// Sensors that measure, where the answer has a closed form, and batches of sensors against each of them alone.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include "norrsken/image.h"
#include "tests/end_to_end/rendering.h"

namespace norrsken::end_to_end {
namespace {

constexpr double kPi = std::numbers::pi;

std::string film(int width, int height) {
  return R"(<film type="hdrfilm"><integer name="width" value=")" + std::to_string(width) +
         R"("/><integer name="height" value=")" + std::to_string(height) + R"("/><rfilter type="box"/></film>)";
}
const std::string kSky = R"(<emitter type="constant"><rgb name="radiance" value="0.5 1 2"/></emitter>)";
const std::string kBlackBall =
    R"(<shape type="sphere"><bsdf type="diffuse"><rgb name="reflectance" value="0"/></bsdf></shape>)";

Image render(const std::string& elements, int samples = 256) {
  const std::string text = "<scene version=\"3.0.0\">" + elements + "</scene>";
  auto scene = Scene::load(SceneSource::memory("scene.xml", text, {}));
  for (const Diagnostic& diagnostic : scene.diagnostics().all()) ADD_FAILURE() << to_text(diagnostic);
  RenderOptions options;
  options.samples_per_pixel = samples;
  return render_image(*scene, options);
}
double value(const Image& image, const char* channel, std::size_t i = 0) {
  return static_cast<double>(image.find(channel)->values.at(i));
}

TEST(RadianceMeter, SeesWhatLiesOnItsRay) {
  const std::string ball =
      R"(<shape type="sphere"><emitter type="area"><rgb name="radiance" value="3 2 1"/></emitter></shape>)";
  const auto sensor = [](const std::string& inside) {
    return "<sensor type=\"radiancemeter\">" + inside + film(1, 1) + "</sensor>";
  };
  const Image hit =
      render(ball + sensor(R"(<point name="origin" x="0" y="0" z="5"/><vector name="direction" x="0" y="0" z="-7"/>)"));
  EXPECT_FLOAT_EQ(hit.find("R")->values[0], 3);
  EXPECT_FLOAT_EQ(hit.find("B")->values[0], 1);
  const Image miss = render(ball + sensor(R"(<transform name="to_world"><translate y="1.01" z="-5"/></transform>)"));
  EXPECT_EQ(miss.find("R")->values[0], 0);
  EXPECT_FLOAT_EQ(
      render(ball + sensor(R"(<transform name="to_world"><scale value="3"/><translate y="0.99" z="-5"/></transform>)"))
          .find("R")
          ->values[0],
      3);
}

TEST(IrradianceMeter, MeasuresAUniformSkyOnEveryShape) {
  const std::string meter = "<sensor type=\"irradiancemeter\">" + film(2, 3) + "</sensor>";
  for (const std::string shape :
       {"<shape type=\"rectangle\">", "<shape type=\"disk\">", "<shape type=\"sphere\">", "<shape type=\"cube\">",
        "<shape type=\"cylinder\"><transform name=\"to_world\"><scale value=\"2\"/><rotate y=\"1\" "
        "angle=\"40\"/></transform>"}) {
    SCOPED_TRACE(shape);
    const Image image = render(
        kSky + shape + R"(<bsdf type="diffuse"><rgb name="reflectance" value="0"/></bsdf>)" + meter + "</shape>", 4);
    ASSERT_EQ(image.find("R")->values.size(), 6u);
    for (std::size_t i = 0; i < 6; ++i) {
      EXPECT_NEAR(value(image, "R", i), kPi / 2, 1e-5);
      EXPECT_NEAR(value(image, "B", i), 2 * kPi, 1e-5);
    }
  }
}

TEST(IrradianceMeter, LooksToTheSideOfTheNormalsAndMapsTheFilm) {
  // A wall in the plane x = 1 shines towards -x; the meter in the plane z = 0 is mapped along x.
  const std::string wall =
      R"(<shape type="rectangle"><transform name="to_world"><rotate y="1" angle="-90"/><translate x="1"/></transform>)"
      R"(<emitter type="area"/></shape>)";
  const auto meter = [](const std::string& inside) {
    return "<shape type=\"rectangle\">" + inside + "<sensor type=\"irradiancemeter\">" + film(4, 1) +
           "</sensor></shape>";
  };
  const Image image = render(wall + meter(""), 1024);
  for (std::size_t i = 1; i < 4; ++i) EXPECT_GT(value(image, "G", i), 1.5 * value(image, "G", i - 1));
  // A lamp in z > 0 alone is not seen from the back.
  const std::string lamp =
      R"(<shape type="sphere"><point name="center" x="0" y="0" z="3"/><emitter type="area"/></shape>)";
  // E of a sphere of radius r at distance d above a point, in the mean over the square: near pi r^2 / d^2.
  EXPECT_NEAR(
      value(render(lamp + meter(R"(<transform name="to_world"><scale value="0.01"/></transform>)"), 4096), "G", 1),
      kPi / 9, 5e-3);
  EXPECT_EQ(value(render(lamp + meter(R"(<boolean name="flip_normals" value="true"/>)")), "G", 1), 0);
}

TEST(Distant, MeasuresTheMeanOverItsTarget) {
  const auto sensor = [](const std::string& inside) {
    return "<sensor type=\"distant\">" + inside + film(1, 1) + "</sensor>";
  };
  const std::string ball =
      R"(<shape type="sphere"><emitter type="area"><rgb name="radiance" value="1"/></emitter></shape>)";
  // The disk across the sphere around the ball's box, whose radius is sqrt(3).
  EXPECT_NEAR(value(render(ball + sensor(R"(<vector name="direction" x="1" y="2" z="-1"/>)"), 4096), "G"), 1.0 / 3,
              2e-3);
  EXPECT_EQ(value(render(ball + sensor(R"(<point name="ray_target" x="0" y="0.99" z="0"/>)")), "G"), 1);
  EXPECT_EQ(value(render(ball + sensor(R"(<point name="ray_target" x="0" y="1.01" z="0"/>)")), "G"), 0);
  // A square of side 4 in front of the ball, on which its shadow would be of area pi.
  const std::string target =
      R"(<shape type="rectangle" name="ray_target"><transform name="to_world"><scale value="2"/><translate z="5"/></transform></shape>)";
  EXPECT_NEAR(value(render(ball + sensor(target), 4096), "G"), kPi / 16, 2e-3);
}

TEST(Batch, ShowsEverySensorsPictureSideBySide) {
  const std::string scene = kSky + kBlackBall;
  const auto camera = [](int distance, const std::string& inside) {
    return R"(<sensor type="perspective"><transform name="to_world"><lookat origin="0,0,)" + std::to_string(distance) +
           R"(" target="0,0,0" up="0,1,0"/></transform>)" + inside + "</sensor>";
  };
  const std::string meter =
      R"(<sensor type="radiancemeter"><transform name="to_world"><translate x="5"/></transform></sensor>)";
  const Image joined = render(scene + "<sensor type=\"batch\">" + camera(4, film(8, 8)) + camera(8, film(8, 8)) +
                              meter + film(24, 8) + "</sensor>");
  for (int i = 0; i < 2; ++i) {
    const Image alone = render(scene + camera(4 + 4 * i, film(8, 8)));
    for (std::size_t y = 0; y < 8; ++y) {
      for (std::size_t x = 0; x < 8; ++x)
        EXPECT_NEAR(value(joined, "G", y * 24 + static_cast<std::size_t>(8 * i) + x), value(alone, "G", y * 8 + x),
                    0.1);
    }
  }
  for (std::size_t y = 0; y < 8; ++y) EXPECT_FLOAT_EQ(joined.find("G")->values[y * 24 + 17], 1);
  EXPECT_LT(value(joined, "G", 4 * 24 + 4), 0.1) << "the ball is in the middle of the first picture";
}

TEST(Meters, SayWhatIsWrongWithThem) {
  const auto messages = [](const std::string& sensor) {
    const std::string text = "<scene version=\"3.0.0\">" + kSky + kBlackBall + sensor + "</scene>";
    std::string all;
    const auto scene = Scene::load(SceneSource::memory("scene.xml", text, {}));
    for (const Diagnostic& d : scene.diagnostics().all()) {
      if (d.severity == Diagnostic::Severity::error) all += d.message + "; ";
    }
    return all;
  };
  EXPECT_EQ(messages(R"(<sensor type="radiancemeter"><point name="origin" x="0" y="0" z="1"/></sensor>)"),
            "'origin' is given without 'direction'; ");
  EXPECT_EQ(messages(R"(<sensor type="distant"><vector name="direction" x="0" y="0" z="0"/></sensor>)"),
            "'direction' is a vector of length 0; ");
  EXPECT_EQ(messages(R"(<sensor type="irradiancemeter"/>)"), "sensor 'irradiancemeter' stands outside of a shape; ");
  EXPECT_EQ(messages(R"(<sensor type="batch"/>)"), "sensor 'batch' has no sensor inside; ");
  EXPECT_EQ(
      messages(R"(<sensor type="batch"><sensor type="distant"/><sensor type="distant"/>)" + film(5, 2) + "</sensor>"),
      "the film is 5 pixels wide, which 2 sensors cannot share evenly; ");
  EXPECT_EQ(messages(R"(<integrator type="ptracer"/><sensor type="distant"/>)"),
            "nothing that begins at the lights finds sensor 'distant', as paths of integrator 'ptracer' would; ");
}

}  // namespace
}  // namespace norrsken::end_to_end
