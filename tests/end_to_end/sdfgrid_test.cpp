// Grids of signed distances in pictures: every instruction set sees the same surface, and light comes from it.
#include <algorithm>
#include <cmath>
#include <cstring>

#include "tests/closed_form/closed_form.h"
#include "tests/end_to_end/scene_folder.h"
#include "tests/statistics/statistical_test.h"

namespace norrsken::end_to_end {
namespace {

using closed_form::Vec;

constexpr int kSize = 32;
constexpr double kRadius = 0.35;

class SdfGrid : public SceneFolder {
 protected:
  void SetUp() override {
    SceneFolder::SetUp();
    constexpr int kValues = 24;
    std::string bytes = "VOL\3";
    const auto append = [&](auto value) { bytes.append(reinterpret_cast<const char*>(&value), sizeof value); };
    for (const std::int32_t word : {1, kValues, kValues, kValues, 1}) append(word);
    for (int i = 0; i < 6; ++i) append(0.0f);
    const auto place = [](int i) { return i / (kValues - 1.0) - 0.5; };
    for (int z = 0; z < kValues; ++z) {
      for (int y = 0; y < kValues; ++y) {
        for (int x = 0; x < kValues; ++x)
          append(static_cast<float>(std::hypot(place(x), place(y), place(z)) - kRadius));
      }
    }
    write("ball.vol", bytes);
  }

  /// Of diameter 1.4 around the origin.
  static std::string ball(const std::string& inside, const std::string& normals = "smooth") {
    return R"(<shape type="sdfgrid"><string name="filename" value="ball.vol"/><string name="normals" value=")" +
           normals +
           R"("/><transform name="to_world"><translate x="-0.5" y="-0.5" z="-0.5"/><scale value="2"/></transform>)" +
           inside + "</shape>";
  }
  static Image show(const Scene& scene, const std::string& isa, int samples = 1) {
    return render_image(scene, {.samples_per_pixel = samples, .seed = 1, .threads = kThreads, .isa = isa}, true);
  }
};

TEST_F(SdfGrid, LooksAlikeOnEveryInstructionSet) {
  for (const std::string normals : {"smooth", "analytic"}) {
    const Scene scene =
        load_elements(R"(<integrator type="aov"><string name="aovs" value="p:position,g:geo_normal,n:sh_normal"/>
        </integrator><emitter type="constant"/>)" +
                      camera(kSize) + ball(diffuse("0.5"), normals));
    const Image wanted = show(scene, "scalar");
    int hits = 0;
    double largest_difference = 0;
    for (std::size_t i = 0; i < std::size_t{kSize} * kSize; ++i) {
      const auto vec = [&](const std::string& layer) {
        const auto value = [&](const char* axis) { return double{wanted.find(layer + axis)->values[i]}; };
        return Vec{value(".X"), value(".Y"), value(".Z")};
      };
      const Vec n = vec("n"), g = vec("g"), p = vec("p");
      if (dot(n, n) == 0) continue;
      ++hits;
      EXPECT_NEAR(length(n), 1, 1e-5);
      EXPECT_NEAR(length(p), 2 * kRadius, 0.005);
      // The ball's own normal, which the blended one is closer to.
      EXPECT_LT(length(n - normalize(p)), normals == "smooth" ? 0.02 : 0.1) << i;
      largest_difference = std::max(largest_difference, length(n - g));
    }
    EXPECT_GT(hits, 50);
    EXPECT_EQ(largest_difference > 0.01, normals == "smooth");
    for (const std::string& isa : usable_isas()) {
      const Image got = show(scene, isa);
      for (const Channel& channel : wanted.channels) {
        int different = 0;
        for (std::size_t i = 0; i < channel.values.size(); ++i)
          different += std::abs(channel.values[i] - got.find(channel.name)->values[i]) > 1e-4f ? 1 : 0;
        EXPECT_LE(different, kSize * kSize / 200) << isa << ", " << channel.name;
      }
    }
  }
}

/// Its light, found by the surface's rays alone, is that of the ball that the grid is of.
TEST_F(SdfGrid, LightsWhatIsAround) {
  const Scene scene = load_elements(R"(<integrator type="path"><integer name="max_depth" value="2"/></integrator>)" +
                                    camera(8, {.origin = "1, 0, 4", .target = "1, 0, -1", .fov = "0.1"}) +
                                    R"(<shape type="rectangle"><transform name="to_world"><scale value="5"/>
                                       <translate z="-1"/></transform>)" +
                                    diffuse("1") + "</shape>" +
                                    ball(R"(<emitter type="area"><rgb name="radiance" value="2"/></emitter>)"));
  const double wanted = closed_form::reflected_radiance(
      1, closed_form::sphere_irradiance(2, {0, 0, 0}, 2 * kRadius, {1, 0, -1}, {0, 0, 1}));
  constexpr int kSamples = 4096;
  double sum = 0;
  const auto picture = picture_of(show(scene, "auto", kSamples));
  for (const auto& pixel : picture.pixels) sum += pixel[0];
  // A sample is 0 or 2. The grid's ball is within 0.2 % of a ball.
  const double hit = wanted / 2;
  statistics::StatisticalTest test;
  EXPECT_TRUE(test.agree({sum / 64, 4 * hit * (1 - hit) / (64.0 * kSamples), 64 * kSamples}, wanted, "ball", 0.004));
}

}  // namespace
}  // namespace norrsken::end_to_end
