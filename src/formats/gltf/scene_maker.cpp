#include "formats/gltf/scene_maker.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>

#include "base/text.h"
#include "formats/two_sides.h"

namespace norrsken::gltf {
namespace {

/// Copies of a mesh are traced faster than instances, as long as they take little memory.
constexpr std::size_t kMostCopied = 500000;  // triangles
constexpr std::size_t kNodeBytes = 1024;     // about what a shape takes in the description

std::size_t triangles_of(const std::vector<Part>& parts) {
  std::size_t count = 0;
  for (const Part& part : parts) count += part.mesh->triangles.size() / 3;
  return count;
}

bool shines(const std::vector<Part>& parts) {
  return std::ranges::any_of(parts, [](const Part& part) { return part.surface.emitter != nullptr; });
}

bool is_placement(const glm::dmat4& matrix) {
  for (int c = 0; c < 4; ++c) {
    for (int r = 0; r < 4; ++r) {
      if (!(std::abs(matrix[c][r]) < kMaxCoordinate)) return false;
    }
  }
  return std::isnormal(glm::determinant(glm::dmat3(matrix)));
}

}  // namespace

Node SceneMaker::shape_of(const Part& part, const glm::dmat4& to_world) {
  asset_.memory.grow(kNodeBytes);
  const SourceLocation place = part.surface.bsdf->location;
  Node shape = make_node("shape", "mesh", place);
  give(shape, "mesh", part.mesh, place);
  if (part.is_flat) give(shape, "face_normals", true, place);
  if (to_world != glm::dmat4(1)) give(shape, "to_world", to_transform(to_world), place);
  // Normals keep to their side of a mirrored surface; where there are none the order of the corners tells the front.
  if (part.is_flat && glm::determinant(glm::dmat3(to_world)) < 0) give(shape, "flip_normals", true, place);
  shape.children.push_back({{}, part.surface.bsdf, place});
  return shape;
}

void SceneMaker::add_parts(const std::vector<Part>& parts, const glm::dmat4& to_world) {
  for (const Part& part : parts) {
    bounds_.add(bounds_of(*part.mesh), to_world);
    std::vector<Part> sides{part};
    if (part.surface.emitter && part.surface.shines_on_both_sides) {
      asset_.memory.grow(2 * sizeof(float) *
                         (part.mesh->positions.size() + part.mesh->normals.size() + part.mesh->texcoords.size()));
      sides.clear();
      for (Mesh& side : two_sides(*part.mesh)) {
        sides.push_back(part);
        sides.back().mesh = std::make_shared<const Mesh>(std::move(side));
      }
    }
    for (const Part& side : sides) {
      Node shape = shape_of(side, to_world);
      if (side.surface.emitter) shape.children.push_back({{}, side.surface.emitter, shape.location});
      scene_.add(std::move(shape));
    }
  }
}

std::vector<glm::dmat4> SceneMaker::instances_of(const Json& node, const glm::dmat4& to_world) {
  const Json* extension = asset_.extension(node, "EXT_mesh_gpu_instancing");
  const Json* attributes = extension ? asset_.member(*extension, "attributes", Json::Kind::object) : nullptr;
  if (!attributes) return {to_world};
  const auto translations = read_numbers(asset_, *attributes, "TRANSLATION", {"VEC3"});
  const auto rotations = read_numbers(asset_, *attributes, "ROTATION", {"VEC4"});
  const auto scales = read_numbers(asset_, *attributes, "SCALE", {"VEC3"});
  std::optional<std::size_t> count;
  for (const auto* numbers : {&translations, &rotations, &scales}) {
    if (!*numbers) continue;
    if (count.value_or((*numbers)->count) != (*numbers)->count) {
      asset_.error(*attributes, "attributes of instances have different counts", "as many of each");
      return {};
    }
    count = (*numbers)->count;
  }
  asset_.memory.grow(count.value_or(1) * sizeof(glm::dmat4));
  std::vector<glm::dmat4> places;
  for (std::size_t i = 0; i < count.value_or(0); ++i) {
    Pose pose;
    if (translations) pose.translation = {translations->at(i)[0], translations->at(i)[1], translations->at(i)[2]};
    if (scales) pose.scale = {scales->at(i)[0], scales->at(i)[1], scales->at(i)[2]};
    if (rotations) {
      const float* q = rotations->at(i);
      const glm::dquat rotation(q[3], q[0], q[1], q[2]);
      if (glm::length(rotation) > 0) pose.rotation = glm::normalize(rotation);
    }
    places.push_back(to_world * pose.matrix());
  }
  return places;
}

std::vector<glm::dmat4> SceneMaker::joints_of(const Json& skin) {
  std::vector<glm::dmat4> joints;
  const auto inverse = read_numbers(asset_, skin, "inverseBindMatrices", {"MAT4"});
  for (const Json& joint : asset_.items(skin, "joints")) {
    const bool exists =
        joint.kind == Json::Kind::number && joint.number >= 0 && joint.number < static_cast<double>(nodes_.size());
    if (!exists) {
      asset_.error(joint, "there is no such node", fmt::format("below {}", nodes_.size()));
      return {};
    }
    glm::dmat4 matrix(1);
    if (inverse && joints.size() < inverse->count) {
      for (int k = 0; k < 16; ++k) matrix[k / 4][k % 4] = double{inverse->at(joints.size())[k]};
    }
    joints.push_back(nodes_.to_world(static_cast<std::size_t>(joint.number)) * matrix);
  }
  return joints;
}

void SceneMaker::add_mesh(std::size_t i) {
  const Json& node = nodes_.json(i);
  const Json* mesh = asset_.referred(node, "mesh", "meshes");
  if (!mesh) return;
  Deformation deformation;
  deformation.weights = nodes_.weights(i);
  if (deformation.weights.empty()) {
    for (const Json& weight : asset_.items(*mesh, "weights")) deformation.weights.push_back(weight.number);
  }
  if (const Json* skin = asset_.referred(node, "skin", "skins")) {
    deformation.joints = joints_of(*skin);
    if (!deformation.joints.empty())
      return add_parts(make_parts(asset_, materials_, *mesh, deformation), glm::dmat4(1));
  }
  std::vector<glm::dmat4> places = instances_of(node, nodes_.to_world(i));
  if (std::erase_if(places, [](const glm::dmat4& place) { return !is_placement(place); }) > 0)
    asset_.tell(node, "a mesh is placed where it has no volume", "nothing there");
  if (std::ranges::any_of(deformation.weights, [](double weight) { return weight != 0; })) {
    const std::vector<Part> parts = make_parts(asset_, materials_, *mesh, deformation);
    for (const glm::dmat4& place : places) add_parts(parts, place);
    return;
  }
  const auto [use, is_new] = meshes_.try_emplace(mesh);
  if (is_new) use->second.parts = make_parts(asset_, materials_, *mesh, {});
  use->second.places.insert(use->second.places.end(), places.begin(), places.end());
}

void SceneMaker::add_shared_meshes() {
  std::size_t groups = 0;
  for (const auto& [json, use] : meshes_) {
    if (use.parts.empty()) continue;
    if (use.places.size() < 2 || shines(use.parts) || triangles_of(use.parts) * use.places.size() <= kMostCopied) {
      for (const glm::dmat4& place : use.places) add_parts(use.parts, place);
      continue;
    }
    const SourceLocation place = asset_.place(*json);
    Node group = make_node("shape", "shapegroup", place);
    group.id = fmt::format("mesh_{}", groups++);
    Bounds bounds;
    for (const Part& part : use.parts) {
      bounds.add(bounds_of(*part.mesh), glm::dmat4(1));
      group.add(shape_of(part, glm::dmat4(1)));
    }
    const auto shared = std::make_shared<const Node>(std::move(group));
    scene_.children.push_back({{}, shared, place});
    for (const glm::dmat4& to_world : use.places) {
      asset_.memory.grow(kNodeBytes);
      bounds_.add(bounds, to_world);
      Node instance = make_node("shape", "instance", place);
      give(instance, "to_world", to_transform(to_world), place);
      instance.children.push_back({{}, shared, place});
      scene_.add(std::move(instance));
    }
  }
}

void SceneMaker::add_camera(std::size_t i) {
  const Json& node = nodes_.json(i);
  const Json* camera = asset_.referred(node, "camera", "cameras");
  if (!camera) return;
  const std::string type = asset_.string(*camera, "type");
  const Json* lens =
      asset_.member(*camera, type == "orthographic" ? "orthographic" : "perspective", Json::Kind::object);
  if (!lens || (type != "perspective" && type != "orthographic"))
    return asset_.error(*camera, fmt::format("a camera of type {}", quoted(type)),
                        "perspective or orthographic, with an object of that name");
  const SourceLocation place = asset_.place(*camera);
  // glTF's cameras look along -z with +x to the right, ours along +z with +x to the left.
  glm::dmat4 to_world = glm::scale(without_scale(nodes_.to_world(i)), glm::dvec3(-1, 1, -1));
  double aspect = 4.0 / 3;
  Node sensor = make_node("sensor", type, place);
  sensor.id = asset_.string(node, "name", asset_.string(*camera, "name"));
  if (type == "perspective") {
    aspect = asset_.number(*lens, "aspectRatio", aspect, 1e-3, 1e3);
    const double yfov = asset_.number(*lens, "yfov", std::numbers::pi / 4, 1e-4, std::numbers::pi - 1e-4);
    give(sensor, "fov", yfov * 180 / std::numbers::pi, place);
    give(sensor, "fov_axis", std::string("y"), place);
  } else {
    const double x = std::abs(asset_.number(*lens, "xmag", 1)), y = std::abs(asset_.number(*lens, "ymag", 1));
    if (!(x > 0 && y > 0))
      return asset_.error(*lens, "an orthographic camera sees nothing: xmag or ymag is 0", "numbers above 0");
    aspect = x / y;
    to_world = glm::scale(to_world, glm::dvec3(x, x, 1));
  }
  const double near = std::max(asset_.number(*lens, "znear", 0.01, 0), 1e-6);
  give(sensor, "near_clip", near, place);
  give(sensor, "far_clip", std::max(asset_.number(*lens, "zfar", 1e11, 0), 2 * near), place);
  give(sensor, "to_world", to_transform(to_world), place);
  add_film(sensor, std::clamp(aspect, 0.05, 14.0), place);
  scene_.add(std::move(sensor));
  has_camera_ = true;
}

void SceneMaker::add_spot(const Json& light, const Property::Rgb& intensity, const glm::dmat4& to_world) {
  const Json* given = asset_.member(light, "spot", Json::Kind::object);
  const Json& spot = given ? *given : no_members();
  const double outer = asset_.number(spot, "outerConeAngle", std::numbers::pi / 4, 0, std::numbers::pi / 2);
  const double inner = std::min(asset_.number(spot, "innerConeAngle", 0, 0), outer);
  const SourceLocation place = asset_.place(light);
  Node node = make_node("emitter", "spot", place);
  give(node, "intensity", intensity, place);
  give(node, "to_world", to_transform(glm::scale(to_world, glm::dvec3(-1, 1, -1))), place);
  // The square of what goes linearly with the cosine, as a picture that the spot throws.
  constexpr double kWidestPicture = 85 * std::numbers::pi / 180;
  const double cutoff = std::clamp(outer, 1e-3, kWidestPicture);
  if (outer > kWidestPicture)
    asset_.tell(light, "a spot wider than 85 degrees on each side is not supported", "one of 85 degrees");
  give(node, "cutoff_angle", cutoff * 180 / std::numbers::pi, place);
  give(node, "beam_width", cutoff * 180 / std::numbers::pi, place);
  constexpr int kTexels = 512;
  Image image;
  image.width = image.height = kTexels;
  image.channels.push_back({"Y", {}});
  const double half = std::tan(cutoff), end = std::cos(outer), range = std::max(std::cos(inner) - end, 1e-3);
  for (int row = 0; row < kTexels; ++row) {
    for (int column = 0; column < kTexels; ++column) {
      const double x = half * (1 - 2 * (column + 0.5) / kTexels), y = half * (1 - 2 * (row + 0.5) / kTexels);
      const double share = std::clamp((1 / std::sqrt(1 + x * x + y * y) - end) / range, 0.0, 1.0);
      image.channels[0].values.push_back(static_cast<float>(share * share));
    }
  }
  asset_.memory.grow(sizeof(float) * kTexels * kTexels);
  Node picture = make_node("texture", "bitmap", place);
  give(picture, "image", std::make_shared<const Image>(std::move(image)), place);
  give(picture, "wrap_mode", std::string("clamp"), place);
  node.add(std::move(picture), "texture");
  scene_.add(std::move(node));
}

void SceneMaker::add_light(std::size_t i) {
  const Json* use = asset_.extension(nodes_.json(i), "KHR_lights_punctual");
  const Json* all = use ? asset_.extension(asset_.root(), "KHR_lights_punctual") : nullptr;
  const auto number = use ? asset_.index(*use, "light") : std::nullopt;
  if (!number) return;
  const std::vector<Json>& lights = all ? asset_.items(*all, "lights") : asset_.items(*use, "lights");
  if (*number >= lights.size())
    return asset_.error(*use, fmt::format("there is no light {}", *number), fmt::format("below {}", lights.size()));
  const Json& light = lights[*number];
  const std::string type = asset_.string(light, "type");
  const auto color = asset_.numbers<3>(light, "color", {1, 1, 1});
  const double scale = asset_.number(light, "intensity", 1, 0) / asset_.choices.lumens_per_watt;
  Property::Rgb emission;
  for (std::size_t c = 0; c < 3; ++c) emission.value[c] = std::max(color[c], 0.0) * scale;
  const glm::dmat4 to_world = without_scale(nodes_.to_world(i));
  const SourceLocation place = asset_.place(light);
  asset_.diagnostics.note(
      asset_.place(*use),
      fmt::format("{:g} candela or lux of a light are 1 W/sr or W/m^2", asset_.choices.lumens_per_watt),
      "-Dlumens_per_watt=N");
  if (light.find("range"))
    asset_.diagnostics.note(asset_.place(*light.find("range")),
                            "'range' of a light has no effect: its light falls off with the squared distance");
  has_light_ = true;
  if (type == "directional") {
    Node node = make_node("emitter", "directional", place);
    give(node, "direction", Property::Vector{to_array(-glm::dvec3(to_world[2]))}, place);
    give(node, "irradiance", emission, place);
    scene_.add(std::move(node));
  } else if (type == "point") {
    Node node = make_node("emitter", "point", place);
    give(node, "position", Property::Vector{to_array(glm::dvec3(to_world[3]))}, place);
    give(node, "intensity", emission, place);
    scene_.add(std::move(node));
  } else if (type == "spot") {
    add_spot(light, emission, to_world);
  } else {
    asset_.error(light, fmt::format("unknown type of light {}", quoted(type)), "directional, point, spot");
  }
}

void SceneMaker::complete() {
  SourceLocation place;
  place.file = asset_.place(asset_.root()).file;
  if (!has_camera_) {
    scene_.add(sensor_around(bounds_, place));
    asset_.diagnostics.note(place, "the scene has no camera: all of it is framed");
  }
  if (asset_.choices.sky.value_or(!has_light_)) {
    scene_.add(studio_sky(place));
    if (!asset_.choices.sky)
      asset_.diagnostics.note(place, fmt::format("the scene has no light: {} is added", kStudioText), "-Dsky=false");
  }
  scene_.add(studio_integrator(place));
}

std::shared_ptr<const Node> SceneMaker::make() {
  if (!nodes_.read()) return nullptr;
  const std::vector<std::size_t> visible = nodes_.of_scene();
  for (const std::size_t i : visible) {
    add_mesh(i);
    add_camera(i);
    add_light(i);
  }
  if (asset_.diagnostics.has_errors()) return nullptr;
  add_shared_meshes();
  complete();
  return std::make_shared<const Node>(std::move(scene_));
}

}  // namespace norrsken::gltf
