#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "compile/compile_testing.h"

namespace norrsken::testing {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

const std::string kArea = R"(<emitter type="area"><rgb name="radiance" value="1, 2, 3"/></emitter>)";

/// An emitting mesh of these OBJ statements.
Compiled compile_mesh_light(const std::string& obj) {
  return compile_elements(kSensor + R"(<shape type="obj"><string name="filename" value="a.obj"/>)" + kArea + "</shape>",
                          {{"a.obj", obj}});
}

TEST(PointEmitter, HasPositionAndIntensity) {
  const Compiled c = compile_emitter(
      R"(<emitter type="point"><point name="position" x="4.9" y="0" z="-1"/><rgb name="intensity" value="10, 5, 0"/></emitter>)");
  ASSERT_THAT(c.messages(), IsEmpty());
  ASSERT_EQ(c.tables().lights.size(), 1u);
  const LightRecord& light = c.tables().lights[0];
  EXPECT_EQ(light.kind, LightKind::point);
  EXPECT_THAT(light.origin, ElementsAre(4.9f, 0, -1));
  EXPECT_THAT(light.emission, ElementsAre(10, 5, 0));
  EXPECT_EQ(light.area, 0);
  EXPECT_EQ(light.prob, 1);
}

TEST(PointEmitter, MayBePlacedByATransform) {
  const Compiled c = compile_emitter(
      R"(<emitter type="point"><transform name="to_world"><translate x="1" y="2" z="3"/></transform></emitter>)");
  ASSERT_THAT(c.messages(), IsEmpty());
  EXPECT_THAT(c.tables().lights.at(0).origin, ElementsAre(1, 2, 3));
  EXPECT_THAT(c.tables().lights.at(0).emission, ElementsAre(1, 1, 1));
  EXPECT_THAT(compile_emitter(R"(<emitter type="point"><point name="position" x="1" y="2" z="3"/>)"
                              R"(<transform name="to_world"><translate x="1"/></transform></emitter>)")
                  .messages(),
              ElementsAre("error: emitter 'point' has both 'position' and 'to_world' [one of them]"));
}

TEST(PointEmitter, RefusesNegativeLightAndOtherParameters) {
  EXPECT_THAT(compile_emitter(R"(<emitter type="point"><rgb name="intensity" value="-1, 1, 1"/></emitter>)").messages(),
              ElementsAre("error: 'intensity' is (-1, 1, 1) [components of at least 0]"));
  EXPECT_THAT(
      compile_emitter(R"(<emitter type="point"><rgb name="radiance" value="1"/></emitter>)").messages(),
      ElementsAre(
          "error: unused parameter 'radiance' of emitter 'point' [intensity, position, sampling_weight, to_world]"));
}

TEST(AreaEmitter, ARectangleIsOneParallelogram) {
  const Compiled c = compile_elements(kSensor + R"(<shape type="rectangle">)" + kArea + "</shape>");
  ASSERT_THAT(c.messages(), IsEmpty());
  ASSERT_EQ(c.tables().lights.size(), 1u);
  const LightRecord& light = c.tables().lights[0];
  EXPECT_EQ(light.kind, LightKind::parallelogram);
  EXPECT_EQ(light.area, 4);
  EXPECT_EQ(light.prob, 1);
  EXPECT_THAT(light.normal, ElementsAre(0, 0, 1));
  EXPECT_THAT(light.emission, ElementsAre(1, 2, 3));
  // The four corners that the light's parameters reach are the rectangle's.
  for (int axis = 0; axis < 2; ++axis) {
    float low = light.origin[axis], high = low;
    for (const float edge : {light.edge1[axis], light.edge2[axis]}) (edge < 0 ? low : high) += edge;
    EXPECT_EQ(low, -1);
    EXPECT_EQ(high, 1);
  }
  for (std::uint32_t i = 0; i < 2; ++i) {
    const SurfaceRecord& surface = c.tables().surfaces[i];
    EXPECT_EQ(c.tables().light_of(i), 0u);
    EXPECT_TRUE(surface.material_front & kEmitsBit);
    EXPECT_FALSE(surface.material_back & kEmitsBit);
    EXPECT_EQ(material_kind(surface.material_front), BsdfKind::absorb);  // Mitsuba's material for lights that name none
  }
}

TEST(AreaEmitter, SurfacesThatDoNotShineHaveNoLight) {
  const Compiled c =
      compile_elements(kSensor + R"(<shape type="rectangle"/><shape type="rectangle">)" + kArea + "</shape>" + kShape);
  ASSERT_EQ(c.tables().surfaces.size(), 5u);
  const auto lights = std::vector{c.tables().light_of(0), c.tables().light_of(1), c.tables().light_of(2),
                                  c.tables().light_of(3), c.tables().light_of(4)};
  EXPECT_THAT(lights, ElementsAre(kNone, kNone, 0u, 0u, kNone));
  EXPECT_FALSE(c.tables().surfaces[0].material_front & kEmitsBit);
  EXPECT_FALSE(c.tables().surfaces[4].material_front & kEmitsBit);
}

TEST(AreaEmitter, ASphereIsOneLight) {
  const Compiled c = compile_elements(
      kSensor + R"(<shape type="sphere"><point name="center" x="1" y="2" z="3"/><float name="radius" value="2"/>)" +
      kArea + R"(</shape><shape type="sphere"><boolean name="flip_normals" value="true"/>)" + kArea + "</shape>");
  ASSERT_THAT(c.messages(), IsEmpty());
  ASSERT_EQ(c.tables().lights.size(), 2u);
  const LightRecord& light = c.tables().lights[0];
  EXPECT_EQ(light.kind, LightKind::sphere);
  EXPECT_THAT(light.origin, ElementsAre(1, 2, 3));
  EXPECT_FLOAT_EQ(light.area, static_cast<float>(16 * std::numbers::pi));
  EXPECT_THAT(light.edge1, ElementsAre(2, 0, 0));
  EXPECT_THAT(c.tables().lights[1].edge1, ElementsAre(1, 1, 0));
  EXPECT_EQ(c.tables().light_of(0), 0u);
  EXPECT_EQ(c.tables().light_of(1), 1u);
  EXPECT_FLOAT_EQ(light.prob, 0.65f);  // half of 0.8, its share of the power, and half of a half
}

TEST(AreaEmitter, TrianglesThatMakeNoParallelogramStayTriangles) {
  // A kite: the shared edge is there, the corners across do not mirror each other.
  const Compiled kite = compile_mesh_light("v 0 0 0\nv 2 0 0\nv 3 3 0\nv 0 2 0\nf 1 2 3\nf 1 3 4\n");
  ASSERT_THAT(kite.messages(), IsEmpty());
  ASSERT_EQ(kite.tables().lights.size(), 2u);
  for (std::uint32_t i = 0; i < 2; ++i) {
    EXPECT_EQ(kite.tables().lights[i].kind, LightKind::triangle);
    EXPECT_EQ(kite.tables().lights[i].area, 3);
    EXPECT_EQ(kite.tables().lights[i].prob, 0.5f);
    EXPECT_EQ(kite.tables().light_of(i), i);
  }
  // A parallelogram folded along its diagonal, and one whose halves face opposite ways.
  EXPECT_EQ(compile_mesh_light("v 0 0 0\nv 1 0 0\nv 1 1 1\nv 0 1 0\nf 1 2 4\nf 2 3 4\n").tables().lights.size(), 2u);
  EXPECT_EQ(compile_mesh_light("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 4\nf 2 4 3\n").tables().lights.size(), 2u);
}

TEST(AreaEmitter, MergesAcrossVerticesOfOnePlaceAndToleratesRounding) {
  // Corners apart in the file, and decimals that no float holds: a slanted parallelogram far from the origin.
  const Compiled c = compile_mesh_light(
      "v 100.1 0.1 7.3\nv 102.2 0.3 7.3\nv 100.4 1.7 8.4\n"
      "v 102.2 0.3 7.3\nv 102.5 1.9 8.4\nv 100.4 1.7 8.4\nf 1 2 3\nf 4 5 6\n");
  ASSERT_EQ(c.tables().lights.size(), 1u);
  EXPECT_EQ(c.tables().lights[0].kind, LightKind::parallelogram);
  EXPECT_EQ(c.tables().light_of(0), 0u);
  EXPECT_EQ(c.tables().light_of(1), 0u);
  const glm::dvec3 e1(2.1, 0.2, 0), e2(0.3, 1.6, 1.1);
  const glm::dvec3 cross(e1.y * e2.z - e1.z * e2.y, e1.z * e2.x - e1.x * e2.z, e1.x * e2.y - e1.y * e2.x);
  EXPECT_NEAR(c.tables().lights[0].area, std::sqrt(cross.x * cross.x + cross.y * cross.y + cross.z * cross.z), 1e-4);
  // A hundredth of a unit is not rounding.
  EXPECT_EQ(compile_mesh_light("v 0 0 0\nv 1 0 0\nv 1.01 1 0\nv 0 1 0\nf 1 2 4\nf 2 3 4\n").tables().lights.size(), 2u);
}

TEST(AreaEmitter, EveryTriangleOfAMeshIsInExactlyOneLight) {
  // A cube: six parallelograms.
  const Compiled c = compile_mesh_light(
      "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n"
      "f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n");
  ASSERT_EQ(c.tables().lights.size(), 6u);
  std::vector<int> triangles(6, 0);
  for (std::uint32_t i = 0; i < c.tables().triangle_count(); ++i) ++triangles.at(c.tables().light_of(i));
  EXPECT_THAT(triangles, ElementsAre(2, 2, 2, 2, 2, 2));
  for (const LightRecord& light : c.tables().lights) {
    EXPECT_EQ(light.kind, LightKind::parallelogram);
    EXPECT_EQ(light.area, 1);
    // Outwards, away from the cube's middle.
    float side = 0;
    for (int axis = 0; axis < 3; ++axis) {
      side += light.normal[axis] * (light.origin[axis] + (light.edge1[axis] + light.edge2[axis]) / 2 - 0.5f);
    }
    EXPECT_FLOAT_EQ(side, 0.5f);
  }
}

TEST(AreaEmitter, StandsInAShape) {
  EXPECT_THAT(compile_emitter(R"(<emitter type="area"/>)").messages(),
              ElementsAre("error: emitter 'area' stands outside of a shape "
                          "[an area emitter inside of the shape that shines]"));
}

TEST(AreaEmitter, ShinesWithOneUnlessTold) {
  const Compiled c = compile_elements(kSensor + R"(<shape type="rectangle"><emitter type="area"/></shape>)");
  EXPECT_THAT(c.tables().lights.at(0).emission, ElementsAre(1, 1, 1));
  EXPECT_THAT(compile_elements(kSensor + R"(<shape type="rectangle"><emitter type="area">)"
                                         R"(<rgb name="radiance" value="1e20"/></emitter></shape>)")
                  .messages(),
              ElementsAre("error: 'radiance' is (1e+20, 1e+20, 1e+20) [components from 0 to 1e+18]"));
}

TEST(EmitterHost, RefusesOthers) {
  EXPECT_THAT(compile_emitter(R"(<emitter type="sunsky"/>)").messages(),
              ElementsAre("error: emitter 'sunsky' is not supported yet [area, constant, directional, directionalarea, "
                          "envmap, point, projector, spot]"));
  EXPECT_THAT(compile_emitter(R"(<emitter type="pont"/>)").messages(),
              ElementsAre("error: unknown emitter 'pont', did you mean 'point'? [area, constant, directional, "
                          "directionalarea, envmap, point, projector, spot]"));
}

TEST(EmitterHost, BrokenShapesEmittersAreCheckedToo) {
  EXPECT_THAT(compile_elements(kSensor + R"(<shape type="sphere"><float name="radius" value="-1"/>)"
                                         R"(<emitter type="area"><float name="power" value="1"/></emitter></shape>)")
                  .messages(),
              ElementsAre("error: 'radius' is -1 [a number of at least 0]",
                          "error: unused parameter 'power' of emitter 'area' [radiance, sampling_weight]"));
}

}  // namespace
}  // namespace norrsken::testing
