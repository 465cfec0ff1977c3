// batch: several sensors at once, whose pictures stand side by side on one film.
//
// The film's width is divided evenly among them, from the left. Of a sensor's own film (768 x 576 if it has none) only the
// ratio of its sides counts, and only for the angle of view where that depends on it, as that of a focal length does; so it
// is in Mitsuba. Its sampler does not count. What a sensor would see beyond `far_clip` is seen. Each picture is filtered by
// itself: nothing reaches over to its neighbour.
//
// Children: film, sampler, any number of sensors.
#include <fmt/core.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <string_view>
#include <variant>

#include "camera/camera_host.h"
#include "camera/meter_host.h"

namespace norrsken {
namespace {

/// A side of a sensor's own film, or what films have that say nothing.
int own_side(const Node& sensor, std::string_view name, int fallback) {
  for (const Node::Child& film : sensor.children) {
    if (film.node->kind != "film") continue;
    for (const Property& property : film.node->properties) {
      const auto* side = std::get_if<std::int64_t>(&property.value);
      if (property.name == name && side && *side > 0 && *side <= kMaxFilmSide) return static_cast<int>(*side);
    }
  }
  return fallback;
}

/// Makes the view of `camera` as wide as that of `other`; they have films of so many pixels.
void widen_as(const CameraRecord& other, int other_width, int width, CameraRecord& camera) {
  const auto vector = [](const float(&v)[3]) { return glm::dvec3(v[0], v[1], v[2]); };
  const double ratio = glm::length(vector(other.du)) * other_width / (glm::length(vector(camera.du)) * width);
  const glm::dvec3 forward = vector(camera.forward), base = vector(camera.base);
  const glm::dvec3 center = glm::dot(base, forward) * forward;
  store(camera.du, ratio * vector(camera.du));
  store(camera.dv, ratio * vector(camera.dv));
  store(camera.base, center + ratio * (base - center));
}

}  // namespace

CameraRecord compile_sensor_batch(Parameters& p, Sensors& sensors, const FilmSettings& film) {
  const auto children = p.children("sensor");
  if (children.empty()) {
    p.diagnostics().error(p.node().location, "sensor 'batch' has no sensor inside", R"(<sensor type="perspective">)");
    return make_meter(CameraKind::batch);
  }
  const int count = static_cast<int>(children.size());
  if (film.full_width % count != 0) {
    p.diagnostics().error(
        p.node().location,
        fmt::format("the film is {} pixels wide, which {} sensors cannot share evenly", film.full_width, count),
        fmt::format("a width that is a multiple of {}", count));
  }
  FilmSettings part = film;
  part.full_width = part.width = std::max(film.full_width / count, 1);
  part.height = part.full_height;
  part.crop_x = part.crop_y = 0;
  for (const Node::Child* child : children) {
    if (child->node->plugin == p.node().plugin) {
      p.diagnostics().error(child->node->location, "a batch stands inside of another one", "sensors of any other type");
    } else {
      CameraRecord camera = sensors.inside(*child->node, part);
      FilmSettings own = part;
      own.full_width = own_side(*child->node, "width", 768);
      own.full_height = own_side(*child->node, "height", 576);
      const bool is_alike = own.full_width * part.full_height == part.full_width * own.full_height;
      const bool has_film = camera.du[0] != 0 || camera.du[1] != 0 || camera.du[2] != 0;
      if (has_film && !is_alike && !p.diagnostics().has_errors())
        widen_as(sensors.inside(*child->node, own), own.full_width, part.full_width, camera);
      sensors.join(camera);
    }
  }
  sensors.describe(p.node(), fmt::format("{} sensors", count));
  return make_meter(CameraKind::batch);
}

}  // namespace norrsken
