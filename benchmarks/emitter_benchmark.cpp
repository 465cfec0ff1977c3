// What a path pays for a kind of light, per instruction set: every line of src/lists/light.def, in a scene of one such
// light. scripts/measure_models.py makes a table of it.
#include <array>
#include <map>
#include <memory>

#include "light/light_testing.h"
#include "model_bench.h"
#include "render/scene_view.h"

namespace norrsken {
namespace {

constexpr struct {
  LightKind kind;
  const char* name;
} kKinds[] = {
#define NORRSKEN_LIGHT(kind, Model, is_delta) {LightKind::kind, #kind},
#include "lists/light.def"
#undef NORRSKEN_LIGHT
};

/// By kind. Above the paths, which begin in a cube of two units around the origin.
const std::map<std::string, const char*> kScenes = {
    {"triangle", R"(<shape type="obj"><string name="filename" value="triangle.obj"/><emitter type="area"/></shape>)"},
    {"parallelogram",
     R"(<shape type="rectangle"><transform name="to_world"><rotate x="1" angle="180"/><translate z="3"/>
                </transform><emitter type="area"/></shape>)"},
    {"sphere", R"(<shape type="sphere"><point name="center" x="0" y="0" z="3"/><emitter type="area"/></shape>)"},
    {"analytic",
     R"(<shape type="disk"><transform name="to_world"><rotate x="1" angle="180"/><translate z="3"/>
                </transform><emitter type="area"/></shape>)"},
    {"point", R"(<emitter type="point"><point name="position" x="0" y="0" z="3"/></emitter>)"},
    {"spot",
     R"(<emitter type="spot"><transform name="to_world"><lookat origin="0, 0, 3" target="0, 0, 0" up="0, 1, 0"/>
                </transform></emitter>)"},
    {"projector",
     R"(<emitter type="projector"><float name="fov" value="60"/><transform name="to_world">
                <lookat origin="0, 0, 3" target="0, 0, 0" up="0, 1, 0"/></transform></emitter>)"},
    {"directional", R"(<emitter type="directional"><vector name="direction" x="0" y="0" z="-1"/></emitter>)"},
    {"constant", R"(<emitter type="constant"/>)"},
    {"envmap", R"(<emitter type="envmap"><string name="filename" value="sky.hdr"/></emitter>)"},
};

/// A sky of 512 x 256 texels that brightens upwards, with a small sun.
std::string sky() {
  constexpr int kWidth = 512, kHeight = 256;
  std::vector<std::array<double, 3>> texels;
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const double value = x / 4 == 30 && y / 4 == 12 ? 1000 : 1 - 0.9 * y / kHeight;
      texels.push_back({value, value, 1.2 * value});
    }
  }
  return testing::radiance_file(kWidth, kHeight, texels);
}

struct LitScene {
  testing::Compiled compiled;
  SceneView view;

  explicit LitScene(const std::string& kind)
      : compiled(testing::compile_elements(testing::kSensor + testing::kShape + kScenes.at(kind),
                                           {{"triangle.obj", "v -1 -1 3\nv -1 1 3\nv 1 -1 3\nf 1 2 3\n"},
                                            {"sky.hdr", kind == "envmap" ? sky() : ""}})),
        view(make_scene_view(tables_of(compiled), {})) {}
};

void register_kind(LightKind kind, const std::string& name) {
  if (name.ends_with("_normals")) return;  // no point of a surface samples those
  if (!kScenes.contains(name)) throw std::runtime_error("no scene to measure light kind '" + name + "' in");
  const auto scene = std::make_shared<const LitScene>(name);
  if (scene->view.light_count == 0 || scene->view.lights[0].kind != kind)
    throw std::runtime_error("the scene of light kind '" + name + "' has none");
  for (const ModelKernels* kernels : usable_model_kernels()) {
    const auto& kernel = kernels->light[static_cast<int>(kind)];
    const auto sample = kernel[static_cast<int>(LightOperation::sample)];
    register_model(name + "/sample", *kernels, sample, [scene] { return ModelPaths(scene->view, 0); });
    register_model(name + "/pdf_sa", *kernels, kernel[static_cast<int>(LightOperation::pdf_sa)], [scene, sample] {
      ModelPaths paths(scene->view, 0);
      sample(paths.arrays());
      paths.look_at_samples();
      return paths;
    });
  }
}

}  // namespace
}  // namespace norrsken

int main(int argc, char** argv) {
  for (const auto& [kind, name] : norrsken::kKinds) norrsken::register_kind(kind, name);
  return norrsken::run_benchmarks(argc, argv);
}
