#include "tests/oracle/scene.h"

#include <array>
#include <utility>

namespace norrsken::oracle {

void Scene::add_triangle(const Vec& v0, const Vec& v1, const Vec& v2, const Vec& inside, const Material& material,
                         const Rgb& emission) {
  Vec normal = normalize(cross(v1 - v0, v2 - v0));
  if (dot(inside - v0, normal) < 0) normal = -normal;
  if (emission.x > 0 || emission.y > 0 || emission.z > 0) emitters.push_back(triangles.size());
  triangles.push_back({v0, v1, v2, normal, material, emission});
}

void Scene::add_parallelogram(const Vec& v0, const Vec& a, const Vec& b, const Vec& inside, const Material& material,
                              const Rgb& emission) {
  add_triangle(v0, v0 + a, v0 + b, inside, material, emission);
  add_triangle(v0 + a + b, v0 + a, v0 + b, inside, material, emission);
}

namespace {

Material diffuse(double r, double g, double b) { return {Material::Kind::diffuse, {r, g, b}}; }

void add_walls(Scene& scene) {
  constexpr double kFloor = -5, kCeiling = 5;
  constexpr std::array<std::array<double, 2>, 6> kCorners = {{{-3, 0}, {0, 6}, {10, 6}, {13, 0}, {10, -6}, {0, -6}}};
  const Material white = diffuse(0.8, 0.8, 0.8);
  const Material red = diffuse(0.8, 0.2, 0.2), green = diffuse(0.2, 0.8, 0.2), blue = diffuse(0.2, 0.2, 0.8);
  const std::array<Material, 6> wall = {red, green, blue, blue, green, red};
  const Vec inside{5, 0, 0};
  for (std::size_t i = 0; i < kCorners.size(); ++i) {
    const auto [x0, y0] = kCorners[i];
    const auto [x1, y1] = kCorners[(i + 1) % kCorners.size()];
    scene.add_triangle({5, 0, kFloor}, {x0, y0, kFloor}, {x1, y1, kFloor}, inside, white);
    scene.add_triangle({5, 0, kCeiling}, {x0, y0, kCeiling}, {x1, y1, kCeiling}, inside, white);
    scene.add_parallelogram({x0, y0, kFloor}, {x1 - x0, y1 - y0, 0}, {0, 0, kCeiling - kFloor}, inside, wall[i]);
  }
}

void add_tetrahedron(Scene& scene) {
  const std::array<Vec, 4> v = {{{7, 2, -5}, {9, 3, -5}, {8, 4.5, -5}, {8, 3, -2}}};
  const Vec centroid = (v[0] + v[1] + v[2] + v[3]) / 4;
  const Material green = diffuse(0.2, 0.8, 0.2);
  for (std::size_t left_out = 0; left_out < 4; ++left_out) {
    const Vec &a = v[(left_out + 1) % 4], &b = v[(left_out + 2) % 4], &c = v[(left_out + 3) % 4];
    const Vec outside = 2 * a - centroid;  // the centroid mirrored in a vertex of the face lies in front of it
    scene.add_triangle(a, b, c, outside, green);
  }
}

}  // namespace

Scene hexagon_room(RoomLight light) {
  Scene scene;
  add_walls(scene);
  add_tetrahedron(scene);
  scene.spheres.push_back({{7, -2.5, -2}, 1.5, {Material::Kind::mirror, {}}});
  if (light == RoomLight::area) {
    scene.add_parallelogram({6, -1, 4.9}, {2, 0, 0}, {0, 2, 0}, {7, 0, 0}, diffuse(0, 0, 0), {10, 10, 10});
  } else {
    scene.point_lights.push_back({{4.9, 0, 4.9}, {10, 10, 10}});
  }
  return scene;
}

Camera hexagon_room_camera() {
  // Looking along +x with z up, +y is to the left.
  return {{-1, 0, 0}, {0, 1, 1}, {0, -2, 0}, {0, 0, -2}};
}

Scene closed_box(const Material& material, const Rgb& emission) {
  Scene scene;
  const Vec a{4, 0, 0}, b{0, 4, 0}, c{0, 0, 3};
  const Vec low{-2, -2, -1.5}, high{2, 2, 1.5};
  for (const auto& [u, v] : {std::pair{a, b}, std::pair{b, c}, std::pair{c, a}}) {
    scene.add_parallelogram(low, u, v, {}, material, emission);
    scene.add_parallelogram(high, -u, -v, {}, material, emission);
  }
  return scene;
}

namespace {

Scene box_with_sphere() {
  Scene scene = closed_box(diffuse(0.3, 0.5, 0.7), {});
  scene.spheres.push_back({{0.8, 0.2, -0.7}, 0.6, {Material::Kind::mirror, {}}});
  return scene;
}

}  // namespace

Scene lamp_box() {
  Scene scene = box_with_sphere();
  scene.add_parallelogram({-1.5, -1.5, 1.4}, {3, 0, 0}, {0, 3, 0}, {}, diffuse(0, 0, 0), {2, 2, 2});
  return scene;
}

Scene bulb_box() {
  Scene scene = box_with_sphere();
  scene.point_lights.push_back({{0.3, -0.4, 0.2}, {3, 2, 1}});
  return scene;
}

}  // namespace norrsken::oracle
