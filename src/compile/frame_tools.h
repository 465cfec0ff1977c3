// What a frame is made of (sensors, films, reconstruction filters, samplers and integrators) is compiled with these, and
// the host function of each: what the families' NAME.cpp define.
#pragma once

#include "compile/plugin_tools.h"
#include "compile/shape_geometry.h"
#include "tables/layers.h"

namespace norrsken {

/// Bounds on what a scene may ask for.
inline constexpr int kMaxFilmSide = 65536;

class Sensors : public PluginTools {
 public:
  using PluginTools::PluginTools;
  /// Of a shape in the scene, what is wrong with it is told elsewhere.
  enum class IsInScene { no, yes };
  /// The surface of a shape, which does not get into the picture by that; empty after a complaint.
  std::optional<ShapeGeometry> surface(const Node& shape, IsInScene is_in_scene);
  /// Pieces of surface: tables/meter_tables.h.
  Array<float>& meter();
  /// A sensor inside another one, for a part of the film. It must be no batch.
  CameraRecord inside(const Node& sensor, const FilmSettings& film);
  void join(const CameraRecord& camera);
};

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
#define NORRSKEN_METER(kind, Model) CompileSensor compile_sensor_##kind;
#include "lists/meter.def"
#undef NORRSKEN_METER
#define NORRSKEN_SENSOR_ADAPTER(kind) CompileSensor compile_sensor_##kind;
#include "lists/sensor_adapter.def"
#undef NORRSKEN_SENSOR_ADAPTER
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
