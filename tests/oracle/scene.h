// What the oracle can render: one-sided triangles and spheres, area and point lights, a pinhole camera.
#pragma once

#include <cstddef>
#include <vector>

#include "tests/oracle/vector.h"

namespace norrsken::oracle {

/// Both kinds scatter on their front only; a hit from behind is black.
struct Material {
  enum class Kind { diffuse, mirror };
  Kind kind = Kind::diffuse;
  Rgb albedo;  ///< of a diffuse surface; a mirror reflects everything
};

struct Triangle {
  Vec v0, v1, v2;
  Vec normal;  ///< unit, on the front
  Material material;
  Rgb emission;  ///< radiance of the front
};

struct Sphere {
  Vec centre;
  double radius = 1;
  Material material;  ///< the front is the outside
};

struct PointLight {
  Vec position;
  Rgb intensity;  ///< radiant, per steradian
};

struct Scene {
  std::vector<Triangle> triangles;
  std::vector<Sphere> spheres;
  std::vector<PointLight> point_lights;
  std::vector<std::size_t> emitters;  ///< the triangles with an emission

  /// Adds a triangle whose front is the side on which `inside` lies.
  void add_triangle(const Vec& v0, const Vec& v1, const Vec& v2, const Vec& inside, const Material& material,
                    const Rgb& emission = {});
  /// Adds the parallelogram with corner `v0` and the sides `a` and `b` as two triangles.
  void add_parallelogram(const Vec& v0, const Vec& a, const Vec& b, const Vec& inside, const Material& material,
                         const Rgb& emission = {});
};

/// Looks from `eye` through a rectangle: film position (0,0) is `top_left`, (1,1) is top_left + across + down.
struct Camera {
  Vec eye, top_left, across, down;
};

enum class RoomLight { area, point };

/// The report's room: hexagon, tetrahedron, mirror sphere, and one of its two lights.
Scene hexagon_room(RoomLight light);
/// The report's camera: eye (-1,0,0), image plane of 2 x 2 units around the origin, z up.
Camera hexagon_room_camera();

/// A closed box 4 x 4 x 3 around the origin, every side of one material and emission, facing inward.
Scene closed_box(const Material& material, const Rgb& emission);
/// The box with a large lamp below its ceiling and a mirror sphere that casts a caustic.
Scene lamp_box();
/// The box with a point light in its middle and the same sphere.
Scene bulb_box();
/// Looks along +x from within the box, z up, 90 degrees.
inline constexpr Camera kInsideBoxCamera{{-1, 0.3, 0.2}, {0, 1.3, 1.2}, {0, -2, 0}, {0, 0, -2}};

}  // namespace norrsken::oracle
