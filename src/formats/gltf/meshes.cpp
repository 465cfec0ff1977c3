#include "formats/gltf/meshes.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "formats/gltf/accessors.h"

namespace norrsken::gltf {
namespace {

constexpr std::size_t kMostSets = 8;

/// Triangles of `mode` among so many corners; empty for points and lines.
Array<std::uint32_t> triangles_of(std::size_t mode, std::size_t corners) {
  Array<std::uint32_t> list;
  const auto add = [&](std::size_t a, std::size_t b, std::size_t c) {
    for (const std::size_t i : {a, b, c}) list.push_back(static_cast<std::uint32_t>(i));
  };
  list.reserve(mode == 4 ? corners : 3 * corners);
  if (mode == 4) {
    for (std::size_t i = 0; i + 2 < corners; i += 3) add(i, i + 1, i + 2);
  } else if (mode == 5) {
    for (std::size_t i = 0; i + 2 < corners; ++i) add(i, i + 1 + i % 2, i + 2 - i % 2);
  } else if (mode == 6) {
    for (std::size_t i = 1; i + 1 < corners; ++i) add(i, i + 1, 0);
  }
  return list;
}

FloatArray plain(Asset& asset, const Numbers& numbers) {
  asset.memory.grow(sizeof(float) * numbers.values.size());
  return {numbers.values.begin(), numbers.values.end()};
}

/// Where nothing has, a shape would have no attributes either.
bool has_area(const Mesh& mesh) {
  const auto point = [&](std::size_t corner) {
    const float* p = &mesh.positions[3 * std::size_t{mesh.triangles[corner]}];
    return glm::dvec3(p[0], p[1], p[2]);
  };
  for (std::size_t i = 0; i + 2 < mesh.triangles.size(); i += 3) {
    const glm::dvec3 normal = glm::cross(point(i + 1) - point(i), point(i + 2) - point(i));
    if (glm::dot(normal, normal) > 0) return true;
  }
  return false;
}

/// One primitive on its way to a mesh.
class Primitive {
 public:
  Primitive(Asset& asset, Materials& materials, const Json& json, const Deformation& deformation)
      : asset_(asset), materials_(materials), json_(json), deformation_(deformation) {}

  void make(std::vector<Part>& parts) {
    attributes_ = asset_.member(json_, "attributes", Json::Kind::object);
    const std::size_t mode = asset_.whole(json_, "mode", 4);
    if (!attributes_ || mode > 6)
      return asset_.error(json_, "a primitive without 'attributes', or of an unknown mode", "modes 0 to 6");
    if (mode < 4) return asset_.tell(json_, "points and lines have no area", "nothing there");
    for (const char* packed : {"KHR_draco_mesh_compression"}) {
      if (asset_.extension(json_, packed))
        asset_.tell(json_, fmt::format("{} is not supported", packed), "what the accessors hold");
    }
    if (!attributes_->find("POSITION")) return asset_.tell(json_, "a primitive has no POSITION", "nothing there");
    const auto positions = vectors("POSITION", {"VEC3"}, 0);
    if (!positions || !read_triangles(mode) || triangles_.empty()) return;
    mesh_.positions = plain(asset_, *positions);
    read_normals();
    const Json* material = materials_.of_primitive(json_);
    if (!material) return;
    read_texcoords(material);
    read_colors();
    deform();
    finish(material, parts);
  }

 private:
  std::size_t vertices() const { return vertices_; }

  /// An attribute that there are as many of as of positions; empty if there is none, or after a complaint.
  std::optional<Numbers> vectors(const std::string& name, const std::vector<std::string>& types, std::size_t count) {
    if (!attributes_->find(name)) return std::nullopt;
    auto numbers = read_numbers(asset_, *attributes_, name, types);
    if (!numbers) return std::nullopt;
    if (name == "POSITION") vertices_ = numbers->count;
    if (count != 0 && numbers->count != count) {
      asset_.error(*attributes_->find(name),
                   fmt::format("{} has {} elements, POSITION {}", name, numbers->count, count), "as many");
      return std::nullopt;
    }
    return numbers;
  }

  bool read_triangles(std::size_t mode) {
    if (json_.find("indices")) {
      const auto indices = read_indices(asset_, json_, "indices");
      if (!indices) return false;
      const auto wrong = std::ranges::find_if(*indices, [&](std::uint32_t i) { return i >= vertices(); });
      if (wrong != indices->end()) {
        asset_.error(json_, fmt::format("index {} of {} vertices", *wrong, vertices()),
                     "indices of vertices that there are");
        return false;
      }
      triangles_ = triangles_of(mode, indices->size());
      for (std::uint32_t& corner : triangles_) corner = (*indices)[corner];
    } else {
      triangles_ = triangles_of(mode, vertices());
    }
    return true;
  }

  void read_normals() {
    const auto normals = vectors("NORMAL", {"VEC3"}, vertices());
    if (normals) mesh_.normals = plain(asset_, *normals);
  }

  void read_texcoords(const Json* material) {
    for (std::size_t set = 0; set < kMostSets; ++set) {
      if (attributes_->find(fmt::format("TEXCOORD_{}", set))) traits_.sets.push_back(set);
    }
    if (traits_.sets.empty()) return;
    const auto uv =
        vectors(fmt::format("TEXCOORD_{}", materials_.set_of(material, traits_.sets)), {"VEC2"}, vertices());
    if (uv) mesh_.texcoords = plain(asset_, *uv);
  }

  void read_colors() {
    const auto colors = vectors("COLOR_0", {"VEC3", "VEC4"}, vertices());
    if (!colors) return;
    asset_.memory.grow(sizeof(float) * 4 * vertices());
    Mesh::Attribute rgb{"vertex_color", 3, {}}, alpha{"vertex_alpha", 1, {}};
    bool is_white = true, is_opaque = true;
    for (std::size_t i = 0; i < vertices(); ++i) {
      for (std::size_t c = 0; c < 3; ++c) {
        rgb.values.push_back(std::clamp(colors->at(i)[c], 0.0f, 1.0f));
        is_white = is_white && rgb.values.back() == 1.0f;
      }
      alpha.values.push_back(colors->components == 4 ? std::clamp(colors->at(i)[3], 0.0f, 1.0f) : 1.0f);
      is_opaque = is_opaque && alpha.values.back() == 1.0f;
    }
    traits_.has_colors = !is_white, traits_.has_alpha = !is_opaque;
    if (!is_white) mesh_.attributes.push_back(std::move(rgb));
    if (!is_opaque) mesh_.attributes.push_back(std::move(alpha));
  }

  void morph() {
    const Json* targets = asset_.member(json_, "targets", Json::Kind::array);
    for (std::size_t k = 0; targets && k < targets->items.size() && k < deformation_.weights.size(); ++k) {
      const double weight = deformation_.weights[k];
      if (weight == 0) continue;
      for (const auto& [name, values] :
           {std::pair<const char*, FloatArray*>{"POSITION", &mesh_.positions}, {"NORMAL", &mesh_.normals}}) {
        if (!targets->items[k].find(name) || values->empty()) continue;
        const auto offsets = read_numbers(asset_, targets->items[k], name, {"VEC3"});
        if (!offsets || offsets->values.size() != values->size()) continue;
        for (std::size_t i = 0; i < values->size(); ++i)
          (*values)[i] += static_cast<float>(weight * double{offsets->values[i]});
      }
    }
  }

  void deform() {
    if (!deformation_.weights.empty()) morph();
    if (deformation_.joints.empty()) return;
    std::vector<std::pair<Numbers, Numbers>> influences;
    for (std::size_t set = 0; set < kMostSets; ++set) {
      auto joints = vectors(fmt::format("JOINTS_{}", set), {"VEC4"}, vertices());
      auto weights = vectors(fmt::format("WEIGHTS_{}", set), {"VEC4"}, vertices());
      if (joints && weights) influences.emplace_back(std::move(*joints), std::move(*weights));
    }
    for (std::size_t i = 0; i < vertices(); ++i) {
      glm::dmat4 blended(0);
      double sum = 0;
      for (const auto& [joints, weights] : influences) {
        for (std::size_t c = 0; c < 4; ++c) {
          const auto joint = static_cast<std::size_t>(std::max(joints.at(i)[c], 0.0f));
          const double weight = double{weights.at(i)[c]};
          if (weight == 0 || joint >= deformation_.joints.size()) continue;
          blended += weight * deformation_.joints[joint];
          sum += weight;
        }
      }
      blended = sum > 0 ? blended / sum : deformation_.joints[0];
      move(i, blended);
    }
  }

  void move(std::size_t i, const glm::dmat4& matrix) {
    const auto vector = [i](FloatArray& values) {
      return glm::dvec3(values[3 * i], values[3 * i + 1], values[3 * i + 2]);
    };
    const auto store = [i](FloatArray& values, const glm::dvec3& v) {
      for (int c = 0; c < 3; ++c) values[3 * i + static_cast<std::size_t>(c)] = static_cast<float>(v[c]);
    };
    store(mesh_.positions, glm::dvec3(matrix * glm::dvec4(vector(mesh_.positions), 1)));
    if (mesh_.normals.empty()) return;
    const glm::dmat3 linear(matrix);
    // The cofactors: the inverse transpose times the determinant.
    const glm::dmat3 cofactors(glm::cross(linear[1], linear[2]), glm::cross(linear[2], linear[0]),
                               glm::cross(linear[0], linear[1]));
    const glm::dvec3 normal = cofactors * vector(mesh_.normals);
    const double length = glm::length(normal);
    store(mesh_.normals, length > 0 ? normal / length : normal);
  }

  /// Whether a triangle's image is seen mirrored. In texture coordinates v goes down.
  bool is_mirrored(const std::uint32_t* corners) const {
    const auto uv = [&](int k, std::size_t c) { return mesh_.texcoords[2 * std::size_t{corners[k]} + c]; };
    return (uv(1, 0) - uv(0, 0)) * (uv(2, 1) - uv(0, 1)) > (uv(2, 0) - uv(0, 0)) * (uv(1, 1) - uv(0, 1));
  }

  void add(const Json* material, const PrimitiveTraits& traits, Mesh mesh, std::vector<Part>& parts) {
    if (!has_area(mesh)) return;
    Part part;
    part.is_flat = mesh.normals.empty();
    part.surface = materials_.surface(material, traits);
    part.mesh = std::make_shared<const Mesh>(std::move(mesh));
    parts.push_back(std::move(part));
  }

  void finish(const Json* material, std::vector<Part>& parts) {
    asset_.memory.grow(sizeof(std::uint32_t) * triangles_.size());
    if (!materials_.has_normal_map(material) || mesh_.texcoords.empty()) {
      mesh_.triangles.assign(triangles_.begin(), triangles_.end());
      return add(material, traits_, std::move(mesh_), parts);
    }
    IndexArray mirrored;
    for (std::size_t i = 0; i + 2 < triangles_.size(); i += 3) {
      IndexArray& list = is_mirrored(&triangles_[i]) ? mirrored : mesh_.triangles;
      list.insert(list.end(), triangles_.begin() + static_cast<std::ptrdiff_t>(i),
                  triangles_.begin() + static_cast<std::ptrdiff_t>(i) + 3);
    }
    PrimitiveTraits mirror = traits_;
    mirror.is_mirrored = true;
    if (!mirrored.empty()) {
      asset_.memory.grow(sizeof(float) * 12 * vertices());
      Mesh other = mesh_;
      other.triangles = std::move(mirrored);
      add(material, mirror, std::move(other), parts);
    }
    add(material, traits_, std::move(mesh_), parts);
  }

  Asset& asset_;
  Materials& materials_;
  const Json& json_;
  const Deformation& deformation_;
  const Json* attributes_ = nullptr;
  std::size_t vertices_ = 0;
  Array<std::uint32_t> triangles_;
  Mesh mesh_;
  PrimitiveTraits traits_;
};

}  // namespace

std::vector<Part> make_parts(Asset& asset, Materials& materials, const Json& mesh, const Deformation& deformation) {
  std::vector<Part> parts;
  const Json* primitives = asset.member(mesh, "primitives", Json::Kind::array);
  if (!primitives) {
    asset.error(mesh, "a mesh has no 'primitives'", "an array");
    return parts;
  }
  for (const Json& primitive : primitives->items) {
    if (primitive.kind == Json::Kind::object) {
      Primitive(asset, materials, primitive, deformation).make(parts);
    } else {
      asset.error(primitive, "a primitive is no object", "an object");
    }
  }
  return parts;
}

}  // namespace norrsken::gltf
