// orthographic: parallel rays; the film is 2 units wide.
//
// Children: film, sampler.
// Measure: every film point has the same weight.
#include <fmt/core.h>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "camera/camera_host.h"
#include "compile/frame_tools.h"

namespace norrsken {
namespace {

constexpr TransformParameter kToWorld{
    .name = "to_world",
    .text = "local +z is the direction of view, +y up and +x left. Scaling by s makes the picture 2 s wide"};

}  // namespace

CameraRecord compile_sensor_orthographic(Parameters& p, Sensors& sensors, const FilmSettings& film) {
  CameraRecord camera{};
  camera.kind = CameraKind::orthographic;
  read_clip_planes(p, camera);
  const glm::dmat4 to_world = p.read(kToWorld);
  const glm::dmat3 axes(to_world);
  const CameraFrame frame{glm::dvec3(to_world[3]), axes[0], axes[1], axes[2]};
  const double unit = glm::length(frame.forward), near_clip = static_cast<double>(camera.near_clip);
  store(camera.origin, frame.origin);
  store(camera.forward, frame.forward / unit);
  span_film(camera, frame, film, frame.origin + near_clip * frame.forward, 1, 0, 0);
  // As in Mitsuba the near plane is scaled with the camera, and what lies between it and the far plane is not.
  camera.far_clip = static_cast<float>(near_clip * unit + static_cast<double>(camera.far_clip) - near_clip);
  camera.near_clip = static_cast<float>(near_clip * unit);
  sensors.describe(p.node(), fmt::format("{:.4g} wide", 2 * glm::length(axes[0])));
  return camera;
}

}  // namespace norrsken
