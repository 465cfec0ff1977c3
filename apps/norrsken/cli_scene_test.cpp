// What the program says of scenes: which sensor, which version, which kind of file.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/process.h"
#include "tests/temporary_folder.h"

namespace norrsken::cli {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

class CliScene : public testing::Test {
 protected:
  ProcessResult run(const std::vector<std::string>& arguments) const {
    ProcessOptions options;
    options.folder = folder_.string();
    return run_program(arguments, options);
  }
  const TemporaryFolder folder_;
};

TEST_F(CliScene, ASensorIsChosen) {
  folder_.write("two.xml", R"(<scene version="3.0.0">
  <sensor type="perspective" id="left"><film type="hdrfilm"><integer name="width" value="5"/></film></sensor>
  <sensor type="perspective" id="right"><film type="hdrfilm"><integer name="width" value="7"/></film></sensor>
  <shape type="sphere"/><emitter type="constant"/>
</scene>)");
  const ProcessResult first = run({"info", "two.xml"});
  EXPECT_THAT(first.err, AllOf(HasSubstr("only the scene's first sensor is used"), HasSubstr("accepted: --sensor 1")));
  EXPECT_THAT(first.out, AllOf(HasSubstr("5 x 576 pixels"), HasSubstr("--sensor 0, the one that is used"),
                               HasSubstr("--sensor 1")));
  for (const char* choice : {"1", "right"}) {
    const ProcessResult second = run({"info", "two.xml", "--sensor", choice, "--json"});
    EXPECT_EQ(second.err, "");
    EXPECT_EQ(nlohmann::json::parse(second.out).at("width"), 7);
  }
  const ProcessResult wrong = run({"render", "two.xml", "--sensor", "rigt", "--spp", "1"});
  EXPECT_EQ(wrong.status, 64);
  EXPECT_THAT(wrong.err, AllOf(HasSubstr("the scene has no sensor 'rigt', did you mean 'right'?"),
                               HasSubstr("accepted: 0 or left, 1 or right")));
}

TEST_F(CliScene, AnOldSceneIsUpgradedAndInfoTellsHow) {
  folder_.write("old.xml", R"(<scene version="0.5.0">
  <integrator type="path"><integer name="maxDepth" value="3"/></integrator>
  <sensor type="perspective"><film type="ldrfilm"><integer name="width" value="5"/></film></sensor>
  <shape type="sphere"/><emitter type="constant"/>
</scene>)");
  const ProcessResult info = run({"info", "old.xml"});
  EXPECT_EQ(info.status, 0);
  EXPECT_THAT(info.err, HasSubstr("old.xml:1:17: note: the scene is for Mitsuba '0.5.0' and was upgraded"));
  EXPECT_THAT(info.out, HasSubstr("upgraded from an older version of the format\n"
                                  "  old.xml:2:42: 'maxDepth' is 'max_depth'\n"
                                  "  old.xml:3:42: film 'ldrfilm' is 'hdrfilm'\n"));
  EXPECT_EQ(nlohmann::json::parse(run({"info", "old.xml", "--json"}).out).at("changes").size(), 2U);
}

TEST_F(CliScene, WhatIsNoSceneIsToldByName) {
  folder_.write("ball.txt", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  const ProcessResult mesh = run({"render", "ball.txt"});
  EXPECT_EQ(mesh.status, 65);
  EXPECT_THAT(mesh.err, AllOf(HasSubstr("ball.txt: error: 'ball.txt' is a Wavefront OBJ mesh, not a scene"),
                              Not(HasSubstr("root element"))));
  // The scene that it proposes renders the mesh.
  const std::size_t begin = mesh.err.find("    <scene"), end = mesh.err.find("</scene>");
  ASSERT_NE(end, std::string::npos);
  folder_.write("ball.xml", mesh.err.substr(begin, end + 8 - begin));
  const ProcessResult info = run({"info", "ball.xml"});
  EXPECT_EQ(info.err, "");
  EXPECT_THAT(info.out, HasSubstr("1 triangle,"));
}

TEST_F(CliScene, MeshesAreConvertedToScenes) {
  folder_.write("ball.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  const ProcessResult converted = run({"convert", "ball.obj", "-o", "ball.xml"});
  EXPECT_EQ(converted.status, 0);
  EXPECT_THAT(converted.err, HasSubstr("note: a mesh without camera and light"));
  EXPECT_EQ(converted.out, "ball.xml and 2 files beside it\n");
  EXPECT_THAT(run({"info", "ball.xml"}).out, HasSubstr("1 triangle,"));
  EXPECT_EQ(run({"convert", "ball.xml", "-o", "./ball.xml"}).status, 64);
  EXPECT_EQ(run({"convert", "missing.obj", "-o", "b.xml"}).status, 66);
  EXPECT_EQ(run({"convert", "ball.obj", "-o", "b.json"}).status, 64);
}

}  // namespace
}  // namespace norrsken::cli
