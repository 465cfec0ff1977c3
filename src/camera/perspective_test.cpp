#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "compile/compile_testing.h"

namespace norrsken::testing {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

/// A 200 x 100 film, so that no two sides are alike.
Compiled compile_camera(const std::string& inside, const std::string& width = "200",
                        const std::string& height = "100") {
  return compile_sensor(
      "<sensor type=\"perspective\">" + inside + R"(<film type="hdrfilm"><integer name="width" value=")" + width +
      R"("/><integer name="height" value=")" + height + R"("/><rfilter type="box"/></film></sensor>)");
}
std::string number(const std::string& name, const std::string& value) {
  return "<float name=\"" + name + "\" value=\"" + value + "\"/>";
}
std::string text(const std::string& name, const std::string& value) {
  return "<string name=\"" + name + "\" value=\"" + value + "\"/>";
}

glm::dvec3 direction(const CameraRecord& camera, double px, double py) {
  glm::dvec3 d;
  for (int i = 0; i < 3; ++i) d[i] = camera.base[i] + px * camera.du[i] + py * camera.dv[i];
  return d;
}

void expect_near(const glm::dvec3& a, const glm::dvec3& b) {
  EXPECT_LT(glm::length(a - b), 1e-6) << a.x << " " << a.y << " " << a.z << " instead of " << b.x << " " << b.y << " "
                                      << b.z;
}

/// Angle between the directions of two film points in degrees.
double angle(const CameraRecord& camera, double px0, double py0, double px1, double py1) {
  const auto a = glm::normalize(direction(camera, px0, py0)), b = glm::normalize(direction(camera, px1, py1));
  return std::acos(glm::dot(a, b)) * 180 / M_PI;
}
double angle_x(const CameraRecord& c) { return angle(c, 0, 50, 200, 50); }
double angle_y(const CameraRecord& c) { return angle(c, 100, 0, 100, 100); }
double angle_diagonal(const CameraRecord& c) { return angle(c, 0, 0, 200, 100); }

TEST(Perspective, LooksAlongItsZWithXToTheLeftAndYUp) {
  const CameraRecord camera = compile_camera(number("fov", "90")).tables().camera;
  expect_near(direction(camera, 100, 50), {0, 0, 1});
  expect_near(direction(camera, 0, 0), {1, 0.5, 1});
  expect_near(direction(camera, 200, 0), {-1, 0.5, 1});
  expect_near(direction(camera, 0, 100), {1, -0.5, 1});
  EXPECT_THAT(camera.origin, ElementsAre(0, 0, 0));
  EXPECT_THAT(camera.forward, ElementsAre(0, 0, 1));
}

TEST(Perspective, ShowsTheWorldTheRightWayRound) {
  // From behind the origin along +x with z up, +y lies to the left.
  const CameraRecord camera =
      compile_camera(number("fov", "90") +
                     R"(<transform name="to_world"><lookat origin="-1,0,0" target="0,0,0" up="0,0,1"/></transform>)")
          .tables()
          .camera;
  EXPECT_THAT(camera.origin, ElementsAre(-1, 0, 0));
  expect_near(direction(camera, 100, 50), {1, 0, 0});
  expect_near(direction(camera, 0, 0), {1, 1, 0.5});
  expect_near(direction(camera, 200, 100), {1, -1, -0.5});
}

TEST(Perspective, FovSpansTheAxisThatIsNamed) {
  const auto camera = [](const char* axis, const char* width = "200", const char* height = "100") {
    return compile_camera(number("fov", "40") + text("fov_axis", axis), width, height).tables().camera;
  };
  EXPECT_NEAR(angle_x(camera("x")), 40, 1e-4);
  EXPECT_NEAR(angle_y(camera("y")), 40, 1e-4);
  EXPECT_NEAR(angle_diagonal(camera("diagonal")), 40, 1e-4);
  EXPECT_NEAR(angle_x(camera("larger")), 40, 1e-4);
  EXPECT_NEAR(angle_y(camera("smaller")), 40, 1e-4);
  EXPECT_NEAR(angle(camera("larger", "100", "200"), 50, 0, 50, 200), 40, 1e-4);
  EXPECT_NEAR(angle(camera("smaller", "100", "200"), 0, 100, 100, 100), 40, 1e-4);
  EXPECT_NEAR(angle_x(compile_camera(number("fov", "40")).tables().camera), 40, 1e-4);
  EXPECT_THAT(compile_camera(number("fov", "40") + text("fov_axis", "z")).messages(),
              ElementsAre("error: 'fov_axis' is 'z' [x, y, diagonal, smaller, larger]"));
}

TEST(Perspective, TheAxisMayBeInCapitals) {
  for (const auto& [capitals, small] : {std::pair("X", "x"), {"Smaller", "smaller"}, {"DIAGONAL", "diagonal"}}) {
    const Compiled a = compile_camera(number("fov", "40") + text("fov_axis", capitals)),
                   b = compile_camera(number("fov", "40") + text("fov_axis", small));
    ASSERT_THAT(a.messages(), IsEmpty());
    EXPECT_EQ(angle_diagonal(a.tables().camera), angle_diagonal(b.tables().camera));
  }
}

TEST(Perspective, FocalLengthIsThatOf35MillimetreFilm) {
  const double of_50mm = 2 * std::atan(std::hypot(36.0, 24.0) / 100) * 180 / M_PI;
  EXPECT_NEAR(angle_diagonal(compile_camera("").tables().camera), of_50mm, 1e-4);
  EXPECT_NEAR(angle_diagonal(compile_camera(text("focal_length", "50mm")).tables().camera), of_50mm, 1e-4);
  EXPECT_NEAR(angle_diagonal(compile_camera(text("focal_length", "25 mm")).tables().camera),
              2 * std::atan(std::hypot(36.0, 24.0) / 50) * 180 / M_PI, 1e-4);
  EXPECT_NEAR(angle_diagonal(compile_camera(text("focal_length", "50")).tables().camera), of_50mm, 1e-4);
  const std::string accepted = " [a length from 0.001mm to 1000000mm, such as 50mm]";
  for (const std::string wrong : {"wide", "0mm", "-3mm", "nanmm", "1e9mm", "mm"}) {
    EXPECT_THAT(compile_camera(text("focal_length", wrong)).messages(),
                ElementsAre("error: 'focal_length' is '" + wrong + "'" + accepted));
  }
  EXPECT_THAT(compile_camera(text("focal_length", "50mm") + number("fov", "40")).messages(),
              ElementsAre("error: sensor 'perspective' has both 'fov' and 'focal_length' [one of them]"));
}

TEST(Perspective, RefusesAnglesThatSpanNothing) {
  for (const std::string wrong : {"0", "180"}) {
    EXPECT_THAT(compile_camera(number("fov", wrong)).messages(),
                ElementsAre("error: 'fov' is " + wrong + " [a number above 0 and below 180]"));
  }
  EXPECT_THAT(compile_camera(number("fov", "200")).messages(),
              ElementsAre("error: 'fov' is 200 [a number above 0 and below 180]"));
  EXPECT_THAT(compile_camera(text("fov", "wide")).messages(), ElementsAre("error: 'fov' is a string [float]"));
}

TEST(Perspective, HasClipDistances) {
  const CameraRecord standard = compile_camera("").tables().camera;
  EXPECT_FLOAT_EQ(standard.near_clip, 0.01f);
  EXPECT_FLOAT_EQ(standard.far_clip, 10000.0f);
  const CameraRecord camera = compile_camera(number("near_clip", "2") + number("far_clip", "3")).tables().camera;
  EXPECT_FLOAT_EQ(camera.near_clip, 2.0f);
  EXPECT_FLOAT_EQ(camera.far_clip, 3.0f);
  EXPECT_THAT(compile_camera(number("near_clip", "3") + number("far_clip", "2")).messages(),
              ElementsAre("error: 'near_clip' is 3, but 'far_clip' is 2 [a near_clip smaller than the far_clip]"));
  EXPECT_THAT(compile_camera(number("near_clip", "0")).messages(),
              ElementsAre("error: 'near_clip' is 0 [a number above 0]"));
}

TEST(Perspective, PrincipalPointMovesThePicture) {
  const CameraRecord camera = compile_camera(number("fov", "90") + number("principal_point_offset_x", "0.25") +
                                             number("principal_point_offset_y", "0.1"))
                                  .tables()
                                  .camera;
  // What was in the middle is a quarter of the width further left, a tenth of the height further up.
  expect_near(direction(camera, 50, 40), {0, 0, 1});
}

TEST(Perspective, RefusesPlacementsThatScale) {
  const std::string expected = "error: 'to_world' of a sensor scales [translations, rotations and lookat]";
  EXPECT_THAT(compile_camera(R"(<transform name="to_world"><scale value="2"/></transform>)").messages(),
              ElementsAre(expected));
  EXPECT_THAT(compile_camera(R"(<transform name="to_world"><scale x="-1"/></transform>)").messages(), IsEmpty());
}

TEST(Perspective, RefusesOtherSensorsAndParameters) {
  EXPECT_THAT(compile_sensor(R"(<sensor type="perspectiv"/>)").messages(),
              ElementsAre("error: unknown sensor 'perspectiv', did you mean 'perspective'? "
                          "[batch, distant, irradiancemeter, orthographic, perspective, radiancemeter, thinlens]"));
  EXPECT_THAT(compile_camera(number("fow", "40")).messages(),
              ElementsAre("error: unused parameter 'fow' of sensor 'perspective', did you mean 'fov'? "
                          "[far_clip, focal_length, fov, fov_axis, near_clip, principal_point_offset_x, "
                          "principal_point_offset_y, to_world]"));
}

}  // namespace
}  // namespace norrsken::testing
