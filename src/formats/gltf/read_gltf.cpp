#include "formats/gltf/read_gltf.h"

#include <algorithm>
#include <memory>

#include "base/numbers.h"
#include "base/text.h"
#include "formats/gltf/scene_maker.h"

namespace norrsken {
namespace {

using gltf::Asset;
using gltf::Choices;
using gltf::Json;

/// Extensions that are understood as far as docs/gltf.md tells.
const std::vector<std::string>& known_extensions() {
  static const std::vector<std::string> known = {"EXT_mesh_gpu_instancing",    "KHR_lights_punctual",
                                                 "KHR_materials_clearcoat",    "KHR_materials_emissive_strength",
                                                 "KHR_materials_ior",          "KHR_materials_pbrSpecularGlossiness",
                                                 "KHR_materials_sheen",        "KHR_materials_specular",
                                                 "KHR_materials_transmission", "KHR_materials_unlit",
                                                 "KHR_materials_variants",     "KHR_materials_volume",
                                                 "KHR_mesh_quantization",      "KHR_node_visibility",
                                                 "KHR_texture_transform",      "KHR_xmp_json_ld"};
  return known;
}
/// Those of which the material's own part is told where it stands.
bool is_told_elsewhere(std::string_view name) {
  return name == "KHR_materials_iridescence" || name == "KHR_materials_anisotropy" ||
         name == "KHR_materials_dispersion" || name == "KHR_materials_diffuse_transmission";
}

bool read_boolean(const std::string& text, bool& value) {
  if (text != "true" && text != "false") return false;
  value = text == "true";
  return true;
}

void read_choice(Choices& choices, const std::string& name, const std::string& value, Diagnostics& diagnostics) {
  static const std::vector<std::string> names = {"allow_outside", "lumens_per_watt", "scene", "sky", "time", "variant"};
  bool ok = true, flag = false;
  std::string accepted;
  std::int64_t whole = 0;
  if (name == "scene") {
    ok = parse_integer(value, whole) == NumberStatus::ok && whole >= 0;
    choices.scene = static_cast<std::size_t>(std::max<std::int64_t>(whole, 0));
    accepted = "a number from 0 on";
  } else if (name == "variant") {
    choices.variant = value;
  } else if (name == "time") {
    ok = parse_number(value, choices.time) == NumberStatus::ok;
    choices.is_animated = true;
    accepted = "seconds";
  } else if (name == "lumens_per_watt") {
    ok = parse_number(value, choices.lumens_per_watt) == NumberStatus::ok && choices.lumens_per_watt > 0;
    accepted = "a number above 0";
  } else if (name == "sky" || name == "allow_outside") {
    ok = read_boolean(value, flag);
    if (name == "sky") {
      choices.sky = flag;
    } else {
      choices.allow_outside = flag;
    }
    accepted = "true or false";
  } else {
    return diagnostics.error(
        {}, fmt::format("-D{}: scenes of glTF have no such parameter{}", name, did_you_mean(name, names)), join(names));
  }
  if (!ok) diagnostics.error({}, fmt::format("-D{}={}: the value is wrong", name, shortened(value)), accepted);
}

void check_extensions(Asset& asset) {
  const std::vector<std::string>& known = known_extensions();
  std::vector<std::string> required;
  for (const Json& name : asset.items(asset.root(), "extensionsRequired")) {
    required.push_back(name.text);
    if (std::ranges::find(known, name.text) == known.end() && !is_told_elsewhere(name.text))
      asset.error(name, fmt::format("the file requires the extension {}, which is not supported", quoted(name.text)),
                  listed(known));
  }
  for (const Json& name : asset.items(asset.root(), "extensionsUsed")) {
    const bool is_known = std::ranges::find(known, name.text) != known.end() || is_told_elsewhere(name.text) ||
                          std::ranges::find(required, name.text) != required.end();
    if (!is_known)
      asset.tell(name, fmt::format("the extension {} is not supported", quoted(name.text)), "the file without it");
  }
}

}  // namespace

bool looks_like_gltf(std::string_view bytes) {
  if (bytes.starts_with("glTF")) return true;
  if (bytes.starts_with("\xEF\xBB\xBF")) bytes.remove_prefix(3);
  return trim(bytes.substr(0, 256)).starts_with('{') && bytes.find("\"asset\"") != std::string_view::npos;
}

std::optional<Description> read_gltf(const std::string& path, const FileSystem& files,
                                     const std::vector<std::pair<std::string, std::string>>& parameters,
                                     Diagnostics& diagnostics) {
  Asset asset(files, diagnostics, path);
  for (const auto& [name, value] : parameters) read_choice(asset.choices, name, value, diagnostics);
  if (diagnostics.has_errors() || !asset.open(path)) return std::nullopt;
  check_extensions(asset);
  if (diagnostics.has_errors()) return std::nullopt;
  Description description;
  description.scene = gltf::SceneMaker(asset).make();
  if (!description.scene || diagnostics.has_errors()) return std::nullopt;
  description.search_paths = {asset.folder()};
  description.parameters = parameters;
  description.memory = std::make_shared<MemoryReservation>(std::move(asset.memory));
  return description;
}

}  // namespace norrsken
