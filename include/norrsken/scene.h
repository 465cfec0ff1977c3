// Loading a scene, and asking what is in it.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "norrsken/description.h"
#include "norrsken/diagnostics.h"
#include "norrsken/memory.h"
#include "norrsken/result.h"

namespace norrsken {

// Private to the library.
struct LoadedScene;
struct SceneFrame;
class SceneState;

/// Where a scene is read from.
struct SceneSource {
  /// A file on the disk, or the name of a built-in scene, which files of that name hide.
  std::string path = {};
  /// In place of the disk: files by their paths, and `path` is one of them. What the scene names is looked for among
  /// these alone; nothing is read from the disk.
  std::map<std::string, std::string> files = {};

  static SceneSource file(std::string path_or_name) { return {std::move(path_or_name), {}}; }
  /// A scene in memory: `text` as if it were in the file `name`, and the files that it names.
  static SceneSource memory(std::string name, std::string text, std::map<std::string, std::string> files = {}) {
    files[name] = std::move(text);
    return {std::move(name), std::move(files)};
  }
};

/// What may be said over a scene.
struct LoadOptions {
  std::vector<std::pair<std::string, std::string>> parameters;  ///< -Dname=value, in order, later ones win
  std::optional<std::string> integrator = {};                   ///< plugin name in place of the file's
  std::optional<std::string> sampler = {};
  std::optional<std::string> sensor = {};  ///< its id, or its number from 0; empty: the first
  std::optional<int> width = {}, height = {};
  /// In place of the scene's; a $spp parameter that `parameters` does not set follows.
  std::optional<int> samples_per_pixel = {};
  /// For loading and for what is rendered of the scene. Empty: MemoryBudget::of_machine().
  std::shared_ptr<MemoryBudget> memory = {};
  /// Whether there has to be memory for the film and its image, too. Not to be told of a scene, or to replay a sample.
  bool reserve_film = true;
  /// Called with each diagnostic as it comes, from the thread that loads; the result has them all, sorted.
  DiagnosticSink log = {};
};

/// How a scene is looked at otherwise than it says itself; what is empty stays.
struct ViewOptions {
  /// Pixels of the film; nothing else of it changes.
  struct Crop {
    int x = 0, y = 0, width = 0, height = 0;
  };

  std::optional<std::string> sensor = {};  ///< one of the scene's: its id, or its number from 0
  /// A sensor in place of the scene's. Film and sampler that it does not have are those of the scene's.
  std::optional<Node> sensor_node = {};
  /// Parameters of the sensor: "to_world", "fov", ... Of two that exclude each other, as fov and focal_length do, the
  /// other one goes.
  std::vector<Property> camera = {};
  std::optional<int> width = {}, height = {};  ///< of the whole film; the picture, and a crop window in it, stay
  /// The part that is rendered, in pixels of a film of this size. Its pixels draw other random numbers than the same
  /// pixels of the whole image.
  std::optional<Crop> crop = {};
  std::optional<std::string> integrator = {}, sampler = {};  ///< plugin names; parameters are kept as far as they fit
  std::optional<Node> integrator_node = {}, sampler_node = {};
  /// Of the sampler alone. What else a scene makes of a `$spp` stays as it was loaded (LoadOptions::samples_per_pixel).
  std::optional<int> samples_per_pixel = {};
};

/// What `norrsken info` tells.
struct SceneInfo {
  struct Item {
    std::string kind;    ///< "bsdf", "shape", "emitter", "sensor", ...
    std::string plugin;  ///< "diffuse", "obj", ...
    std::string id;
    std::string detail;  ///< one line of figures: "24 triangles", "radius 1.5"
  };
  std::vector<Item> items;
  std::vector<std::pair<std::string, std::string>> parameters;  ///< the `$parameters` in use and their values
  /// What a scene of an old version says in other words, each with its place: "a.xml:4:13: 'maxDepth' is 'max_depth'".
  std::vector<std::string> changes;
  /// On the disk, that the scene was read from: its own file, includes, meshes, textures, ...
  std::vector<std::string> files;
  std::string hash;  ///< of what these and built-in files hold, whatever their names: 32 hexadecimal digits
  /// Surfaces, those of groups counted once, whatever their number of instances.
  std::uint64_t triangles = 0, spheres = 0, other_shapes = 0;
  std::uint64_t instances = 0, lights = 0;
  double bounds_min[3] = {}, bounds_max[3] = {};
  int width = 0, height = 0, samples_per_pixel = 0, max_depth = 0, rr_depth = 0, emitter_samples = 0;
  std::string integrator, sampler, accelerator;
  int sensor = 0;         ///< which of the scene's, in the file's order
  std::string sensor_id;  ///< empty if it has none

  /// Bytes, as the budget counts them.
  struct Memory {
    std::uint64_t geometry = 0, textures = 0, other_tables = 0;
    std::uint64_t loading = 0;       ///< the most that was counted at once while the scene was loaded
    std::uint64_t film = 0;          ///< at its size
    std::uint64_t image = 0;         ///< that the film becomes, with all layers, and writing it
    std::uint64_t acceleration = 0;  ///< an estimate of what the acceleration structure of a large scene takes
    std::uint64_t tables() const { return geometry + textures + other_tables; }
  } memory;
};

struct BuiltinScene {
  std::string name, description;
};

/// An immutable scene, cheap to copy, which any number of threads may use. What is expensive (its tables, acceleration
/// structures) is made once and shared by all copies, by those that `with` makes, and by whatever is rendered of them.
class Scene {
 public:
  /// Complaints are sorted (see Diagnostics::sort).
  static Result<Scene> load(const SceneSource& source, const LoadOptions& options = {});
  static Result<Scene> load(const std::string& path_or_name, const LoadOptions& options = {}) {
    return load(SceneSource::file(path_or_name), options);
  }
  /// A scene that a program has put together. Files that it names are looked for in its search paths and in the current
  /// folder, or among `files` if there are any. `options.parameters` mean nothing here and are an error.
  static Result<Scene> build(const Description& description, const LoadOptions& options = {},
                             std::map<std::string, std::string> files = {});

  /// The same scene looked at in another way: with another camera, size, integrator, sampler. Nothing is loaded or built,
  /// so it takes less than a millisecond. What is not said in `options` is as in this scene. An error where lights were
  /// prepared for another kind of integrator (directionalarea, mis_compensation): then load the scene with that one.
  Result<Scene> with(const ViewOptions& options) const;

  SceneInfo info() const;
  /// How many acceleration structures have been built for this scene and those that share its tables.
  std::uint64_t structures_built() const;

  // For the library itself.
  const LoadedScene& tables() const;
  const SceneFrame& frame() const { return *frame_; }
  const SceneState& state() const { return *state_; }

 private:
  Scene(std::shared_ptr<const SceneState> state, std::shared_ptr<const SceneFrame> frame)
      : state_(std::move(state)), frame_(std::move(frame)) {}
  /// As it is after loading; `loaded` may be empty.
  static Result<Scene> finish(std::optional<LoadedScene>& loaded, Diagnostics diagnostics);

  std::shared_ptr<const SceneState> state_;
  std::shared_ptr<const SceneFrame> frame_;
};

/// A format that scenes are read from.
struct SceneFormat {
  std::string name;                   ///< "Mitsuba XML"
  std::vector<std::string> suffixes;  ///< ".xml"
};
std::vector<SceneFormat> scene_formats();

std::vector<BuiltinScene> builtin_scenes();

}  // namespace norrsken
