#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstring>

#include "compile/compile_testing.h"
#include "shape/sdfgrid.h"

namespace norrsken::testing {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

std::string vol(const std::vector<std::int32_t>& size, const std::vector<float>& values, std::int32_t channels = 1) {
  std::string bytes = "VOL\3";
  const auto append = [&](auto value) { bytes.append(reinterpret_cast<const char*>(&value), sizeof value); };
  append(std::int32_t{1});
  for (const std::int32_t n : size) append(n);
  append(channels);
  for (int i = 0; i < 6; ++i) append(0.0f);
  for (const float value : values) append(value);
  return bytes;
}

/// 3 x 2 x 2 values of which the second voxel's are of both signs.
const std::string kGrid = vol({3, 2, 2}, {4, 4, -8, 4, 4, 4, 4, 4, 4, 4, 4, 4});

Compiled grid(const std::string& inside = "", const std::string& bytes = kGrid) {
  return compile_shape(R"(<shape type="sdfgrid"><string name="filename" value="a.vol"/>)" + inside + "</shape>",
                       {{"a.vol", bytes}});
}
std::string transform(const std::string& inside) { return "<transform name=\"to_world\">" + inside + "</transform>"; }

std::uint32_t word(const Compiled& c, std::size_t k) { return std::bit_cast<std::uint32_t>(c.tables().texels.at(k)); }

TEST(SdfGridHost, LeavesSizesValuesAndVoxels) {
  const Compiled c = grid();
  ASSERT_THAT(c.messages(), IsEmpty());
  ASSERT_EQ(c.tables().analytics.size(), 1u);
  const AnalyticRecord& record = c.tables().analytics[0];
  EXPECT_EQ(record.kind, AnalyticKind::sdfgrid);
  EXPECT_EQ(record.element_count, 1u);
  EXPECT_EQ(record.flip_normals, 0u);
  EXPECT_EQ(record.table, 0u);
  EXPECT_EQ(c.tables().analytic_count(), 1u);
  ASSERT_EQ(c.tables().texels.size(), 17u);
  EXPECT_THAT((std::vector<std::uint32_t>{word(c, 0), word(c, 1), word(c, 2), word(c, 3)}), ElementsAre(3, 2, 2, 1));
  EXPECT_EQ(c.tables().texels[4], 0.5f);  // times a power of two
  EXPECT_EQ(c.tables().texels[6], -1.0f);
  EXPECT_EQ(word(c, 16), 1u);
  // Only voxels with a surface count.
  EXPECT_THAT(c.info().bounds_min, ElementsAre(0.5, 0, 0));
  EXPECT_THAT(c.info().bounds_max, ElementsAre(1, 1, 1));
}

TEST(SdfGridHost, KnowsBothNormals) {
  EXPECT_EQ(word(grid(R"(<string name="normals" value="smooth"/>)"), SdfGridTable::kSmooth), 1u);
  EXPECT_EQ(word(grid(R"(<string name="normals" value="analytic"/>)"), SdfGridTable::kSmooth), 0u);
  EXPECT_THAT(grid(R"(<string name="normals" value="flat"/>)").messages(),
              ElementsAre("error: 'normals' is 'flat' [smooth, analytic]"));
  EXPECT_THAT(grid(R"(<integer name="normals" value="1"/>)").messages(),
              ElementsAre("error: 'normals' is an integer [string: smooth, analytic]"));
}

TEST(SdfGridHost, IsPlaced) {
  const Compiled c = grid(transform(R"(<scale x="2"/><rotate z="1" angle="90"/><translate z="5"/>)"));
  ASSERT_THAT(c.messages(), IsEmpty());
  const float* m = c.tables().analytics.at(0).place.world_from_local;
  EXPECT_NEAR(m[0], 0, 1e-6);
  EXPECT_NEAR(m[1], -1, 1e-6);
  EXPECT_NEAR(m[4], 2, 1e-6);
  EXPECT_NEAR(m[11], 5, 1e-6);
  EXPECT_THAT(grid(transform(R"(<scale z="0"/>)")).messages(),
              ElementsAre("error: 'to_world' cannot be inverted [scale factors other than 0]"));
  EXPECT_THAT(
      grid(transform(R"(<scale value="1e-25"/>)")).messages(),
      ElementsAre("warning: the sdfgrid's area of 6e-50 is too small to be told from 0: nothing of it is drawn"));
  EXPECT_THAT(grid(transform(R"(<scale value="9e11"/><translate x="9e11"/>)")).messages(),
              ElementsAre("error: the sdfgrid is placed too far away or made too large [coordinates up to 1e+12]"));
  EXPECT_THAT(grid(R"(<float name="to_world" value="2"/>)").messages(),
              ElementsAre("error: 'to_world' is a float [transform]"));
}

TEST(SdfGridHost, TakesWatertightWithoutEffect) {
  const Compiled closed = grid(R"(<boolean name="watertight" value="true"/>)"),
                 open = grid(R"(<boolean name="watertight" value="false"/>)");
  ASSERT_THAT(closed.messages(), IsEmpty());
  ASSERT_THAT(open.messages(), IsEmpty());
  EXPECT_EQ(std::memcmp(closed.tables().texels.data(), open.tables().texels.data(), 17 * sizeof(float)), 0);
  EXPECT_THAT(grid(R"(<float name="watertight" value="1"/>)").messages(),
              ElementsAre("error: 'watertight' is a float [boolean]"));
}

TEST(SdfGridHost, RefusesOtherParameters) {
  EXPECT_THAT(grid(R"(<boolean name="flip_normals" value="true"/>)").messages(),
              ElementsAre("error: unused parameter 'flip_normals' of shape 'sdfgrid' [filename, normals, to_world, "
                          "watertight]"));
  EXPECT_THAT(compile_shape(R"(<shape type="sdfgrid"/>)").messages(),
              ElementsAre("error: shape 'sdfgrid' needs a parameter 'filename' [<string name=\"filename\" "
                          "value=\"...\"/>]"));
  EXPECT_THAT(compile_shape(R"(<shape type="sdfgrid"><integer name="filename" value="1"/></shape>)").messages(),
              ElementsAre("error: 'filename' is an integer [string]"));
  EXPECT_THAT(compile_shape(R"(<shape type="sdfgrid"><string name="filename" value="b.vol"/></shape>)").messages(),
              ElementsAre(HasSubstr("error: there is no file 'b.vol'")));
}

TEST(SdfGridHost, RefusesGridsWithoutASurface) {
  const std::string none =
      "error: the grid has no surface: its values have one sign [values that are negative inside, 0 or more outside]";
  EXPECT_THAT(grid("", vol({2, 2, 2}, std::vector<float>(8, 1))).messages(), ElementsAre(none));
  EXPECT_THAT(grid("", vol({2, 2, 2}, std::vector<float>(8, -1))).messages(), ElementsAre(none));
  EXPECT_THAT(grid("", vol({2, 2, 2}, std::vector<float>(8, 0))).messages(), ElementsAre(none));
  EXPECT_THAT(grid("", vol({1, 2, 2}, {-1, 1, 1, 1})).messages(),
              ElementsAre("error: a grid of 1 x 2 x 2 values [2 or more along each axis]"));
}

TEST(SdfGridHost, RefusesOtherFiles) {
  EXPECT_THAT(grid("", vol({2, 2, 2}, std::vector<float>(24, 1), 3)).messages(),
              ElementsAre("error: a volume of 3 channels [1]"));
  EXPECT_THAT(grid("", "v 0 0 0").messages(),
              ElementsAre("error: this is no volume file (named at scene.xml:2:162) [a file that begins with VOL]"));
  EXPECT_THAT(grid("", vol({2, 2, 2}, {1, 2})).messages(),
              ElementsAre("error: 2 x 2 x 2 values of 1 channel do not fit the 8 bytes behind the header "
                          "(named at scene.xml:2:162) [4 bytes for each]"));
}

TEST(SdfGridHost, EvenTheSmallestAndLargestFloatsAreValues) {
  for (const float large : {1e-45f, 1e-38f, 1.0f, 3e38f}) {
    std::vector<float> values(8, large);
    values[3] = -large;
    const Compiled c = grid("", vol({2, 2, 2}, values));
    ASSERT_THAT(c.messages(), IsEmpty()) << large;
    EXPECT_GE(c.tables().texels[4], 1) << large;
    EXPECT_LT(c.tables().texels[4], 2) << large;
    EXPECT_EQ(c.tables().texels[7], -c.tables().texels[4]) << large;
  }
}

TEST(SdfGridHost, AsALightIsFoundByRaysAlone) {
  const Compiled c = compile_elements(
      kSensor + kEmitter +
          R"(<shape type="sdfgrid"><string name="filename" value="a.vol"/><emitter type="area"/></shape>)",
      {{"a.vol", kGrid}});
  ASSERT_THAT(c.messages(), IsEmpty());
  ASSERT_EQ(c.tables().lights.size(), 2u);
  const std::uint32_t light = c.tables().light_of(0);
  ASSERT_LT(light, 2u);
  EXPECT_EQ(c.tables().lights[light].kind, LightKind::analytic);
  EXPECT_EQ(c.tables().lights[light].prob, 0);
  EXPECT_NE(c.tables().surfaces.at(0).material_front & kEmitsBit, 0u);
}

TEST(SdfGridHost, PathsCannotBeginAtIt) {
  const Compiled c = compile_elements(
      R"(<integrator type="ptracer"/>)" + std::string(kSensor) + kEmitter +
          R"(<shape type="sdfgrid"><string name="filename" value="a.vol"/><emitter type="area"/></shape>)",
      {{"a.vol", kGrid}});
  ASSERT_EQ(c.messages().size(), 1u);
  EXPECT_THAT(c.messages()[0], HasSubstr("paths cannot begin at the shape around this emitter"));
}

}  // namespace
}  // namespace norrsken::testing
