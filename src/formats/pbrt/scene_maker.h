// Gathers what a pbrt file's world is made of, and puts the scene together when all names are known.
#pragma once

#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "formats/pbrt/state.h"

namespace norrsken::pbrt {

class SceneMaker {
 public:
  explicit SceneMaker(Context& context) : context_(context), textures_(context), materials_(context, textures_) {}

  Textures& textures() { return textures_; }
  Materials& materials() { return materials_; }
  Node& scene() { return scene_; }
  Environment& environment() { return environment_; }

  /// Shape "type" ... of the world, or of the object that is open.
  void add_shape(const std::string& type, Parameters p, SharedParameters alpha, const GraphicsState& state);

  /// ObjectBegin, ObjectEnd. False if there is one of that name.
  bool begin_object(const std::string& name, const Place& place);
  void end_object() { open_object_ = nullptr; }
  bool in_object() const { return open_object_ != nullptr; }
  void add_instance(const std::string& name, const Place& place, const glm::dmat4& to_world);

  /// The scene, complete; asks for everything that has not been asked for.
  std::shared_ptr<const Node> finish(Settings& settings);

 private:
  struct Shape {
    Geometry geometry;
    MaterialUse material;
    std::shared_ptr<const AreaLight> light;
    std::optional<Parameters> alpha;  ///< if there is one
  };
  struct Object {
    Place place;
    std::vector<Shape> shapes;
  };
  struct Instance {
    std::string name;
    Place place;
    glm::dmat4 to_world;
  };

  void finish_shape(Shape& shape, Node& parent);
  void finish_instances();
  /// The material with the holes that "alpha" makes.
  std::shared_ptr<const Node> surface_of(Shape& shape);

  Context& context_;
  Textures textures_;
  Materials materials_;
  Node scene_{"scene"};
  Environment environment_;
  std::vector<Shape> shapes_;
  std::map<std::string, Object> objects_;
  Object* open_object_ = nullptr;
  std::vector<Instance> instances_;
  /// By the material and what says the alpha: many shapes have the same.
  std::map<std::pair<const Node*, std::string>, std::shared_ptr<const Node>> masks_;
};

}  // namespace norrsken::pbrt
