#include "formats/mesh_flaws.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace norrsken {
namespace {

bool is_finite(const auto& values) {
  return std::ranges::all_of(values, [](float value) { return std::isfinite(value); });
}

void clear_not_finite(auto& vectors) {
  for (auto& vector : vectors) {
    if (!is_finite(vector)) vector = {};
  }
}

}  // namespace

void leave_out_not_finite(MeshData& mesh) {
  if (!std::ranges::all_of(mesh.positions, [](const auto& p) { return is_finite(p); })) {
    for (auto& triangle : mesh.triangles) {
      const auto lost = std::ranges::find_if(triangle, [&](std::uint32_t v) { return !is_finite(mesh.positions[v]); });
      if (lost != triangle.end()) triangle = {*lost, *lost, *lost};
    }
    clear_not_finite(mesh.positions);
  }
  clear_not_finite(mesh.normals);
  clear_not_finite(mesh.texcoords);
  for (MeshAttribute& attribute : mesh.attributes) {
    std::ranges::replace_if(
        attribute.values, [](float value) { return !std::isfinite(value); }, 0.0f);
  }
}

std::string not_finite_text(const std::string& what) {
  return fmt::format("{}: vertices that are not finite are left out with their triangles, other values are taken for 0",
                     what);
}

std::string small_face_text(std::size_t corners) {
  return fmt::format("a face of {} {} is left out", corners, corners == 1 ? "vertex" : "vertices");
}

void warn_of_intricate(const PolygonCutter& cutter, MeshComplaints& complaints) {
  if (!cutter.too_intricate) return;
  complaints.flaw_at(
      {}, MeshFlaw::intricate_face,
      "a face has too many corners in too intricate an order: it is drawn as a fan around its first one");
  complaints.tell_flaws();
}

}  // namespace norrsken
