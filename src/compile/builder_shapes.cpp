// The builder's part that is about shapes, what they are made of, and lights.
#include <fmt/format.h>

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <utility>

#include "base/text.h"
#include "compile/builder.h"
#include "compile/plugins.h"
#include "scene/within_memory.h"

namespace norrsken {
namespace {

bool is_delta(LightKind kind) {
  switch (kind) {
#define NORRSKEN_LIGHT(name, Model, is_delta) \
  case LightKind::name:                       \
    return is_delta;
#include "lists/light.def"
#undef NORRSKEN_LIGHT
    default:
      return false;
  }
}

/// Mitsuba's coordinates of a mesh without any are barycentric, and so are those of our tables, but in the order of the
/// winding. Where that is not the file's, every triangle gets corners of its own that say them.
void give_rewound_texcoords(MeshData& mesh) {
  if (std::ranges::find(mesh.rewound, true) == mesh.rewound.end()) return;
  const auto unshare = [&]<class T>(Array<T>& values) {
    if (values.empty()) return;
    Array<T> own;
    own.reserve(3 * mesh.triangles.size());
    for (const auto& t : mesh.triangles) {
      for (const std::uint32_t vertex : t) own.push_back(values[vertex]);
    }
    values = std::move(own);
  };
  unshare(mesh.positions);
  unshare(mesh.normals);
  for (MeshAttribute& attribute : mesh.attributes) {
    if (attribute.per_face) continue;
    decltype(attribute.values) own;
    own.reserve(3 * mesh.triangles.size() * attribute.channels);
    for (const auto& t : mesh.triangles) {
      for (const std::uint32_t vertex : t) {
        const auto first = attribute.values.begin() + std::ptrdiff_t{vertex} * attribute.channels;
        own.insert(own.end(), first, first + attribute.channels);
      }
    }
    attribute.values = std::move(own);
  }
  mesh.texcoords.reserve(3 * mesh.triangles.size());
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto corner = static_cast<std::uint32_t>(3 * i);
    mesh.triangles[i] = {corner, corner + 1, corner + 2};
    const float second = mesh.rewound[i] ? 0.0f : 1.0f;
    mesh.texcoords.push_back({0, 0});
    mesh.texcoords.push_back({second, 1 - second});
    mesh.texcoords.push_back({1 - second, second});
  }
}

}  // namespace

void Builder::compile_emitter(const Node& node, std::uint32_t shape) {
  const auto* plugin = find_plugin(emitter_plugins(), node, diagnostics_);
  if (!plugin) return;
  Parameters p = parameters(node);
  sampling_weight_ = read_sampling_weight(p);
  medium_around(p);  // which paths from the camera need not know
  const std::size_t before = tables().lights.size();
  Lights lights(*this);
  within_memory(node.location, "emitter " + quoted(node.plugin), diagnostics_,
                [&] { plugin->compile(p, lights, shape); });
  p.finish();
  if (sampling_weight_ > 0 || tables().lights.size() == before) return;
  if (is_delta(tables().lights.back().kind) || !tables().integrator.finds_lights()) {
    diagnostics_.warning(
        p.where("sampling_weight"),
        fmt::format("the light of emitter {} is lost: with a 'sampling_weight' of 0 it is not sampled, "
                    "and nothing else finds it",
                    quoted(node.plugin)),
        "a sampling_weight above 0");
  }
}

Material Builder::material_of(Parameters& shape) {
  if (const Node::Child* child = shape.child("bsdf")) return bsdf(*child->node);
  // Mitsuba's material for shapes that name none: lights are black, others grey.
  if (shape.child("emitter") != nullptr) return {};
  if (!default_material_) {
    Materials materials(*this);
    default_material_ = default_material(materials);
  }
  return *default_material_;
}

void Builder::compile_shape(const Node& node) {
  const auto* plugin = find_plugin(shape_plugins(), node, diagnostics_);
  if (!plugin) return;
  Parameters p = parameters(node);
  if (!geometry_.in_group()) geometry_.forget_latest();
  within_memory(p.has("filename") ? p.where("filename") : node.location, "shape " + quoted(node.plugin), diagnostics_,
                [&] { compile_shape(p, plugin->compile); });
  if (!geometry_.in_group()) remember_if_beyond_view(node);
}

void Builder::remember_if_beyond_view(const Node& node) {
  const GeometryBuilder::Box& box = geometry_.latest();
  if (box.empty() || default_sensor_) return;
  const CameraRecord& camera = tables().camera;
  const auto vector = [](const float(&v)[3]) { return glm::dvec3(v[0], v[1], v[2]); };
  const glm::dvec3 forward = vector(camera.forward);
  const double middle = glm::dot((box.lower + box.upper) / 2.0 - vector(camera.origin), forward);
  const double half = glm::dot((box.upper - box.lower) / 2.0, glm::abs(forward));
  if (middle - half <= static_cast<double>(camera.far_clip)) return;
  beyond_view_.push_back(&node);
  farthest_ = std::max(farthest_, middle + half);
}

void Builder::tell_what_is_beyond_view() {
  if (beyond_view_.empty()) return;
  constexpr std::size_t kNamed = 5;
  std::vector<std::string> names;
  for (std::size_t i = 0; i < std::min(kNamed, beyond_view_.size()); ++i) {
    const Node& node = *beyond_view_[i];
    names.push_back(node.id.empty() ? fmt::format("a {} in line {}", node.plugin, node.location.line)
                                    : quoted(node.id));
  }
  if (beyond_view_.size() > kNamed) names.push_back(fmt::format("and {} more", beyond_view_.size() - kNamed));
  diagnostics_.warning(view_place_,
                       fmt::format("what is farther away than 'far_clip', {:g}, is not seen: {}",
                                   static_cast<double>(tables().camera.far_clip), join(names)),
                       fmt::format("a far_clip of at least {:.3g}", farthest_));
}

void Builder::compile_shape(Parameters& p, CompileShape* compile) {
  const Node& node = p.node();
  Shapes shapes(*this);
  // An empty shape stands in for a broken one, so that its emitter's complaints are heard too.
  ShapeGeometry geometry = compile(p, shapes).value_or(ShapeGeometry{});
  if (!geometry.of_shapes) {
    const Material material = material_of(p);
    const Node::Child* emitter = p.child("emitter");
    attributes_.check(node, geometry.mesh.attributes, diagnostics_);
    if (geometry.mesh.texcoords.empty() && !geometry.mesh.triangles.empty()) want_texcoords(node);
    const bool looks_at_uv = material.variation != Variation::none || texture_by_uv(node) != nullptr;
    if (looks_at_uv) give_rewound_texcoords(geometry.mesh);
    const std::vector<MeshAttribute> attributes = std::move(geometry.mesh.attributes);
    const auto first_vertex = static_cast<std::uint32_t>(tables().positions.size() / 3);
    const std::uint32_t first_triangle = tables().triangle_count();
    const std::uint32_t shape = geometry_.add(std::move(geometry), material);
    attributes_.add(shape, first_vertex, first_triangle, attributes);
    compile_media_of(p, tables().shapes[shape]);
    if (!node.id.empty()) {
      scene_.shape_ids.resize(shape + 1);
      scene_.shape_ids[shape] = node.id;
    }
    if (emitter && geometry_.in_group()) {
      diagnostics_.error(emitter->location, "an emitter stands inside a shapegroup, whose instances cannot shine",
                         "emitters on shapes of the scene itself");
    } else if (emitter) {
      variation_ = Variation::none;
      compile_emitter(*emitter->node, shape);
      ShapeRecord& record = tables().shapes[shape];
      record.variation = std::max(record.variation, variation_);
    }
  }
  p.children("sensor");  // which stand beside the shape
  refuse_kinds_to_come(p);
  p.finish();
}

std::optional<ShapeGeometry> Builder::surface(const Node& node, bool is_heard) {
  Diagnostics unheard;
  Diagnostics& diagnostics = is_heard ? diagnostics_ : unheard;
  const auto* plugin = find_plugin(shape_plugins(), node, diagnostics);
  if (!plugin) return std::nullopt;
  Parameters p(node, description_, files_, diagnostics);
  Shapes shapes(*this);
  is_silent_ = true;
  std::optional<ShapeGeometry> surface = plugin->compile(p, shapes);
  is_silent_ = false;
  for (const char* kind : {"bsdf", "emitter", "sensor"}) p.children(kind);
  p.finish();
  return surface;
}

std::uint32_t Builder::shape_group(const Node& node) {
  if (const auto known = groups_.find(&node); known != groups_.end()) return known->second;
  Parameters p = parameters(node);
  geometry_.begin_group();
  const auto shapes = p.children("shape");
  if (shapes.empty()) diagnostics_.warning(node.location, "the shapegroup has no shape");
  for (const Node::Child* child : shapes) compile_shape(*child->node);
  p.finish();
  return groups_[&node] = geometry_.end_group();
}

}  // namespace norrsken
