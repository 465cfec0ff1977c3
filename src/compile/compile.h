// From the description to the tables: gives every plugin name its meaning.
#pragma once

#include <map>
#include <optional>

#include "norrsken/diagnostics.h"
#include "norrsken/scene.h"
#include "scene/description.h"
#include "scene/file_system.h"
#include "tables/layers.h"
#include "tables/scene_tables.h"

namespace norrsken {

/// How a scene is looked at: what its sensor and its integrator become. It costs next to nothing, so that a scene may be
/// looked at in any number of ways; what is expensive does not depend on it.
struct SceneFrame {
  CameraRecord camera{};
  Array<CameraRecord> batch;
  Array<float> meter;
  FilmSettings film;
  Array<float> filter;
  SamplerSettings sampler;
  IntegratorSettings integrator;
  SceneLayers layers;
  std::string integrator_name, sampler_name;  ///< of their plugins
  int sensor = 0;                             ///< which of the scene's, and its id
  std::string sensor_id = {};
  bool is_as_loaded = false;
  std::vector<SceneInfo::Item> items;
  std::uint64_t film_bytes = 0, image_bytes = 0;
  ViewOptions view;     ///< in which it differs from the scene's own words
  std::string changes;  ///< of the camera since the scene was loaded, in words for image files; empty: none
};

/// What of an integrator the tables of a scene depend on, as far as some plugin asked for it.
struct AskedOfIntegrator {
  std::optional<bool> from_lights, finds_lights;

  /// What an integrator has otherwise, in words; empty if the tables serve it as well.
  std::string difference(const IntegratorSettings& integrator) const;
};

/// A scene ready to be rendered, with the names that its users know its parts by.
struct LoadedScene {
  std::shared_ptr<MemoryBudget> memory;  ///< that the tables are counted in
  std::string file;                      ///< for complaints about the scene as a whole
  SceneTables tables;
  SceneLayers layers;
  std::vector<std::string> shape_ids;  ///< those that the scene gives its shapes, by their indices; may be shorter
  SceneInfo info;                      ///< all but `accelerator`, which is chosen when rendering
  std::map<const Node*, std::uint32_t> media;  ///< which of the tables' a node is
  std::size_t frame_items = 0;                 ///< of `info.items`: the first so many are of the frame
  AskedOfIntegrator asked;
  /// Sensors and integrators alone: what other frames are made of.
  Description outline;
  ViewOptions view;  ///< that it was loaded with

  /// The scene as it was loaded.
  SceneFrame frame(const ViewOptions& view) const;
};

/// What layers show of the surfaces themselves: triangles that differ in it are not to be merged.
Variation variation_of(const SceneLayers& layers);

/// Compiles a description. Overrides in `options` (integrator, sampler, size, samples) win over the scene's own nodes;
/// their complaints have no location. Empty if `diagnostics` holds any error, one of the reader's included.
std::optional<LoadedScene> compile(const Description& description, const FileSystem& files, const LoadOptions& options,
                                   Diagnostics& diagnostics);

/// The part of `options` that says how a scene is looked at.
ViewOptions view_of(const LoadOptions& options);

/// `frame` looked at otherwise. Nothing is loaded; empty after a complaint.
std::optional<SceneFrame> compile_frame(const LoadedScene& scene, const SceneFrame& frame, const ViewOptions& changes,
                                        Diagnostics& diagnostics);

}  // namespace norrsken
