// The program as its users meet it: arguments in, exit status, messages and files out.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cmath>
#include <csignal>
#include <filesystem>
#include <iterator>
#include <nlohmann/json.hpp>
#include <sstream>

#include "cli_testing.h"
#include "norrsken/image.h"

namespace norrsken::cli {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::AllOf;
using testing::ContainsRegex;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::StartsWith;

TEST_F(Cli, HelpAndVersionGoToStdout) {
  for (const char* command : {"render", "info", "scenes", "convert", "compare", "bench", "figures"}) {
    const ProcessResult help = run({command, "--help"});
    EXPECT_EQ(help.status, 0) << command;
    EXPECT_THAT(help.out, AllOf(HasSubstr("Example"), HasSubstr(std::string("norrsken ") + command)));
    EXPECT_THAT(help.out, AllOf(Not(HasSubstr("REQUIRED")), Not(HasSubstr("Excludes")), Not(HasSubstr("..."))));
    EXPECT_THAT(help.err, IsEmpty());
  }
  EXPECT_THAT(run({"merge", "--help"}).out,
              AllOf(HasSubstr("norrsken merge [OPTIONS] FILE...\n"), HasSubstr("Example")));
  const ProcessResult version = run({"--version"});
  EXPECT_EQ(version.status, 0);
  EXPECT_THAT(version.out, AllOf(StartsWith("norrsken "), HasSubstr("scalar")));
  // As other programs have it.
  for (const char* word : {"version", "-V"}) EXPECT_EQ(run({word}).out, version.out);
  EXPECT_EQ(run({"help"}).out, run({"--help"}).out);
  EXPECT_EQ(run({"help", "render"}).out, run({"render", "--help"}).out);
}

/// 41 million samples with one shadow ray per hit: three seconds on two cores.
TEST_F(Cli, TheFirstExamplesOfTheHelpAreQuick) {
  for (const std::vector<std::string>& help : {std::vector<std::string>{"--help"}, {"render", "--help"}}) {
    const std::string text = run(help).out;
    const std::size_t begin =
        text.find("  norrsken render ", text.find("Examples:")) + std::string("  norrsken ").size();
    std::istringstream words(text.substr(begin, text.find('\n', begin) - begin));
    std::vector<std::string> example = {"info", "--json"};
    std::string word;
    words >> word;  // render
    while (words >> word && word != "writes") {
      if (word == "-o" || word == "--exposure")
        words >> word;
      else
        example.push_back(word);
    }
    const ProcessResult told = run(example);
    ASSERT_EQ(told.status, 0) << told.err;
    const json info = parse_lines(told.out).at(0);
    const double samples = info["width"].get<double>() * info["height"].get<double>() *
                           info["samples_per_pixel"].get<double>() * info["emitter_samples"].get<double>();
    EXPECT_LE(samples, 800.0 * 800 * 64);
  }
}

TEST_F(Cli, WrongCommandLinesAre64AndLeaveNothing) {
  const auto expect_usage = [this](const std::vector<std::string>& arguments, const std::string& message) {
    const ProcessResult result = run(arguments);
    EXPECT_EQ(result.status, 64) << message;
    EXPECT_THAT(result.err, HasSubstr(message));
    EXPECT_THAT(result.out, IsEmpty());
  };
  expect_usage({}, "Usage: norrsken");
  expect_usage({"rendr"}, "unknown command 'rendr', did you mean 'render'?");
  expect_usage({"render"}, "SCENE is required");
  expect_usage({"render", "hexagon_room", "--sppp", "3"}, "unknown option '--sppp', did you mean '--spp'?");
  expect_usage({"render", "hexagon_room", "--spp", "0"}, "--spp: found '0', accepted is a whole number from 1 to");
  expect_usage({"render", "hexagon_room", "--size", "800"}, "--size: found '800', accepted is WIDTHxHEIGHT");
  expect_usage({"render", "hexagon_room", "--target-error", "2"},
               "--target-error: found '2', accepted is a share greater than 0 and less than 1, as in 1% or 0.01");
  expect_usage({"render", "hexagon_room", "--time", "30"}, "--time: found '30', accepted is a time with its unit");
  expect_usage({"render", "hexagon_room", "--samples", "0:4", "--checkpoint", "x", "--adaptive"},
               "--samples takes all samples of a range");
  expect_usage({"render", "hexagon_room", "--pixel", "1,1", "--sample", "0", "--time", "1s"},
               "--pixel prints one sample");
  expect_usage({"render", "hexagon_room", "-Dspp"}, "-D: found 'spp', accepted is NAME=VALUE");
  expect_usage({"render", "hexagon_room", "-Dlite=point"}, "$lite");
  expect_usage({"render", "hexagon_room", "--isa", "mmx"}, "accepted: auto");
  expect_usage({"render", "hexagon_room", "--integrator", "pth"}, "did you mean 'path'?");
  expect_usage({"render", "hexagon_room", "--integrator", ""}, "integrator");
  expect_usage({"render", "hexagon_room", "--sampler", ""}, "sampler");
  expect_usage({"render", "hexagon_room", "--threads", "1025"}, "a whole number from 0 to 1024");
  expect_usage({"render", "hexagon_room", "-o", "a.bmp"}, "a.bmp");
  expect_usage({"--json", "info", "hexagon_room"}, "'--json' belongs after the command: norrsken info --json\n");
  expect_usage({"-Dspp=4", "render", "hexagon_room"}, "'-D' belongs after the command: norrsken render -D\n");
  expect_usage({"--json"}, "'--json' belongs after the command: norrsken COMMAND --json\n");
  expect_usage({"-v"}, "unknown option '-v'\n");
  expect_usage({"help", "rendr"}, "unknown command 'rendr', did you mean 'render'?");
  EXPECT_THAT(files(), IsEmpty());
}

TEST_F(Cli, WrongScenesAre65AndMissingOnes66) {
  write("bad.xml", "<scene version=\"3.0.0\"><bsdf type=\"difuse\"/></scene>\n");
  const ProcessResult bad = run({"render", "bad.xml", "-o", "bad.png"});
  EXPECT_EQ(bad.status, 65);
  EXPECT_THAT(bad.err, AllOf(HasSubstr("bad.xml:1:"), HasSubstr("difuse")));
  const ProcessResult missing = run({"render", "missing.xml"});
  EXPECT_EQ(missing.status, 66);
  EXPECT_THAT(missing.err, HasSubstr("missing.xml"));
  EXPECT_EQ(run({"info", "."}).status, 66);
  EXPECT_THAT(files(), testing::ElementsAre("bad.xml"));
}

TEST_F(Cli, OutputsAreCheckedBeforeRendering) {
  const ProcessResult result =
      run(std::vector<std::string>{"render", "hexagon_room", "-o", "no/folder/a.png", "-o", "none/b.exr"} + kEndless);
  EXPECT_EQ(result.status, 73);
  EXPECT_THAT(result.err, AllOf(HasSubstr("no/folder/a.png"), HasSubstr("none/b.exr")));
  EXPECT_THAT(files(), IsEmpty());
}

TEST_F(Cli, EverythingWrongIsToldAtOnce) {
  write("bad.xml", "<scene version=\"3.0.0\"><bsdf type=\"difuse\"/></scene>\n");
  const ProcessResult result = run({"render", "bad.xml", "-o", "none/a.exr", "-o", "b.bmp"});
  EXPECT_EQ(result.status, 64);
  EXPECT_THAT(result.err, AllOf(HasSubstr("none/a.exr"), HasSubstr("b.bmp"), HasSubstr("difuse")));
}

TEST_F(Cli, PipesAreNotInputsAndNobodyWaitsForThem) {
  ASSERT_EQ(mkfifo((folder_ / "pipe.xml").c_str(), 0600), 0);
  ASSERT_EQ(mkfifo((folder_ / "pipe.exr").c_str(), 0600), 0);
  EXPECT_EQ(run({"info", "pipe.xml"}).status, 66);
  EXPECT_EQ(run({"compare", "pipe.exr", "pipe.exr"}).status, 66);
}

TEST_F(Cli, RendersEveryOutputAndTheDefaultOne) {
  const ProcessResult result =
      run(std::vector<std::string>{"render", "hexagon_room", "-o", "a.exr", "-o", "a.png", "--layers"} + kShort);
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_THAT(result.out, IsEmpty());
  EXPECT_THAT(result.err, HasSubstr("wrote a.exr, a.png"));
  const Image image = image_of("a.exr");
  EXPECT_EQ(image.width, 40);
  EXPECT_EQ(image.height, 30);
  EXPECT_NE(image.find("variance.R"), nullptr);
  EXPECT_EQ(run(std::vector<std::string>{"render", "hexagon_room"} + kShort).status, 0);
  EXPECT_THAT(files(), testing::UnorderedElementsAre("a.exr", "a.png", "hexagon_room.exr"));
}

TEST_F(Cli, SeedAndThreadsDecideAsPromised) {
  const auto render = [&](const std::string& file, const std::vector<std::string>& more) {
    EXPECT_EQ(run(std::vector<std::string>{"render", "hexagon_room", "-o", file} + kShort + more).status, 0);
    const Image image = image_of(file);
    return image.find("R")->values;
  };
  const auto one = render("one.exr", {"--threads", "1"});
  EXPECT_EQ(one, render("two.exr", {"--threads", "2"}));
  EXPECT_NE(one, render("seed.exr", {"--seed", "1"}));
}

TEST_F(Cli, ReplaysOneSample) {
  const std::vector<std::string> one = {"render", "hexagon_room", "-Dshadow_rays=1", "--size", "40x30", "--spp",
                                        "1",      "--sampler",    "independent",     "--isa",  "scalar"};
  ASSERT_EQ(run(one + std::vector<std::string>{"-o", "a.exr", "--seed", "3"}).status, 0);
  const Image image = image_of("a.exr");
  const ProcessResult text = run(one + std::vector<std::string>{"--seed", "3", "--pixel", "12,20", "--trace"});
  EXPECT_EQ(text.status, 0);
  EXPECT_THAT(text.out, AllOf(StartsWith("sample 0 of pixel 12, 20\n"), HasSubstr("\n  1  ray from (-0.99, "),
                              ContainsRegex("meets shape [0-9]+ '[a-z_0-9]+', primitive"),
                              HasSubstr("light sample for diffuse"), HasSubstr("radiance (")));
  const ProcessResult object = run(one + std::vector<std::string>{"--seed", "3", "--pixel", "12,20", "--json"});
  const std::vector<float> radiance = parse_lines(object.out).at(0)["radiance"];
  const char* names[] = {"R", "G", "B"};
  for (std::size_t k = 0; k < 3; ++k)
    EXPECT_FLOAT_EQ(radiance.at(k), image.find(names[k])->values[20 * 40 + 12]) << names[k];
  EXPECT_EQ(run(one + std::vector<std::string>{"--pixel", "40,20"}).status, 64);
  EXPECT_EQ(run(one + std::vector<std::string>{"--pixel", "12"}).status, 64);
  EXPECT_EQ(run(one + std::vector<std::string>{"--trace"}).status, 64);
  EXPECT_EQ(run(one + std::vector<std::string>{"--pixel", "1,1", "-o", "b.exr"}).status, 64);
}

/// A projector of the brightest light that a scene may have, so close to a floor that some of it is beyond the greatest
/// float.
TEST_F(Cli, SamplesThatAreInfiniteAreToldWithTheCommandThatReplaysThem) {
  write("bright.xml",
        R"(<scene version="3.0.0"><integrator type="path"><integer name="max_depth" value="2"/></integrator>
    <sensor type="perspective"><transform name="to_world"><lookat origin="0, 0, 0.4" target="0, 0, 0" up="0, 1, 0"/>
    </transform><film type="hdrfilm"><integer name="width" value="16"/><integer name="height" value="16"/></film></sensor>
    <shape type="rectangle"/><emitter type="projector"><float name="fov" value="120"/><float name="scale" value="1e18"/>
    <rgb name="irradiance" value="1e18, 1, 0"/><transform name="to_world">
    <lookat origin="0, 0, 0.1" target="0, 0, 0" up="0, 1, 0"/></transform></emitter></scene>)");
  const ProcessResult rendered = run({"render", "bright.xml", "--spp", "4", "--seed", "7", "-o", "a.exr"});
  EXPECT_EQ(rendered.status, 0);
  EXPECT_THAT(rendered.err, HasSubstr("samples were left out, being infinite or not a number: pixel ("));
  const std::string before = "what became of the first: norrsken ";
  const std::size_t begin = rendered.err.find(before);
  ASSERT_NE(begin, std::string::npos) << rendered.err;
  std::istringstream command(
      rendered.err.substr(begin + before.size(), rendered.err.find('\n', begin) - begin - before.size()));
  const std::vector<std::string> arguments{std::istream_iterator<std::string>(command), {}};
  EXPECT_THAT(arguments, testing::IsSupersetOf({"--pixel", "--sample", "--trace", "--seed", "7"}));
  const ProcessResult replayed = run(arguments);
  EXPECT_EQ(replayed.status, 0);
  EXPECT_THAT(replayed.out, AllOf(HasSubstr("light sample for diffuse: along ("), HasSubstr(" adds (inf, "),
                                  HasSubstr("\nradiance (inf, ")));

  const Image image = image_of("a.exr");
  for (const char* channel : {"R", "G", "B"}) {
    for (const float value : image.find(channel)->values) ASSERT_TRUE(std::isfinite(value));
  }
}

TEST_F(Cli, EndsAtAnErrorOrATime) {
  const std::vector<std::string> room = {"render", "hexagon_room", "-Dshadow_rays=1", "--size", "40x30"};
  const auto events = parse_lines(run(room + std::vector<std::string>{"--target-error", "50%", "--json"}).out);
  ASSERT_GE(events.size(), 2u);
  EXPECT_EQ(events.front()["target_error"], 0.5);
  EXPECT_EQ(events.front()["samples_per_pixel"], nullptr);
  const json& done = events.back();
  EXPECT_EQ(done["interrupted"], false);
  EXPECT_LE(done["relative_error_interval"][1], 0.5);
  EXPECT_LE(done["relative_error_interval"][0], done["relative_error"]);
  EXPECT_EQ(events[events.size() - 2]["fraction"], 1);

  const ProcessResult timed = run(room + std::vector<std::string>{"--time", "0.3s", "--spp", "1000000", "--adaptive"});
  EXPECT_EQ(timed.status, 0) << timed.err;
  EXPECT_THAT(timed.err, AllOf(HasSubstr("at most 1000000 samples per pixel on average, for 0.3s"),
                               ContainsRegex("estimated error [0-9.]+ % \\([0-9.]+ % to [0-9.]+ %\\)")));
}

TEST_F(Cli, InterruptSavesAndSays) {
  for (const int signal_number : {SIGINT, SIGTERM, SIGHUP, SIGUSR1, SIGXCPU}) {
    const ProcessResult result = run(std::vector<std::string>{"render", "hexagon_room", "-o", "part.exr"} + kEndless,
                                     {.signals = {signal_number}});
    EXPECT_EQ(result.status, 77) << result.err;
    EXPECT_THAT(result.err, AllOf(HasSubstr("stopping; writing what there is (Ctrl-C again before that discards it)\n"),
                                  HasSubstr("wrote part.exr"),
                                  HasSubstr("of 1000000 samples per pixel; with --checkpoint FILE, the same command "
                                            "would go on\n")));
    const Image image = image_of("part.exr");
    double sum = 0;
    for (const float value : image.find("R")->values) sum += value;
    EXPECT_GT(sum, 0);
    fs::remove(folder_ / "part.exr");
  }
  // Where the kernel kills without a signal first, as `ulimit -t 3` has it.
  const ProcessResult limited =
      run(std::vector<std::string>{"render", "hexagon_room", "-o", "part.exr"} + kEndless, {.processor_seconds = 3});
  EXPECT_EQ(limited.status, 77) << limited.err;
  EXPECT_THAT(limited.err, HasSubstr("wrote part.exr"));
  fs::remove(folder_ / "part.exr");
  const auto events = parse_lines(
      run(std::vector<std::string>{"render", "hexagon_room", "--json"} + kEndless, {.signals = {SIGINT}}).out);
  EXPECT_EQ(events.back()["interrupted"], true);
  EXPECT_EQ(events.back()["files"], json::array({"hexagon_room.exr"}));
}

TEST_F(Cli, TerminalGetsOneRewrittenLineWithinItsWidth) {
  const ProcessResult result = run(std::vector<std::string>{"render", "hexagon_room"} + kEndless,
                                   {.terminal = true, .signals = {SIGINT}, .signal_delay = std::chrono::seconds(1)});
  EXPECT_EQ(result.status, 77);
  std::istringstream stream(result.err);
  int updates = 0;
  for (std::string part; std::getline(stream, part, '\r');) {
    const auto end = part.find("\x1b[K");
    if (end == std::string::npos || end == 0) continue;
    ++updates;
    EXPECT_LT(end, 80u) << part;
    EXPECT_THAT(part, HasSubstr(" %"));
  }
  EXPECT_GE(updates, 2);
  // The line is removed before the summary follows.
  EXPECT_THAT(result.err, HasSubstr("\r\x1b[K"));
}

TEST_F(Cli, ColorOnTerminalsOnlyAndNeverWithNoColor) {
  const std::vector<std::string> wrong = {"render", "hexagon_room", "--spp", "0"};
  const std::string red = "\x1b[1;31merror:";
  EXPECT_THAT(run(wrong, {.terminal = true}).err, HasSubstr(red));
  EXPECT_THAT(run(wrong, {.environment = {"NO_COLOR=1"}, .terminal = true}).err, Not(HasSubstr("\x1b[")));
  EXPECT_THAT(run(wrong, {.environment = {"TERM=dumb"}, .terminal = true}).err, Not(HasSubstr("\x1b[")));
  EXPECT_THAT(run(wrong).err, Not(HasSubstr("\x1b[")));
}

TEST_F(Cli, SamplesPerPixelReplaceTheScenes) {
  const auto info = [this](const std::vector<std::string>& more) {
    return parse_lines(run(std::vector<std::string>{"info", "hexagon_room", "--json"} + more).out).at(0);
  };
  const json both = info({"--spp", "5"});
  EXPECT_EQ(both["samples_per_pixel"], 5);
  EXPECT_EQ(both["emitter_samples"], 5);  // $shadow_rays follows $spp
  EXPECT_FALSE(both.contains("accelerator"));
  const json apart = info({"--spp", "5", "-Dspp=7"});
  EXPECT_EQ(apart["samples_per_pixel"], 5);
  EXPECT_EQ(apart["emitter_samples"], 7);
  EXPECT_THAT(run({"info", "hexagon_room", "--spp", "1"}).out,
              AllOf(HasSubstr("1 sample per pixel"), HasSubstr("1 shadow ray per hit"), HasSubstr("1 sphere,")));
}

TEST_F(Cli, InfoAndScenesTellTheRoom) {
  EXPECT_THAT(run({"scenes"}).out, AllOf(StartsWith("gallery_cameras "), HasSubstr("\nhexagon_room ")));
  EXPECT_EQ(parse_lines(run({"scenes", "--json"}).out).at(3)["name"], "hexagon_room");
  const json info = parse_lines(run({"info", "hexagon_room", "-Dlight=point", "--json"}).out).at(0);
  EXPECT_EQ(info["triangles"], 28);
  EXPECT_EQ(info["spheres"], 1);
  EXPECT_EQ(info["width"], 800);
  EXPECT_EQ(info["parameters"]["light"], "point");
  EXPECT_THAT(run({"info", "hexagon_room"}).out, AllOf(HasSubstr("30 triangles"), HasSubstr("mirror")));
}

TEST_F(Cli, CompareTellsDistancesAndWritesTheDifference) {
  ASSERT_EQ(run(std::vector<std::string>{"render", "hexagon_room", "-o", "a.exr", "--layers"} + kShort).status, 0);
  ASSERT_EQ(run(std::vector<std::string>{"render", "hexagon_room", "-o", "b.exr", "--seed", "7"} + kShort).status, 0);
  const ProcessResult same = run({"compare", "a.exr", "a.exr", "--json"});
  EXPECT_EQ(same.status, 0);
  EXPECT_EQ(json::parse(same.out)["mse"], 0);
  EXPECT_TRUE(json::parse(same.out)["psnr"].is_null());  // infinite
  const json other = json::parse(run({"compare", "a.exr", "b.exr", "-o", "d.png", "--json"}).out);
  EXPECT_GT(other["mse"], 0);
  EXPECT_FALSE(other["z_test"].is_null());
  EXPECT_TRUE(fs::exists(folder_ / "d.png"));
  EXPECT_THAT(run({"compare", "b.exr", "b.exr"}).out, HasSubstr("z-test  none"));
  const ProcessResult missing = run({"compare", "missing.exr", "none.exr"});
  EXPECT_EQ(missing.status, 66);
  EXPECT_THAT(missing.err, AllOf(HasSubstr("missing.exr"), HasSubstr("none.exr")));
  write("not.exr", "");
  EXPECT_EQ(run({"compare", "a.exr", "not.exr"}).status, 65);
  const std::string before = read("a.exr");
  EXPECT_EQ(run({"compare", "a.exr", "b.exr", "-o", "./a.exr"}).status, 64);
  EXPECT_EQ(read("a.exr"), before);
  const std::vector<std::string> small = {"render", "hexagon_room", "-o", "s.exr", "-Dshadow_rays=1", "--spp", "1"};
  ASSERT_EQ(run(small + std::vector<std::string>{"--size", "8x6"}).status, 0);
  const ProcessResult sizes = run({"compare", "a.exr", "s.exr"});
  EXPECT_EQ(sizes.status, 65);
  EXPECT_THAT(sizes.err, HasSubstr("the images differ in size: a.exr is 40x30, s.exr 8x6"));
}

TEST_F(Cli, FiguresNeedsAFolderItCanMakeAndSavesNoPageWhenInterrupted) {
  write("file", "");
  EXPECT_EQ(run({"figures", "-o", "file/below"}).status, 73);
  const ProcessResult result = run({"figures", "-o", "out", "--quick"}, {.signals = {SIGINT}});
  EXPECT_EQ(result.status, 77) << result.err;
  EXPECT_THAT(result.err, AllOf(HasSubstr("index.html was not written"), Not(HasSubstr("error:"))));
  EXPECT_FALSE(fs::exists(folder_ / "out/index.html"));
}

}  // namespace
}  // namespace norrsken::cli
