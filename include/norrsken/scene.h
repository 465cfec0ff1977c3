// Loading a scene, and asking what is in it.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "norrsken/diagnostics.h"
#include "norrsken/memory.h"

namespace norrsken {

struct LoadedScene;  // the scene as tables; private to the library

/// What the command line may say over the scene file's head.
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

/// An immutable scene, cheap to copy.
class Scene {
 public:
  /// Loads a Mitsuba XML file, or a built-in scene by name. Complaints go to `diagnostics`; the result is empty
  /// if there was an error. They are sorted (see Diagnostics::sort).
  static std::optional<Scene> load(const std::string& path_or_name, const LoadOptions& options,
                                   Diagnostics& diagnostics);

  SceneInfo info() const;
  const LoadedScene& tables() const { return *tables_; }

 private:
  explicit Scene(std::shared_ptr<const LoadedScene> tables) : tables_(std::move(tables)) {}
  std::shared_ptr<const LoadedScene> tables_;
};

std::vector<BuiltinScene> builtin_scenes();

}  // namespace norrsken
