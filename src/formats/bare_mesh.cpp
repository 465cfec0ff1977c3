#include "formats/bare_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "base/memory.h"
#include "base/text.h"
#include "formats/mesh_readers.h"
#include "formats/mtl.h"
#include "formats/studio.h"

namespace norrsken {
namespace {

constexpr double kGrey = 0.6, kRoughness = 0.45;

class MeshScene {
 public:
  MeshScene(const std::string& path, const FileSystem& files, Diagnostics& diagnostics)
      : path_(path), files_(files), diagnostics_(diagnostics) {
    place_.file = path;
  }

  std::optional<Description> make() {
    std::optional<MeshData> data = read();
    if (!data || diagnostics_.has_errors()) return std::nullopt;
    if (data->triangles.empty()) {
      diagnostics_.error(place_, "the mesh has no triangles", "a mesh with faces");
      return std::nullopt;
    }
    const std::vector<float> numbers = take_material_numbers(*data);
    std::map<float, Mesh> meshes = split(*data, numbers);
    const auto libraries = read_materials();
    if (diagnostics_.has_errors()) return std::nullopt;
    for (auto& [number, mesh] : meshes) {
      bounds_.add(bounds_of(mesh), glm::dmat4(1));
      add_shape(std::move(mesh), number < 0 ? nullptr : find(libraries, names_.names[static_cast<std::size_t>(number)]),
                data->face_normals || (is_obj_ && data->normals.empty() && !names_.is_smooth));
    }
    scene_.add(studio_floor(bounds_, place_));
    scene_.add(sensor_around(bounds_, place_));
    scene_.add(studio_sky(place_));
    scene_.add(studio_integrator(place_));
    diagnostics_.note(place_,
                      fmt::format("a mesh without camera and light: it is framed, on a floor, under {}", kStudioText));
    Description description;
    description.scene = std::make_shared<const Node>(std::move(scene_));
    description.search_paths = {folder_of(path_)};
    description.memory = std::make_shared<MemoryReservation>(std::move(memory_));
    return description;
  }

 private:
  using Library = std::map<std::string, MtlMaterial>;

  std::optional<MeshData> read() {
    std::string error;
    const auto contents = read_counted(files_, path_, error);
    if (!contents) {
      diagnostics_.error(place_, "cannot read the mesh: " + error, "a PLY, OBJ or STL file");
      return std::nullopt;
    }
    std::string name = path_;
    std::ranges::transform(name, name.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    if (name.ends_with(".ply") || looks_like_ply(contents->bytes))
      return read_ply(contents->bytes, path_, diagnostics_);
    is_obj_ = name.ends_with(".obj");
    if (is_obj_) return read_obj_with_materials(contents->bytes, path_, diagnostics_, names_);
    auto mesh = read_stl(contents->bytes, path_, diagnostics_);
    if (!mesh) return mesh;
    for (auto& p : mesh->positions) p = {p[0], p[2], -p[1]};
    return mesh;
  }

  static std::vector<float> take_material_numbers(MeshData& data) {
    std::vector<float> numbers;
    std::erase_if(data.attributes, [&](const MeshAttribute& attribute) {
      if (attribute.name != ObjMaterials::kAttribute) return false;
      numbers.assign(attribute.values.begin(), attribute.values.end());
      return true;
    });
    return numbers;
  }

  /// A mesh for each material, with the vertices that it needs.
  std::map<float, Mesh> split(const MeshData& data, const std::vector<float>& numbers) {
    memory_.grow(data.triangles.size() * (sizeof(data.triangles[0]) + sizeof(std::size_t)) +
                 data.positions.size() * 11 * sizeof(float));
    std::map<float, std::vector<std::size_t>> triangles;
    for (std::size_t i = 0; i < data.triangles.size(); ++i)
      triangles[i < numbers.size() ? numbers[i] : -1].push_back(i);
    std::map<float, Mesh> meshes;
    std::vector<std::uint32_t> moved(data.positions.size(), kNowhere);
    for (const auto& [number, members] : triangles) {
      Mesh& mesh = meshes[number];
      for (const std::size_t i : members) {
        for (const std::uint32_t v : data.triangles[i]) {
          if (moved[v] == kNowhere) moved[v] = add_vertex(mesh, data, v);
          mesh.triangles.push_back(moved[v]);
        }
      }
      for (const std::size_t i : members) {
        for (const std::uint32_t v : data.triangles[i]) moved[v] = kNowhere;
      }
    }
    return meshes;
  }

  static std::uint32_t add_vertex(Mesh& mesh, const MeshData& data, std::uint32_t v) {
    const auto number = static_cast<std::uint32_t>(mesh.positions.size() / 3);
    const auto append = [](FloatArray& values, const auto& more) {
      values.insert(values.end(), more.begin(), more.end());
    };
    append(mesh.positions, data.positions[v]);
    if (!data.normals.empty()) append(mesh.normals, data.normals[v]);
    // In these files v goes up, in images down.
    if (!data.texcoords.empty()) append(mesh.texcoords, std::array{data.texcoords[v][0], 1 - data.texcoords[v][1]});
    add_attributes(mesh, data, v);
    return number;
  }

  static void add_attributes(Mesh& mesh, const MeshData& data, std::uint32_t v) {
    std::size_t k = 0;
    for (const MeshAttribute& attribute : data.attributes) {
      if (attribute.name != "vertex_color" || attribute.channels != 3) continue;
      if (mesh.attributes.size() <= k) mesh.attributes.push_back({attribute.name, 3, {}});
      for (std::size_t c = 0; c < 3; ++c)
        mesh.attributes[k].values.push_back(std::clamp(attribute.values[3 * std::size_t{v} + c], 0.0f, 1.0f));
      ++k;
    }
  }

  Library read_materials() {
    Library all;
    for (const std::string& name : names_.libraries) {
      const std::string path = folder_of(path_) + name;
      std::string error;
      const auto contents = read_counted(files_, path, error);
      if (contents) {
        all.merge(read_mtl(contents->bytes, path, diagnostics_));
      } else {
        diagnostics_.warning(place_,
                             fmt::format("cannot read the materials {}: {}; instead: grey", quoted(name, 200), error));
      }
    }
    return all;
  }

  const MtlMaterial* find(const Library& library, const std::string& name) {
    const auto found = library.find(name);
    if (found != library.end()) return &found->second;
    if (!library.empty())
      diagnostics_.warning(place_, fmt::format("there is no material {}; instead: grey", quoted(name)));
    return nullptr;
  }

  void set(Node& node, const char* name, Property::Value value) {
    node.set(name, std::move(value));
    node.properties.back().location = node.properties.back().name_location = place_;
  }
  Node make(const char* kind, const char* plugin) {
    Node node(kind, plugin);
    node.location = node.plugin_location = place_;
    return node;
  }

  Node bitmap(const std::string& name, const SourceLocation& at) {
    Node node = make("texture", "bitmap");
    std::string slashes = name;
    std::ranges::replace(slashes, '\\', '/');
    node.set("filename", slashes);
    node.properties.back().location = node.properties.back().name_location = at;
    return node;
  }

  Node surface(const MtlMaterial* material, bool has_colors) {
    Node bsdf = make("bsdf", "principled");
    if (!material) {
      if (has_colors) {
        Node colors = make("texture", "mesh_attribute");
        set(colors, "name", std::string("vertex_color"));
        bsdf.add(std::move(colors), "base_color");
      } else {
        set(bsdf, "base_color", Property::Rgb{{kGrey, kGrey, kGrey}});
      }
      set(bsdf, "roughness", kRoughness);
    } else {
      const MtlMaterial& m = *material;
      if (m.diffuse_map.empty()) {
        set(bsdf, "base_color", Property::Rgb{m.diffuse});
      } else {
        bsdf.add(bitmap(m.diffuse_map, m.diffuse_map_place), "base_color");
      }
      // Blinn's exponent to the slope, whose root is Disney's roughness.
      const double roughness = m.roughness >= 0 ? m.roughness : std::pow(2 / (m.exponent + 2), 0.25);
      const double specular = std::max({m.specular[0], m.specular[1], m.specular[2]});
      set(bsdf, "roughness", roughness);
      set(bsdf, "metallic", m.metallic);
      set(bsdf, "specular", m.metallic > 0 ? 0.5 : std::clamp(0.5 * specular, 0.0, 1.0));
    }
    Node sides = make("bsdf", "twosided");
    sides.add(std::move(bsdf));
    if (!material || (material->opacity == 1 && material->opacity_map.empty())) return sides;
    Node mask = make("bsdf", "mask");
    if (material->opacity_map.empty()) {
      set(mask, "opacity", material->opacity);
    } else {
      mask.add(bitmap(material->opacity_map, material->opacity_map_place), "opacity");
    }
    mask.add(std::move(sides));
    return mask;
  }

  void add_shape(Mesh mesh, const MtlMaterial* material, bool is_flat) {
    Node shape = make("shape", "mesh");
    if (is_flat) set(shape, "face_normals", true);
    shape.add(surface(material, !mesh.attributes.empty()));
    if (material && *std::ranges::max_element(material->emission) > 0) {
      Node light = make("emitter", "area");
      if (material->emission_map.empty()) {
        set(light, "radiance", Property::Rgb{material->emission});
      } else {
        light.add(bitmap(material->emission_map, material->emission_map_place), "radiance");
      }
      shape.add(std::move(light));
    }
    set(shape, "mesh", std::make_shared<const Mesh>(std::move(mesh)));
    scene_.add(std::move(shape));
  }

  static constexpr std::uint32_t kNowhere = 0xffffffffu;

  const std::string& path_;
  const FileSystem& files_;
  Diagnostics& diagnostics_;
  MemoryReservation memory_{0};
  SourceLocation place_;
  ObjMaterials names_;
  bool is_obj_ = false;
  Bounds bounds_;
  Node scene_{"scene"};
};

}  // namespace

bool looks_like_ply(std::string_view bytes) { return bytes.starts_with("ply\n") || bytes.starts_with("ply\r"); }

bool looks_like_stl(std::string_view bytes) {
  return trim(bytes.substr(0, 256)).starts_with("solid") &&
         bytes.substr(0, 1024).find("facet") != std::string_view::npos;
}

std::optional<Description> read_bare_mesh(const std::string& path, const FileSystem& files, Diagnostics& diagnostics) {
  return MeshScene(path, files, diagnostics).make();
}

}  // namespace norrsken
