// Scene::load, Scene::info and builtin_scenes of include/norrsken/scene.h.
#include "norrsken/scene.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/text.h"
#include "compile/compile.h"
#include "formats/mitsuba_xml.h"
#include "scene/file_system.h"

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

/// The path that `path_or_name` stands for; empty after a complaint. A file on disk hides a built-in scene.
std::string find_scene(const std::string& path_or_name, const FileSystem& files, Diagnostics& diagnostics) {
  if (files.exists(path_or_name)) return path_or_name;
  std::vector<std::string> names;
  for (const BuiltinScene& scene : builtin_scenes()) {
    if (scene.name == path_or_name) return fmt::format("builtin:{}{}", scene.name, kSceneSuffix);
    names.push_back(scene.name);
  }
  diagnostics.error({},
                    fmt::format("there is no scene file or built-in scene {}{}", quoted(path_or_name, 200),
                                did_you_mean(path_or_name, names)),
                    "the path of a Mitsuba 3 XML file, or one of " + join(names));
  return {};
}

}  // namespace

std::optional<Scene> Scene::load(const std::string& path_or_name, const LoadOptions& options,
                                 Diagnostics& diagnostics) {
  const FileSystem files;
  const std::string path = find_scene(path_or_name, files, diagnostics);
  if (path.empty()) return std::nullopt;
  const auto description = read_mitsuba_xml(path, files, options.parameters, diagnostics);
  if (!description) return std::nullopt;
  auto loaded = compile(*description, files, options, diagnostics);
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
