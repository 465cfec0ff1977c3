#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "compile/compile_testing.h"

namespace norrsken::testing {
namespace {

using ::testing::ElementsAre;
using ::testing::FloatNear;
using ::testing::IsEmpty;
using ::testing::Pointwise;

std::string transform(const std::string& inside) { return "<transform name=\"to_world\">" + inside + "</transform>"; }
std::string rectangle(const std::string& inside) { return "<shape type=\"rectangle\">" + inside + "</shape>"; }
std::string sphere(const std::string& inside) { return "<shape type=\"sphere\">" + inside + "</shape>"; }

/// Unit normal and n.p of a triangle.
std::vector<float> plane(const Compiled& c, std::size_t triangle) {
  const auto& g = c.tables().surfaces.at(triangle).geometry;
  return {g[0], g[1], g[2], g[3]};
}
std::vector<float> sphere_of(const Compiled& c) { return plane(c, 0); }

const std::string kShapes =
    "bsplinecurve, cube, cylinder, disk, instance, linearcurve, mesh, obj, ply, rectangle, sdfgrid, serialized, "
    "shapegroup, "
    "sphere";

TEST(Rectangle, IsTheSquareThatFacesZ) {
  const Compiled c = compile_shape(rectangle(""));
  ASSERT_THAT(c.messages(), IsEmpty());
  EXPECT_EQ(c.tables().triangle_count(), 2u);
  EXPECT_EQ(c.tables().sphere_count(), 0u);
  EXPECT_THAT(plane(c, 0), ElementsAre(0, 0, 1, 0));
  EXPECT_THAT(plane(c, 1), ElementsAre(0, 0, 1, 0));
  EXPECT_THAT(c.tables().positions, ElementsAre(-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0));
  EXPECT_THAT(c.tables().texcoords, ElementsAre(0, 0, 1, 0, 1, 1, 0, 1));
  EXPECT_THAT(c.tables().normals, IsEmpty());
  EXPECT_THAT(c.info().bounds_min, ElementsAre(-1, -1, 0));
  EXPECT_THAT(c.info().bounds_max, ElementsAre(1, 1, 0));
}

TEST(Rectangle, IsPlacedAndFlipped) {
  const Compiled placed = compile_shape(rectangle(transform(R"(<scale value="3"/><translate z="2"/>)")));
  EXPECT_THAT(plane(placed, 0), ElementsAre(0, 0, 1, 2));
  EXPECT_THAT(placed.tables().positions, ElementsAre(-3, -3, 2, 3, -3, 2, 3, 3, 2, -3, 3, 2));
  const Compiled flipped = compile_shape(rectangle(R"(<boolean name="flip_normals" value="true"/>)"));
  EXPECT_THAT(plane(flipped, 0), ElementsAre(0, 0, -1, 0));
  EXPECT_THAT(plane(flipped, 1), ElementsAre(0, 0, -1, 0));
}

TEST(Rectangle, MirroredInItsPlaneItFacesTheSameWay) {
  EXPECT_THAT(plane(compile_shape(rectangle(transform(R"(<scale x="-1"/>)"))), 0), ElementsAre(0, 0, 1, 0));
  EXPECT_THAT(plane(compile_shape(rectangle(transform(R"(<scale z="-1"/>)"))), 0), ElementsAre(0, 0, -1, 0));
}

TEST(Rectangle, MayBeFlattenedAcrossItsPlane) {
  const Compiled c = compile_shape(rectangle(transform(R"(<scale z="0"/><rotate y="1" angle="90"/>)")));
  EXPECT_THAT(c.messages(), IsEmpty());
  EXPECT_THAT(plane(c, 0), Pointwise(FloatNear(1e-6f), {1.0f, 0.0f, 0.0f, 0.0f}));
}

TEST(Rectangle, WarnsOfPlacementsThatLeaveNothingOfIt) {
  EXPECT_THAT(compile_shape(rectangle(transform(R"(<scale x="0"/>)"))).messages(),
              ElementsAre("warning: no triangle of the shape has an area, nothing of it is drawn"));
  EXPECT_THAT(compile_shape(rectangle(transform(R"(<scale value="1e-25"/>)"))).messages(),
              ElementsAre("warning: no triangle of the shape has an area, nothing of it is drawn"));
  EXPECT_FALSE(compile_shape(rectangle(transform(R"(<scale value="1e18"/>)"))).scene);
}

std::string cube(const std::string& inside) { return "<shape type=\"cube\">" + inside + "</shape>"; }

TEST(Cube, FacesOutwards) {
  const std::string flip = R"(<boolean name="flip_normals" value="true"/>)";
  for (const auto& [inside, distance] : {std::pair{std::string(), 1.0f},
                                         {transform(R"(<scale x="-1"/>)"), 1.0f},
                                         {flip, -1.0f},
                                         {flip + transform(R"(<scale value="2"/>)"), -2.0f}}) {
    const Compiled c = compile_shape(cube(inside));
    ASSERT_THAT(c.messages(), IsEmpty());
    ASSERT_EQ(c.tables().triangle_count(), 12u);
    EXPECT_EQ(c.tables().shapes.at(0).smooth, 0u);
    std::set<std::vector<float>> normals;
    for (std::size_t i = 0; i < 12; ++i) {
      const auto p = plane(c, i);
      EXPECT_FLOAT_EQ(p[3], distance) << inside << i;
      normals.insert({p[0], p[1], p[2]});
    }
    EXPECT_EQ(normals.size(), 6u) << inside;
  }
}

TEST(Cube, EveryFaceHasTheWholeUnitSquareOfTexture) {
  const Compiled c = compile_shape(cube(""));
  const SceneTables& t = c.tables();
  ASSERT_EQ(t.positions.size(), 3 * 24u);
  for (std::size_t face = 0; face < 6; ++face) {
    // Of the corners, u and v make the square; where Mitsuba has its (0, 0) is a corner of each face.
    const float* uv = &t.texcoords[8 * face];
    EXPECT_THAT(std::vector(uv, uv + 8), ElementsAre(0, 1, 1, 1, 1, 0, 0, 0)) << face;
  }
  const auto origin = [&](std::size_t face) {
    return std::vector(t.positions.data() + 12 * face + 9, t.positions.data() + 12 * face + 12);
  };
  EXPECT_THAT(origin(0), ElementsAre(-1, -1, -1));
  EXPECT_THAT(origin(1), ElementsAre(1, 1, 1));
  EXPECT_THAT(origin(2), ElementsAre(1, -1, 1));
  EXPECT_THAT(origin(3), ElementsAre(-1, -1, 1));
  EXPECT_THAT(origin(4), ElementsAre(-1, -1, -1));
  EXPECT_THAT(origin(5), ElementsAre(-1, 1, -1));
}

TEST(Cube, TakesTheParametersOfMeshesWithoutAFile) {
  EXPECT_THAT(compile_shape(cube(R"(<boolean name="face_normals" value="true"/>)")).messages(), IsEmpty());
  EXPECT_THAT(compile_shape(cube(R"(<float name="size" value="2"/>)")).messages(),
              ElementsAre("error: unused parameter 'size' of shape 'cube' [face_normals, flip_normals, to_world]"));
}

TEST(Sphere, HasCentreAndRadius) {
  const Compiled standard = compile_shape(sphere(""));
  ASSERT_THAT(standard.messages(), IsEmpty());
  EXPECT_THAT(sphere_of(standard), ElementsAre(0, 0, 0, 1));
  const Compiled c =
      compile_shape(sphere(R"(<point name="center" x="7" y="-2.5" z="-2"/><float name="radius" value="1.5"/>)"));
  ASSERT_THAT(c.messages(), IsEmpty());
  EXPECT_THAT(sphere_of(c), ElementsAre(7, -2.5f, -2, 1.5f));
  EXPECT_EQ(c.tables().sphere_count(), 1u);
  EXPECT_EQ(c.tables().shapes.at(0).flip_normals, 0u);
  EXPECT_THAT(c.info().bounds_min, ElementsAre(5.5, -4, -3.5));
  EXPECT_THAT(c.info().bounds_max, ElementsAre(8.5, -1, -0.5));
}

TEST(Sphere, IsPlacedByUniformScales) {
  const Compiled c =
      compile_shape(sphere(R"(<point name="center" x="1" y="0" z="0"/><float name="radius" value="0.5"/>)" +
                           transform(R"(<rotate z="1" angle="90"/><scale value="4"/><translate x="10"/>)")));
  ASSERT_THAT(c.messages(), IsEmpty());
  EXPECT_THAT(sphere_of(c), Pointwise(FloatNear(1e-5f), {10.0f, 4.0f, 0.0f, 2.0f}));
}

TEST(Sphere, RefusesScalesThatMakeAnEllipsoid) {
  const std::string expected =
      "error: 'to_world' does not scale the sphere alike in all directions "
      "[translations, rotations and scales with one value]";
  EXPECT_THAT(compile_shape(sphere(transform(R"(<scale x="2"/>)"))).messages(), ElementsAre(expected));
  EXPECT_THAT(compile_shape(sphere(transform(R"(<matrix value="1 0.5 0 0  0 1 0 0  0 0 1 0  0 0 0 1"/>)"))).messages(),
              ElementsAre(expected));
}

/// As exporters print: a rotation times 0.02 and what is left of it after six decimals.
TEST(Sphere, TakesWhatPrintedDecimalsLeave) {
  const Compiled c =
      compile_shape(sphere(transform(R"(<matrix value="0.016773 -0.010169 0.003904 0  0.010893 0.015659 -0.006011 0  )"
                                     R"(0 0.007167 0.018672 0  0 0 0 1"/>)")));
  EXPECT_THAT(c.messages(), IsEmpty());
  EXPECT_THAT(sphere_of(c), Pointwise(FloatNear(1e-6f), {0.0f, 0.0f, 0.0f, 0.02f}));
}

TEST(Sphere, WarnsOfAPercentThatItLeavesOut) {
  const Compiled c = compile_shape(sphere(transform(R"(<scale x="1.003"/>)")));
  EXPECT_THAT(
      c.messages(),
      ElementsAre("warning: 'to_world' does not scale the sphere alike in all directions: by up to 0.2 %, which "
                  "is left out [translations, rotations and scales with one value]"));
  EXPECT_THAT(sphere_of(c), Pointwise(FloatNear(1e-5f), {0.0f, 0.0f, 0.0f, 1.001f}));
  EXPECT_FALSE(compile_shape(sphere(transform(R"(<scale x="1.03"/>)"))).scene);
}

TEST(Sphere, TurnsItsNormalInwards) {
  const std::string flip = R"(<boolean name="flip_normals" value="true"/>)";
  const std::string mirror = transform(R"(<scale x="-1"/>)");
  EXPECT_EQ(compile_shape(sphere(flip)).tables().shapes.at(0).flip_normals, 1u);
  EXPECT_EQ(compile_shape(sphere(mirror)).tables().shapes.at(0).flip_normals, 1u);
  EXPECT_EQ(compile_shape(sphere(flip + mirror)).tables().shapes.at(0).flip_normals, 0u);
}

TEST(Sphere, OfRadiusZeroIsNotDrawn) {
  for (const auto& [inside, radius] : {std::pair{R"(<float name="radius" value="0"/>)", "0"},
                                       {R"(<transform name="to_world"><scale value="0"/></transform>)", "0"},
                                       {R"(<float name="radius" value="1e-60"/>)", "1e-60"}}) {
    const Compiled c = compile_shape(sphere(inside));
    ASSERT_TRUE(c.scene) << inside;
    EXPECT_EQ(c.info().spheres, 0u);
    EXPECT_THAT(c.messages(), ElementsAre("warning: the sphere's radius of " + std::string(radius) +
                                          " is too small to be told from 0: nothing of it is drawn"));
  }
}

TEST(Sphere, RefusesRadiiThatMakeNoSphere) {
  EXPECT_THAT(compile_shape(sphere(R"(<float name="radius" value="-1"/>)")).messages(),
              ElementsAre("error: 'radius' is -1 [a number of at least 0]"));
  EXPECT_FALSE(compile_shape(sphere(transform(R"(<scale x="0"/>)"))).scene);
  EXPECT_FALSE(
      compile_shape(sphere(R"(<float name="radius" value="1e10"/>)" + transform(R"(<scale value="1e10"/>)"))).scene);
  EXPECT_THAT(compile_shape(sphere(R"(<float name="center" value="1"/>)")).messages(),
              ElementsAre("error: 'center' is a float [point, vector]"));
}

TEST(ShapeHost, SpheresFollowTriangles) {
  const Compiled c = compile_shape(sphere("") + rectangle("") + sphere(R"(<float name="radius" value="2"/>)"));
  ASSERT_THAT(c.messages(), IsEmpty());
  const SceneTables& t = c.tables();
  ASSERT_EQ(t.surfaces.size(), 4u);
  ASSERT_EQ(t.shapes.size(), 3u);
  EXPECT_EQ(t.shapes[0].first_primitive, 2u);
  EXPECT_EQ(t.shapes[1].first_primitive, 0u);
  EXPECT_EQ(t.shapes[2].first_primitive, 3u);
  EXPECT_THAT((std::vector{t.shapes[0].primitive_count, t.shapes[1].primitive_count, t.shapes[2].primitive_count}),
              ElementsAre(1u, 2u, 1u));
  for (std::uint32_t shape = 0; shape < 3; ++shape) {
    for (std::uint32_t i = 0; i < t.shapes[shape].primitive_count; ++i) {
      EXPECT_EQ(t.surfaces[t.shapes[shape].first_primitive + i].shape, shape);
    }
  }
  EXPECT_EQ(t.surfaces[3].geometry[3], 2.0f);
}

TEST(ShapeHost, RefusesWhatDoesNotBelongIntoAShape) {
  EXPECT_THAT(compile_shape(sphere(sphere(""))).messages(),
              ElementsAre("error: unused shape 'sphere' in shape 'sphere' [bsdf, emitter, medium, sensor]"));
  EXPECT_THAT(compile_shape(sphere(R"(<medium type="homogeneous" name="inside"/>)")).messages(),
              ElementsAre("error: a medium of shape 'sphere' is named 'inside' ['interior' or 'exterior']"));
  EXPECT_THAT(compile_shape(sphere(R"(<bsdf type="diffuse"/><bsdf type="diffuse"/>)")).messages(),
              ElementsAre("error: shape 'sphere' has more than one bsdf [one bsdf]"));
  EXPECT_THAT(compile_shape(R"(<shape type="merge"/>)").messages(),
              ElementsAre("error: shape 'merge' is not supported yet [" + kShapes + "]"));
  EXPECT_THAT(compile_shape(R"(<shape type="sfere"/>)").messages(),
              ElementsAre("error: unknown shape 'sfere', did you mean 'sphere'? [" + kShapes + "]"));
}

}  // namespace
}  // namespace norrsken::testing
