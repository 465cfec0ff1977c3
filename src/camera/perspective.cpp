// perspective: a pinhole camera.
//
// Children: film, sampler.
// Measure: every film point has the same weight.
#include <fmt/core.h>

#include <cmath>
#include <glm/trigonometric.hpp>

#include "camera/camera_host.h"
#include "compile/field_of_view.h"
#include "compile/frame_tools.h"

namespace norrsken {
namespace {

constexpr NumberParameter kOffsetX{
    .name = "principal_point_offset_x",
    .fallback = 0,
    .range = {-1e6, 1e6},
    .text = "share of the image's width: what is in the middle of the image without it moves left by as much"};
constexpr NumberParameter kOffsetY{.name = "principal_point_offset_y",
                                   .fallback = 0,
                                   .range = {-1e6, 1e6},
                                   .text = "share of the image's height: the same, up"};

}  // namespace

CameraRecord compile_sensor_perspective(Parameters& p, Sensors& sensors, const FilmSettings& film) {
  CameraRecord camera{};
  camera.kind = CameraKind::perspective;
  const double half_width = half_width_of_view(p, static_cast<double>(film.full_width) / film.full_height);
  read_clip_planes(p, camera);
  const double offset_x = p.read(kOffsetX);
  const double offset_y = p.read(kOffsetY);
  const CameraFrame frame = read_rigid_frame(p);
  store(camera.origin, frame.origin);
  store(camera.forward, frame.forward);
  span_film(camera, frame, film, frame.forward, half_width, offset_x, offset_y);
  sensors.describe(p.node(), fmt::format("{:.4g} degrees wide", glm::degrees(2 * std::atan(half_width))));
  return camera;
}

}  // namespace norrsken
