// thinlens: a perspective camera with a lens, out of focus where the scene is nearer or farther than its plane of focus.
//
// Children: film, sampler.
// Measure: every film point and every point of the lens has the same weight.
// Departures: an aperture_radius of 0, which Mitsuba replaces by a tiny one, is refused: that camera is `perspective`.
#include <fmt/core.h>

#include <cmath>
#include <glm/trigonometric.hpp>

#include "camera/camera_host.h"
#include "compile/field_of_view.h"
#include "compile/frame_tools.h"

namespace norrsken {
namespace {

constexpr NumberParameter kApertureRadius{.name = "aperture_radius",
                                          .fallback = 1,
                                          .range = above(0, kMaxCoordinate),
                                          .text = "the lens's radius, at most 10000 times focus_distance",
                                          .unit = "scene units",
                                          .example = R"(<float name="aperture_radius" value="..."/>)"};
constexpr NumberParameter kFocusDistance{
    .name = "focus_distance",
    .fallback = 1e4,
    .range = above(0, kMaxCoordinate),
    .text = "along the axis: where the picture is sharp; far_clip, if it is not given",
    .unit = "scene units"};

/// Radii of a lens per distance of focus. Beyond, rays are so nearly across the axis that float loses where they lead.
constexpr double kMaxRadius = 1e4;

}  // namespace

CameraRecord compile_sensor_thinlens(Parameters& p, Sensors& sensors, const FilmSettings& film) {
  CameraRecord camera{};
  camera.kind = CameraKind::thinlens;
  const double half_width = half_width_of_view(p, static_cast<double>(film.full_width) / film.full_height);
  read_clip_planes(p, camera);
  const double radius = p.read(kApertureRadius);
  const double focus = p.read(kFocusDistance.or_else(static_cast<double>(camera.far_clip)));
  if (p.has(kApertureRadius.name) && radius > kMaxRadius * focus) {
    p.error(kApertureRadius.name, fmt::format("'aperture_radius' is {:.9g} times 'focus_distance'", radius / focus),
            fmt::format("an aperture_radius of at most {:g} times focus_distance, here {:g}", kMaxRadius,
                        kMaxRadius * focus));
  }
  const CameraFrame frame = read_rigid_frame(p);
  store(camera.origin, frame.origin);
  store(camera.forward, frame.forward);
  span_film(camera, frame, film, focus * frame.forward, focus * half_width, 0, 0);
  store(camera.lens_x, radius * frame.left);
  store(camera.lens_y, radius * frame.up);
  sensors.describe(p.node(), fmt::format("{:.4g} degrees wide, lens {:.4g} wide, sharp at {:.4g}",
                                         glm::degrees(2 * std::atan(half_width)), 2 * radius, focus));
  return camera;
}

}  // namespace norrsken
