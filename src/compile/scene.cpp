// Scene::load, Scene::info and builtin_scenes of include/norrsken/scene.h.
#include "norrsken/scene.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/memory.h"
#include "base/text.h"
#include "compile/compile.h"
#include "formats/mitsuba_xml.h"
#include "scene/read_files.h"
#include "scene/within_memory.h"

namespace norrsken {
namespace {

constexpr std::string_view kSceneSuffix = ".xml";

/// The first line of the first comment of an XML file.
std::string description_of(std::string_view xml) {
  const std::size_t open = xml.find("<!--");
  const std::size_t close = xml.find("-->", open);
  if (open == std::string_view::npos || close == std::string_view::npos) return {};
  const std::string_view comment = trim(xml.substr(open + 4, close - open - 4));
  return std::string(trim(comment.substr(0, comment.find('\n'))));
}

/// The path that `path_or_name` stands for; empty after a complaint. A file on disk hides a built-in scene,
/// a folder does not.
std::string find_scene(const std::string& path_or_name, const FileSystem& files, Diagnostics& diagnostics) {
  if (files.exists(path_or_name) && !files.is_folder(path_or_name)) return path_or_name;
  std::vector<std::string> names;
  for (const BuiltinScene& scene : builtin_scenes()) {
    if (scene.name == path_or_name) return fmt::format("builtin:{}{}", scene.name, kSceneSuffix);
    names.push_back(scene.name);
  }
  if (files.exists(path_or_name)) return path_or_name;  // to be told that it is a folder
  diagnostics.error({},
                    fmt::format("there is no scene file or built-in scene {}{}", quoted(path_or_name, 200),
                                did_you_mean(path_or_name, names)),
                    "the path of a Mitsuba XML file, or one of " + join(names));
  return {};
}

using SceneArguments = std::vector<std::pair<std::string, std::string>>;

/// The parameters to read the scene with. A `$spp` that nobody set follows the samples per pixel, so that what the
/// scene derives from it (such as emitter samples) does too. Whether there is one is known only when the scene has been
/// read.
SceneArguments scene_arguments(const std::string& path, const FileSystem& files, const LoadOptions& options) {
  SceneArguments arguments = options.parameters;
  const auto is_spp = [](const auto& parameter) { return parameter.first == "spp"; };
  if (options.samples_per_pixel.value_or(0) < 1 || std::ranges::any_of(arguments, is_spp)) return arguments;
  Diagnostics unheard;  // the reading that counts says it all again
  const auto description = read_mitsuba_xml(path, files, arguments, unheard);
  if (description && std::ranges::any_of(description->parameters, is_spp)) {
    arguments.emplace_back("spp", std::to_string(*options.samples_per_pixel));
  }
  return arguments;
}

std::optional<LoadedScene> load_tables(const std::string& path_or_name, const LoadOptions& options,
                                       Diagnostics& diagnostics) {
  const RecordedFiles files;
  const std::string path = find_scene(path_or_name, files, diagnostics);
  if (path.empty()) return std::nullopt;
  SourceLocation whole_file;
  whole_file.file = path;
  std::optional<Description> description;
  within_memory(whole_file, "the scene's XML", diagnostics, [&] {
    description = read_mitsuba_xml(path, files, scene_arguments(path, files, options), diagnostics);
  });
  if (!description) return std::nullopt;
  std::optional<LoadedScene> scene = compile(*description, files, options, diagnostics);
  if (!scene) return std::nullopt;
  scene->info.files = files.paths();
  scene->info.hash = files.fingerprint();
  return scene;
}

}  // namespace

std::optional<Scene> Scene::load(const std::string& path_or_name, const LoadOptions& options,
                                 Diagnostics& diagnostics) {
  LoadOptions counted = options;
  if (!counted.memory) counted.memory = MemoryBudget::of_machine();
  const MemoryScope scope(counted.memory);
  std::optional<LoadedScene> loaded;
  try {
    loaded = load_tables(path_or_name, counted, diagnostics);
  } catch (const LoadingStopped&) {
    // It has been said why.
  }
  diagnostics.sort();
  if (!loaded) return std::nullopt;
  return Scene(std::make_shared<const LoadedScene>(std::move(*loaded)));
}

SceneInfo Scene::info() const { return tables_->info; }

std::vector<BuiltinScene> builtin_scenes() {
  std::vector<BuiltinScene> scenes;
  for (const auto& [path, contents] : builtin_files()) {
    // Fragments and meshes lie in folders of their own.
    if (path.find('/') != std::string_view::npos || !path.ends_with(kSceneSuffix)) continue;
    scenes.push_back({std::string(path.substr(0, path.size() - kSceneSuffix.size())), description_of(contents)});
  }
  std::ranges::sort(scenes, {}, &BuiltinScene::name);
  return scenes;
}

}  // namespace norrsken
