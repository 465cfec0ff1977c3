// A box with a lamp or a bulb in it, where light comes from everywhere: against the oracle, and by Russian roulette.
#include <gtest/gtest.h>

#include <array>
#include <string>

#include "tests/end_to_end/rendering.h"
#include "tests/oracle/oracle.h"
#include "tests/statistics/judge.h"

namespace norrsken::end_to_end {
namespace {

using statistics::Grid;
using statistics::Judge;
using statistics::RegionEstimates;

constexpr int kSize = 16;  ///< of the images of box.xml
constexpr int kSeeds = 24;

std::vector<statistics::Region> regions() {
  return statistics::regions_of(kSize, kSize, std::array{Grid{1, 1, 0.005}, Grid{2, 2, 0.02}});
}

RegionEstimates estimates(const SceneParameters& parameters, int samples_per_pixel) {
  return render_replicates(load_test_scene("box.xml", parameters),
                           {.samples_per_pixel = samples_per_pixel, .threads = kThreads}, kSeeds, regions())
      .estimates();
}

/// The box of box.xml against the oracle's, whose paths may scatter `bounces` times.
void expect_oracle_box(Judge& judge, const std::string& what, const SceneParameters& parameters, int samples_per_pixel,
                       const oracle::Scene& box, int bounces, int strata) {
  judge.compare(
      what, estimates(parameters, samples_per_pixel),
      oracle::estimate(box, oracle::kInsideBoxCamera, {.bounces = bounces}, {kSize, kSize, strata, kSeeds}, regions()));
}

TEST(OracleBox, LampShowsTheSameRadiance) {
  Judge judge("box.lamp");
  for (const int bounces : {1, 2, 3}) {
    expect_oracle_box(judge, std::to_string(bounces) + " bounces",
                      {{"contents", "lamp"}, {"max_depth", std::to_string(bounces + 1)}}, 512, oracle::lamp_box(),
                      bounces, 14);
  }
  EXPECT_TRUE(judge.verdict());
}

TEST(OracleBox, BulbShowsTheSameRadiance) {
  Judge judge("box.bulb");
  for (const int bounces : {1, 2, 3, 4}) {
    expect_oracle_box(judge, std::to_string(bounces) + " bounces",
                      {{"contents", "bulb"}, {"max_depth", std::to_string(bounces + 1)}}, 512, oracle::bulb_box(),
                      bounces, 13);
  }
  EXPECT_TRUE(judge.verdict());
}

RegionEstimates lamp_box(const char* max_depth, const char* rr_depth) {
  return estimates({{"max_depth", max_depth}, {"rr_depth", rr_depth}}, 512);
}

TEST(RussianRoulette, IsUnbiased) {
  Judge judge("russian_roulette");
  const RegionEstimates without = lamp_box("8", "1000");
  judge.compare("from depth 1", lamp_box("8", "1"), without);
  judge.compare("from depth 5", lamp_box("8", "5"), without);
  EXPECT_TRUE(judge.verdict());
}

TEST(UnboundedPaths, FindAllOfTheLight) {
  // What paths of 30 hits leave out is less than 0.7^30 of the light.
  Judge judge("unbounded_paths");
  judge.compare("", lamp_box("-1", "5"), lamp_box("31", "1000"));
  EXPECT_TRUE(judge.verdict());
}

}  // namespace
}  // namespace norrsken::end_to_end
