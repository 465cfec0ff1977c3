#include "compile/plugins.h"

#include <fmt/format.h>

#include "base/text.h"
#include "compile/scene_children.h"
#include "scene/constant_spectrum.h"

namespace norrsken {
namespace {

// What may stand below a definition that a scene refers to.
std::vector<std::string> supported_plugins(const std::string& kind) {
  if (kind == "bsdf") return names_of(bsdf_plugins());
  if (kind == "medium") return names_of(medium_plugins());
  if (kind == "phase") return names_of(phase_plugins());
  if (kind == "volume") return names_of(volume_plugins());
  if (kind == "emitter") return names_of(emitter_plugins());
  if (kind == "shape") return names_of(shape_plugins());
  if (kind == "texture" || kind == "spectrum") return names_of(texture_plugins());
  return {};
}

}  // namespace

bool perturbs_bsdf(std::string_view plugin) {
  return false
#define NORRSKEN_BSDF_PERTURBING(name, Adapter) || plugin == #name
#include "lists/bsdf_resolved.def"
#undef NORRSKEN_BSDF_PERTURBING
      ;
}

bool chooses_bsdf(std::string_view plugin) {
  const bool is_looked_through = false
#define NORRSKEN_BSDF_RESOLVED(name, Adapter) || plugin == #name
#include "lists/bsdf_resolved.def"
#undef NORRSKEN_BSDF_RESOLVED
      ;
  return is_looked_through && !perturbs_bsdf(plugin);
}

std::span<const Plugin<CompileBsdf>> bsdf_plugins() {
  static constexpr Plugin<CompileBsdf> kTable[] = {
#define NORRSKEN_BSDF(kind, Model) {#kind, compile_bsdf_##kind},
#include "lists/bsdf.def"
#undef NORRSKEN_BSDF
#define NORRSKEN_BSDF_RESOLVED(name, Adapter) {#name, compile_bsdf_##name},
#include "lists/bsdf_resolved.def"
#undef NORRSKEN_BSDF_RESOLVED
#define NORRSKEN_BSDF_ADAPTER(name) {#name, compile_bsdf_##name},
#include "lists/bsdf_adapter.def"
#undef NORRSKEN_BSDF_ADAPTER
  };
  return kTable;
}

std::span<const Plugin<CompileTexture>> texture_plugins() {
  static constexpr Plugin<CompileTexture> kTable[] = {
#define NORRSKEN_TEXTURE(kind, Model) {#kind, compile_texture_##kind},
#include "lists/texture.def"
#undef NORRSKEN_TEXTURE
  };
  return kTable;
}

std::span<const Plugin<CompileMedium>> medium_plugins() {
  static constexpr Plugin<CompileMedium> kTable[] = {
#define NORRSKEN_MEDIUM(name) {#name, compile_medium_##name},
#include "lists/medium.def"
#undef NORRSKEN_MEDIUM
  };
  return kTable;
}

std::span<const Plugin<CompilePhase>> phase_plugins() {
  static constexpr Plugin<CompilePhase> kTable[] = {
#define NORRSKEN_PHASE(kind, Model) {#kind, compile_phase_##kind},
#include "lists/phase.def"
#undef NORRSKEN_PHASE
#define NORRSKEN_PHASE_ADAPTER(kind) {#kind, compile_phase_##kind},
#include "lists/phase_adapter.def"
#undef NORRSKEN_PHASE_ADAPTER
  };
  return kTable;
}

std::span<const Plugin<CompileVolume>> volume_plugins() {
  static constexpr Plugin<CompileVolume> kTable[] = {
#define NORRSKEN_VOLUME(name) {#name, compile_volume_##name},
#include "lists/volume.def"
#undef NORRSKEN_VOLUME
  };
  return kTable;
}

std::span<const Plugin<CompileShape>> shape_plugins() {
  static constexpr Plugin<CompileShape> kTable[] = {
#define NORRSKEN_SHAPE(name) {#name, compile_shape_##name},
#include "lists/shape.def"
#undef NORRSKEN_SHAPE
  };
  return kTable;
}

std::span<const Plugin<CompileEmitter>> emitter_plugins() {
  static constexpr Plugin<CompileEmitter> kTable[] = {
#define NORRSKEN_EMITTER(name) {#name, compile_emitter_##name},
#include "lists/emitter.def"
#undef NORRSKEN_EMITTER
  };
  return kTable;
}

std::span<const Plugin<CompileSensor>> sensor_plugins() {
  static constexpr Plugin<CompileSensor> kTable[] = {
#define NORRSKEN_CAMERA(kind, Model) {#kind, compile_sensor_##kind},
#include "lists/camera.def"
#undef NORRSKEN_CAMERA
#define NORRSKEN_METER(kind, Model) {#kind, compile_sensor_##kind},
#include "lists/meter.def"
#undef NORRSKEN_METER
#define NORRSKEN_SENSOR_ADAPTER(kind) {#kind, compile_sensor_##kind},
#include "lists/sensor_adapter.def"
#undef NORRSKEN_SENSOR_ADAPTER
  };
  return kTable;
}

std::span<const Plugin<CompileFilm>> film_plugins() {
  static constexpr Plugin<CompileFilm> kTable[] = {
#define NORRSKEN_FILM(name) {#name, compile_film_##name},
#include "lists/film.def"
#undef NORRSKEN_FILM
  };
  return kTable;
}

std::span<const Plugin<CompileSampler>> sampler_plugins() {
  static constexpr Plugin<CompileSampler> kTable[] = {
#define NORRSKEN_SAMPLER(name) {#name, compile_sampler_##name},
#include "lists/sampler.def"
#undef NORRSKEN_SAMPLER
  };
  return kTable;
}

std::span<const Plugin<CompileRfilter>> rfilter_plugins() {
  static constexpr Plugin<CompileRfilter> kTable[] = {
#define NORRSKEN_RFILTER(name) {#name, compile_rfilter_##name},
#include "lists/rfilter.def"
#undef NORRSKEN_RFILTER
  };
  return kTable;
}

std::span<const Plugin<CompileIntegrator>> integrator_plugins() {
  static constexpr Plugin<CompileIntegrator> kTable[] = {
#define NORRSKEN_INTEGRATOR(name) {#name, compile_integrator_##name},
#include "lists/integrator.def"
#undef NORRSKEN_INTEGRATOR
  };
  return kTable;
}

bool is_supported(const Node& unused, Diagnostics& diagnostics) {
  for (const Node* node : nodes_below({&unused})) {
    const std::vector<std::string> supported = supported_plugins(node->kind);
    if (is_constant_spectrum(*node) || std::ranges::find(supported, node->plugin) != supported.end()) continue;
    const std::string name = unused.id.empty() ? "this " + unused.kind : quoted(unused.id);
    diagnostics.warning(
        node->plugin_location,
        fmt::format("nothing uses {}, which is left out: {}", name, complaint_about_plugin(*node, supported)),
        join(supported));
    return false;
  }
  return true;
}

}  // namespace norrsken
