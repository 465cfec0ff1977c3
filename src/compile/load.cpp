// builtin_scenes and scene_formats of include/norrsken/scene.h and include/norrsken/convert.h, too.
#include "compile/load.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <utility>

#include "base/memory.h"
#include "base/text.h"
#include "formats/scene_formats.h"
#include "formats/write_mitsuba_xml.h"
#include "norrsken/convert.h"
#include "scene/check_description.h"
#include "scene/memory_files.h"
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
                    "the path of a scene file, or one of " + join(names));
  return {};
}

/// A `$spp` that nobody set follows the samples per pixel, so that what the scene derives from it (such as emitter samples)
/// does too.
SceneArguments scene_arguments(const LoadOptions& options) {
  SceneArguments arguments{options.parameters, {}};
  if (options.samples_per_pixel.value_or(0) > 0)
    arguments.preferred.emplace_back("spp", std::to_string(*options.samples_per_pixel));
  return arguments;
}

std::optional<Description> read_scene_file(const std::string& path, const FileSystem& files, const LoadOptions& options,
                                           Diagnostics& diagnostics) {
  SourceLocation whole_file;
  whole_file.file = path;
  const SceneReader& reader = reader_of(path, files);
  std::optional<Description> description;
  const std::string what = path.ends_with(kSceneSuffix) ? "the scene's XML" : "the scene";
  within_memory(whole_file, what, diagnostics,
                [&] { description = reader.read(path, files, scene_arguments(options), diagnostics); });
  return description;
}

std::optional<LoadedScene> read_and_compile(const std::string& path, const RecordedFiles& files,
                                            const LoadOptions& options, Diagnostics& diagnostics) {
  const std::optional<Description> description = read_scene_file(path, files, options, diagnostics);
  if (!description) return std::nullopt;
  return compile(*description, files, options, diagnostics);
}

/// Calls `load` in the memory budget of `options`; it may stop with LoadingStopped.
std::optional<LoadedScene> counted(const LoadOptions& options, Diagnostics& diagnostics,
                                   const std::function<std::optional<LoadedScene>(const LoadOptions&)>& load) {
  LoadOptions counted = options;
  if (!counted.memory) counted.memory = MemoryBudget::of_machine();
  const MemoryScope scope(counted.memory);
  std::optional<LoadedScene> loaded;
  try {
    loaded = load(counted);
  } catch (const LoadingStopped&) {
    // It has been said why.
  }
  diagnostics.sort();
  return loaded;
}

std::optional<LoadedScene> with_files(std::optional<LoadedScene> scene, const RecordedFiles& files) {
  if (scene) {
    scene->info.files = files.paths();
    scene->info.hash = files.fingerprint();
  }
  return scene;
}

}  // namespace

std::optional<LoadedScene> load_scene(const SceneSource& source, const LoadOptions& options, Diagnostics& diagnostics) {
  return counted(options, diagnostics, [&](const LoadOptions& in_budget) -> std::optional<LoadedScene> {
    if (source.files.empty()) {
      const RecordedFiles files;
      const std::string path = find_scene(source.path, files, diagnostics);
      if (path.empty()) return std::nullopt;
      return with_files(read_and_compile(path, files, in_budget, diagnostics), files);
    }
    const RecordedFiles files(std::make_unique<MemoryFiles>(source.files));
    if (files.exists(source.path) && !files.is_folder(source.path))
      return with_files(read_and_compile(source.path, files, in_budget, diagnostics), files);
    std::vector<std::string> names;
    for (const auto& [name, contents] : source.files) names.push_back(name);
    diagnostics.error({},
                      fmt::format("there is no {} among the scene's files{}", quoted(source.path, 200),
                                  did_you_mean(source.path, names)),
                      listed(names));
    return std::nullopt;
  });
}

std::optional<LoadedScene> build_scene(const Description& description, const LoadOptions& options,
                                       std::map<std::string, std::string> files_by_path, Diagnostics& diagnostics) {
  return counted(options, diagnostics, [&](const LoadOptions& in_budget) -> std::optional<LoadedScene> {
    for (const auto& [name, value] : options.parameters)
      diagnostics.error({}, fmt::format("-D{}: the scene was put together by a program and has no parameters", name));
    if (!check_description(description, diagnostics)) return std::nullopt;
    const RecordedFiles files(files_by_path.empty() ? std::make_unique<FileSystem>()
                                                    : std::make_unique<MemoryFiles>(std::move(files_by_path)));
    std::optional<LoadedScene> scene = with_files(compile(description, files, in_budget, diagnostics), files);
    if (scene) scene->info.hash = fingerprint_of(description, scene->info.hash);
    return scene;
  });
}

Result<std::vector<std::string>> convert_scene(const SceneSource& source, const std::string& path,
                                               const LoadOptions& options) {
  Diagnostics diagnostics(options.log);
  if (!path.ends_with(kSceneSuffix)) {
    diagnostics.error({}, fmt::format("cannot write a scene to {}: its name tells no format", quoted(path, 200)),
                      ".xml");
    return diagnostics;
  }
  std::vector<std::string> written;
  counted(options, diagnostics, [&](const LoadOptions& in_budget) -> std::optional<LoadedScene> {
    const auto files =
        source.files.empty() ? std::make_unique<FileSystem>() : std::make_unique<MemoryFiles>(source.files);
    const std::string found = source.files.empty() ? find_scene(source.path, *files, diagnostics) : source.path;
    if (found.empty()) return std::nullopt;
    const auto description = read_scene_file(found, *files, in_budget, diagnostics);
    if (!description || diagnostics.has_errors()) return std::nullopt;
    SourceLocation whole_file;
    whole_file.file = found;
    within_memory(whole_file, "writing the scene", diagnostics,
                  [&] { written = write_mitsuba_xml(*description, path, *files, diagnostics); });
    return std::nullopt;
  });
  if (diagnostics.has_errors()) return diagnostics;
  return {std::move(written), std::move(diagnostics)};
}

std::vector<SceneFormat> scene_formats() {
  std::vector<SceneFormat> formats;
  for (const SceneReader& reader : scene_readers())
    formats.push_back({std::string(reader.name), {reader.suffixes.begin(), reader.suffixes.end()}});
  return formats;
}

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
