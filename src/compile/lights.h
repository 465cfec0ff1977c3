// What emitters are compiled with, and the host function of each: what src/light/NAME.cpp defines.
#pragma once

#include "compile/light_choice.h"
#include "compile/plugin_tools.h"

namespace norrsken {

class ImageStore;

inline constexpr double kMaxEmission = 1e18;  ///< of radiance and intensity; its square must fit a float

class Lights : public TexturedTools {
 public:
  using TexturedTools::TexturedTools;

  /// Stores what else a kind keeps, and returns its offset.
  template <class Block>
  std::uint32_t store(const Block& block) {
    return store(std::span<const float>(floats_of(block)));
  }
  /// `light.prob` and the alias fields are filled in later. Returns the record's index.
  std::uint32_t add(const LightRecord& light, const LightPower& power);
  /// A light that surrounds the scene, of which there may be one.
  void add_environment(const Node& node, const LightRecord& light, const LightPower& power);

  ImageStore& images();
  /// Where images and tables of lights are kept.
  Array<float>& texels();

  /// The records of a shape's primitives.
  std::span<SurfaceRecord> surfaces_of(std::uint32_t shape);
  bool is_sphere(std::uint32_t shape) const;
  bool is_analytic(std::uint32_t shape) const;
  /// Makes a primitive, counted within its shape, part of a light.
  void set_light(std::uint32_t shape, std::uint32_t primitive, std::uint32_t light);
  /// Shapes and triangles as they are by now.
  const SceneTables& tables() const;

  /// What the integrator does about lights. Tables that depend on it serve no other integrator.
  bool paths_begin_at_lights();
  bool paths_find_lights();

 private:
  std::uint32_t store(std::span<const float> block);
};

/// Adds lights. `shape` is the index of the shape that the emitter stands in, or kNone.
using CompileEmitter = void(Parameters&, Lights&, std::uint32_t shape);

#define NORRSKEN_EMITTER(name) CompileEmitter compile_emitter_##name;
#include "lists/emitter.def"
#undef NORRSKEN_EMITTER

/// How often an emitter is chosen, in proportion; defined in src/light/light_host.cpp.
double read_sampling_weight(Parameters& emitter);

}  // namespace norrsken
