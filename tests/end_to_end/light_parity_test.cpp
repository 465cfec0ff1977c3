// Every kind of light on every instruction set against one lane: the same random numbers, so the same pictures but for
// rounding.
#include <algorithm>
#include <cmath>

#include "norrsken/image.h"
#include "tests/end_to_end/param_name.h"
#include "tests/end_to_end/scene_folder.h"

namespace norrsken::end_to_end {
namespace {

struct LightCase {
  std::string name, elements;
};
std::ostream& operator<<(std::ostream& out, const LightCase& c) { return out << c.name; }

const std::string kFromAbove = R"(<transform name="to_world"><lookat origin="1, 2, 5" target="0, 0, 0" up="0, 1, 0"/>
  </transform>)";
const std::string kChecks = R"(type="checkerboard"><rgb name="color0" value="4, 2, 1"/><rgb name="color1" value="0.5"/>
  <transform name="to_uv"><scale x="5" y="3"/></transform></texture>)";

std::string lamp(const std::string& shape, const std::string& place) {
  return "<shape type=\"" + shape + "\"><transform name=\"to_world\">" + place +
         R"(</transform><emitter type="area"><texture name="radiance" )" + kChecks + "</emitter></shape>";
}
const std::string kHanging = R"(<rotate x="1" angle="160"/><translate x="1" y="1" z="3"/>)";

const LightCase kCases[] = {
    {"spot", "<emitter type=\"spot\"><float name=\"intensity\" value=\"60\"/>" + kFromAbove +
                 "<texture name=\"texture\" " + kChecks + "</emitter>"},
    {"projector", "<emitter type=\"projector\"><float name=\"scale\" value=\"20\"/><float name=\"fov\" value=\"40\"/>" +
                      kFromAbove + "<texture name=\"irradiance\" " + kChecks + "</emitter>"},
    {"envmap", R"(<emitter type="envmap"><string name="filename" value="sky.exr"/><transform name="to_world">
       <rotate x="1" angle="70"/></transform></emitter>)"},
    {"directional",
     R"(<emitter type="directional"><vector name="direction" value="1, 0.5, -2"/><rgb name="irradiance" value="3, 2, 1"/></emitter>)"},
    {"constant", R"(<emitter type="constant"><rgb name="radiance" value="1, 2, 3"/></emitter>)"},
    {"textured_rectangle", lamp("rectangle", kHanging)},
    {"textured_disk", lamp("disk", kHanging)},
    {"textured_cylinder", lamp("cylinder", R"(<scale value="0.4"/><translate x="-1" y="1" z="2"/>)")},
    {"textured_sphere", lamp("sphere", R"(<scale value="0.5"/><translate x="1" y="1" z="3"/>)")},
    {"textured_cube", lamp("cube", R"(<scale value="0.4"/><translate x="1" y="1" z="3"/>)")}};

class LightParity : public SceneFolder, public ::testing::WithParamInterface<LightCase> {
 protected:
  static constexpr int kSize = 24;

  void SetUp() override {
    SceneFolder::SetUp();
    Image sky;
    sky.width = 16, sky.height = 8;
    for (const char* name : {"R", "G", "B"}) {
      auto& values = sky.channel(name).values;
      for (std::size_t i = 0; i < values.size(); ++i) values[i] = 0.2f + 0.1f * static_cast<float>(i % 7);
      values[37] = 40;
    }
    ASSERT_TRUE(write_image(path("sky.exr"), sky));
  }
};

TEST_P(LightParity, EveryInstructionSetSeesTheSame) {
  const Scene scene = load_elements(
      "<integrator type=\"path\">" + integer("max_depth", 4) + "</integrator>" + camera(kSize) +
      R"(<shape type="rectangle"><transform name="to_world"><scale value="10"/></transform>)" +
      diffuse("0.6, 0.5, 0.4") + R"(</shape><shape type="sphere"><point name="center" value="-0.5, -0.4, 0.7"/>
        <float name="radius" value="0.7"/><bsdf type="roughconductor"><float name="alpha" value="0.3"/></bsdf></shape>)" +
      GetParam().elements);
  const auto view = [&](const std::string& isa) {
    return picture_of(render_image(scene, {.samples_per_pixel = 16, .seed = 3, .threads = kThreads, .isa = isa}));
  };
  const auto wanted = view("scalar");
  double sum = 0;
  for (const auto& pixel : wanted.pixels) sum += pixel[0];
  EXPECT_GT(sum, 0.02 * kSize * kSize);
  for (const std::string& isa : usable_isas()) {
    const auto got = view(isa);
    int different = 0;
    double got_sum = 0;
    for (std::size_t i = 0; i < wanted.pixels.size(); ++i) {
      const double a = got.pixels[i][0], b = wanted.pixels[i][0];
      different += std::abs(a - b) <= 1e-3 * std::max(a, b) + 1e-5 ? 0 : 1;
      got_sum += a;
    }
    // Where rounding takes a path to the other side of an edge.
    EXPECT_LE(different, kSize * kSize / 50) << isa;
    EXPECT_NEAR(got_sum, sum, 2e-3 * sum) << isa;
  }
}

INSTANTIATE_TEST_SUITE_P(, LightParity, ::testing::ValuesIn(kCases), kParamName);

}  // namespace
}  // namespace norrsken::end_to_end
