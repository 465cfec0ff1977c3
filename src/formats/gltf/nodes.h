// The tree of nodes: where each stands, at the time that was asked for.
#pragma once

#include <glm/gtc/quaternion.hpp>
#include <glm/mat4x4.hpp>
#include <map>
#include <vector>

#include "formats/gltf/accessors.h"

namespace norrsken::gltf {

/// What a node says of its placement, or an animation in its place.
struct Pose {
  glm::dvec3 translation{0}, scale{1};
  glm::dquat rotation{1, 0, 0, 0};
  std::vector<double> weights = {};  ///< of morph targets; empty: those of the mesh
  glm::dmat4 matrix() const;
};

class Nodes {
 public:
  explicit Nodes(Asset& asset) : asset_(asset) {}

  /// Reads all nodes of the file; false after a complaint, such as of a node with two parents.
  bool read();

  std::size_t size() const { return all_.size(); }
  const Json& json(std::size_t i) const { return *all_[i].json; }
  const glm::dmat4& to_world(std::size_t i) const { return all_[i].to_world; }
  const std::vector<double>& weights(std::size_t i) const { return all_[i].weights; }
  /// The nodes of the chosen scene that are visible, parents first.
  std::vector<std::size_t> of_scene();

 private:
  struct One {
    const Json* json = nullptr;
    std::vector<std::size_t> children = {};
    bool has_parent = false;
    glm::dmat4 to_world{1};
    std::vector<double> weights = {};
  };
  glm::dmat4 local(const Json& node, Pose* animated);
  std::map<std::size_t, Pose> animate();
  Pose pose_of(const Json& node);

  Asset& asset_;
  std::vector<One> all_;
};

/// `matrix` with axes of length 1 at right angles, the last one first.
glm::dmat4 without_scale(const glm::dmat4& matrix);

}  // namespace norrsken::gltf
