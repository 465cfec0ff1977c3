// Participating media against what is known of them in closed form. A camera along -z looks at a cube from -1 to 1.
#include <gmock/gmock.h>

#include <array>
#include <cmath>
#include <cstring>
#include <numbers>
#include <vector>

#include "tests/end_to_end/scene_folder.h"

namespace norrsken::end_to_end {
namespace {

using Rgb = std::array<double, 3>;

const std::string kNull = R"(<bsdf type="null"/>)";
const std::string kWhiteSky = R"(<emitter type="constant"><float name="radiance" value="1"/></emitter>)";
const std::string kBehind = R"(<shape type="rectangle"><transform name="to_world"><scale value="9"/><translate z="-3"/>
  </transform><emitter type="area"><float name="radiance" value="2"/></emitter></shape>)";

std::string number(const std::string& name, double value) {
  return "<float name=\"" + name + "\" value=\"" + std::to_string(value) + "\"/>";
}
std::string volpath(int max_depth, const std::string& inside = "") {
  return "<integrator type=\"volpath\">" + integer("max_depth", max_depth) + inside + "</integrator>";
}
std::string cube(const std::string& inside, const std::string& bsdf = kNull) {
  return "<shape type=\"cube\">" + bsdf + inside + "</shape>";
}
std::string interior(const std::string& inside, const std::string& type = "homogeneous") {
  return "<medium name=\"interior\" type=\"" + type + "\">" + inside + "</medium>";
}
/// Parallel rays over the square from -0.5 to 0.5.
std::string parallel_camera(const std::string& inside = "") {
  return R"(<sensor type="orthographic"><transform name="to_world"><scale x="0.5" y="0.5"/>
    <lookat origin="0, 0, 4" target="0, 0, 0" up="0, 1, 0"/></transform><film type="hdrfilm">)" +
         integer("width", 8) + integer("height", 8) + R"(<rfilter type="box"/></film>)" + inside + "</sensor>";
}

Rgb mean_of(const Image& image) {
  const auto picture = picture_of(image);
  Rgb mean{};
  const int n = image.width * image.height;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      for (std::size_t c = 0; c < 3; ++c) mean[c] += picture.at(x, y)[c] / n;
    }
  }
  return mean;
}

class Media : public SceneFolder {
 protected:
  Rgb mean(const std::string& elements, int samples = 64) const {
    return mean_of(render_image(load_elements(elements), {.samples_per_pixel = samples, .threads = kThreads}));
  }
  /// A volume file of one channel in which x varies fastest.
  void write_grid(std::int32_t n, const std::vector<float>& values) const {
    std::string bytes = "VOL\x03";
    const std::int32_t head[] = {1, n, n, n, 1};
    const float box[] = {0, 0, 0, 1, 1, 1};
    bytes.append(reinterpret_cast<const char*>(head), sizeof head);
    bytes.append(reinterpret_cast<const char*>(box), sizeof box);
    bytes.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(float));
    write("grid.vol", bytes);
  }
  static std::string grid(const std::string& inside = "") {
    return R"(<volume type="gridvolume" name="sigma_t"><string name="filename" value="grid.vol"/>
      <transform name="to_world"><scale value="2"/><translate x="-1" y="-1" z="-1"/></transform>)" +
           inside + "</volume>";
  }
};

void expect_near(const Rgb& found, const Rgb& expected, double relative) {
  for (std::size_t c = 0; c < 3; ++c)
    EXPECT_NEAR(found[c], expected[c], relative * std::abs(expected[c])) << "channel " << c;
}

TEST_F(Media, ASlabAbsorbsByBeersLaw) {
  const std::string medium = interior(R"(<rgb name="sigma_t" value="0.1 0.5 2"/>)" + number("albedo", 0));
  const Rgb expected = {2 * std::exp(-0.2), 2 * std::exp(-1.0), 2 * std::exp(-4.0)};
  for (const int depth : {1, 5, -1})
    expect_near(mean(volpath(depth) + parallel_camera() + cube(medium) + kBehind, 4), expected, 1e-5);
  // Also towards an environment, and from inside of the medium.
  expect_near(mean(volpath(-1) + parallel_camera() + cube(medium) + kWhiteSky, 4),
              {std::exp(-0.2), std::exp(-1.0), std::exp(-4.0)}, 1e-5);
  const std::string around =
      R"(<medium type="homogeneous">)" + number("sigma_t", 0.25) + number("albedo", 0) + "</medium>";
  const double near_clip = 0.01, seen = 2 * std::exp(-0.25 * (7 - near_clip));
  expect_near(mean(volpath(-1) + parallel_camera(around) + kBehind, 4), {seen, seen, seen}, 1e-5);
}

/// What one scattering sends back of a light along the view: the integral of sigma_s p exp(-2 sigma_t t) over the slab.
TEST_F(Media, ASlabScattersOnce) {
  const std::string light = R"(<emitter type="directional"><vector name="direction" value="0, 0, -1"/>
    <float name="irradiance" value="3"/></emitter>)";
  const double isotropic = 1 / (4 * std::numbers::pi);
  for (const double g : {0.0, 0.5, -0.5}) {
    const double back = isotropic * (1 - g * g) / std::pow(1 + g * g + 2 * g, 1.5);
    const auto of = [&](double sigma, double albedo) { return 3 * back * albedo * (1 - std::exp(-4 * sigma)) / 2; };
    const std::string medium =
        interior(R"(<rgb name="sigma_t" value="0.3 0.6 2"/><rgb name="albedo" value="0.5 0.9 0.2"/>
      <phase type="hg">)" +
                 number("g", g) + "</phase>");
    expect_near(mean(volpath(2) + parallel_camera() + cube(medium) + light, 4096),
                {of(0.3, 0.5), of(0.6, 0.9), of(2, 0.2)}, 4e-3);
  }
}

/// Nothing is lost where nothing absorbs. Where the channels differ each is noisy, their sum less so.
TEST_F(Media, AFurnaceStaysWhite) {
  const std::string forward = number("albedo", 1) + R"(<phase type="hg"><float name="g" value="0.7"/></phase>)";
  const std::string grey = interior(number("sigma_t", 2) + forward);
  const std::string coloured = interior(R"(<rgb name="sigma_t" value="0.3 1 3"/>)" + forward);
  const std::string bsdfs[] = {kNull, R"(<bsdf type="thindielectric"/>)", R"(<bsdf type="dielectric"/>)"};
  for (const std::string& bsdf : bsdfs) {
    expect_near(mean(volpath(-1) + parallel_camera() + cube(grey, bsdf) + kWhiteSky, 1024), {1, 1, 1}, 1.5e-2);
    expect_near(mean(volpath(-1) + parallel_camera() + cube(coloured, bsdf) + kWhiteSky, 1024), {1, 1, 1}, 2e-2);
  }
}

TEST_F(Media, AConstantGridIsHomogeneous) {
  const std::string rest = number("albedo", 0.8) + number("scale", 0.5);
  const std::string scene = volpath(-1) + parallel_camera() + kBehind;
  const Rgb expected = mean(scene + cube(interior(number("sigma_t", 3) + rest)), 8192);
  for (const int n : {1, 20}) {
    write_grid(n, std::vector<float>(static_cast<std::size_t>(n) * n * n, 3.0f));
    for (const std::string filter : {"trilinear", "nearest"})
      expect_near(mean(scene + cube(interior(grid(text("filter_type", filter)) + rest, "heterogeneous")), 8192),
                  expected, 5e-3);
  }
}

/// Optical depth along z is the mean of the values, wherever the majorants' cells end.
TEST_F(Media, AGridAbsorbsWhatItsValuesSumTo) {
  constexpr int kSide = 24;
  std::vector<float> values;
  double sum = 0;
  for (int z = 0; z < kSide; ++z) {
    const float value = z % 5 == 0 ? 2.0f : 0.1f * static_cast<float>(z % 3);
    values.insert(values.end(), kSide * kSide, value);
    sum += double{value} / kSide;
  }
  write_grid(kSide, values);
  const std::string medium = interior(grid(text("filter_type", "nearest")) + number("albedo", 0), "heterogeneous");
  const double seen = 2 * std::exp(-2 * sum);
  expect_near(mean(volpath(1) + parallel_camera() + cube(medium) + kBehind, 16384), {seen, seen, seen}, 5e-3);
}

/// Shadow rays pass boundaries and media to a light, and rays that find it by themselves are weighted against them.
TEST_F(Media, LightArrivesThroughBoundaries) {
  const std::string floor =
      R"(<shape type="rectangle"><transform name="to_world"><scale value="0.5"/><translate z="-2"/>
    </transform>)" +
      diffuse("1, 1, 1") + "</shape>";
  const std::string lamp =
      R"(<shape type="sphere"><float name="radius" value="0.5"/><point name="center" x="0" y="0" z="2"/>
    <emitter type="area"><float name="radiance" value="5"/></emitter></shape>)";
  const std::string view = camera(8, {.origin = "0, 3, -1.5", .target = "0, 0, -2", .fov = "10"});
  const std::string scene = view + floor + lamp;
  const Rgb bare = mean("<integrator type=\"path\">" + integer("max_depth", 2) + "</integrator>" + scene, 1024);
  expect_near(mean(volpath(2) + scene + cube(""), 1024), bare, 3e-3);
  // Twice through a slab of which either half absorbs.
  const std::string half = interior(number("sigma_t", 0) + number("albedo", 0));
  expect_near(mean(volpath(2) + scene + cube(half), 1024), bare, 3e-3);
  const std::string mask =
      R"(<shape type="rectangle"><transform name="to_world"><scale value="3"/></transform><bsdf type="mask">)" +
      number("opacity", 0.25) + R"(<bsdf type="diffuse"/></bsdf></shape>)";
  expect_near(mean(volpath(2) + scene + mask, 4096), {0.75 * bare[0], 0.75 * bare[1], 0.75 * bare[2]}, 8e-3);
}

TEST_F(Media, AreTheSameForAnyNumberOfThreads) {
  write_grid(2, {0, 1, 2, 3, 4, 5, 6, 7});
  const Scene scene =
      load_elements(volpath(6) + parallel_camera() + kWhiteSky + cube(interior(grid(), "heterogeneous")));
  EXPECT_TRUE(identical(render_image(scene, {.samples_per_pixel = 16, .threads = 1}),
                        render_image(scene, {.samples_per_pixel = 16, .threads = 3})));
}

}  // namespace
}  // namespace norrsken::end_to_end
