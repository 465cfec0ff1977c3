// What a path pays for a scattering model, per instruction set: every line of bsdf_test_cases.def, which has every
// model of lists/bsdf.def. scripts/measure_models.py makes a table of it.
#include "model_bench.h"
#include "render/scene_view.h"

namespace norrsken {
namespace {

struct Case {
  BsdfKind kind;
  const char* plugin;
  const char* name;
  const char* inside;
};

constexpr Case kCases[] = {
#define NORRSKEN_BSDF_CASE(kind, name, energy_limit, inside) {BsdfKind::kind, #kind, name, inside},
#define NORRSKEN_BSDF_CASE_ONE_WAY(kind, name, energy_limit, reason, inside) {BsdfKind::kind, #kind, name, inside},
#define NORRSKEN_BSDF_FURNACE(...)
#include "bsdf/bsdf_test_cases.def"
#undef NORRSKEN_BSDF_FURNACE
#undef NORRSKEN_BSDF_CASE_ONE_WAY
#undef NORRSKEN_BSDF_CASE
};

constexpr std::pair<BsdfOperation, const char*> kOperations[] = {{BsdfOperation::evaluate, "evaluate"},
                                                                 {BsdfOperation::pdf_sa, "pdf_sa"},
                                                                 {BsdfOperation::sample, "sample"},
                                                                 {BsdfOperation::hit, "hit"}};

/// A sphere of that material.
struct Ball {
  testing::Compiled compiled;
  SceneView view;
  MaterialWord material;

  explicit Ball(const Case& c)
      : compiled(testing::compile_bsdf("<bsdf type=\"" + std::string(c.plugin) + "\">" + c.inside + "</bsdf>")),
        view(make_scene_view(tables_of(compiled), {})),
        material(compiled.tables().surfaces.at(0).material_front) {}
};

void register_case(const Case& c) {
  const auto ball = std::make_shared<const Ball>(c);
  const std::string name = std::string(c.plugin) + " (" + c.name + ")";
  for (const auto& [operation, label] : kOperations) {
    for (const ModelKernels* kernels : usable_model_kernels()) {
      register_model(name + "/" + label, *kernels, kernels->bsdf[static_cast<int>(c.kind)][static_cast<int>(operation)],
                     [ball] { return ModelPaths(ball->view, ball->material & kMaterialOffsetMask); });
    }
  }
}

}  // namespace
}  // namespace norrsken

int main(int argc, char** argv) {
  for (const norrsken::Case& c : norrsken::kCases) norrsken::register_case(c);
  return norrsken::run_benchmarks(argc, argv);
}
