// LightSource "infinite": pbrt's images of equal areas become latitude and longitude.
#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <numbers>

#include "formats/pbrt/lights.h"

namespace norrsken::pbrt {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr int kSamples = 4;  // along each side of a texel, of the square that is seen there

/// What pbrt calls the illuminance of such an image: its solid angles count half there.
double illuminance_of(const ImageFile& file) {
  const int size = file.image.width;
  double sum = 0;
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      const glm::dvec3 w = direction_of_square((glm::dvec2(x, y) + 0.5) / static_cast<double>(size));
      if (w.z > 0) sum += luminance_of(file.texel(x, y)) * w.z;
    }
  }
  return sum * 2 * kPi / (static_cast<double>(size) * size);
}

/// The texel of an image in latitude and longitude with z up, which infinite lights of version 3 have.
glm::dvec3 version3_texel(const ImageFile& file, const glm::dvec3& d) {
  const int width = file.image.width, height = file.image.height;
  const double turns = std::atan2(d.y, d.x) / (2 * kPi), down = std::acos(std::clamp(d.z, -1.0, 1.0)) / kPi;
  return file.texel(std::clamp(static_cast<int>((turns - std::floor(turns)) * width), 0, width - 1),
                    std::clamp(static_cast<int>(down * height), 0, height - 1));
}

/// The radiance from a direction of the world.
glm::dvec3 radiance_from(const Environment& environment, const glm::dvec3& world) {
  glm::dvec3 sum = environment.radiance;
  for (const Environment::Map& map : environment.maps)
    sum += map.scale * map.look_up(*map.file, glm::normalize(map.light_from_world * world));
  return sum;
}

/// The image as the emitter envmap wants it, with +y up in the world.
Image to_latitude_longitude(const Environment& environment) {
  Image image;
  image.height = 3;
  for (const Environment::Map& map : environment.maps) image.height = std::max(image.height, map.file->image.height);
  image.width = 2 * image.height;
  const std::size_t pixels = static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
  for (const char* name : {"R", "G", "B"}) image.channels.push_back({name, std::vector<float>(pixels)});
  const double last_row = image.height - 1;
  std::size_t pixel = 0;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x, ++pixel) {
      glm::dvec3 sum(0);
      for (int i = 0; i < kSamples * kSamples; ++i) {
        const glm::dvec2 inside = (glm::dvec2(i % kSamples, i / kSamples) + 0.5) / double{kSamples};
        // The emitter's texels: rows from pole to pole, columns around from -z, half a column off.
        const double theta = std::clamp((y + inside.y - 0.5) / last_row, 0.0, 1.0) * kPi;
        const double phi = (x + inside.x) / image.width * 2 * kPi;
        sum += radiance_from(environment,
                             {std::sin(phi) * std::sin(theta), std::cos(theta), -std::cos(phi) * std::sin(theta)});
      }
      for (int c = 0; c < 3; ++c)
        image.channels[static_cast<std::size_t>(c)].values[pixel] = static_cast<float>(sum[c] / (kSamples * kSamples));
    }
  }
  return image;
}

}  // namespace

glm::dvec2 square_of_direction(const glm::dvec3& d) {
  const double radius = std::sqrt(std::max(1 - std::abs(d.z), 0.0));
  const double turn = std::atan2(std::abs(d.y), std::abs(d.x)) * 2 / kPi;
  glm::dvec2 at(radius - turn * radius, turn * radius);
  if (d.z < 0) at = {1 - at.y, 1 - at.x};
  return (glm::dvec2(std::copysign(at.x, d.x), std::copysign(at.y, d.y)) + 1.0) / 2.0;
}

glm::dvec3 direction_of_square(const glm::dvec2& square) {
  const glm::dvec2 p = 2.0 * square - 1.0, size = glm::abs(p);
  const double inside = 1 - size.x - size.y, radius = 1 - std::abs(inside);
  const double phi = (radius == 0 ? 1 : (size.y - size.x) / radius + 1) * kPi / 4;
  const double sine = radius * std::sqrt(std::max(2 - radius * radius, 0.0));
  return {std::copysign(std::cos(phi), p.x) * sine, std::copysign(std::sin(phi), p.y) * sine,
          std::copysign(1 - radius * radius, inside)};
}

glm::dvec3 equal_area_texel(const ImageFile& file, const glm::dvec3& direction) {
  const glm::dvec2 at = square_of_direction(direction) * glm::dvec2(file.image.width, file.image.height);
  return file.texel(std::clamp(static_cast<int>(at.x), 0, file.image.width - 1),
                    std::clamp(static_cast<int>(at.y), 0, file.image.height - 1));
}

void add_infinite_light(Context& context, ImageFiles& images, Parameters& p, const ColorSpace& space,
                        const glm::dmat4& to_world, Environment& environment) {
  double scale = p.number("scale", 1, 0) * context.imaging_ratio;
  const glm::dvec3 radiance = read_emission(context, p, "L", space);
  const double illuminance = p.number("illuminance", -1);
  const Parameter* version3 = p.find("string", "mapname");
  const Parameter* filename = version3 ? version3 : p.find("string", "filename");
  if (version3)
    p.note(version3, "'mapname' of light 'infinite', of pbrt's version 3, is an image in latitude and longitude");
  if (p.list("point3", "portal", 3))
    context.tell(p.find("point3", "portal")->place, "portals of infinite lights are not supported",
                 "the light from all directions");
  if (!filename) {
    if (illuminance > 0) scale *= illuminance / kPi;
    environment.radiance += scale * radiance;
    environment.place = p.place();
    return;
  }
  if (p.has("L") && !version3) return p.error(filename, "light 'infinite' has 'filename' beside 'L'", "either");
  const auto file = p.has_values(*filename, 1) ? images.read(*filename) : nullptr;
  if (!file) return;
  const int width = file->image.width, height = file->image.height;
  if (width != height && !version3)
    return p.error(
        filename, fmt::format("the image of light 'infinite' has {} x {} pixels", width, height),
        "a square image of equal areas, as pbrt's 'imgtool makeequiarea' makes it of one in latitude and longitude");
  if (illuminance > 0 && !version3) scale *= illuminance / illuminance_of(*file);
  // Version 3 multiplies its image with "L".
  environment.maps.push_back({file, version3 ? version3_texel : equal_area_texel, glm::inverse(glm::dmat3(to_world)),
                              version3 ? scale * radiance : glm::dvec3(scale)});
  environment.place = p.place();
}

void add_environment(Context& context, const Environment& environment, Node& scene) {
  if (!environment.place.source) return;
  if (environment.maps.empty()) {
    Node node = make_node("emitter", "constant", environment.place);
    give(node, "radiance", to_rgb(environment.radiance), environment.place);
    scene.add(std::move(node));
    return;
  }
  Image image = to_latitude_longitude(environment);
  context.memory.grow(sizeof(float) * 3 * image.channels[0].values.size());
  Node node = make_node("emitter", "envmap", environment.place);
  give(node, "image", std::make_shared<const Image>(std::move(image)), environment.place);
  scene.add(std::move(node));
}

}  // namespace norrsken::pbrt
