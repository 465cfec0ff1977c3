// Filters with negative lobes weigh samples with signs: the error that an image tells must still be that of images of
// different seeds.
#include <cmath>

#include "tests/end_to_end/param_name.h"
#include "tests/end_to_end/reported_variance.h"
#include "tests/end_to_end/scene_folder.h"

namespace norrsken::end_to_end {
namespace {

struct FilterCase {
  std::string name, filter, sampler;
};
std::ostream& operator<<(std::ostream& out, const FilterCase& c) { return out << c.name; }

class FilterError : public SceneFolder, public ::testing::WithParamInterface<FilterCase> {};

TEST_P(FilterError, IsThatOfImagesOfDifferentSeeds) {
  constexpr int kSize = 24;
  // The lamp's edges, and soft light on the floor.
  const Scene scene = load_elements(
      "<integrator type=\"path\">" + integer("max_depth", 2) + "</integrator>" +
      camera(kSize, {.origin = "0, -3, 3"}, "<rfilter type=\"" + GetParam().filter + "\"/>", GetParam().sampler) +
      R"(<shape type="rectangle"><transform name="to_world"><scale value="10"/></transform></shape>
      <shape type="rectangle"><transform name="to_world"><rotate x="1" angle="110"/><scale value="0.7"/>
      <translate y="0.5" z="0.6"/></transform><bsdf type="diffuse"/>
      <emitter type="area"><rgb name="radiance" value="2"/></emitter></shape>)");
  statistics::StatisticalTest test;
  EXPECT_TRUE(reports_its_variance(test, 0.08, scene, {.samples_per_pixel = 32, .seed = 700}, 256, GetParam().name));
}

/// A lamp's edge along a column of pixels shows the filter's integral, which goes below 0 and beyond 1.
class FilterWeights : public SceneFolder {};
TEST_F(FilterWeights, MakeAnEdgeTheFiltersIntegral) {
  constexpr int kSize = 24;
  const Scene scene =
      load_elements("<integrator type=\"path\">" + integer("max_depth", 1) + "</integrator>" +
                    camera(kSize, {}, R"(<rfilter type="catmullrom"/>)") +
                    R"(<shape type="rectangle"><transform name="to_world"><scale value="10"/><translate x="10"/>
      </transform><emitter type="area"><rgb name="radiance" value="2"/></emitter></shape>)");
  const auto picture = picture_of(render_image(scene, {.samples_per_pixel = 32768, .threads = kThreads}));
  // Mitchell and Netravali 1988, "Reconstruction Filters in Computer Graphics", with B = 0 and C = 1/2.
  const auto filter = [](double x) {
    x = std::abs(x);
    if (x < 1) return (1.5 * x - 2.5) * x * x + 1;
    return x < 2 ? ((-0.5 * x + 2.5) * x - 4) * x + 2 : 0.0;
  };
  for (int column = 3; column < kSize - 3; ++column) {
    double wanted = 0, got = 0;
    const double edge = kSize / 2.0 - (column + 0.5);  // from the pixel's centre
    constexpr int kFine = 4000;
    for (int i = 0; i < kFine; ++i) {
      const double x = -2 + 4 * (i + 0.5) / kFine;
      if (x > edge) wanted += 2 * filter(x) * 4 / kFine;
    }
    for (int row = 3; row < kSize - 3; ++row) got += picture.at(column, row)[1] / (kSize - 6);
    EXPECT_NEAR(got, wanted, 4e-3) << "column " << column;
  }
}

INSTANTIATE_TEST_SUITE_P(, FilterError,
                         ::testing::Values(FilterCase{"mitchell_independent", "mitchell", "independent"},
                                           FilterCase{"mitchell_sobol", "mitchell", "sobol"},
                                           FilterCase{"catmullrom_independent", "catmullrom", "independent"},
                                           FilterCase{"catmullrom_sobol", "catmullrom", "sobol"},
                                           FilterCase{"lanczos_independent", "lanczos", "independent"},
                                           FilterCase{"lanczos_sobol", "lanczos", "sobol"}),
                         kParamName);

}  // namespace
}  // namespace norrsken::end_to_end
