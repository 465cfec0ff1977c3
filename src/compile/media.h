// What media, phase functions and volumes are compiled with, and the host function of each: what src/medium/NAME.cpp defines.
#pragma once

#include <glm/vec3.hpp>

#include "compile/plugin_tools.h"
#include "tables/slots.h"

namespace norrsken {

/// What a volume becomes.
struct Volume {
  std::uint32_t index = kNone;    ///< in SceneTables::volumes
  double min = 0, max = 0;        ///< of its values
  glm::dvec3 lower{0}, upper{0};  ///< of a box along the axes of the world that its unit cube is in
};

class Media : public PluginTools {
 public:
  using PluginTools::PluginTools;

  const FileSystem& files() const;
  SceneTables& tables();
  /// Stores a phase function's block and returns the word that leads to it.
  template <class Stored>
  PhaseWord add(const Stored& stored) {
    return add(Stored::kKind, floats_of(stored));
  }
  PhaseWord add(const PhaseBlend& blend) { return add(PhaseKind::blendphase, floats_of(blend)); }
  /// Of a node inside; one that several refer to is compiled once.
  PhaseWord phase(const Node& node);
  Volume volume(const Node& node);

 private:
  PhaseWord add(PhaseKind kind, std::span<const float> block);
};

using CompileMedium = MediumRecord(Parameters&, Media&);
using CompilePhase = PhaseWord(Parameters&, Media&);
using CompileVolume = Volume(Parameters&, Media&);

/// Of media that name none: as Mitsuba has it, the `isotropic` one.
PhaseWord default_phase(Media& media);

#define NORRSKEN_MEDIUM(name) CompileMedium compile_medium_##name;
#include "lists/medium.def"
#undef NORRSKEN_MEDIUM
#define NORRSKEN_PHASE(kind, Model) CompilePhase compile_phase_##kind;
#include "lists/phase.def"
#undef NORRSKEN_PHASE
#define NORRSKEN_PHASE_ADAPTER(kind) CompilePhase compile_phase_##kind;
#include "lists/phase_adapter.def"
#undef NORRSKEN_PHASE_ADAPTER
#define NORRSKEN_VOLUME(name) CompileVolume compile_volume_##name;
#include "lists/volume.def"
#undef NORRSKEN_VOLUME

}  // namespace norrsken
