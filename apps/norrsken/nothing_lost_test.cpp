// Files of the user's: what is read is not written over, one process at a time has a checkpoint, and whatever there is of
// a rendering becomes an image that says how it was made.
#include <gmock/gmock.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <future>
#include <map>
#include <thread>

#include "cli_testing.h"
#include "norrsken/image.h"

namespace norrsken::cli {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;
using Words = std::vector<std::string>;
using std::chrono::milliseconds;

constexpr const char* kScene = R"(<scene version="3.0.0"><include filename="part.xml"/>
  <sensor type="perspective"><film type="hdrfilm"><integer name="width" value="8"/><integer name="height" value="8"/>
  </film></sensor>
  <shape type="obj"><string name="filename" value="mesh.obj"/><ref id="paper"/></shape></scene>)";
constexpr const char* kPart = R"(<scene version="3.0.0"><emitter type="constant"/>
  <bsdf type="diffuse" id="paper"><texture type="bitmap" name="reflectance">
    <string name="filename" value="scene.exr"/></texture></bsdf></scene>)";

class NothingLost : public Cli {
 protected:
  /// scene.xml, which reads part.xml, mesh.obj and the texture scene.exr.
  void write_scene() const {
    write("scene.xml", kScene);
    write("part.xml", kPart);
    write("mesh.obj", "v 0 0 4\nv 1 0 4\nv 0 1 4\nvt 0 0\nvt 1 0\nvt 0 1\nf 1/1 2/2 3/3\n");
    Image image;
    image.width = image.height = 2;
    for (const char* name : {"R", "G", "B"}) image.channel(name).values.assign(4, 0.5f);
    ASSERT_TRUE(write_image(folder_.file("scene.exr"), image));
  }
  void link(const std::string& to, const std::string& name) const { fs::create_symlink(to, folder_ / name); }
  std::map<std::string, std::string> contents() const {
    std::map<std::string, std::string> all;
    for (const std::string& name : files()) all[name] = fs::is_regular_file(folder_ / name) ? read(name) : "";
    return all;
  }
  /// The command is wrong, says so, and changes nothing.
  void expect_refused(const Words& arguments, const std::string& message) const {
    const auto before = contents();
    const ProcessResult result = run(arguments);
    EXPECT_EQ(result.status, 64) << message;
    EXPECT_EQ(result.err, "norrsken: error: " + message + "\n");
    EXPECT_EQ(contents(), before) << message;
  }
  json metadata_of(const std::string& name) const {
    return parse_lines(run({"info", name, "--json"}).out).at(0)["metadata"];
  }

  /// Until there is such a file, for half a minute at most.
  void wait_for(const std::string& name) const {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(30);
    while (!fs::exists(folder_ / name) && std::chrono::steady_clock::now() < end)
      std::this_thread::sleep_for(milliseconds(5));
    ASSERT_TRUE(fs::exists(folder_ / name));
  }

 public:
  using Cli::run;

 protected:
  const Words room_ = {"render", "hexagon_room", "-Dshadow_rays=1", "--size", "64x48"};
  const Words endless_ = room_ + Words{"--spp", "100000000", "--checkpoint", "c.ckpt", "--checkpoint-every", "0.05s"};
};

TEST_F(NothingLost, OutputsThatTheSceneReadsAreRefused) {
  write_scene();
  // The texture is what the image would be called by default.
  expect_refused({"render", "scene.xml"}, "cannot write 'scene.exr': it is a file that the scene reads");
  link("scene.xml", "link.png");
  expect_refused({"render", "scene.xml", "-o", "link.png"},
                 "cannot write 'link.png': it is 'scene.xml', a file that the scene reads");
  fs::create_hard_link(folder_ / "mesh.obj", folder_ / "hard.jpg");
  expect_refused({"render", "scene.xml", "-o", "hard.jpg"},
                 "cannot write 'hard.jpg': it is 'mesh.obj', a file that the scene reads");
  link(".", "here");
  link("here/part.xml", "far.exr");
  expect_refused({"render", "here/scene.xml", "-o", "new.exr", "-o", "far.exr"},
                 "cannot write 'far.exr': it is 'here/part.xml', a file that the scene reads");
  EXPECT_EQ(run({"render", "scene.xml", "-o", "new.exr", "--spp", "1"}).status, 0);
}

TEST_F(NothingLost, CheckpointsAreNeitherOutputsNorFilesOfTheScene) {
  write_scene();
  const Words scene = {"render", "scene.xml", "--spp", "1"};
  expect_refused(scene + Words{"--checkpoint", "a.exr", "-o", "a.exr"}, "cannot write 'a.exr': it is the checkpoint");
  link("new.ckpt.1", "l.png");
  expect_refused(scene + Words{"--checkpoint", "new.ckpt", "-o", "l.png"},
                 "cannot write 'l.png': it is 'new.ckpt.1', a file of the checkpoint");
  fs::rename(folder_ / "part.xml", folder_ / "part.1");
  write("scene.xml", std::string(kScene).replace(std::string(kScene).find("part.xml"), 8, "part.1"));
  const ProcessResult older = run(scene + Words{"--checkpoint", "part", "-o", "a.exr"});
  EXPECT_EQ(older.status, 73);
  EXPECT_EQ(older.err, "norrsken: error: cannot write 'part': 'part.1' is in the way, which is no checkpoint\n");
}

TEST_F(NothingLost, OutputsThatAreOneFileAreRefused) {
  link("b.exr", "a.png");  // which is not there yet
  expect_refused(room_ + Words{"-o", "a.png", "-o", "b.exr"},
                 "cannot write 'b.exr': it is 'a.png', another file to be written");
  link(".", "here");
  expect_refused(room_ + Words{"-o", "x.exr", "-o", "here/x.exr"},
                 "cannot write 'here/x.exr': it is 'x.exr', another file to be written");
  EXPECT_EQ(run(room_ + Words{"--spp", "1", "-o", "x.exr", "-o", "./x.exr"}).status, 0) << "one file by one name";
  fs::create_directory(folder_ / "out");
  fs::create_symlink("figure_06.png", folder_ / "out/figure_05.png");
  EXPECT_EQ(run({"figures", "--quick", "-o", "out"}).status, 64);
}

TEST_F(NothingLost, MergedPartsAreNotOutputs) {
  ASSERT_EQ(run(room_ + Words{"--samples", "0:2", "--checkpoint", "part.exr", "--quiet"}).status, 0);
  link("part.exr", "l.png");
  expect_refused({"merge", "part.exr", "-o", "new.exr", "-o", "part.exr"},
                 "cannot write 'part.exr': it is one of the files to merge");
  expect_refused({"merge", "part.exr", "-o", "l.png"},
                 "cannot write 'l.png': it is 'part.exr', one of the files to merge");
}

TEST_F(NothingLost, OptionsThatKeepNothingAreRefused) {
  expect_refused(room_ + Words{"--checkpoint", ""},
                 "--checkpoint: found '', accepted is the name of a file\n"
                 "see 'norrsken render --help'");
  expect_refused(room_ + Words{"--checkpoint-every", "1s"},
                 "--checkpoint-every needs --checkpoint FILE, which is written so often");
  expect_refused(room_ + Words{"--samples", "0:4", "--spp", "2", "--checkpoint", "a.part"},
                 "--samples 0:4 ends behind the 2 samples of --spp");
  EXPECT_EQ(run(room_ + Words{"--samples", "2:4", "--spp", "4", "--checkpoint", "a.part"}).status, 0);
}

/// A rendering that goes on, with a checkpoint, until it is stopped.
class Background {
 public:
  Background(const NothingLost& test, Words arguments, int signal)
      : result_(std::async(std::launch::async, [this, &test, arguments = std::move(arguments), signal] {
          return test.run(arguments, {.signals = {signal}, .signal_when = [this] { return is_over_.load(); }});
        })) {}
  ~Background() { is_over_ = true; }
  ProcessResult stop() {
    is_over_ = true;
    return result_.get();
  }

 private:
  std::atomic<bool> is_over_ = false;
  std::future<ProcessResult> result_;
};

TEST_F(NothingLost, ASecondProcessOnACheckpointIsRefusedAtOnceAndAKilledOneIsNot) {
  for (const int signal : {SIGKILL, SIGTERM}) {
    fs::remove(folder_ / "c.ckpt");
    Background first(*this, endless_ + Words{"-o", "a.exr", "--quiet"}, signal);
    wait_for("c.ckpt");
    const ProcessResult second = run(endless_ + Words{"-o", "b.exr"});
    EXPECT_EQ(second.status, 73);
    EXPECT_EQ(second.err, "norrsken: error: cannot write 'c.ckpt': another process is writing it\n");
    EXPECT_EQ(first.stop().status, signal == SIGKILL ? 128 + SIGKILL : 77);
    EXPECT_EQ(fs::exists(folder_ / "c.ckpt.lock"), signal == SIGKILL) << "what is left of it locks nobody out";
  }
  EXPECT_THAT(files(), testing::IsSupersetOf({"a.exr", "c.ckpt"}));
  EXPECT_THAT(files(), Not(testing::Contains("b.exr")));
}

TEST_F(NothingLost, ACheckpointThatIsNotTheOneThatWasReadIsNotReplaced) {
  ASSERT_EQ(run(room_ + Words{"--spp", "4", "--checkpoint", "other", "-o", "a.exr", "--quiet"}).status, 0);
  const std::string other = read("other");
  Background rendering(*this, endless_ + Words{"-o", "b.exr"}, SIGTERM);
  wait_for("c.ckpt");
  // Again and again: the program may just be between looking and writing.
  for (int i = 0; i < 3; ++i) {
    write("again", other);
    fs::rename(folder_ / "again", folder_ / "c.ckpt");
    std::this_thread::sleep_for(milliseconds(100));
  }
  const ProcessResult result = rendering.stop();
  EXPECT_EQ(result.status, 74);
  EXPECT_THAT(result.err,
              HasSubstr("cannot write 'c.ckpt': it is no longer the checkpoint of this rendering, and is left "
                        "as it is\n"));
  EXPECT_EQ(read("c.ckpt"), other);
  EXPECT_TRUE(fs::exists(folder_ / "b.exr"));
}

TEST_F(NothingLost, ACheckpointBecomesAnImageWhileItIsWritten) {
  Background rendering(*this, endless_ + Words{"-o", "a.exr", "--quiet", "--layers"}, SIGTERM);
  wait_for("c.ckpt.1");
  const ProcessResult merged = run({"merge", "c.ckpt", "-o", "m.exr"});
  EXPECT_EQ(merged.status, 0) << merged.err;
  EXPECT_THAT(merged.err, AllOf(StartsWith("norrsken: warning: 'c.ckpt' is not finished: it holds "),
                                HasSubstr(" of 100000000 samples per pixel\n")));
  EXPECT_EQ(rendering.stop().status, 77);
  // In the end, the same picture.
  ASSERT_EQ(run({"merge", "c.ckpt", "-o", "m.exr", "--layers", "--quiet"}).status, 0);
  const Image image = image_of("a.exr"), image_of_merge = image_of("m.exr");
  for (const char* channel : {"R", "G", "B", "samples"})
    EXPECT_EQ(image.find(channel)->values, image_of_merge.find(channel)->values) << channel;
  EXPECT_EQ(metadata_of("m.exr")["norrsken.relative_error"], metadata_of("a.exr")["norrsken.relative_error"]);
}

TEST_F(NothingLost, ImpatienceDiscardsNoLargeImage) {
  // What has been rendered is saved and summed up for a second or so between the two signals and the files.
  const Words large = {"render",       "hexagon_room", "-Dshadow_rays=1",    "--size", "2000x1000", "--spp", "1000000",
                       "--checkpoint", "c.ckpt",       "--checkpoint-every", "0.05s",  "-o",        "a.png"};
  const ProcessResult result =
      run(large, {.signals = {SIGINT, SIGINT, SIGTERM}, .signal_delay = milliseconds(350), .signal_when = [this] {
                    return fs::exists(folder_ / "c.ckpt");
                  }});
  EXPECT_EQ(result.status, 77) << result.err;
  EXPECT_TRUE(fs::exists(folder_ / "a.png"));
}

TEST_F(NothingLost, ImagesSayHowTheyWereMade) {
  const Words command =
      room_ + Words{"--spp", "4", "--seed", "7", "-Dlight=point", "-o", "a.exr", "-o", "a.png", "--json"};
  const json done = parse_lines(run(command).out).back();
  const json exr = metadata_of("a.exr");
  EXPECT_EQ(exr, metadata_of("a.png"));
  EXPECT_THAT(exr["Software"].get<std::string>(), StartsWith("norrsken "));
  EXPECT_EQ(exr["norrsken.scene"], "builtin:hexagon_room.xml");
  EXPECT_EQ(exr["norrsken.scene_hash"],
            parse_lines(run({"info", "hexagon_room", "-Dlight=point", "--json"}).out).at(0)["hash"]);
  EXPECT_THAT(exr["norrsken.parameters"].get<std::string>(),
              AllOf(HasSubstr("light=point"), HasSubstr("shadow_rays=1")));
  EXPECT_EQ(exr["norrsken.seed"], "7");
  EXPECT_EQ(exr["norrsken.samples_per_pixel"], "4");
  EXPECT_EQ(exr["norrsken.integrator"], "path");
  EXPECT_EQ(exr["norrsken.sampler"], "sobol");
  EXPECT_EQ(exr["norrsken.isa"], done["isa"]);
  EXPECT_NEAR(std::stod(exr["norrsken.relative_error"].get<std::string>()), done["relative_error"], 1e-4);
  EXPECT_NEAR(std::stod(exr["norrsken.seconds"].get<std::string>()), done["seconds"], 1e-3);
  EXPECT_THAT(exr["norrsken.date"].get<std::string>(), testing::MatchesRegex("20..-..-..T..:..:..Z"));
  EXPECT_FALSE(exr.contains("norrsken.interrupted"));
  EXPECT_THAT(run({"info", "a.png"}).out,
              AllOf(StartsWith("a.png\n  PNG, 64 x 48 pixels\n  channels R, G, B\n"), HasSubstr("norrsken.seed ")));
  EXPECT_EQ(run({"info", "a.png", "-Dlight=point"}).status, 64);
  write("cut.exr", read("a.exr").substr(0, 300));
  EXPECT_EQ(run({"info", "cut.exr"}).status, 65);
}

TEST_F(NothingLost, ImagesSayWhichSensorTheyAreOf) {
  write("two.xml", R"(<scene version="3.0.0"><emitter type="constant"/><shape type="sphere"/>
  <sensor type="perspective"><film type="hdrfilm"/></sensor><sensor type="perspective" id="left"><film type="hdrfilm"/>
  </sensor></scene>)");
  const auto sensor_of = [&](const Words& choice) {
    const Words command = {"render", "two.xml", "--size", "4x4", "--spp", "1", "-o", "a.png", "-o", "a.exr"};
    EXPECT_EQ(run(command + choice).status, 0);
    EXPECT_EQ(metadata_of("a.png")["norrsken.sensor"], metadata_of("a.exr")["norrsken.sensor"]);
    return metadata_of("a.exr")["norrsken.sensor"].get<std::string>();
  };
  EXPECT_EQ(sensor_of({}), "0");
  EXPECT_EQ(sensor_of({"--sensor", "1"}), "1 left");
  EXPECT_EQ(sensor_of({"--sensor", "left"}), "1 left");
  const json info = parse_lines(run({"info", "two.xml", "--sensor", "left", "--json"}).out).at(0);
  EXPECT_EQ(info["sensor"], 1);
  EXPECT_EQ(info["sensor_id"], "left");
  EXPECT_THAT(run({"info", "two.xml", "--sensor", "1"}).out, HasSubstr("\n  sensor      1 (left)\n"));
}

TEST_F(NothingLost, ACheckpointIsNoImageAndSaysHowItBecomesOne) {
  const Words finished = room_ + Words{"--spp", "2", "--checkpoint", "c.ckpt", "-o", "a.exr"};
  ASSERT_EQ(run(finished).status, 0);
  const ProcessResult compared = run({"compare", "a.exr", "c.ckpt"});
  EXPECT_EQ(compared.status, 65);
  EXPECT_EQ(compared.err,
            "norrsken: error: 'c.ckpt' is a checkpoint, not an image: 'norrsken merge c.ckpt -o image.exr --layers' "
            "makes one of it\n");
  const ProcessResult told = run({"info", "c.ckpt"});
  EXPECT_EQ(told.status, 65);
  EXPECT_THAT(told.err, HasSubstr("'norrsken merge c.ckpt -o image.exr' makes an image of it"));
  const ProcessResult again = run(finished);
  EXPECT_EQ(again.status, 0);
  EXPECT_THAT(again.err, AllOf(HasSubstr("no samples were left to take: the checkpoint holds 6.14 k, "),
                               Not(HasSubstr("Msamples/s")), Not(HasSubstr("0 threads")), HasSubstr("wrote a.exr")));
}

TEST_F(NothingLost, FilesOfTheSameSamplesDifferInDateAndSecondsAlone) {
  const auto render = [&](const std::string& name, const std::string& threads, const Words& environment = {}) {
    const Words outputs = {"--spp", "4", "-o", name + ".exr", "-o", name + ".png", "--layers", "--quiet"};
    EXPECT_EQ(run(room_ + outputs + Words{"--threads", threads}, {.environment = environment}).status, 0);
  };
  render("a", "1");
  render("b", "2");
  json a = metadata_of("a.exr"), b = metadata_of("b.exr");
  for (json* metadata : {&a, &b}) {
    EXPECT_EQ(metadata->erase("norrsken.date") + metadata->erase("norrsken.seconds"), 2u);
  }
  EXPECT_EQ(a, b);
  render("c", "1", {"SOURCE_DATE_EPOCH=1000000000"});
  render("d", "2", {"SOURCE_DATE_EPOCH=1000000000"});
  EXPECT_EQ(read("c.exr"), read("d.exr"));
  EXPECT_EQ(read("c.png"), read("d.png"));
  EXPECT_EQ(metadata_of("c.png")["norrsken.date"], "2001-09-09T01:46:40Z");
}

TEST_F(NothingLost, MergedAndResumedImagesSayItToo) {
  for (const char* samples : {"0:2", "2:6"}) {
    ASSERT_EQ(run(room_ + Words{"--samples", samples, "--seed", "3", "--checkpoint", samples, "--quiet"}).status, 0);
  }
  ASSERT_EQ(run({"merge", "2:6", "0:2", "-o", "m.png"}).status, 0);
  ASSERT_EQ(run(room_ + Words{"--spp", "6", "--seed", "3", "-o", "a.png", "--quiet"}).status, 0);
  json merged = metadata_of("m.png"), whole = metadata_of("a.png");
  EXPECT_EQ(merged["norrsken.samples"], "0:6");
  merged.erase("norrsken.samples");
  for (json* metadata : {&merged, &whole}) {
    // $spp is a parameter of the room, and does nothing where samples and shadow rays are given.
    for (const char* name : {"norrsken.date", "norrsken.seconds", "norrsken.parameters"}) metadata->erase(name);
  }
  EXPECT_EQ(merged, whole);

  const Words kept = room_ + Words{"--checkpoint", "c", "-o", "c.exr", "--quiet"};
  ASSERT_EQ(run(kept + Words{"--spp", "40"}).status, 0);
  const double before = std::stod(metadata_of("c.exr")["norrsken.seconds"].get<std::string>());
  ASSERT_EQ(run(kept + Words{"--spp", "41"}).status, 0);
  EXPECT_GE(std::stod(metadata_of("c.exr")["norrsken.seconds"].get<std::string>()), before);
  EXPECT_EQ(metadata_of("c.exr")["norrsken.samples_per_pixel"], "41");
}

}  // namespace
}  // namespace norrsken::cli
