#include "shape/curve_host.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>

#include "compile/compile_testing.h"

namespace norrsken::testing {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::Pointwise;

const std::string kLine = "0 0 0 0.5\n0 0 2 0.25\n";
const std::string kLines = kLine + "0 3 2 0.25\n\n1 0 0 0.125\n4 0 0 0.125\n";
const std::string kSpline = "0 0 0 .5\n1 0 0 .5\n2 0 0 .5\n3 0 0 .5\n4 0 0 .5\n";

std::string named(const std::string& file) { return "<string name=\"filename\" value=\"" + file + "\"/>"; }
std::string to_world(const std::string& inside) { return "<transform name=\"to_world\">" + inside + "</transform>"; }

Compiled compile_kind(const std::string& kind, const std::string& inside, const std::string& text) {
  return compile_shape("<shape type=\"" + kind + "\">" + inside + "</shape>", {{"curves.txt", text}});
}
Compiled linear(const std::string& inside, const std::string& text = kLines) {
  return compile_kind("linearcurve", inside, text);
}
Compiled bspline(const std::string& inside, const std::string& text = kSpline) {
  return compile_kind("bsplinecurve", inside, text);
}

std::uint32_t word(float value) { return std::bit_cast<std::uint32_t>(value); }

TEST(LinearCurve, EverySegmentIsAPrimitive) {
  const Compiled c = linear(named("curves.txt"));
  ASSERT_THAT(c.messages(), IsEmpty());
  const SceneTables& t = c.tables();
  ASSERT_EQ(t.analytics.size(), 1u);
  EXPECT_EQ(t.analytics[0].kind, AnalyticKind::linearcurve);
  EXPECT_EQ(t.analytics[0].element_count, 3u);
  EXPECT_EQ(t.analytics[0].flip_normals, 0u);
  EXPECT_EQ(t.analytic_count(), 3u);
  for (std::uint32_t i = 0; i < 3; ++i) EXPECT_EQ(word(t.surfaces.at(t.first_analytic + i).geometry[1]), i);
  const float* table = &t.texels.at(t.analytics[0].table);
  EXPECT_EQ(word(table[0]), 3u);
  EXPECT_EQ(word(table[1]), 0u);
  EXPECT_EQ(word(table[2]), 1u);
  EXPECT_EQ(word(table[3]), 3u);
  EXPECT_THAT(std::vector(table + 4, table + 24), ElementsAre(0, 0, 0, 0.5f, 0, 0, 2, 0.25f, 0, 3, 2, 0.25f,  //
                                                              1, 0, 0, 0.125f, 4, 0, 0, 0.125f));
  EXPECT_THAT(c.info().bounds_min, ElementsAre(-0.5, -0.5, -0.5));
  EXPECT_THAT(c.info().bounds_max, ElementsAre(4.125, 3.25, 2.25));
}

TEST(LinearCurve, ItsPlaceMovesControlPointsAndLeavesRadiiAlone) {
  const Compiled c = linear(named("curves.txt") + to_world(R"(<scale x="2" y="3" z="-1"/><translate x="1"/>)"), kLine);
  ASSERT_THAT(c.messages(), IsEmpty());
  const SceneTables& t = c.tables();
  const float* points = &t.texels.at(t.analytics[0].table + 2);
  EXPECT_THAT(std::vector(points, points + 8), ElementsAre(1, 0, 0, 0.5f, 1, 0, -2, 0.25f));
  EXPECT_THAT(c.info().bounds_min, ElementsAre(0.5, -0.5, -2.25));
}

TEST(BsplineCurve, SegmentsShareControlPoints) {
  const Compiled c = bspline(named("curves.txt"));
  ASSERT_THAT(c.messages(), IsEmpty());
  const SceneTables& t = c.tables();
  EXPECT_EQ(t.analytics.at(0).kind, AnalyticKind::bsplinecurve);
  EXPECT_EQ(t.analytics.at(0).element_count, 2u);
  const float* table = &t.texels.at(t.analytics[0].table);
  EXPECT_EQ(word(table[0]), 2u);
  EXPECT_EQ(word(table[1]), 0u);
  EXPECT_EQ(word(table[2]), 1u);
  EXPECT_EQ(table[3 + 4 * 4], 4.0f);
  // From the second control point to the last but one.
  EXPECT_THAT(c.info().bounds_min, Pointwise(::testing::DoubleNear(1e-6), {0.5, -0.5, -0.5}));
  EXPECT_THAT(c.info().bounds_max, Pointwise(::testing::DoubleNear(1e-6), {3.5, 0.5, 0.5}));
}

TEST(CurveShapes, HaveTheirMessages) {
  for (const std::string kind : {"linearcurve", "bsplinecurve"}) {
    const auto messages = [&](const std::string& inside) { return compile_kind(kind, inside, kSpline).messages(); };
    EXPECT_THAT(messages(""),
                ElementsAre("error: shape '" + kind +
                            "' needs a parameter 'filename' [<string name=\"filename\" value=\"...\"/>]"));
    EXPECT_THAT(messages(named("hair.txt")),
                ElementsAre("error: there is no file 'hair.txt' [a file in the current folder]"));
    EXPECT_THAT(messages(R"(<float name="filename" value="2"/>)"),
                ElementsAre("error: 'filename' is a float [string]"));
    EXPECT_THAT(messages(named("curves.txt") + R"(<float name="to_world" value="2"/>)"),
                ElementsAre("error: 'to_world' is a float [transform]"));
    EXPECT_THAT(messages(named("curves.txt") + R"(<boolean name="flip_normals" value="true"/>)"),
                ElementsAre("error: unused parameter 'flip_normals' of shape '" + kind + "' [filename, to_world]"));
    EXPECT_THAT(messages(named("curves.txt") + to_world(R"(<scale x="5e11"/>)")),
                ElementsAre("error: a control point is at (1.5e+12, 0, 0) [coordinates from -1e+12 to 1e+12]"));
  }
}

TEST(CurveShapes, RefuseWhatHasNoSurface) {
  EXPECT_THAT(
      linear(named("curves.txt"), "0 0 0 0\n0 0 1 0\n").messages(),
      ElementsAre("warning: the linearcurve's area of 0 is too small to be told from 0: nothing of it is drawn"));
  EXPECT_THAT(linear(named("curves.txt"), "0 0 0 1\n").messages(),
              ElementsAre("error: a curve of 1 control point (named at scene.xml:2:166) [at least 2 control points]"));
  EXPECT_THAT(bspline(named("curves.txt"), kLine + "0 0 3 1\n").messages(),
              ElementsAre("error: a curve of 3 control points (named at scene.xml:2:167) [at least 4 control points]"));
}

TEST(CurveShapes, AsLightsAreFoundByRaysAlone) {
  const Compiled c = linear(named("curves.txt") + R"(<emitter type="area"/>)");
  ASSERT_THAT(c.messages(), IsEmpty());
  const SceneTables& t = c.tables();
  for (std::uint32_t i = 0; i < 3; ++i) {
    const SurfaceRecord& surface = t.surfaces.at(t.first_analytic + i);
    const std::uint32_t light = t.light_of(t.first_analytic + i);
    ASSERT_NE(light, kNone);
    EXPECT_EQ(t.lights.at(light).kind, LightKind::analytic);
    EXPECT_EQ(t.lights.at(light).prob, 0);
    EXPECT_NE(surface.material_front & kEmitsBit, 0u);
    EXPECT_EQ(surface.material_back & kEmitsBit, 0u);
  }
}

}  // namespace
}  // namespace norrsken::testing
