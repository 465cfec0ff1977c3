#include "formats/ply_faces.h"

#include <bit>
#include <type_traits>
#include <utility>

#include "formats/combinations.h"

namespace norrsken {

void PlyFaces::add() {
  if (corners.size() < 3) return;
  if (have_texcoords) ++(texcoords.empty() ? without_texcoords : with_texcoords);
  if (have_texcoords) texcoords.resize(2 * corners.size());
  const Fan fan{mesh_.triangles.size(), corners.size()};
  for (std::size_t i = 2; i < corners.size(); ++i) {
    mesh_.triangles.push_back({corners[0], corners[i - 1], corners[i]});
    if (!have_texcoords) continue;
    for (const std::size_t corner : {std::size_t{0}, i - 1, i})
      corner_texcoords_.push_back({texcoords[2 * corner], texcoords[2 * corner + 1]});
  }
  texcoords.clear();
  if (fan.corners == 3) return;
  if (mesh_.positions.empty()) {
    fans_to_come_.push_back(fan);
  } else {
    cut(fan);
  }
}

/// Other triangles in place of a fan, if it does not do.
void PlyFaces::cut(const Fan& fan) {
  const auto in_fan = [&](std::size_t i) { return 3 * fan.first + (i < 2 ? i : 3 * (i - 2) + 2); };
  const auto vertex = [&](std::size_t i) { return mesh_.triangles[in_fan(i) / 3][in_fan(i) % 3]; };
  points_.clear();
  for (std::size_t i = 0; i < fan.corners; ++i) points_.push_back(mesh_.positions[vertex(i)]);
  const auto triangles = cutter_.cut(points_);
  if (triangles.empty()) return;
  Array<std::pair<std::uint32_t, Texcoord>> polygon;
  for (std::size_t i = 0; i < fan.corners; ++i)
    polygon.emplace_back(vertex(i), have_texcoords ? corner_texcoords_[in_fan(i)] : Texcoord{});
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    for (std::size_t k = 0; k < 3; ++k) {
      const auto& [index, texcoord] = polygon[triangles[t][k]];
      mesh_.triangles[fan.first + t][k] = index;
      if (have_texcoords) corner_texcoords_[3 * (fan.first + t) + k] = texcoord;
    }
  }
}

void PlyFaces::split_vertices() {
  Combinations combinations(corner_texcoords_.size());
  for (std::size_t i = 0; i < corner_texcoords_.size(); ++i) {
    std::uint32_t& vertex = mesh_.triangles[i / 3][i % 3];
    const auto& [u, v] = corner_texcoords_[i];
    vertex = combinations.number_of({vertex, std::bit_cast<std::uint32_t>(u), std::bit_cast<std::uint32_t>(v)});
  }
  corner_texcoords_ = {};
  const auto& keys = combinations.keys();
  // `size` values for each vertex.
  const auto spread = [&keys](auto& values, std::size_t size) {
    const std::remove_reference_t<decltype(values)> old = std::exchange(values, {});
    values.reserve(keys.size() * size);
    for (const Combinations::Key& key : keys) {
      for (std::size_t k = 0; k < size; ++k) values.push_back(old[key[0] * size + k]);
    }
  };
  spread(mesh_.positions, 1);
  if (!mesh_.normals.empty()) spread(mesh_.normals, 1);
  for (MeshAttribute& attribute : mesh_.attributes) {
    if (!attribute.per_face) spread(attribute.values, attribute.channels);
  }
  mesh_.texcoords.clear();
  mesh_.texcoords.reserve(keys.size());
  for (const Combinations::Key& key : keys)
    mesh_.texcoords.push_back({std::bit_cast<float>(key[1]), std::bit_cast<float>(key[2])});
}

const PolygonCutter& PlyFaces::finish() {
  for (const Fan& fan : fans_to_come_) cut(fan);
  if (with_texcoords > 0) split_vertices();
  return cutter_;
}

}  // namespace norrsken
