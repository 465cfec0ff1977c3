// The command that replays a sample, and how a path is told.
#include "replay.h"

#include <gtest/gtest.h>

#include <limits>

namespace norrsken::cli {
namespace {

TEST(ReplayCommand, HasWhatDecidesTheSample) {
  SceneArguments scene;
  scene.scene = "my room.xml";
  scene.definitions = {"light=point"};
  scene.integrator = "path";
  scene.size = "40x30";
  scene.spp = 16;
  RenderStatistics statistics;
  statistics.isa = "avx2";
  statistics.accelerator = "embree";
  EXPECT_EQ(replay_command(scene, 7, statistics, 12, 20, 5),
            "norrsken render 'my room.xml' -D light=point --integrator path --size 40x30 --spp 16 --seed 7 --isa avx2 "
            "--accel embree --pixel 12,20 --sample 5 --trace");
}

TEST(ReplayCommand, QuotesForTheShell) {
  SceneArguments scene;
  scene.scene = "it's.xml";
  RenderStatistics statistics;
  statistics.isa = "scalar";
  statistics.accelerator = "planes";
  EXPECT_EQ(replay_command(scene, 0, statistics, 0, 0, 0),
            "norrsken render 'it'\\''s.xml' --isa scalar --accel planes --pixel 0,0 --sample 0 --trace");
}

TEST(ParsePixel, TakesColumnAndRow) {
  EXPECT_EQ(parse_pixel("12,40"), std::pair(12, 40));
  for (const char* wrong : {"", "12", "12,", ",4", "12, 4", "-1,2", "1,2,3", "a,b", "99999999999,0"})
    EXPECT_FALSE(parse_pixel(wrong)) << wrong;
}

TEST(DescribePath, ShowsWhatIsNotANumber) {
  PathTrace path;
  path.vertices.resize(2);
  path.vertices[0].hit = true;
  path.vertices[0].bsdf = "diffuse";
  path.vertices[0].light_samples.push_back({"diffuse", {}, {0, 0, 1}, 2, {1, 1, 1}, false});
  path.vertices[1].throughput = {std::numeric_limits<float>::quiet_NaN(), 0, 0};
  path.radiance = {0.25f, 0, 0};
  EXPECT_EQ(describe_path(path, false), "radiance (0.25, 0, 0)");
  EXPECT_EQ(describe_path(path, true),
            "\n  1  ray from (0, 0, 0) along (0, 0, 0)\n"
            "     throughput (0, 0, 0)\n"
            "     meets shape 0, primitive 0, after 0 at (0, 0, 0): diffuse\n"
            "     light sample for diffuse: along (0, 0, 1), 2 away, hidden, would have added (1, 1, 1)\n"
            "\n  2  ray from (0, 0, 0) along (0, 0, 0)\n"
            "     throughput (nan, 0, 0)\n"
            "     meets nothing that emits\n"
            "\nradiance (0.25, 0, 0)");
}

}  // namespace
}  // namespace norrsken::cli
