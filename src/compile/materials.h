// What BSDFs are compiled with, and the host function of each: what src/bsdf/NAME.cpp defines.
#pragma once

#include "compile/material.h"
#include "compile/plugin_tools.h"
#include "tables/slots.h"

namespace norrsken {

class Materials : public TexturedTools {
 public:
  using TexturedTools::TexturedTools;

  /// Stores a model's block and returns the word that leads to it.
  template <class Stored>
  MaterialWord add(const Stored& stored) {
    return add(Stored::kKind, floats_of(stored));
  }
  /// A model without parameters.
  MaterialWord add(BsdfKind kind) { return add(kind, {}); }
  /// The material of a `bsdf` node inside; a node that several refer to is compiled once.
  Material inside(const Node& node);
  /// Says that the model looks at texture coordinates or tangents, which surface points then have.
  void need_uv();
  /// Whether the integrator's paths begin at the lights. It warns of what is then otherwise; no table may depend on it.
  bool paths_begin_at_lights() const;

 private:
  MaterialWord add(BsdfKind kind, std::span<const float> block);
};

using CompileBsdf = Material(Parameters&, Materials&);
/// Of shapes that name none: as Mitsuba has it, the `diffuse` one without parameters.
Material default_material(Materials& materials);

#define NORRSKEN_BSDF(kind, Model) CompileBsdf compile_bsdf_##kind;
#include "lists/bsdf.def"
#undef NORRSKEN_BSDF
#define NORRSKEN_BSDF_RESOLVED(name, Adapter) CompileBsdf compile_bsdf_##name;
#include "lists/bsdf_resolved.def"
#undef NORRSKEN_BSDF_RESOLVED
#define NORRSKEN_BSDF_ADAPTER(name) CompileBsdf compile_bsdf_##name;
#include "lists/bsdf_adapter.def"
#undef NORRSKEN_BSDF_ADAPTER

}  // namespace norrsken
