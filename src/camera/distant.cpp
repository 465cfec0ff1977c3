// distant: a sensor infinitely far away: the mean radiance that comes to it from its target.
//
// Its target is the scene as a whole, as it is seen from there (the disk that a sphere around it fills, what is beside the
// scene included), or `ray_target`, a point or a shape that is no part of the scene.
//
// Children: film, sampler, ray_target (a shape).
// Departures: Mitsuba 3.9.1 documents ray_target and does not load it; films may be of any size, every pixel measures the
// same.
#include <fmt/core.h>

#include "camera/camera_host.h"
#include "camera/meter_host.h"
#include "tables/meter_tables.h"

namespace norrsken {
namespace {

constexpr PointParameter kDirection{
    .name = "direction", .fallback = {0, 0, 1}, .text = "of the rays, from the sensor to the scene; of any length"};
constexpr TransformParameter kToWorld{
    .name = "to_world", .text = "the rays go along the local +z", .in_place_of = "direction"};
constexpr PointParameter kTarget{.name = "ray_target", .text = "the one point that all rays go through"};

}  // namespace

CameraRecord compile_sensor_distant(Parameters& p, Sensors& sensors, const FilmSettings&) {
  CameraRecord meter = make_meter(CameraKind::distant);
  const glm::dmat4 to_world = p.read(kToWorld);
  glm::dvec3 direction = read_direction(p, kDirection);
  if (p.has(kToWorld.name) && p.has(kDirection.name)) {
    p.error(kToWorld.name, "'to_world' is given next to 'direction'", "one of them");
  } else if (p.has(kToWorld.name)) {
    direction = direction_of(to_world);
  }
  store(meter.forward, direction);
  std::string target = "the scene";
  meter.piece_count = kWholeScene;
  if (const Node::Child* shape = p.child("shape")) {
    target = "a shape";
    const auto surface = sensors.surface(*shape->node, Sensors::IsInScene::no);
    if (surface) set_surface(meter, *surface, *shape->node, p, sensors);
  } else if (p.has(kTarget.name)) {
    target = "a point";
    store(meter.origin, p.read(kTarget));
    meter.piece_count = 0;
  } else {
    p.read(kTarget);
  }
  sensors.describe(p.node(),
                   fmt::format("of {}, along ({:.4g}, {:.4g}, {:.4g})", target, direction.x, direction.y, direction.z));
  return meter;
}

}  // namespace norrsken
