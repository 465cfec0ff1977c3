// radiancemeter: the radiance along one ray, which begins at `origin`.
//
// Children: film, sampler.
#include <fmt/core.h>

#include "camera/camera_host.h"
#include "camera/meter_host.h"

namespace norrsken {
namespace {

constexpr PointParameter kOrigin{.name = "origin", .text = "where the ray begins; with `direction`"};
constexpr PointParameter kDirection{
    .name = "direction", .fallback = {0, 0, 1}, .text = "of the ray, of any length; with `origin`"};
constexpr TransformParameter kToWorld{
    .name = "to_world", .text = "the ray begins in the local origin and goes along +z", .in_place_of = "origin"};

}  // namespace

CameraRecord compile_sensor_radiancemeter(Parameters& p, Sensors& sensors, const FilmSettings&) {
  CameraRecord meter = make_meter(CameraKind::radiancemeter);
  const glm::dmat4 to_world = p.read(kToWorld);
  glm::dvec3 origin = p.read(kOrigin), direction = read_direction(p, kDirection);
  const bool has_origin = p.has(kOrigin.name), has_direction = p.has(kDirection.name);
  if (has_origin != has_direction) {
    p.error(has_origin ? kOrigin.name : kDirection.name,
            fmt::format("'{}' is given without '{}'", has_origin ? kOrigin.name : kDirection.name,
                        has_origin ? kDirection.name : kOrigin.name),
            "origin and direction, or to_world");
  } else if (has_origin && p.has(kToWorld.name)) {
    p.error(kToWorld.name, "'to_world' is given next to 'origin' and 'direction'", "origin and direction, or to_world");
  } else if (!has_origin) {
    origin = glm::dvec3(to_world[3]), direction = direction_of(to_world);
  }
  store(meter.origin, origin);
  store(meter.forward, direction);
  sensors.describe(p.node(), fmt::format("from ({:.4g}, {:.4g}, {:.4g}) along ({:.4g}, {:.4g}, {:.4g})", origin.x,
                                         origin.y, origin.z, direction.x, direction.y, direction.z));
  return meter;
}

}  // namespace norrsken
