// Every family of statistical comparisons in the test suite and its size, so that the level of one comparison can be
// chosen for the suite as a whole. A judge refuses to make more or fewer comparisons than are entered here, and so does a
// StatisticalTest.
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>

namespace norrsken::statistics {

/// Probability that a suite without any error in it fails; the seeds being fixed, it would then always fail.
inline constexpr double kSuiteLevel = 0.01;

struct Family {
  std::string_view name;  ///< of a judge's images; or of a test, without what tells its instances apart
  int comparisons;        ///< of one test
  int tests = 1;          ///< instances of it
};

/// R, G, B of the whole image, 4 quadrants and 4 x 4 blocks.
inline constexpr int kPerPicture = 3 * (1 + 4 + 16);

/// The same with two halves: oracle::room_regions.
inline constexpr int kPerRoom = kPerPicture + 3 * 2;

/// Sets of parameters in src/bsdf/bsdf_test_cases.def.
inline constexpr int kBsdfCases = 0
#define NORRSKEN_BSDF_CASE(...) +1
#define NORRSKEN_BSDF_CASE_ONE_WAY(...) +1
#define NORRSKEN_BSDF_CASE_NOT_RECIPROCAL(...) +1
#define NORRSKEN_BSDF_FURNACE(...)
#include "bsdf/bsdf_test_cases.def"
#undef NORRSKEN_BSDF_FURNACE
#undef NORRSKEN_BSDF_CASE_NOT_RECIPROCAL
#undef NORRSKEN_BSDF_CASE_ONE_WAY
#undef NORRSKEN_BSDF_CASE
    ;
/// White ones.
inline constexpr int kBsdfFurnaces = 0
#define NORRSKEN_BSDF_CASE(...)
#define NORRSKEN_BSDF_CASE_ONE_WAY(...)
#define NORRSKEN_BSDF_CASE_NOT_RECIPROCAL(...)
#define NORRSKEN_BSDF_FURNACE(...) +1
#include "bsdf/bsdf_test_cases.def"
#undef NORRSKEN_BSDF_FURNACE
#undef NORRSKEN_BSDF_CASE_NOT_RECIPROCAL
#undef NORRSKEN_BSDF_CASE_ONE_WAY
#undef NORRSKEN_BSDF_CASE
    ;
/// Places to look from, on each side of the surface.
inline constexpr int kBsdfViews = 2 * 4;

/// Scenes in src/light/light_test_cases.def.
inline constexpr int kLightCases = 0
#define NORRSKEN_LIGHT_CASE(...) +1
#include "light/light_test_cases.def"
#undef NORRSKEN_LIGHT_CASE
    ;
/// Places to see a light from, and rectangles that it shines on.
inline constexpr int kLightReferences = 2, kLightReceivers = 6;

/// Plugins.
inline constexpr int kSamplers = 0
#define NORRSKEN_SAMPLER(...) +1
#include "lists/sampler.def"
#undef NORRSKEN_SAMPLER
    ;
inline constexpr int kCameras = 0
#define NORRSKEN_CAMERA(...) +1
#include "lists/camera.def"
#undef NORRSKEN_CAMERA
    ;

/// Where samples are, and how many come.
inline constexpr int kPerDensity = 2;

inline constexpr Family kSuite[] = {
    {"judge.synthetic", kPerPicture},
    {"oracle.point_light_over_plane", kPerPicture},
    {"oracle.rectangle_over_plane", kPerPicture},
    {"oracle.uniform_room", 4 * 3 * (1 + 4)},
    {"oracle.shadow_rays_against_chance_hits", 3 * (1 + 4)},
    {"oracle.room_reference", 8 * 3 * (1 + 2 + 4)},
    {"plane.point", kPerPicture},
    {"plane.rectangle", kPerPicture},
    {"plane.triangle", kPerPicture},
    {"plane.sphere", kPerPicture},
    {"plane.all_path", kPerPicture},
    {"plane.all_direct", kPerPicture},
    {"plane.all_whitted", kPerPicture},
    {"plane.two_sided_from_below", kPerPicture},
    {"closed_room.uniform", 5 * kPerPicture},
    {"closed_room.uniform_sphere", 5 * kPerPicture},
    {"box.lamp", 3 * 3 * (1 + 4)},
    {"box.bulb", 4 * 3 * (1 + 4)},
    {"russian_roulette", 2 * 3 * (1 + 4)},
    {"unbounded_paths", 3 * (1 + 4)},
    {"light_paths.room", 3 * (1 + 4)},
    {"light_paths.direct", 3 * (1 + 4)},
    {"light_paths.roulette", 3 * (1 + 4)},
    {"light_paths.hidden_emitters", 3 * (1 + 4)},
    {"light_paths.outdoors", 3 * (1 + 4)},
    {"light_paths.glass", 3 * (1 + 4)},
    {"light_paths.lights", 3 * (1 + 4)},
    {"light_paths.near_far", 3 * (1 + 4)},
    {"light_paths.thinlens", 3 * (1 + 4)},
    {"light_paths.orthographic", 3 * (1 + 4)},
    {"light_paths.crop", 3 * (1 + 4)},
    {"light_paths.border", 3 * (1 + 4)},
    {"light_paths.plane", 3 * (1 + 4)},
    {"light_paths.uniform", 4 * 3 * (1 + 4)},
    {"direct.splits", 6 * 3 * (1 + 4)},
    {"room.area_0_bounces", kPerRoom},
    {"room.area_1_bounce", kPerRoom},
    {"room.area_2_bounces", kPerRoom},
    {"room.area_3_bounces", kPerRoom},
    {"room.area_4_bounces", kPerRoom},
    {"room.point_1_bounce", kPerRoom},
    {"room.point_3_bounces", kPerRoom},
    {"room.area_direct", kPerRoom},
    {"room.area_whitted", kPerRoom},
    {"room.point_whitted", kPerRoom},
    {"room.area_4_shadow_rays", kPerRoom},
    {"adaptive.room", kPerPicture},
    {"agreement.shadow_rays", 2 * kPerRoom},
    {"agreement.samplers", kPerRoom},
    {"agreement.odd_samples", kPerRoom},
    {"agreement.accelerator.planes", kPerRoom},
    {"agreement.accelerator.bvh", kPerRoom},
    {"agreement.accelerator.embree", kPerRoom},
    {"agreement.isa.sse4.2", kPerRoom},
    {"agreement.isa.avx2", kPerRoom},
    {"agreement.isa.avx512", kPerRoom},
    {"agreement.isa.neon", kPerRoom},

    {"ChiSquare.RejectsARightDensityAtTheNominalRate", 2},
    {"FollowsDensity.tests_of_itself", kPerDensity},
    {"StatisticalTest.RefusesAnotherNumberOfComparisons", 1},
    {"StatisticalTest.RefusesAnotherNumberOfInstances", 0, 2},
    {"StatisticalTest.tests_of_itself", 1},
    {"EveryBsdf.DirectionsFollowTheDensity", kBsdfViews* kPerDensity, kBsdfCases},
    {"EveryBsdf.WeightsAddUpToTheIntegralOfTheValueAndNoMoreThanArrives", 3 * kBsdfViews, kBsdfCases},
    {"EveryLight.DirectionsFollowTheDensity", kLightReferences* kPerDensity, kLightCases},
    {"EveryLight.RaysFollowPositionTimesDirection", 1, kLightCases},
    {"EveryLight.DensityOverTheAreaIntegratesToOne", kLightReferences, kLightCases},
    {"EveryLight.RaysCarryWhatNextEventEstimationFinds", kLightReceivers, kLightCases},
    {"EnvmapEnvironment.CompensationLeavesTheDarkToOthersAndLosesNothing", 2},
    {"EnvmapEnvironment.ItsMeanRadianceIsItsPower", 1},
    {"ManyLights.AreChosenAsOftenAsTheirProbabilitySays", 3, 3},
    {"AlongNormals.APlaneSendsParallelRays", 2},
    {"EverySampler.IsUniform", 8, kSamplers},
    {"EverySampler.NumbersAreIndependent", 8, kSamplers},
    {"EverySampler.APixelIsCoveredUniformly", 1, kSamplers},
    {"Filter.SamplesFollowTheAbsoluteValue", 10 * 2 * (kPerDensity + 1)},
    {"Warp.DiskPreservesArea", 1},
    {"Warp.CosineHemisphereFollowsItsDensity", kPerDensity},
    {"Warp.SphereIsUniform", kPerDensity},
    {"Warp.TriangleIsUniform", kPerDensity},
    {"Warp.ConeIsUniformOverItsSolidAngle", 4 * 2},
    {"Phase.IsotropicFollowsItsDensity", 2 * kPerDensity},
    {"Phase.HenyeyGreensteinFollowsItsDensity", 3 * 2 * kPerDensity},
    {"Phase.RayleighFollowsItsDensity", 2 * kPerDensity},
    {"Phase.SggxFollowsItsDensity", 2 * kPerDensity},
    {"Phase.TabulatedFollowsItsDensity", 2 * kPerDensity},
    {"Analytic.SamplesAreUniformOverTheArea", 1, 2},
    {"Microfacet.VisibleNormalsFollowTheirDensity", 8 * 4 * kPerDensity},
    {"Connect.RaysHaveTheDensityOfConnections", 2 * kCameras* kPerDensity},
    {"Cameras.ThinLensIsSharpInThePlaneOfFocus", 2},
    {"ManyLightsInAHall.HaveTheSameMeanAndLessNoiseByPlace", 1, 2},
    {"ShadeSurface.RouletteKeepsTheMeanThroughput", 1},
    {"Film.VarianceIsUnbiased", 2 * 5 * 2},
    {"CompareZTest.HonestVariancesPass", 4},
    {"CompareZTest.ASmallBiasShowsInTheMeans", 3},
    {"SdfGrid.LightsWhatIsAround", 1},
    {"SamplingWeights.ChangeNoMean", 4},
    {"Judging.AcceptsUnbiasedDataAtTheNominalRate", 2},
    {"Direct.DirectionsAreIndependentOfTheChosenLobe", 2},
    {"Direct.DirectionsAreIndependentOfRoulette", 2},
    {"Direct.SamplesDivideTheVariance", 3},
    {"ReportedVariance.IsThatOfImagesOfDifferentSeeds", 1, 2},
    {"LightPathsError.IsThatOfImagesOfDifferentSeeds", 2},
    {"FilterError.IsThatOfImagesOfDifferentSeeds", 1, 6},
    {"WhiteFurnace.ReturnsWhatItSays", kBsdfViews, kBsdfFurnaces},
};

constexpr int suite_comparisons() {
  int sum = 0;
  for (const Family& family : kSuite) sum += family.comparisons * family.tests;
  return sum;
}

constexpr const Family& family_of(std::string_view name) {
  for (const Family& family : kSuite) {
    if (family.name == name) return family;
  }
  throw std::invalid_argument("not entered in suite.h: " + std::string(name));
}

constexpr int planned_comparisons(std::string_view name) { return family_of(name).comparisons; }

}  // namespace norrsken::statistics
