#include "compile/default_sensor.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/trigonometric.hpp>
#include <utility>

namespace norrsken {
namespace {

template <class Value>
void give(Node& sensor, const char* name, const char* type, Value value) {
  Property property;
  property.name = name;
  property.type = type;
  property.value = std::move(value);
  property.location = property.name_location = sensor.location;
  sensor.properties.push_back(std::move(property));
}

}  // namespace

Node make_default_sensor(const SourceLocation& location) {
  Node sensor;
  sensor.kind = "sensor";
  sensor.plugin = "perspective";
  sensor.location = sensor.plugin_location = location;
  give(sensor, "fov", "float", kDefaultFieldOfView);
  return sensor;
}

void look_at_box(Node& sensor, const glm::dvec3& lower, const glm::dvec3& upper) {
  const glm::dvec3 sides = upper - lower;
  const double longest = std::max({sides.x, sides.y, sides.z});
  if (!(longest > 0)) return;
  const double distance = longest / (2 * std::tan(glm::radians(kDefaultFieldOfView / 2)));
  const glm::dvec3 center = lower + sides / 2.0;
  give(sensor, "near_clip", "float", distance / 100);
  give(sensor, "far_clip", "float", std::min(5 * longest + distance, kMaxCoordinate));
  give(sensor, "to_world", "transform",
       to_transform(glm::translate(glm::dmat4(1), glm::dvec3(center.x, center.y, lower.z - distance))));
}

}  // namespace norrsken
