// perspective: a pinhole camera.
//
// Parameters
//   fov                       number, degrees, above 0 and below 180
//   focal_length              string such as "50mm" (the default), in place of `fov`: the focal length that gives this
//                             picture on 35 mm film, measured along the diagonal
//   fov_axis                  x (default), y, diagonal, smaller or larger: the side of the image that `fov` spans
//   near_clip, far_clip       numbers above 0, scene units along the axis (default 0.01 and 10000): nothing nearer or
//                             farther is seen
//   principal_point_offset_x  number, share of the image's width (default 0): what is in the middle of the image without
//                             it moves left by as much
//   principal_point_offset_y  number, share of the image's height (default 0): the same, up
//   to_world                  transform without scale; local +z is the direction of view, +y up and +x left
// Children: film, sampler.
// Measure: every film point has the same weight.
#include <fmt/format.h>

#include <cmath>
#include <glm/trigonometric.hpp>

#include "camera/camera_host.h"
#include "compile/field_of_view.h"
#include "compile/plugins.h"

namespace norrsken {

CameraRecord compile_sensor_perspective(Parameters& p, Builder& builder, const FilmSettings& film) {
  CameraRecord camera{};
  camera.kind = CameraKind::perspective;
  const double half_width = half_width_of_view(p, static_cast<double>(film.full_width) / film.full_height);
  read_clip_planes(p, camera);
  const double offset_x = p.number("principal_point_offset_x", 0, -1e6, 1e6);
  const double offset_y = p.number("principal_point_offset_y", 0, -1e6, 1e6);
  const CameraFrame frame = read_rigid_frame(p);
  store(camera.origin, frame.origin);
  store(camera.forward, frame.forward);
  span_film(camera, frame, film, frame.forward, half_width, offset_x, offset_y);
  builder.describe(p.node(), fmt::format("{:.4g} degrees wide", glm::degrees(2 * std::atan(half_width))));
  return camera;
}

}  // namespace norrsken
