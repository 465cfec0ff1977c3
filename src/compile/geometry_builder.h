// The surfaces' part of the tables: triangles as they come, everything else behind them when all shapes are known.
#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <limits>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "compile/material.h"
#include "compile/shape_geometry.h"
#include "norrsken/diagnostics.h"
#include "norrsken/scene.h"
#include "scene/description.h"
#include "tables/scene_tables.h"

namespace norrsken {

/// A placement in single precision.
Placement make_placement(const glm::dmat4& world_from_local);

class GeometryBuilder {
 public:
  struct Box {
    glm::dvec3 lower{std::numeric_limits<double>::infinity()}, upper{-std::numeric_limits<double>::infinity()};
    void extend(const glm::dvec3& p, double radius = 0);
    void extend(const Box& box, const glm::dmat4& map);
    bool empty() const { return lower.x > upper.x; }
  };

  GeometryBuilder(SceneTables& tables, Diagnostics& diagnostics) : tables_(tables), diagnostics_(diagnostics) {}

  /// Lets go of the mesh's arrays as it copies them: a large mesh is never in memory twice. Returns the shape's number.
  std::uint32_t add(ShapeGeometry geometry, Material material);
  bool is_sphere(std::uint32_t shape) const { return classes_[shape] == Class::sphere; }
  bool is_analytic(std::uint32_t shape) const { return classes_[shape] == Class::analytic; }
  /// The records of a shape's primitives, until the next shape is added.
  std::span<SurfaceRecord> surfaces_of(std::uint32_t shape);
  /// Makes a primitive, counted within its shape, part of a light.
  void set_light(std::uint32_t shape, std::uint32_t primitive, std::uint32_t light);

  /// What is added until `end_group` belongs to a group, which only its instances show. Groups are not nested.
  void begin_group() { group_ = tables_.group_count++; }
  /// Returns the group's number.
  std::uint32_t end_group();
  bool in_group() const { return group_ != kNone; }
  /// False if the group would reach out of range there.
  bool add_instance(std::uint32_t group, const glm::dmat4& world_from_object);

  /// Bounds in the world of the shape or instance that was added last; empty if nothing was since `forget_latest`.
  const Box& latest() const { return latest_; }
  void forget_latest() { latest_ = {}; }

  /// Bounds of all that was added to the world.
  Box bounds() const {
    const auto world = boxes_.find(kNone);
    return world == boxes_.end() ? Box{} : world->second;
  }

  /// Puts spheres and analytic primitives behind the triangles, and tells the bounds of it all.
  void finish(SceneInfo& info);

 private:
  enum class Class { triangles, sphere, analytic };

  Array<SurfaceRecord>& surfaces(Class of);
  void add_spheres(const std::vector<ShapeGeometry::Sphere>& spheres, Material material, ShapeRecord& record, Box& box);
  void add_analytic(const AnalyticShape& analytic, Material material, Box& box);
  void add_triangles(MeshData mesh, Material material, Box& box);
  /// Sets `turned_below` of the triangles from this one on, whose vertices have normals.
  void tell_turns(std::size_t first_triangle);
  std::uint32_t next_shape() const { return static_cast<std::uint32_t>(tables_.shapes.size()); }

  SceneTables& tables_;
  Diagnostics& diagnostics_;
  std::vector<Class> classes_;                ///< by shape
  Array<SurfaceRecord> spheres_, analytics_;  ///< waiting to be put behind the triangles
  std::uint32_t group_ = kNone;
  std::map<std::uint32_t, Box> boxes_;  ///< by group, the world's at kNone
  Box latest_;
};

}  // namespace norrsken
