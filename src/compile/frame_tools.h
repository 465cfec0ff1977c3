// What a frame is made of (sensors, films, reconstruction filters, samplers and integrators) is compiled with these, and
// the host function of each: what the families' NAME.cpp define.
#pragma once

#include "compile/plugin_tools.h"
#include "tables/layers.h"

namespace norrsken {

/// Bounds on what a scene may ask for.
inline constexpr int kMaxFilmSide = 65536;

using Sensors = PluginTools;  ///< which describe themselves and need nothing else

class Films : public PluginTools {
 public:
  using PluginTools::PluginTools;
  /// The filter of a film node; Mitsuba's, gaussian, if it names none.
  FilterRecord rfilter(Parameters& film);
};

class Integrators : public PluginTools {
 public:
  using PluginTools::PluginTools;
  /// What is asked for besides the image.
  SceneLayers& layers();
  /// The settings of an integrator inside another one.
  IntegratorSettings inside(const Node& node);
};

using CompileSensor = CameraRecord(Parameters&, Sensors&, const FilmSettings&);
using CompileFilm = FilmSettings(Parameters&, Films&);
using CompileSampler = SamplerSettings(Parameters&);
/// `table`: what filters are tabulated in.
using CompileRfilter = FilterRecord(Parameters&, Array<float>& table);
using CompileIntegrator = IntegratorSettings(Parameters&, Integrators&);

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

}  // namespace norrsken
