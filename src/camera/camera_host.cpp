#include "camera/camera_host.h"

#include <fmt/core.h>

#include <glm/geometric.hpp>

#include "compile/field_of_view.h"

namespace norrsken {
namespace {

constexpr NumberParameter kNearClip{.name = "near_clip",
                                    .fallback = 1e-2,
                                    .range = above(0, kMaxCoordinate),
                                    .text = "along the axis: nothing nearer is seen",
                                    .unit = "scene units"};
constexpr NumberParameter kFarClip{.name = "far_clip",
                                   .fallback = 1e4,
                                   .range = {-kFarthest, kFarthest},
                                   .text = "along the axis, above near_clip: nothing farther is seen",
                                   .unit = "scene units",
                                   .beyond = Beyond::is_clamped_with_a_note};

}  // namespace

void store(float (&out)[3], const glm::dvec3& v) {
  for (int i = 0; i < 3; ++i) out[i] = static_cast<float>(v[i]);
}

void read_clip_planes(Parameters& p, CameraRecord& camera) {
  const double near_clip = p.read(kNearClip);
  const double far_clip = p.read(kFarClip);
  if (near_clip >= far_clip) {
    p.error(p.has(kNearClip.name) ? kNearClip.name : kFarClip.name,
            fmt::format("'near_clip' is {}, but 'far_clip' is {}", near_clip, far_clip),
            "a near_clip smaller than the far_clip");
  }
  camera.near_clip = static_cast<float>(near_clip);
  camera.far_clip = static_cast<float>(far_clip);
}

CameraFrame read_rigid_frame(Parameters& p) {
  const glm::dmat4 to_world = p.read(kRigidToWorld);
  const glm::dmat3 linear(to_world);
  if (!keeps_lengths(linear)) {
    p.error(kRigidToWorld.name, "'to_world' of a sensor scales", "translations, rotations and lookat");
  }
  return {glm::dvec3(to_world[3]), linear[0], linear[1], glm::normalize(linear[2])};
}

void span_film(CameraRecord& camera, const CameraFrame& frame, const FilmSettings& film, const glm::dvec3& center,
               double half_width, double offset_x, double offset_y) {
  // x goes from half_width at px = 0 to -half_width at px = width, y from half_height at py = 0 down.
  const double width = film.full_width, height = film.full_height;
  const glm::dvec3 left = half_width * frame.left, up = half_width * height / width * frame.up;
  store(camera.base, center + (1 - 2 * offset_x) * left + (1 - 2 * offset_y) * up);
  store(camera.du, -2 / width * left);
  store(camera.dv, -2 / height * up);
}

}  // namespace norrsken
