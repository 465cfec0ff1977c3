// Puts the description of a glTF scene together: what its nodes hold, and what it lacks.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "formats/gltf/meshes.h"
#include "formats/gltf/nodes.h"
#include "formats/studio.h"

namespace norrsken::gltf {

class SceneMaker {
 public:
  explicit SceneMaker(Asset& asset) : asset_(asset), materials_(asset), nodes_(asset) {}

  /// Null after complaints.
  std::shared_ptr<const Node> make();

 private:
  /// A mesh of the file without deformation, and where it stands.
  struct MeshUse {
    std::vector<Part> parts;
    std::vector<glm::dmat4> places;
  };

  void add_mesh(std::size_t node);
  void add_parts(const std::vector<Part>& parts, const glm::dmat4& to_world);
  void add_shared_meshes();
  Node shape_of(const Part& part, const glm::dmat4& to_world);
  std::vector<glm::dmat4> instances_of(const Json& node, const glm::dmat4& to_world);
  std::vector<glm::dmat4> joints_of(const Json& skin);
  void add_camera(std::size_t node);
  void add_light(std::size_t node);
  void add_spot(const Json& light, const Property::Rgb& intensity, const glm::dmat4& to_world);
  void complete();

  Asset& asset_;
  Materials materials_;
  Nodes nodes_;
  Node scene_{"scene"};
  Bounds bounds_;
  std::map<const Json*, MeshUse> meshes_;
  bool has_camera_ = false, has_light_ = false;
};

}  // namespace norrsken::gltf
