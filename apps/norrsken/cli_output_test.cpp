// What the program writes: files, JSON, and what becomes of it when it cannot be written.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "cli_testing.h"

namespace norrsken::cli {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

TEST_F(Cli, TerminalsDoNotObeyWhatSomebodyElseWrote) {
  // Escape, the same in eight bits, delete, bell, and half a character.
  const std::string bad = "\x1b[31m\xc2\x9b\x7f\a\xc3";
  write("s.xml", R"(<scene version="3.0.0"><default name="a" value="1"/><sensor type="perspective"/>
  <shape type="sphere" id="$a"><float name="radius" value="2"/></shape><emitter type="constant"/></scene>)");
  fs::copy_file(folder_ / "s.xml", folder_ / (bad + ".xml"));
  write(bad + ".exr", "no image");
  const std::vector<std::vector<std::string>> commands = {
      {"info", "s.xml", "-Da=" + bad},
      {"info", "s.xml", "-D" + bad + "=1"},
      {"info", bad + ".xml"},
      {"info", bad},
      {"info", "s.xml", "--sensor", bad},
      {"render", bad + ".xml", "--size", "4x4", "--spp", "1"},
      {"render", "s.xml", "-Da=" + bad, "--size", "4x4", "--spp", "1", "-o", bad + ".png", "--json"},
      {"info", bad + ".png"},
      {"info", "s.xml", "-Da=" + bad, "--json"},
      {"compare", bad + ".exr", bad + ".exr"},
      {"merge", bad, "-o", "x.exr"},
      {bad},
      {"render", bad, "--" + bad}};
  for (const auto& command : commands) {
    const ProcessResult result = run(command);
    for (const std::string* text : {&result.out, &result.err}) {
      for (const char* control : {"\x1b", "\xc2\x9b", "\x7f", "\a"})
        EXPECT_THAT(*text, Not(HasSubstr(control))) << command[0] << " " << command.size();
    }
    if (command.back() == "--json") static_cast<void>(parse_lines(result.out));  // throws if it is none
  }
}

/// A limit on the size of files (SIGXFSZ) stands in for a disk that is full.
TEST_F(Cli, OneLostOutputDoesNotCostTheOthers) {
  const std::vector<std::string> lost = {"render", "hexagon_room", "-Dshadow_rays=1", "--size", "60x40", "--spp",
                                         "4",      "-o",           "a.exr",           "-o",     "b.jpg", "-o",
                                         "./b.jpg"};
  const ProcessResult result = run(lost, {.largest_file = 12000});
  EXPECT_EQ(result.status, 74);
  EXPECT_THAT(result.err, AllOf(HasSubstr("cannot write 'a.exr': File too large\n"), HasSubstr("wrote b.jpg\n")));
  EXPECT_THAT(files(), testing::ElementsAre("b.jpg"));
  const ProcessResult told = run(lost + std::vector<std::string>{"--json"}, {.largest_file = 12000});
  EXPECT_EQ(parse_lines(told.out).back()["files"], json::array({"b.jpg"}));
}

TEST_F(Cli, ImagesTooLargeForTheirFormatsAreRefusedBeforeRendering) {
  const ProcessResult result = run({"render", "hexagon_room", "-Dshadow_rays=1", "--size", "65536x1", "--spp",
                                    "1000000000", "-o", "a.jpg", "-o", "b.exr"});
  EXPECT_EQ(result.status, 73);
  EXPECT_EQ(
      result.err,
      "norrsken: error: cannot write 'a.jpg': the image has 65536x1 pixels, the format takes 65500 along a side\n");
  EXPECT_THAT(files(), IsEmpty());
}

TEST_F(Cli, QuietJsonIsStartAndDone) {
  // The warning that layers are for EXR files alone is left out.
  const std::vector<std::string> quiet = {"render", "hexagon_room", "--quiet", "--json", "--layers", "-o", "a.png"};
  const ProcessResult result = run(quiet + kShort);
  EXPECT_EQ(result.status, 0);
  EXPECT_THAT(result.err, IsEmpty());
  const auto events = parse_lines(result.out);
  ASSERT_EQ(events.size(), 2u);
  EXPECT_EQ(events[0]["event"], "start");
  EXPECT_EQ(events[1]["event"], "done");
}

/// json::parse refuses what is not UTF-8.
TEST_F(Cli, JsonIsUtf8WhateverThePath) {
  write("bad\xff.xml",
        R"(<scene version="3.0.0"><sensor type="perspective"/><shape type="sphere"/><emitter type="constant"/>
</scene>)");
  const std::vector<std::string> tiny = {"--size", "4x4", "--spp", "1"};
  const auto events =
      parse_lines(run(std::vector<std::string>{"render", "bad\xff.xml", "--json", "-o", "\xe9.exr"} + tiny).out);
  ASSERT_EQ(events.size(), 3u);
  EXPECT_EQ(events.front()["scene"], "bad\xef\xbf\xbd.xml");
  EXPECT_EQ(events.back()["files"], json::array({"\xef\xbf\xbd.exr"}));
  EXPECT_EQ(parse_lines(run({"info", "bad\xff.xml", "--json"}).out).at(0)["scene"], "bad\xef\xbf\xbd.xml");
  EXPECT_EQ(parse_lines(run({"info", "\xe9.exr", "--json"}).out).at(0)["metadata"]["norrsken.scene"],
            "bad\xef\xbf\xbd.xml");
}

TEST_F(Cli, JsonTellsStartProgressDone) {
  const ProcessResult result = run(std::vector<std::string>{"render", "hexagon_room", "--json"} + kShort);
  EXPECT_EQ(result.status, 0);
  EXPECT_THAT(result.err, IsEmpty());
  const auto events = parse_lines(result.out);
  ASSERT_GE(events.size(), 3u);
  EXPECT_EQ(events.front()["event"], "start");
  EXPECT_EQ(events.front()["width"], 40);
  EXPECT_EQ(events[1]["event"], "progress");
  EXPECT_EQ(events.back()["event"], "done");
  EXPECT_EQ(events.back()["samples"], 40 * 30 * 4);
  EXPECT_EQ(events.back()["interrupted"], false);
  EXPECT_EQ(events.back()["files"], json::array({"hexagon_room.exr"}));
  EXPECT_GT(events.back()["closest_rays"], 40 * 30 * 4 - 1);
}

TEST_F(Cli, QuietPrintsNothing) {
  const ProcessResult result = run(std::vector<std::string>{"render", "hexagon_room", "--quiet"} + kShort);
  EXPECT_EQ(result.status, 0);
  EXPECT_EQ(result.out + result.err, "");
}

TEST_F(Cli, LostOutputIs74) {
  const ProcessResult result = run({"scenes"}, {.stdout_file = "/dev/full"});
  EXPECT_EQ(result.status, 74);
  EXPECT_THAT(result.err, HasSubstr("standard output"));
  // The image survives a reader of the progress that does not.
  const std::vector<std::string> render = {"render", "hexagon_room", "--json"};
  EXPECT_EQ(run(render + kShort, {.stdout_file = "/dev/full"}).status, 74);
  EXPECT_THAT(files(), testing::ElementsAre("hexagon_room.exr"));
}

TEST_F(Cli, BenchPrintsOneLineOfJson) {
  const ProcessResult result =
      run(std::vector<std::string>{"bench", "hexagon_room", "--repeat", "2", "--isa", "scalar"} + kShort);
  EXPECT_EQ(result.status, 0) << result.err;
  const auto lines = parse_lines(result.out);
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_EQ(lines[0]["isa"], "scalar");
  EXPECT_EQ(lines[0]["lanes"], 1);
  EXPECT_EQ(lines[0]["samples"], 40 * 30 * 4);
  EXPECT_GT(lines[0]["mrays_per_second"]["median"], 0.0);
  EXPECT_LE(lines[0]["msamples_per_second"]["min"], lines[0]["msamples_per_second"]["max"]);
  EXPECT_THAT(files(), IsEmpty());
}

}  // namespace
}  // namespace norrsken::cli
