#include "formats/pbrt/lights.h"

#include <cmath>
#include <functional>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/matrix.hpp>
#include <numbers>

#include "base/text.h"
#include "color/srgb.h"

namespace norrsken::pbrt {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr int kSlideTexels = 512;  // along a side of the image of a spot's edge

/// A placement at `origin` with +z along `direction`.
Property::Transform facing(const glm::dvec3& origin, const glm::dvec3& direction) {
  const glm::dvec3 z = glm::normalize(direction);
  const glm::dvec3 x = glm::normalize(glm::cross(std::abs(z.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0), z));
  return to_transform(
      glm::dmat4(glm::dvec4(x, 0), glm::dvec4(glm::cross(z, x), 0), glm::dvec4(z, 0), glm::dvec4(origin, 1)));
}

/// The placement with axes of length 1 at right angles, for lights that keep their form.
glm::dmat4 without_scale(Context& context, Parameters& p, const glm::dmat4& to_world) {
  glm::dmat4 rigid(1);
  for (int i = 0; i < 3; ++i) {
    glm::dvec3 axis(to_world[i]);
    for (int k = 0; k < i; ++k) axis -= glm::dvec3(rigid[k]) * glm::dot(axis, glm::dvec3(rigid[k]));
    rigid[i] = glm::dvec4(glm::normalize(axis), 0);
  }
  rigid[3] = to_world[3];
  const double length = glm::length(glm::dvec3(to_world[0]));
  for (int i = 0; i < 3; ++i) {
    if (glm::length(glm::dvec3(to_world[i]) - length * glm::dvec3(rigid[i])) > 1e-3 * length)
      context.tell(p.place(), fmt::format("{} is distorted where it stands", p.object()), "its form without that");
  }
  return rigid;
}

struct Ends {
  glm::dvec3 from, to;
};
Ends read_ends(Parameters& p, const glm::dmat4& to_world) {
  const glm::dvec3 from = p.vector("point3", "from").value_or(glm::dvec3(0));
  const glm::dvec3 to = p.vector("point3", "to").value_or(glm::dvec3(0, 0, 1));
  return {glm::dvec3(to_world * glm::dvec4(from, 1)), glm::dvec3(to_world * glm::dvec4(to, 1))};
}

/// Whether the light goes somewhere; complains otherwise.
bool have_direction(Parameters& p, const Ends& ends) {
  if (glm::length(ends.to - ends.from) > 0) return true;
  p.error(nullptr, fmt::format("'from' and 'to' of {} are the same", p.object()), "two points");
  return false;
}

/// A square image over the plane at distance 1, point by point: (x, y) from -half to half.
Image plane_image(int size, double half, const std::function<glm::dvec3(double x, double y)>& color) {
  Image image;
  image.width = image.height = size;
  const auto pixels = static_cast<std::size_t>(size) * static_cast<std::size_t>(size);
  for (const char* name : {"R", "G", "B"}) image.channels.push_back({name, std::vector<float>(pixels)});
  for (int row = 0; row < size; ++row) {
    for (int column = 0; column < size; ++column) {
      const double x = half * (1 - 2 * (column + 0.5) / size), y = half * (1 - 2 * (row + 0.5) / size);
      const glm::dvec3 c = color(x, y);
      for (int k = 0; k < 3; ++k)
        image.channels[static_cast<std::size_t>(k)].values[static_cast<std::size_t>(row * size + column)] =
            static_cast<float>(c[k]);
    }
  }
  return image;
}

std::shared_ptr<const Node> slide(Context& context, Image image, const Place& place) {
  Node node = image_node(context, std::move(image), place);
  give(node, "wrap_mode", std::string("clamp"), place);
  return std::make_shared<const Node>(std::move(node));
}

void add_point(Parameters& p, const glm::dvec3& emission, double scale, const glm::dmat4& to_world, Node& scene) {
  const glm::dvec3 from = p.vector("point3", "from").value_or(glm::dvec3(0));
  const double power = p.number("power", -1);
  if (power > 0) scale *= power / (4 * kPi);
  Node node = make_node("emitter", "point", p.place());
  give(node, "position", Property::Vector{to_array(glm::dvec3(to_world * glm::dvec4(from, 1)))}, p.place());
  give(node, "intensity", to_rgb(scale * emission), p.place());
  scene.add(std::move(node));
}

void add_spot(Context& context, Parameters& p, const glm::dvec3& emission, double scale, const glm::dmat4& to_world,
              Node& scene) {
  const Ends ends = read_ends(p, to_world);
  const double cone = p.number("coneangle", 30, 0, 180), edge = p.number("conedeltaangle", 5, 0, 180);
  const double power = p.number("power", -1);
  if (!have_direction(p, ends)) return;
  if (edge > cone || cone == 0 || cone == 180) {
    p.error(nullptr, fmt::format("the cone of {} is {:g} degrees with an edge of {:g}", p.object(), cone, edge),
            "a coneangle above 0 and below 180, and a conedeltaangle up to it");
    return;
  }
  const double outer = std::cos(glm::radians(cone)), inner = std::cos(glm::radians(cone - edge));
  if (power > 0) scale *= power / (2 * kPi * (1 - inner + (inner - outer) / 2));
  Node node = make_node("emitter", "spot", p.place());
  give(node, "intensity", to_rgb(scale * emission), p.place());
  give(node, "cutoff_angle", cone, p.place());
  give(node, "to_world", facing(ends.from, ends.to - ends.from), p.place());
  constexpr double kWidestSlide = 85;
  if (cone <= kWidestSlide && edge > 0) {
    give(node, "beam_width", cone, p.place());
    const double half = std::tan(glm::radians(cone));
    Image image = plane_image(kSlideTexels, half, [&](double x, double y) {
      return glm::dvec3(glm::smoothstep(outer, inner, 1 / std::sqrt(1 + x * x + y * y)));
    });
    add_child(node, slide(context, std::move(image), p.place()), "texture", p.place());
  } else {
    give(node, "beam_width", cone - edge, p.place());
    if (edge > 0)
      context.tell(p.place(), fmt::format("the edge of spots wider than {:g} degrees has another form", kWidestSlide),
                   "it falls off linearly with the angle");
  }
  scene.add(std::move(node));
}

void add_distant(Parameters& p, const glm::dvec3& emission, double scale, const glm::dmat4& to_world, Node& scene) {
  const Ends ends = read_ends(p, to_world);
  const double illuminance = p.number("illuminance", -1);
  if (illuminance > 0) scale *= illuminance;
  if (!have_direction(p, ends)) return;
  Node node = make_node("emitter", "directional", p.place());
  give(node, "direction", Property::Vector{to_array(glm::normalize(ends.to - ends.from))}, p.place());
  give(node, "irradiance", to_rgb(scale * emission), p.place());
  scene.add(std::move(node));
}

/// Null after a complaint.
std::shared_ptr<const ImageFile> read_light_image(ImageFiles& images, Parameters& p) {
  const Parameter* filename = p.find("string", "filename");
  if (!filename) p.error(nullptr, fmt::format("{} has no image", p.object()), R"("string filename" "image.exr")");
  return filename && p.has_values(*filename, 1) ? images.read(*filename) : nullptr;
}

/// A projector of 90 degrees for each face of a cube: what each throws is the light's intensity in that direction.
void add_goniometric(Context& context, ImageFiles& images, Parameters& p, const glm::dvec3& emission, double scale,
                     const glm::dmat4& to_world, Node& scene) {
  const double power = p.number("power", -1);
  const auto file = read_light_image(images, p);
  if (!file) return;
  const int width = file->image.width, height = file->image.height;
  if (width != height)
    return p.error(p.find("string", "filename"),
                   fmt::format("the image of {} has {} x {} pixels", p.object(), width, height),
                   "a square image of equal areas");
  if (power > 0) {
    double sum = 0;
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) sum += (file->texel(x, y).r + file->texel(x, y).g + file->texel(x, y).b) / 3;
    }
    scale *= power / (4 * kPi * sum / (static_cast<double>(width) * height));
  }
  const glm::dmat3 light_from_world = glm::inverse(glm::dmat3(to_world));
  static const glm::dvec3 kAxes[] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  for (const glm::dvec3& axis : kAxes) {
    const Property::Transform frame = facing(glm::dvec3(to_world[3]), axis);
    const glm::dmat3 world_from_local(to_glm(frame));
    Image image = plane_image(std::max(width / 2, 16), 1, [&](double x, double y) {
      const glm::dvec3 w = glm::normalize(light_from_world * (world_from_local * glm::dvec3(x, y, 1)));
      const glm::dvec3 color = equal_area_texel(*file, {w.x, w.z, w.y});
      const double cosine = 1 / std::sqrt(1 + x * x + y * y);
      return scale * emission * (color.r + color.g + color.b) / 3.0 * cosine * cosine * cosine / kPi;
    });
    Node node = make_node("emitter", "projector", p.place());
    give(node, "fov", 90.0, p.place());
    give(node, "to_world", frame, p.place());
    add_child(node, slide(context, std::move(image), p.place()), "irradiance", p.place());
    scene.add(std::move(node));
  }
}

void add_projection(Context& context, ImageFiles& images, Parameters& p, double scale, const glm::dmat4& to_world,
                    Node& scene) {
  const double power = p.number("power", -1), fov = p.number("fov", 90, 1e-3, 179.999);
  const auto file = read_light_image(images, p);
  if (!file) return;
  const int width = file->image.width, height = file->image.height;
  const double half = std::tan(glm::radians(fov) / 2);
  const double half_width = half * std::max(1.0, static_cast<double>(width) / height);
  const double half_height = half * std::max(1.0, static_cast<double>(height) / width);
  Image image;
  image.width = width, image.height = height;
  for (const char* name : {"R", "G", "B"})
    image.channels.push_back({name, std::vector<float>(file->color[0]->values.size())});
  double sum = 0;
  for (int row = 0; row < height; ++row) {
    for (int column = 0; column < width; ++column) {
      const double x = half_width * (1 - 2 * (column + 0.5) / width), y = half_height * (1 - 2 * (row + 0.5) / height);
      const double cosine = 1 / std::sqrt(1 + x * x + y * y);
      const glm::dvec3 color = file->texel(column, row) * (cosine * cosine * cosine);
      sum += luminance_of(color);
      for (int k = 0; k < 3; ++k)
        image.channels[static_cast<std::size_t>(k)].values[file->index(column, row)] = static_cast<float>(color[k]);
    }
  }
  if (power > 0) scale *= power / (4 * half_width * half_height * sum / (static_cast<double>(width) * height));
  Node node = make_node("emitter", "projector", p.place());
  give(node, "fov", fov, p.place());
  give(node, "fov_axis", std::string("smaller"), p.place());
  give(node, "scale", scale / kPi, p.place());
  // The image's columns go along pbrt's +x, which is its right.
  give(node, "to_world", to_transform(glm::scale(without_scale(context, p, to_world), glm::dvec3(-1, 1, 1))),
       p.place());
  add_child(node, slide(context, std::move(image), p.place()), "irradiance", p.place());
  scene.add(std::move(node));
}

}  // namespace

double luminance_of(const glm::dvec3& color) { return luminance(color.r, color.g, color.b); }

glm::dvec3 read_emission(Context& context, Parameters& p, std::string_view name, const ColorSpace& space) {
  return read_color(context, p, name, Slot::illuminant, space).value_or(space.srgb_from_light * glm::dvec3(1));
}

void add_light(Context& context, ImageFiles& images, const std::string& type, Parameters& p, const ColorSpace& space,
               const glm::dmat4& to_world, Node& scene, Environment& environment) {
  static const std::vector<std::string> kTypes = {"distant", "goniometric", "infinite", "point", "projection", "spot"};
  const auto scale = [&] { return p.number("scale", 1, 0) * context.imaging_ratio; };
  if (type == "infinite") return add_infinite_light(context, images, p, space, to_world, environment);
  if (type == "point") return add_point(p, read_emission(context, p, "I", space), scale(), to_world, scene);
  if (type == "spot") return add_spot(context, p, read_emission(context, p, "I", space), scale(), to_world, scene);
  if (type == "distant") return add_distant(p, read_emission(context, p, "L", space), scale(), to_world, scene);
  if (type == "projection") return add_projection(context, images, p, scale(), to_world, scene);
  if (type == "goniometric")
    return add_goniometric(context, images, p, read_emission(context, p, "I", space), scale(), to_world, scene);
  context.diagnostics.error(p.place().location(),
                            fmt::format("unknown light {}{}", quoted(type), did_you_mean(type, kTypes)), join(kTypes));
}

}  // namespace norrsken::pbrt
