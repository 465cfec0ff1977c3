#include "shape/analytic_host.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <glm/matrix.hpp>
#include <numbers>

#include "compile/builder.h"
#include "compile/compile_testing.h"
#include "compile/plugins.h"

namespace norrsken::testing {
namespace {

using ::testing::DoubleNear;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::Pointwise;

struct Placed {
  std::optional<ShapeGeometry> geometry;
  std::vector<std::string> messages;
  const AnalyticShape& shape() const { return geometry.value().analytic.value(); }
};

/// What the host function makes of `<shape type=plugin>inside</shape>`.
Placed place(CompileShape& compile_shape_plugin, const std::string& plugin, const std::string& inside) {
  Compiled result;
  const MemoryFiles files(
      {{"scene.xml", "<scene version=\"3.0.0\"><shape type=\"" + plugin + "\">" + inside + "</shape></scene>"}});
  const auto description = read_mitsuba_xml("scene.xml", files, {}, result.diagnostics);
  EXPECT_TRUE(description.has_value());
  Parameters p(*description->scene->children.at(0).node, *description, files, result.diagnostics);
  Builder builder(*description, files, result.diagnostics);
  Shapes shapes(builder);
  Placed placed{compile_shape_plugin(p, shapes), {}};
  p.finish();
  placed.messages = result.messages();
  return placed;
}
Placed disk(const std::string& inside) { return place(compile_shape_disk, "disk", inside); }
Placed cylinder(const std::string& inside) { return place(compile_shape_cylinder, "cylinder", inside); }

std::string transform(const std::string& inside) { return "<transform name=\"to_world\">" + inside + "</transform>"; }
std::string point(const std::string& name, const std::string& value) {
  return "<point name=\"" + name + "\" value=\"" + value + "\"/>";
}
const std::string kFlip = R"(<boolean name="flip_normals" value="true"/>)";

std::vector<double> column(const Placed& placed, int i) {
  const glm::dvec4 c = placed.shape().world_from_local[i];
  return {c.x, c.y, c.z};
}
auto near(const std::vector<double>& values) { return Pointwise(DoubleNear(1e-6), values); }

TEST(Disk, IsPlaced) {
  const Placed standard = disk("");
  ASSERT_THAT(standard.messages, IsEmpty());
  EXPECT_EQ(standard.shape().kind, AnalyticKind::disk);
  EXPECT_EQ(standard.shape().world_from_local, glm::dmat4(1));
  EXPECT_DOUBLE_EQ(standard.shape().area, std::numbers::pi);
  EXPECT_FALSE(standard.shape().flip_normals);

  // An ellipse, sheared in its plane: the area is that of the parallelogram of its axes.
  const Placed sheared =
      disk(transform(R"(<matrix value="2 1 0 5  0 3 0 6  0 0 1 7  0 0 0 1"/><rotate y="1" angle="90"/>)") + kFlip);
  ASSERT_THAT(sheared.messages, IsEmpty());
  EXPECT_THAT(column(sheared, 0), near({0, 0, -2}));
  EXPECT_THAT(column(sheared, 1), near({0, 3, -1}));
  EXPECT_THAT(column(sheared, 3), near({7, 6, -5}));
  EXPECT_NEAR(sheared.shape().area, 6 * std::numbers::pi, 1e-9);
  EXPECT_TRUE(sheared.shape().flip_normals);
}

TEST(Disk, MirroredItFacesTheWayItsNormalGoes) {
  EXPECT_FALSE(disk(transform(R"(<scale x="-1"/>)")).shape().flip_normals);
}

TEST(Disk, RefusesPlacesWhereItCannotBe) {
  EXPECT_THAT(disk(transform(R"(<scale x="0"/>)")).messages,
              ElementsAre("warning: the disk's area of 0 is too small to be told from 0: nothing of it is drawn"));
  EXPECT_THAT(
      disk(transform(R"(<scale value="1e-25"/>)")).messages,
      ElementsAre("warning: the disk's area of 3.14159e-50 is too small to be told from 0: nothing of it is drawn"));
  EXPECT_THAT(disk(transform(R"(<scale value="9e11"/><translate x="9e11"/>)")).messages,
              ElementsAre("error: the disk is placed too far away or made too large [coordinates up to 1e+12]"));
}

TEST(Disk, RefusesOtherParameters) {
  EXPECT_THAT(disk(R"(<float name="radius" value="2"/>)").messages,
              ElementsAre("error: unused parameter 'radius' of shape 'disk' [flip_normals, to_world]"));
  EXPECT_THAT(disk(R"(<float name="to_world" value="2"/>)").messages,
              ElementsAre("error: 'to_world' is a float [transform]"));
  EXPECT_THAT(disk(R"(<float name="flip_normals" value="2"/>)").messages,
              ElementsAre("error: 'flip_normals' is a float [boolean]"));
}

TEST(Cylinder, LiesBetweenItsEnds) {
  const Placed standard = cylinder("");
  ASSERT_THAT(standard.messages, IsEmpty());
  EXPECT_EQ(standard.shape().kind, AnalyticKind::cylinder);
  EXPECT_EQ(standard.shape().world_from_local, glm::dmat4(1));
  EXPECT_DOUBLE_EQ(standard.shape().area, 2 * std::numbers::pi);
  EXPECT_FALSE(standard.shape().flip_normals);

  const Placed c = cylinder(point("p0", "1, 2, 3") + point("p1", "1, 2, 7") + R"(<float name="radius" value="0.5"/>)");
  ASSERT_THAT(c.messages, IsEmpty());
  EXPECT_THAT(column(c, 0), near({0.5, 0, 0}));
  EXPECT_THAT(column(c, 1), near({0, 0.5, 0}));
  EXPECT_THAT(column(c, 2), near({0, 0, 4}));
  EXPECT_THAT(column(c, 3), near({1, 2, 3}));
  EXPECT_NEAR(c.shape().area, 4 * std::numbers::pi, 1e-9);
}

TEST(Cylinder, OfAnyDirectionIsACylinder) {
  for (const char* end : {"1, 0, 0", "0, 0, -2", "-0.3, 0.4, 0.1", "1, 2, -3"}) {
    const Placed c = cylinder(point("p1", end));
    ASSERT_THAT(c.messages, IsEmpty());
    const glm::dmat3 m(c.shape().world_from_local);
    const double length = glm::length(m[2]);
    EXPECT_NEAR(glm::determinant(m), length, 1e-12 * length) << end;
    EXPECT_NEAR(glm::dot(m[0], m[1]), 0, 1e-12) << end;
    EXPECT_NEAR(glm::dot(m[0], m[2]), 0, 1e-12) << end;
    EXPECT_NEAR(glm::length(m[0]), 1, 1e-12) << end;
  }
}

TEST(Cylinder, MayBeStretchedAlongItsAxis) {
  const Placed c = cylinder(transform(R"(<scale x="2" y="2" z="5"/><rotate x="1" angle="90"/><translate z="4"/>)"));
  ASSERT_THAT(c.messages, IsEmpty());
  EXPECT_THAT(column(c, 0), near({2, 0, 0}));
  EXPECT_THAT(column(c, 1), near({0, 0, 2}));
  EXPECT_THAT(column(c, 2), near({0, -5, 0}));
  EXPECT_THAT(column(c, 3), near({0, 0, 4}));
  EXPECT_NEAR(c.shape().area, 20 * std::numbers::pi, 1e-9);
}

TEST(Cylinder, TurnsItsNormals) {
  const std::string mirror = transform(R"(<scale x="-1"/>)");
  EXPECT_TRUE(cylinder(kFlip).shape().flip_normals);
  EXPECT_FALSE(cylinder(mirror).shape().flip_normals) << "outwards still, unlike a sphere";
  EXPECT_TRUE(cylinder(kFlip + mirror).shape().flip_normals);
}

TEST(Disk, MayBeFlattenedAcrossItsPlane) {
  const Placed d = place(compile_shape_disk, "disk", transform(R"(<scale x="2" z="0"/><rotate y="1" angle="90"/>)"));
  EXPECT_THAT(d.messages, IsEmpty());
  EXPECT_NEAR(d.shape().area, 2 * M_PI, 1e-12);
  EXPECT_NEAR(glm::distance(glm::dvec3(d.shape().world_from_local[2]), glm::dvec3(1, 0, 0)), 0, 1e-12);
}

TEST(Cylinder, TakesWhatPrintedDecimalsLeaveAndStraightensIt) {
  const Placed c = cylinder(transform(R"(<matrix value="0.016773 -0.010169 0.003904 0  0.010893 0.015659 -0.006011 0  )"
                                      R"(0 0.007167 0.018672 0  0 0 0 1"/>)"));
  EXPECT_THAT(c.messages, IsEmpty());
  EXPECT_NEAR(static_cast<double>(c.shape().area), 2 * M_PI * 0.02 * 0.02, 1e-7);
  const glm::dmat3 m(c.shape().world_from_local);
  EXPECT_NEAR(glm::dot(m[0], m[1]), 0, 1e-15);
  EXPECT_NEAR(glm::length(m[0]), glm::length(m[1]), 1e-12);
  EXPECT_THAT(cylinder(transform(R"(<scale x="1.004"/>)")).messages,
              ElementsAre("warning: 'to_world' makes the cylinder's cross-section an ellipse or shears it: by up to "
                          "0.4 %, which is left out [translations, rotations and scales with one value or along the "
                          "axis]"));
}

TEST(Cylinder, RefusesWhatIsNone) {
  const std::string no_cylinder =
      "error: 'to_world' makes the cylinder's cross-section an ellipse or shears it "
      "[translations, rotations and scales with one value or along the axis]";
  EXPECT_THAT(cylinder(transform(R"(<scale x="2"/>)")).messages, ElementsAre(no_cylinder));
  EXPECT_THAT(cylinder(transform(R"(<matrix value="1 0 0.5 0  0 1 0 0  0 0 1 0  0 0 0 1"/>)")).messages,
              ElementsAre(no_cylinder));
  EXPECT_THAT(
      cylinder(point("p0", "0, 0, 1")).messages,
      ElementsAre("warning: the cylinder's length of 0 is too small to be told from 0: nothing of it is drawn"));
  EXPECT_THAT(
      cylinder(R"(<float name="radius" value="0"/>)").messages,
      ElementsAre("warning: the cylinder's radius of 0 is too small to be told from 0: nothing of it is drawn"));
  EXPECT_THAT(cylinder(R"(<float name="p0" value="0"/>)").messages,
              ElementsAre("error: 'p0' is a float [point, vector]"));
  EXPECT_THAT(
      cylinder(R"(<float name="length" value="1"/>)").messages,
      ElementsAre("error: unused parameter 'length' of shape 'cylinder' [flip_normals, p0, p1, radius, to_world]"));
  EXPECT_THAT(
      cylinder(R"(<float name="radius" value="1e-25"/>)" + transform(R"(<scale value="1e-25"/>)")).messages,
      ElementsAre(
          "warning: the cylinder's area of 6.28319e-75 is too small to be told from 0: nothing of it is drawn"));
  EXPECT_THAT(cylinder(R"(<float name="radius" value="9e11"/>)" + point("p0", "9e11, 0, 1")).messages,
              ElementsAre("error: the cylinder is placed too far away or made too large [coordinates up to 1e+12]"));
}

}  // namespace
}  // namespace norrsken::testing
