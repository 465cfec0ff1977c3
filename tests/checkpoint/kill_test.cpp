// The program killed, stopped and short of space while it renders with a checkpoint: nothing is lost but what was taken
// since the last one.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/mount.h>
#include <unistd.h>

#include <csignal>
#include <cstring>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <random>

#include "norrsken/image.h"
#include "tests/process.h"
#include "tests/temporary_folder.h"
#include "tests/told.h"

namespace norrsken::cli {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class KillTest : public testing::Test {
 protected:
  /// About half of the time goes into checkpoints.
  static std::vector<std::string> command(const std::string& checkpoint, int samples = 2500) {
    std::vector<std::string> arguments = {"render",
                                          "hexagon_room",
                                          "-Dshadow_rays=1",
                                          "--size",
                                          "64x48",
                                          "--spp",
                                          std::to_string(samples),
                                          "--threads",
                                          "2",
                                          "--json",
                                          "-o",
                                          "a.exr"};
    if (!checkpoint.empty()) {
      for (const char* word : {"--checkpoint", checkpoint.c_str(), "--checkpoint-every", "0.004s"}) {
        arguments.emplace_back(word);
      }
    }
    return arguments;
  }
  ProcessResult run(const std::vector<std::string>& arguments, ProcessOptions options = {}) const {
    options.folder = folder_.string();
    return run_program(arguments, options);
  }
  Image image() const { return value_of(read_image(folder_.file("a.exr"))); }
  /// Of the last line that the program wrote.
  static nlohmann::json last_event(const ProcessResult& result) {
    const std::size_t end = result.out.find_last_not_of('\n'), begin = result.out.rfind('\n', end);
    return nlohmann::json::parse(result.out.substr(begin + 1, end - begin));
  }
  void expect_same_image_as(const Image& expected) const {
    const Image found = image();
    for (const char* name : {"R", "G", "B"}) {
      const auto &a = found.find(name)->values, &b = expected.find(name)->values;
      ASSERT_EQ(a.size(), b.size());
      EXPECT_EQ(std::memcmp(a.data(), b.data(), a.size() * sizeof(float)), 0) << name;
    }
  }

  const TemporaryFolder folder_;
};

TEST_F(KillTest, AHundredKillsChangeNoBit) {
  ASSERT_EQ(run(command("")).status, 0);
  const Image whole = image();
  fs::remove(folder_ / "a.exr");

  std::mt19937 random(11);
  int kills = 0, kills_while_writing = 0;
  while (kills < 100) {
    const ProcessResult result =
        run(command("room.ckpt"), {.signals = {SIGKILL}, .signal_delay = std::chrono::milliseconds(random() % 60)});
    if (result.status == 0) break;
    ASSERT_EQ(result.status, 128 + SIGKILL) << result.err;
    EXPECT_EQ(result.err, "") << "every checkpoint that is found is taken, without a warning";
    ++kills;
    kills_while_writing += fs::exists(folder_ / "room.ckpt.tmp");
  }
  EXPECT_GE(kills, 50) << "the rendering was over too soon";
  EXPECT_GT(kills_while_writing, 0);
  std::printf("%d kills, %d of them while a checkpoint was written\n", kills, kills_while_writing);

  const ProcessResult last = run(command("room.ckpt"));
  EXPECT_EQ(last.status, 0) << last.err;
  EXPECT_GT(last_event(last)["samples_resumed"], 0);
  expect_same_image_as(whole);
  EXPECT_FALSE(fs::exists(folder_ / "room.ckpt.tmp"));
}

TEST_F(KillTest, SignalsSaveAndTheSameCommandGoesOn) {
  for (const int signal : {SIGINT, SIGTERM}) {
    const std::string checkpoint = "signal" + std::to_string(signal);
    std::vector<std::string> endless = command("", 100000000);
    endless.insert(endless.end(), {"--checkpoint", checkpoint});  // once a minute
    const auto begin = std::chrono::steady_clock::now();
    const ProcessResult result = run(endless, {.signals = {signal}, .signal_delay = std::chrono::milliseconds(600)});
    EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::milliseconds(5600));
    EXPECT_EQ(result.status, 77) << result.err;
    const auto done = last_event(result);
    const ProcessResult again = run(endless, {.signals = {signal}, .signal_delay = std::chrono::milliseconds(600)});
    EXPECT_EQ(again.status, 77) << again.err;
    EXPECT_EQ(last_event(again)["samples_resumed"], done["samples"]) << "nothing is lost";
  }
}

/// A limit on the size of files stands in for the disk, and then a disk of a megabyte, where one may be mounted.
TEST_F(KillTest, AFullDiskCostsTheCheckpointAlone) {
  ASSERT_EQ(run(command("room.ckpt", 100)).status, 0);
  const auto size = fs::file_size(folder_ / "room.ckpt");
  fs::remove(folder_ / "a.exr");
  ProcessResult result = run(command("room.ckpt", 300), {.largest_file = size / 2});
  EXPECT_EQ(result.status, 74);
  EXPECT_THAT(result.err, HasSubstr("cannot write 'room.ckpt': File too large"));
  const Image limited = image();
  ASSERT_EQ(run(command("", 300)).status, 0);
  expect_same_image_as(limited);
  result = run(command("room.ckpt", 300));
  EXPECT_EQ(result.status, 0);
  EXPECT_EQ(last_event(result)["samples_resumed"], 100 * 64 * 48) << "that of 100 samples is still there";

  const fs::path small = folder_ / "small";
  fs::create_directory(small);
  const std::string room = "size=" + std::to_string(size * 3 / 2);
  if (mount("norrsken_test", small.c_str(), "tmpfs", 0, room.c_str()) != 0)
    GTEST_SKIP() << "no tmpfs may be mounted here";
  std::vector<std::string> once = command("", 100);
  once.insert(once.end(), {"--checkpoint", "small/room.ckpt"});
  ASSERT_EQ(run(once).status, 0);
  // There is room for one generation and not for two.
  ProcessResult full = run(command("small/room.ckpt", 300));
  EXPECT_EQ(full.status, 74);
  EXPECT_THAT(full.err, HasSubstr("cannot write 'small/room.ckpt': No space left on device"));
  expect_same_image_as(limited);
  full = run(command("small/room.ckpt", 300));
  EXPECT_EQ(last_event(full)["samples_resumed"], 100 * 64 * 48) << "the one that there was room for is intact";
  umount(small.c_str());
}

TEST_F(KillTest, AFolderThatCannotBeWrittenToIsToldAtOnce) {
  const ProcessResult result = run(command("/proc/room.ckpt"));
  EXPECT_EQ(result.status, 73);
  EXPECT_EQ(result.err, "norrsken: error: cannot write '/proc/room.ckpt': No such file or directory\n");
  EXPECT_FALSE(fs::exists(folder_ / "a.exr"));
  const fs::path closed = folder_ / "closed";
  fs::create_directory(closed);
  if (mount("norrsken_test", closed.c_str(), "tmpfs", MS_RDONLY, "size=64k") != 0) {
    if (geteuid() == 0) GTEST_SKIP() << "root may write everywhere, and nothing may be mounted here";
    fs::permissions(closed, fs::perms::owner_read | fs::perms::owner_exec);
  }
  const ProcessResult refused = run(command("closed/room.ckpt"));
  umount(closed.c_str());
  EXPECT_EQ(refused.status, 73);
  EXPECT_THAT(refused.err, HasSubstr("cannot write 'closed/room.ckpt': "));
}

TEST_F(KillTest, WrongScenesAndOptionsAreTold) {
  ASSERT_EQ(run(command("room.ckpt", 20)).status, 0);
  std::vector<std::string> other = command("room.ckpt", 20);
  other.insert(other.end(), {"--seed", "4"});
  const ProcessResult seed = run(other);
  EXPECT_EQ(seed.status, 65);
  EXPECT_EQ(seed.err,
            "room.ckpt: error: the checkpoint is of another rendering: seed is 0, not 4\n"
            "accepted: the settings and files that it was made with, or another checkpoint\n");
  const ProcessResult fewer = run(command("room.ckpt", 19));
  EXPECT_EQ(fewer.status, 65);
  const ProcessResult alone = run({"render", "hexagon_room", "--samples", "0:4"});
  EXPECT_EQ(alone.status, 64);
  EXPECT_THAT(alone.err, HasSubstr("--samples needs --checkpoint FILE"));
  EXPECT_THAT(run({"render", "hexagon_room", "--samples", "4:4", "--checkpoint", "c"}).err,
              HasSubstr("--samples: found '4:4', accepted is FIRST:END, as in 0:64 for the samples 0 to 63"));
  EXPECT_THAT(run({"render", "hexagon_room", "--checkpoint-every", "10"}).err,
              HasSubstr("--checkpoint-every: found '10', accepted is a time with its unit, as in 90s, 1.5m or 2h"));
}

TEST_F(KillTest, PartsOfSeveralProgramsMerge) {
  ASSERT_EQ(run(command("", 40)).status, 0);
  const Image whole = image();
  fs::remove(folder_ / "a.exr");
  const auto part = [&](const std::string& samples, const std::string& file) {
    const ProcessResult result = run({"render", "hexagon_room", "-Dshadow_rays=1", "--size", "64x48", "--samples",
                                      samples, "--checkpoint", file, "--quiet"});
    EXPECT_EQ(result.status, 0) << result.err;
  };
  part("24:40", "b.part");
  part("0:24", "a.part");
  part("50:60", "c.part");
  EXPECT_FALSE(fs::exists(folder_ / "hexagon_room.exr")) << "a part is no image unless one is asked for";
  const ProcessResult merged = run({"merge", "b.part", "a.part", "-o", "a.exr", "-o", "a.png"});
  EXPECT_EQ(merged.status, 0) << merged.err;
  EXPECT_THAT(merged.err, testing::MatchesRegex("64 x 48 pixels, 40 samples per pixel \\(0:40\\) of 2 files, estimated "
                                                "error .* % \\(.* % to .* %\\)\nwrote a.exr, a.png\n"));
  expect_same_image_as(whole);
  const ProcessResult gap = run({"merge", "c.part", "a.part", "-o", "a.exr", "--quiet"});
  EXPECT_EQ(gap.status, 0);
  EXPECT_EQ(gap.err, "norrsken: warning: no file holds the samples 24:50\n");
  const ProcessResult twice = run({"merge", "a.part", "a.part", "-o", "a.exr"});
  EXPECT_EQ(twice.status, 65);
  EXPECT_EQ(twice.err, "norrsken: error: 'a.part' and 'a.part' both hold samples 0 to 23\n");
  EXPECT_EQ(run({"merge", "none.part", "-o", "a.exr"}).status, 66);
  EXPECT_EQ(run({"merge", "a.part"}).status, 64);
}

}  // namespace
}  // namespace norrsken::cli
