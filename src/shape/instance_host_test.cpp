#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "compile/compile_testing.h"

namespace norrsken::testing {
namespace {

using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

std::string group(const std::string& inside) { return "<shape type=\"shapegroup\" id=\"g\">" + inside + "</shape>"; }
std::string instance(const std::string& inside) { return "<shape type=\"instance\">" + inside + "</shape>"; }
std::string place(const std::string& inside) { return "<transform name=\"to_world\">" + inside + "</transform>"; }

const std::string kMembers = R"(<shape type="rectangle"/><shape type="sphere"/><shape type="disk"/>)";
const std::string kReference = R"(<ref id="g"/>)";

TEST(ShapeGroup, IsStoredOnceHoweverOftenItIsPlaced) {
  const Compiled c = compile_shape(group(kMembers) + instance(kReference) +
                                   instance(kReference + place(R"(<scale value="2"/><translate x="5"/>)")) +
                                   R"(<shape type="rectangle"/>)");
  ASSERT_THAT(c.messages(), IsEmpty());
  const SceneTables& t = c.tables();
  EXPECT_EQ(t.group_count, 1u);
  EXPECT_EQ(t.instances.size(), 2u);
  EXPECT_EQ(t.triangle_count(), 4u);
  EXPECT_EQ(t.sphere_count(), 1u);
  EXPECT_EQ(t.analytic_count(), 1u);
  EXPECT_EQ(c.info().instances, 2u);
  EXPECT_EQ(c.info().other_shapes, 1u);
  std::vector<std::uint32_t> groups;
  for (const ShapeRecord& shape : t.shapes) groups.push_back(shape.group);
  EXPECT_THAT(groups, ElementsAre(0, 0, 0, kNone));
  EXPECT_THAT(c.info().bounds_min, ElementsAre(-1, -2, -2));
  EXPECT_THAT(c.info().bounds_max, ElementsAre(7, 2, 2));
}

TEST(ShapeGroup, IsNowhereWithoutAnInstance) {
  const Compiled c = compile_shape(group(kMembers) + R"(<shape type="rectangle"/>)");
  ASSERT_THAT(c.messages(), IsEmpty());
  EXPECT_THAT(c.info().bounds_max, ElementsAre(1, 1, 0));
}

TEST(ShapeGroup, MayBeEmpty) {
  const Compiled c = compile_shape(group("") + R"(<shape type="instance"><ref id="g"/></shape><shape type="sphere"/>)");
  EXPECT_THAT(c.messages(), ElementsAre("warning: the shapegroup has no shape"));
  EXPECT_THAT(c.info().bounds_max, ElementsAre(1, 1, 1));
}

TEST(ShapeGroup, RefusesWhatItCannotHold) {
  EXPECT_THAT(compile_shape(group("<shape type=\"shapegroup\">" + kMembers + "</shape>")).messages(),
              ElementsAre("error: a shapegroup stands inside another one [shapes with a surface]"));
  EXPECT_THAT(compile_shape(group(kMembers + "<shape type=\"instance\"><shape type=\"shapegroup\">" + kMembers +
                                  "</shape></shape>"))
                  .messages(),
              ElementsAre("error: an instance stands inside a shapegroup [shapes with a surface]"));
  EXPECT_THAT(compile_shape(group(R"(<shape type="sphere"><emitter type="area"/></shape>)")).messages(),
              ElementsAre("error: an emitter stands inside a shapegroup, whose instances cannot shine "
                          "[emitters on shapes of the scene itself]"));
  EXPECT_THAT(compile_shape(group(kMembers + R"(<float name="radius" value="1"/>)")).messages(),
              ElementsAre(HasSubstr("radius")));
}

TEST(Instance, KeepsItsPlaceAndTheWayBack) {
  const Compiled c = compile_shape(
      group(kMembers) + instance(kReference + place(R"(<scale x="-2" y="4" z="8"/><translate x="1" y="2" z="3"/>)")));
  ASSERT_THAT(c.messages(), IsEmpty());
  const InstanceRecord& record = c.tables().instances.at(0);
  EXPECT_THAT(record.place.world_from_local, ElementsAre(-2, 0, 0, 1, 0, 4, 0, 2, 0, 0, 8, 3));
  EXPECT_THAT(record.place.local_from_world, ElementsAre(-0.5f, 0, 0, 0.5f, 0, 0.25f, 0, -0.5f, 0, 0, 0.125f, -0.375f));
  EXPECT_EQ(record.group, 0u);
}

TEST(Instance, TakesAGroupAndAPlace) {
  EXPECT_THAT(compile_shape(instance("")).messages(),
              ElementsAre("error: the instance has no shapegroup [<ref id=\"...\"/> to a shapegroup]"));
  EXPECT_THAT(compile_shape(instance(R"(<shape type="sphere"/>)")).messages(),
              ElementsAre("error: an instance of a sphere [<ref id=\"...\"/> to a shapegroup]"));
  EXPECT_THAT(compile_shape(group(R"(<shape type="sphere"><float name="radius" value="9e11"/></shape>)") +
                            instance(kReference + place(R"(<scale value="10"/>)")))
                  .messages(),
              ElementsAre("error: the instance is placed too far away or made too large [coordinates up to 1e+12]"));
  EXPECT_THAT(compile_shape(group(kMembers) + instance(kReference + place(R"(<scale x="0"/>)"))).messages(),
              ElementsAre("error: 'to_world' cannot be inverted [scale factors other than 0]"));
  EXPECT_THAT(
      compile_shape(group(kMembers) + instance(kReference + R"(<float name="to_world" value="1"/>)")).messages(),
      Each(HasSubstr("to_world")));
  EXPECT_THAT(compile_shape(group(kMembers) + instance(kReference + R"(<bsdf type="diffuse"/>)")).messages(),
              ElementsAre(HasSubstr("bsdf")));
}

TEST(SphereShape, RemembersHowItIsTurned) {
  const auto rotation_of = [](const std::string& inside) {
    const Compiled c = compile_shape("<shape type=\"sphere\">" + place(inside) + "</shape>");
    const SceneTables& t = c.tables();
    const std::uint32_t at = t.shapes.at(0).object_from_world;
    return at == kNone ? std::vector<float>() : std::vector(t.parameters.begin() + at, t.parameters.begin() + at + 9);
  };
  EXPECT_THAT(rotation_of(R"(<scale value="3"/><translate x="1"/>)"), IsEmpty());
  EXPECT_THAT(rotation_of(R"(<scale value="3"/><matrix value="0 -1 0 0 1 0 0 0 0 0 1 0 0 0 0 1"/>)"),
              ElementsAre(0, 1, 0, -1, 0, 0, 0, 0, 1));
}

}  // namespace
}  // namespace norrsken::testing
