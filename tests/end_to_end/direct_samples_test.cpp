// The numbers of samples of `direct`: however they are split, the mean is the same, and each is as many rays and as
// little noise as it says.
#include <utility>

#include "tests/end_to_end/scene_folder.h"
#include "tests/statistics/judge.h"
#include "tests/statistics/statistical_test.h"
#include "tests/told.h"

namespace norrsken::end_to_end {
namespace {

constexpr int kSize = 16;

std::string direct(int emitter_samples, int bsdf_samples) {
  return "<integrator type=\"direct\">" + integer("emitter_samples", emitter_samples) +
         integer("bsdf_samples", bsdf_samples) + "</integrator>";
}
std::string shading(int samples) {
  return "<integrator type=\"direct\">" + integer("shading_samples", samples) + "</integrator>";
}

/// A floor under a lamp that is wholly above every point's horizon and faces it.
std::string under_lamp(const std::string& bsdf) {
  return R"(<shape type="rectangle"><transform name="to_world"><scale value="10"/></transform>)" + bsdf +
         R"(</shape><shape type="rectangle"><transform name="to_world">
           <rotate x="1" angle="180"/><scale value="1.5"/><translate x="3" y="1" z="4"/></transform>
           <emitter type="area"><rgb name="radiance" value="3, 2, 1"/></emitter></shape>)";
}
const std::string kGlossy =
    R"(<bsdf type="roughconductor"><string name="material" value="Au"/><float name="alpha" value="0.4"/></bsdf>)";

class Direct : public SceneFolder {
 protected:
  statistics::RegionEstimates estimates(const std::string& integrator, int samples_per_pixel,
                                        std::uint64_t first_seed) const {
    constexpr statistics::Grid kGrids[] = {{1, 1, 0.005}, {2, 2, 0.01}};
    const Scene scene = load_elements(integrator + camera(kSize) + under_lamp(kGlossy) +
                                      R"(<emitter type="constant"><rgb name="radiance" value="0.1"/></emitter>)");
    return render_replicates(scene, {.samples_per_pixel = samples_per_pixel, .threads = kThreads}, 16,
                             statistics::regions_of(kSize, kSize, kGrids), first_seed)
        .estimates();
  }

  struct Rays {
    double shadow, closest;  ///< per camera sample
  };
  Rays rays(const std::string& integrator) const {
    const Scene scene = load_elements(integrator + camera(kSize) + under_lamp(diffuse("0.5")));
    Diagnostics diagnostics;
    const auto render = told(Render::create(scene, {.samples_per_pixel = 16, .threads = kThreads}), diagnostics);
    const RenderStatistics statistics = render->run();
    const auto samples = static_cast<double>(statistics.samples);
    return {static_cast<double>(statistics.shadow_rays) / samples,
            static_cast<double>(statistics.closest_rays) / samples};
  }

  /// Of green over the image, by 16 seeds that no other call has.
  statistics::Estimate mean(const std::string& integrator, const std::string& sampler, const std::string& bsdf,
                            int samples) {
    constexpr statistics::Grid kWhole[] = {{.columns = 1, .rows = 1}};
    const Scene scene =
        load_elements(integrator + camera(kSize, {}, R"(<rfilter type="box"/>)", sampler) + under_lamp(bsdf));
    const auto means = render_replicates(scene, {.samples_per_pixel = samples, .threads = kThreads}, 16,
                                         statistics::regions_of(kSize, kSize, kWhole), seed_ += 100);
    return means.estimates().values[0][1];
  }

  /// Variance of a sample times `samples`, where the camera sees nearly a point.
  statistics::Estimate variance(const std::string& integrator, int samples) {
    const Scene scene =
        load_elements(integrator + camera(kSize, {.fov = "0.1"}, "<rfilter type=\"box\"/>", "independent") +
                      under_lamp(diffuse("0.5")));
    constexpr int kCameraSamples = 256;
    const Image image =
        render_image(scene, {.samples_per_pixel = kCameraSamples, .seed = seed_ += 100, .threads = kThreads}, true);
    statistics::Mean mean;
    for (const float v : image.find("variance.G")->values) mean.add(static_cast<double>(v) * kCameraSamples * samples);
    return mean.estimate();
  }

 private:
  std::uint64_t seed_ = 0;
};

TEST_F(Direct, HasTheSameMeanForEverySplit) {
  const auto wanted = estimates("<integrator type=\"path\">" + integer("max_depth", 2) + "</integrator>", 1024, 1);
  statistics::Judge judge("direct.splits");
  std::uint64_t seed = 100;
  for (const auto& [emitter, bsdf] : {std::pair(1, 1), {4, 1}, {1, 4}, {5, 0}, {0, 5}}) {
    judge.compare(std::to_string(emitter) + " and " + std::to_string(bsdf),
                  estimates(direct(emitter, bsdf), bsdf == 0 || emitter == 0 ? 512 : 256, seed += 100), wanted);
  }
  judge.compare("shading_samples", estimates(shading(3), 256, 900), wanted);
  EXPECT_TRUE(judge.verdict());
}

/// Dimensions that two choices share would show: the directions of a lobe would not be all of its directions.
TEST_F(Direct, DirectionsAreIndependentOfTheChosenLobe) {
  const std::string plastic =
      R"(<bsdf type="roughplastic"><float name="alpha" value="0.4"/><float name="int_ior" value="2.5"/></bsdf>)";
  statistics::StatisticalTest test;
  for (const char* sampler : {"independent", "sobol"}) {
    EXPECT_TRUE(test.agree_to(0.025, mean(direct(0, 1), sampler, plastic, 1024),
                              mean(direct(1, 0), sampler, plastic, 64), sampler));
  }
}

/// Likewise, those that roulette spares.
TEST_F(Direct, DirectionsAreIndependentOfRoulette) {
  const auto path = [](int rr_depth) {
    return "<integrator type=\"path\">" + integer("max_depth", 2) + integer("rr_depth", rr_depth) + "</integrator>";
  };
  // Its lamp is found by directions: light sampling, which roulette does not touch, counts for little.
  const std::string glossy = R"(<bsdf type="roughconductor"><string name="material" value="none"/>
    <float name="alpha" value="0.1"/><rgb name="specular_reflectance" value="0.3"/></bsdf>)";
  statistics::StatisticalTest test;
  for (const char* sampler : {"independent", "sobol"}) {
    EXPECT_TRUE(
        test.agree_to(0.025, mean(path(1), sampler, glossy, 1024), mean(path(100), sampler, glossy, 1024), sampler));
  }
}

TEST_F(Direct, EverySampleIsARay) {
  for (const auto& [emitter, bsdf] : {std::pair(1, 1), {4, 1}, {1, 4}, {3, 0}, {0, 3}}) {
    const Rays r = rays(direct(emitter, bsdf));
    EXPECT_NEAR(r.shadow, emitter, 1e-3) << emitter << " and " << bsdf;
    EXPECT_NEAR(r.closest, 1 + bsdf, 1e-3) << emitter << " and " << bsdf;
  }
  const Rays both = rays(shading(3));
  EXPECT_NEAR(both.shadow, 3, 1e-3);
  EXPECT_NEAR(both.closest, 4, 1e-3);
}

TEST_F(Direct, SamplesDivideTheVariance) {
  statistics::StatisticalTest test;
  EXPECT_TRUE(test.agree_to(0.12, variance(direct(4, 0), 4), variance(direct(1, 0), 1), "emitter_samples"));
  EXPECT_TRUE(test.agree_to(0.12, variance(direct(0, 4), 4), variance(direct(0, 1), 1), "bsdf_samples"));
  EXPECT_TRUE(test.agree_to(0.12, variance(shading(4), 4), variance(shading(1), 1), "shading_samples"));
}

}  // namespace
}  // namespace norrsken::end_to_end
