// AreaLightSource "diffuse".
#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/text.h"
#include "formats/pbrt/lights.h"
#include "formats/pbrt/mesh_maker.h"

namespace norrsken::pbrt {
namespace {

constexpr const char* kRadianceAttribute = "face_radiance";
constexpr double kSameArea = 1e-4;  // by which triangles may differ that are as bright as each other

/// An image of what the light's radiance is, times `scale`, with v upwards as pbrt has it.
std::shared_ptr<const Node> radiance_texture(Context& context, const AreaLight& light, double scale) {
  Image image;
  image.width = light.image->image.width, image.height = light.image->image.height;
  for (std::size_t c = 0; c < 3; ++c) {
    image.channels.push_back({std::string(1, "RGB"[c]), light.image->color[c]->values});
    for (float& value : image.channels[c].values) value = static_cast<float>(std::max(scale * double{value}, 0.0));
  }
  Node node = image_node(context, std::move(image), light.place);
  Property::Transform upside_down;
  upside_down.rows[1][1] = -1, upside_down.rows[1][3] = 1;
  give(node, "to_uv", upside_down, light.place);
  return std::make_shared<const Node>(std::move(node));
}

/// The areas of a mesh's primitives, of so many triangles each.
std::vector<double> primitive_areas(const Mesh& mesh, std::size_t triangles_each) {
  std::vector<double> areas(mesh.triangles.size() / 3 / triangles_each);
  for (std::size_t i = 0; i < areas.size() * triangles_each; ++i) areas[i / triangles_each] += triangle_area(mesh, i);
  return areas;
}

/// `mesh` with a radiance of its own for each primitive, so that all have the same power.
std::shared_ptr<const Mesh> with_radiances(Context& context, const Mesh& mesh, const std::vector<double>& areas,
                                           const glm::dvec3& radiance_times_area) {
  const std::size_t triangles = mesh.triangles.size() / 3, each = triangles / areas.size();
  context.memory.grow(sizeof(float) * 3 * triangles);
  Mesh shining = mesh;
  Mesh::Attribute attribute{.name = kRadianceAttribute, .channels = 3};
  for (std::size_t i = 0; i < triangles; ++i) {
    const double area = areas[i / each];
    for (int c = 0; c < 3; ++c)
      attribute.values.push_back(area > 0 ? static_cast<float>(radiance_times_area[c] / area) : 0.0F);
  }
  shining.attributes.push_back(std::move(attribute));
  return std::make_shared<const Mesh>(std::move(shining));
}

}  // namespace

std::optional<AreaLight> read_area_light(Context& context, ImageFiles& images, const std::string& type, Parameters& p,
                                         const ColorSpace& space) {
  if (type != "diffuse") {
    p.error(nullptr, fmt::format("unknown area light {}", quoted(type)), "diffuse");
    return std::nullopt;
  }
  AreaLight light{.place = p.place()};
  light.scale = p.number("scale", 1, 0) * context.imaging_ratio;
  light.two_sided = p.flag("twosided", false);
  light.power = p.number("power", -1);
  light.radiance = read_emission(context, p, "L", space);
  const Parameter* filename = p.find("string", "filename");
  if (!filename) return light;
  if (p.has("L")) p.error(filename, "light 'diffuse' has 'filename' beside 'L'", "either");
  light.image = p.has_values(*filename, 1) ? images.read(*filename) : nullptr;
  if (!light.image) return std::nullopt;
  double sum = 0;
  for (int y = 0; y < light.image->image.height; ++y) {
    for (int x = 0; x < light.image->image.width; ++x) sum += luminance_of(light.image->texel(x, y));
  }
  light.image_luminance = sum / static_cast<double>(light.image->color[0]->values.size());
  return light;
}

void add_area_light(Context& context, const AreaLight& light, Geometry& geometry) {
  Node emitter = make_node("emitter", "area", light.place);
  const double sides = (light.two_sided ? 2 : 1) * std::numbers::pi;
  const bool has_power = light.power > 0;
  std::vector<double> areas;
  if (has_power && geometry.triangles_per_primitive > 0)
    areas = primitive_areas(*geometry.mesh, geometry.triangles_per_primitive);
  const auto [least, most] = std::ranges::minmax_element(areas);
  const bool alike = areas.empty() || *most - *least <= kSameArea * *most;
  // The power is that of each primitive.
  const double area = geometry.area / static_cast<double>(std::max(areas.size(), std::size_t{1}));
  const double mean_luminance = light.image ? light.image_luminance : 1;
  const double per_area = light.scale * (has_power ? light.power / (sides * mean_luminance) : 1);
  const double scale = has_power ? per_area / area : per_area;
  if (light.image) {
    if (!alike)
      context.tell(light.place, "'power' of an image on surfaces of several sizes", "the same radiance on all");
    add_child(emitter, radiance_texture(context, light, scale), "radiance", light.place);
  } else if (alike) {
    give(emitter, "radiance", to_rgb(scale * light.radiance), light.place);
  } else {
    geometry.mesh = with_radiances(context, *geometry.mesh, areas, per_area * light.radiance);
    give(geometry.node, "mesh", geometry.mesh, light.place);
    Node texture = make_node("texture", "mesh_attribute", light.place);
    give(texture, "name", std::string(kRadianceAttribute), light.place);
    emitter.add(std::move(texture), "radiance");
  }
  geometry.node.add(std::move(emitter));
}

}  // namespace norrsken::pbrt
