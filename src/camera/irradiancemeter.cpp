// irradiancemeter: the irradiance of the shape that it stands in, on the side of its normals.
//
// The film's coordinates are the surface's: of a rectangle, a film of several pixels is a map.
//
// Children: film, sampler.
#include "camera/camera_host.h"
#include "camera/meter_host.h"

namespace norrsken {

CameraRecord compile_sensor_irradiancemeter(Parameters& p, Sensors& sensors, const FilmSettings&) {
  CameraRecord meter = make_meter(CameraKind::irradiancemeter);
  const Node::Child* shape = p.child("shape");
  if (shape == nullptr) {
    p.diagnostics().error(p.node().plugin_location, "sensor 'irradiancemeter' stands outside of a shape",
                          "an irradiancemeter inside of the shape that it measures");
    return meter;
  }
  const auto surface = sensors.surface(*shape->node, Sensors::IsInScene::yes);
  if (surface) set_surface(meter, *surface, *shape->node, p, sensors);
  return meter;
}

}  // namespace norrsken
