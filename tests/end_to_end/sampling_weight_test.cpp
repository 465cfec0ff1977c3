// How often an emitter is chosen changes the noise and nothing else.
#include "tests/end_to_end/scene_folder.h"
#include "tests/statistics/statistical_test.h"

namespace norrsken::end_to_end {
namespace {

constexpr int kSize = 16;

class SamplingWeights : public SceneFolder {
 protected:
  /// The mean of a glossy and a diffuse surface under a sky, a direction, a point and `lamps` large lamps, of which every
  /// second has its weight.
  statistics::Estimate mean(int lamps, const std::string& lamp_weight, const std::string& sky_weight,
                            const std::string& point_weight) {
    const auto weight = [](const std::string& value) {
      return "<float name=\"sampling_weight\" value=\"" + value + "\"/>";
    };
    std::string elements =
        "<integrator type=\"path\">" + integer("max_depth", 3) + "</integrator>" + camera(kSize) +
        R"(<shape type="rectangle"><transform name="to_world"><scale value="2"/></transform>)" + diffuse("0.8") +
        R"(</shape><shape type="sphere"><float name="radius" value="0.7"/><bsdf type="roughconductor">)"
        R"(<float name="alpha" value="0.3"/></bsdf></shape>)"
        R"(<emitter type="constant"><float name="radiance" value="0.3"/>)" +
        weight(sky_weight) +
        R"(</emitter><emitter type="directional"><float name="irradiance" value="0.5"/>)"
        R"(<vector name="direction" value="1, 0, -2"/></emitter>)"
        R"(<emitter type="point"><point name="position" value="1, 1, 3"/><float name="intensity" value="3"/>)" +
        weight(point_weight) + "</emitter>";
    for (int i = 0; i < lamps; ++i) {
      elements +=
          R"(<shape type="rectangle"><transform name="to_world"><scale value="0.5"/><rotate x="1" angle="180"/>)"
          "<translate x=\"" +
          std::to_string(i % 3 - 1) + "\" y=\"" + std::to_string(i / 3 - 1) +
          R"(" z="5"/></transform><emitter type="area"><float name="radiance" value="2"/>)" +
          weight(i % 2 == 0 ? lamp_weight : "1") + "</emitter></shape>";
    }
    constexpr statistics::Grid kWhole[] = {{.columns = 1, .rows = 1}};
    const auto means = render_replicates(load_elements(elements), {.samples_per_pixel = 256, .threads = kThreads}, 16,
                                         statistics::regions_of(kSize, kSize, kWhole), seed_ += 100);
    return means.estimates().values[0][1];
  }

 private:
  std::uint64_t seed_ = 0;
};

/// Few lights are chosen by a table, many by a tree.
TEST_F(SamplingWeights, ChangeNoMean) {
  statistics::StatisticalTest test;
  for (const int lamps : {2, 9}) {
    const std::string what = std::to_string(lamps) + " lamps, ";
    const statistics::Estimate wanted = mean(lamps, "1", "1", "1");
    EXPECT_TRUE(test.agree_to(0.01, mean(lamps, "5", "0.5", "2"), wanted, what + "other weights"));
    EXPECT_TRUE(test.agree_to(0.01, mean(lamps, "0", "0", "1"), wanted, what + "no weight for what rays find"));
  }
}

}  // namespace
}  // namespace norrsken::end_to_end
