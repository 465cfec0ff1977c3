// pbrt's shapes, as nodes of a description.
#pragma once

#include <glm/mat4x4.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "formats/pbrt/context.h"

namespace norrsken::pbrt {

struct Placement {
  glm::dmat4 to_world{1};
  bool reverse = false;       ///< ReverseOrientation
  bool depends_on_uv = true;  ///< the material, perhaps: then (u, v) has to be pbrt's
  bool as_mesh = false;       ///< whatever it is

  bool is_mirrored() const { return glm::determinant(glm::dmat3(to_world)) < 0; }
};

struct Geometry {
  Node node;
  std::shared_ptr<const Mesh> mesh = nullptr;  ///< of shapes that are one: in the world
  double area = 0;                             ///< as pbrt calculates it
  std::size_t triangles_per_primitive = 0;     ///< of a mesh of several lights; 0: the shape is one
};

/// Shape "type" ... Empty after a complaint, or if there is nothing to see. `p` is asked for all that it may have but
/// "alpha".
std::optional<Geometry> make_shape(Context& context, const std::string& type, Parameters& p,
                                   const Placement& placement);

/// A mesh twice, facing to either side, and each of the two just off the other: the two sides of a lamp.
std::vector<Geometry> two_sides(Context& context, const Geometry& geometry);

std::optional<Geometry> make_triangle_mesh(Context& context, Parameters& p, const Placement& placement);
std::optional<Geometry> make_ply_mesh(Context& context, Parameters& p, const Placement& placement);
std::optional<Geometry> make_bilinear_mesh(Context& context, Parameters& p, const Placement& placement);
std::optional<Geometry> make_subdivision(Context& context, Parameters& p, const Placement& placement);
std::optional<Geometry> make_curve(Context& context, Parameters& p, const Placement& placement);

}  // namespace norrsken::pbrt
