// For tests: a BSDF of a scene file on one lane, whatever its model.
#pragma once

#include <memory>
#include <string>

#include "bsdf/models.h"
#include "compile/compile_testing.h"

namespace norrsken::isa_host {

/// The members of a model (bsdf.h) with its parameters filled in.
class LoadedBsdf {
 public:
  virtual ~LoadedBsdf() = default;
  virtual bool is_delta() const = 0;
  virtual Color evaluate(const Vec3f& wo, const Vec3f& wi) const = 0;
  virtual float pdf_sa(const Vec3f& wo, const Vec3f& wi) const = 0;
  virtual BsdfSample sample(const Vec3f& wo, float lobe, Vec2f direction) const = 0;
  virtual Color albedo() const = 0;
  /// The index of refraction beyond over that on this side, for what `evaluate` says of directions that cross.
  virtual float refracted_eta() const = 0;
};

template <class Model>
class LoadedModel final : public LoadedBsdf {
 public:
  explicit LoadedModel(const ParameterReader& p) : parameters_(Model::load(p)) {}
  bool is_delta() const override { return Model::kDelta; }
  Color evaluate(const Vec3f& wo, const Vec3f& wi) const override { return Model::evaluate(parameters_, wo, wi); }
  float pdf_sa(const Vec3f& wo, const Vec3f& wi) const override { return Model::pdf_sa(parameters_, wo, wi).v; }
  BsdfSample sample(const Vec3f& wo, float lobe, Vec2f direction) const override {
    return Model::sample(parameters_, wo, Float(lobe), direction);
  }
  Color albedo() const override { return Model::albedo(parameters_); }
  float refracted_eta() const override {
    if constexpr (requires { Model::refracted_eta(parameters_); }) {
      return Model::refracted_eta(parameters_).v;
    } else {
      return 1;
    }
  }

 private:
  typename Model::Parameters parameters_;
};

/// A sphere's two sides; null where nothing is scattered.
struct LoadedSides {
  testing::Compiled compiled;  ///< owns the floats that models may look up tables in
  std::unique_ptr<LoadedBsdf> front, back;
};

inline std::unique_ptr<LoadedBsdf> load_bsdf(const SceneTables& tables, MaterialWord word) {
  SceneView scene;
  scene.parameters = tables.parameters.data();
  scene.texels = tables.texels.data();
  const TexturePoint point{};
  const ParameterReader reader{scene, UInt(word & kMaterialOffsetMask), point, Mask{true}};
  switch (material_kind(word)) {
#define NORRSKEN_BSDF(kind, Model) \
  case BsdfKind::kind:             \
    return std::make_unique<LoadedModel<Model>>(reader);
#include "lists/bsdf.def"
#undef NORRSKEN_BSDF
    default:
      return nullptr;
  }
}

/// Compiles `<bsdf type="KIND">INSIDE</bsdf>`; without sides if that is complained about.
inline LoadedSides load_bsdf(const std::string& kind, const std::string& inside) {
  LoadedSides sides{testing::compile_bsdf("<bsdf type=\"" + kind + "\">" + inside + "</bsdf>"), nullptr, nullptr};
  if (!sides.compiled.messages().empty()) return sides;
  const SurfaceRecord& surface = sides.compiled.tables().surfaces.at(0);
  sides.front = load_bsdf(sides.compiled.tables(), surface.material_front);
  sides.back = load_bsdf(sides.compiled.tables(), surface.material_back);
  return sides;
}

}  // namespace norrsken::isa_host
