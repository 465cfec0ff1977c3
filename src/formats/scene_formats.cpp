#include "formats/scene_formats.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstdint>

#include "base/text.h"
#include "formats/bare_mesh.h"
#include "formats/gltf/read_gltf.h"
#include "formats/mitsuba_xml.h"
#include "formats/pbrt/read_pbrt.h"

namespace norrsken {
namespace {

/// Beyond this nothing is looked into: the name has to tell.
constexpr std::uint64_t kMaxSniffedBytes = std::uint64_t{64} << 20;

bool looks_like_xml(std::string_view bytes) {
  if (bytes.starts_with("\xEF\xBB\xBF")) bytes.remove_prefix(3);
  return trim(bytes.substr(0, 256)).starts_with('<');
}

std::optional<Description> read_xml(const std::string& path, const FileSystem& files, const SceneArguments& arguments,
                                    Diagnostics& diagnostics) {
  return read_mitsuba_xml(path, files, arguments.parameters, diagnostics, arguments.preferred);
}

std::optional<Description> read_pbrt_scene(const std::string& path, const FileSystem& files,
                                           const SceneArguments& arguments, Diagnostics& diagnostics) {
  for (const auto& [name, value] : arguments.parameters)
    diagnostics.error({}, fmt::format("-D{}: scenes of pbrt have no parameters", name));
  return read_pbrt(path, files, diagnostics);
}

std::optional<Description> read_gltf_scene(const std::string& path, const FileSystem& files,
                                           const SceneArguments& arguments, Diagnostics& diagnostics) {
  return read_gltf(path, files, arguments.parameters, diagnostics);
}

std::optional<Description> read_mesh_scene(const std::string& path, const FileSystem& files,
                                           const SceneArguments& arguments, Diagnostics& diagnostics) {
  for (const auto& [name, value] : arguments.parameters)
    diagnostics.error({}, fmt::format("-D{}: meshes have no parameters", name));
  return read_bare_mesh(path, files, diagnostics);
}

/// Nothing that text of another format would not begin with, too.
bool looks_like_nothing(std::string_view /*bytes*/) { return false; }

}  // namespace

std::span<const SceneReader> scene_readers() {
  static const std::vector<SceneReader> readers = {{"Mitsuba XML", {".xml"}, looks_like_xml, read_xml},
                                                   {"pbrt", {".pbrt", ".pbrt.gz"}, looks_like_pbrt, read_pbrt_scene},
                                                   {"glTF", {".gltf", ".glb"}, looks_like_gltf, read_gltf_scene},
                                                   {"PLY", {".ply"}, looks_like_ply, read_mesh_scene},
                                                   {"OBJ", {".obj"}, looks_like_nothing, read_mesh_scene},
                                                   {"STL", {".stl"}, looks_like_stl, read_mesh_scene}};
  return readers;
}

const SceneReader& reader_of(const std::string& path, const FileSystem& files) {
  const std::span<const SceneReader> readers = scene_readers();
  std::string name = path;
  std::ranges::transform(name, name.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  const auto by_name = std::ranges::find_if(readers, [&](const SceneReader& reader) {
    return std::ranges::any_of(reader.suffixes, [&](std::string_view suffix) { return name.ends_with(suffix); });
  });
  if (by_name != readers.end()) return *by_name;
  std::string ignored;
  const auto bytes =
      readers.size() > 1 && files.size(path) <= kMaxSniffedBytes ? files.read(path, ignored) : std::nullopt;
  const auto by_bytes = std::ranges::find_if(readers, [&](const SceneReader& r) { return bytes && r.sniff(*bytes); });
  return by_bytes != readers.end() ? *by_bytes : readers.front();
}

}  // namespace norrsken
