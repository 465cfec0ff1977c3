// The host function of every plugin, declared from its family's list: what a family's NAME.cpp defines. Each reads the
// plugin's parameters; whoever calls it has looked the name up and complains about parameters nobody asked for.
#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "compile/builder.h"
#include "compile/plugin_table.h"
#include "scene/parameters.h"
#include "tables/scene_tables.h"

namespace norrsken {

using CompileBsdf = Material(Parameters&, Builder&);
using CompileTexture = Texture(Parameters&, Builder&);
/// World-space geometry; empty after a complaint.
using CompileShape = std::optional<ShapeGeometry>(Parameters&, Builder&);
/// Adds lights. `shape` is the index of the shape that the emitter stands in, or kNone.
using CompileEmitter = void(Parameters&, Builder&, std::uint32_t shape);
using CompileSensor = CameraRecord(Parameters&, Builder&, const FilmSettings&);
using CompileFilm = FilmSettings(Parameters&, Builder&);
using CompileSampler = SamplerSettings(Parameters&, Builder&);
using CompileRfilter = FilterRecord(Parameters&, Builder&);
using CompileIntegrator = IntegratorSettings(Parameters&, Builder&);

#define NORRSKEN_BSDF(kind, Model) CompileBsdf compile_bsdf_##kind;
#include "lists/bsdf.def"
#undef NORRSKEN_BSDF
#define NORRSKEN_BSDF_RESOLVED(name, Adapter) CompileBsdf compile_bsdf_##name;
#include "lists/bsdf_resolved.def"
#undef NORRSKEN_BSDF_RESOLVED
#define NORRSKEN_BSDF_ADAPTER(name) CompileBsdf compile_bsdf_##name;
#include "lists/bsdf_adapter.def"
#undef NORRSKEN_BSDF_ADAPTER
#define NORRSKEN_TEXTURE(kind, Model) CompileTexture compile_texture_##kind;
#include "lists/texture.def"
#undef NORRSKEN_TEXTURE
#define NORRSKEN_SHAPE(name) CompileShape compile_shape_##name;
#include "lists/shape.def"
#undef NORRSKEN_SHAPE
#define NORRSKEN_EMITTER(name) CompileEmitter compile_emitter_##name;
#include "lists/emitter.def"
#undef NORRSKEN_EMITTER
#define NORRSKEN_CAMERA(kind, Model) CompileSensor compile_sensor_##kind;
#include "lists/camera.def"
#undef NORRSKEN_CAMERA
#define NORRSKEN_FILM(name) CompileFilm compile_film_##name;
#include "lists/film.def"
#undef NORRSKEN_FILM
#define NORRSKEN_SAMPLER(name) CompileSampler compile_sampler_##name;
#include "lists/sampler.def"
#undef NORRSKEN_SAMPLER
#define NORRSKEN_RFILTER(name) CompileRfilter compile_rfilter_##name;
#include "lists/rfilter.def"
#undef NORRSKEN_RFILTER
#define NORRSKEN_INTEGRATOR(name) CompileIntegrator compile_integrator_##name;
#include "lists/integrator.def"
#undef NORRSKEN_INTEGRATOR

/// Whether hits on the BSDF are looked through (see bsdf/resolved.h) with a new normal, or to one of several models.
bool perturbs_bsdf(std::string_view plugin);
bool chooses_bsdf(std::string_view plugin);

/// Whether a definition that nothing uses can be compiled; else a warning names the plugin inside of it that is missing.
bool is_supported(const Node& unused, Diagnostics& diagnostics);

std::span<const Plugin<CompileBsdf>> bsdf_plugins();
std::span<const Plugin<CompileTexture>> texture_plugins();
std::span<const Plugin<CompileShape>> shape_plugins();
std::span<const Plugin<CompileEmitter>> emitter_plugins();
std::span<const Plugin<CompileSensor>> sensor_plugins();
std::span<const Plugin<CompileFilm>> film_plugins();
std::span<const Plugin<CompileSampler>> sampler_plugins();
std::span<const Plugin<CompileRfilter>> rfilter_plugins();
std::span<const Plugin<CompileIntegrator>> integrator_plugins();

}  // namespace norrsken
