// The plugins of every family by name. The function of each reads the plugin's parameters; whoever calls it has looked the
// name up and complains about parameters nobody asked for.
#pragma once

#include <span>
#include <string_view>

#include "compile/frame_tools.h"
#include "compile/lights.h"
#include "compile/materials.h"
#include "compile/media.h"
#include "compile/plugin_table.h"
#include "compile/shapes.h"
#include "compile/textures.h"

namespace norrsken {

/// Whether hits on the BSDF are looked through (see bsdf/resolved.h) with a new normal, or to one of several models.
bool perturbs_bsdf(std::string_view plugin);
bool chooses_bsdf(std::string_view plugin);

/// Whether a definition that nothing uses can be compiled; else a warning names the plugin inside of it that is missing.
bool is_supported(const Node& unused, Diagnostics& diagnostics);

std::span<const Plugin<CompileBsdf>> bsdf_plugins();
std::span<const Plugin<CompileTexture>> texture_plugins();
std::span<const Plugin<CompileMedium>> medium_plugins();
std::span<const Plugin<CompilePhase>> phase_plugins();
std::span<const Plugin<CompileVolume>> volume_plugins();
std::span<const Plugin<CompileShape>> shape_plugins();
std::span<const Plugin<CompileEmitter>> emitter_plugins();
std::span<const Plugin<CompileSensor>> sensor_plugins();
std::span<const Plugin<CompileFilm>> film_plugins();
std::span<const Plugin<CompileSampler>> sampler_plugins();
std::span<const Plugin<CompileRfilter>> rfilter_plugins();
std::span<const Plugin<CompileIntegrator>> integrator_plugins();

}  // namespace norrsken
