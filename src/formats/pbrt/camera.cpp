// pbrt's cameras. They look along +z with +y up and +x to the right, ours with +x to the left.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/matrix.hpp>

#include "base/text.h"
#include "formats/pbrt/lens.h"
#include "formats/pbrt/state.h"

namespace norrsken::pbrt {
namespace {

// pbrt clips nothing; nearer than this a hit is not told from the camera's own place.
constexpr double kNear = 1e-4, kFar = 1e11;
constexpr double kSameShape = 1e-3;  // by which pixels may differ from squares

/// A camera's placement without its scale, which the axes have apart.
struct Frame {
  glm::dmat4 to_world{1};
  glm::dvec3 scale{1};  ///< world units of a unit along each of the camera's axes
};

Frame frame_of(Context& context, Parameters& p, const glm::dmat4& camera_from_world) {
  Frame frame;
  frame.to_world = glm::scale(glm::inverse(camera_from_world), glm::dvec3(-1, 1, 1));
  bool is_sheared = false;
  // The direction of view stays, and what is up is made to be at right angles to it.
  for (const int i : {2, 1, 0}) {
    glm::dvec3 axis(frame.to_world[i]);
    frame.scale[i] = glm::length(axis);
    for (int k = 2; k > i; --k) {
      const glm::dvec3 other(frame.to_world[k]);
      is_sheared = is_sheared || std::abs(glm::dot(axis, other)) > 1e-3 * glm::length(axis);
      axis -= other * glm::dot(axis, other);
    }
    frame.to_world[i] = glm::dvec4(glm::normalize(axis), 0);
  }
  if (is_sheared) context.tell(p.place(), "the camera's placement is sheared", "axes at right angles");
  return frame;
}

/// What of the camera's plane is on the film.
struct Window {
  double left = -1, right = 1, bottom = -1, top = 1;
  double width() const { return right - left; }
  double height() const { return top - bottom; }
};

Window read_window(Parameters& p, const FilmSize& film) {
  const double aspect = p.positive("frameaspectratio", film.aspect());
  Window window;
  if (aspect > 1) {
    window.left = -aspect, window.right = aspect;
  } else {
    window.bottom = -1 / aspect, window.top = 1 / aspect;
  }
  const Parameter* given = p.find("float", "screenwindow");
  if (!given || !p.has_values(*given, 4)) return window;
  const Array<double>& n = given->numbers;
  if (n[0] < n[1] && n[2] < n[3]) return {n[0], n[1], n[2], n[3]};
  p.error(given, fmt::format("screenwindow {:g} {:g} {:g} {:g} is empty", n[0], n[1], n[2], n[3]),
          "xmin < xmax and ymin < ymax");
  return window;
}

/// Half the film's width in a plane in which pbrt's numbers count `unit`, with a warning if pixels were no squares.
double half_width_of(Context& context, Parameters& p, const Window& window, const Frame& frame, const FilmSize& film) {
  const double width = window.width() * frame.scale.x, height = window.height() * frame.scale.y;
  if (std::abs(width / height / film.aspect() - 1) > kSameShape)
    context.tell(p.place(),
                 fmt::format("the camera's picture is {:.4g} times as wide as high, the film {:.4g} times",
                             width / height, film.aspect()),
                 "pixels that are squares: the picture's width counts");
  return width / 2;
}

void give_placement(Node& node, const Frame& frame, const Place& place) {
  give(node, "near_clip", kNear, place);
  give(node, "far_clip", kFar, place);
  give(node, "to_world", to_transform(frame.to_world), place);
}

struct Lens {
  double radius = 0, focus = 1e6;
};
Lens read_lens(Parameters& p) { return {p.number("lensradius", 0, 0), p.positive("focaldistance", 1e6)}; }

Node make_perspective(Context& context, Parameters& p, const Frame& frame, const FilmSize& film, double half_angle,
                      const Window& window, const Lens& lens) {
  const double half_width = half_width_of(context, p, window, frame, film) * std::tan(half_angle) / frame.scale.z;
  const bool has_lens = lens.radius > 0;
  Node node = make_node("sensor", has_lens ? "thinlens" : "perspective", p.place());
  give(node, "fov", glm::degrees(2 * std::atan(half_width)), p.place());
  give(node, "fov_axis", std::string("x"), p.place());
  give_placement(node, frame, p.place());
  const double x = (window.left + window.right) / 2 / window.width(),
               y = (window.bottom + window.top) / 2 / window.height();
  if (has_lens) {
    give(node, "aperture_radius", lens.radius * frame.scale.x, p.place());
    give(node, "focus_distance", lens.focus * frame.scale.z, p.place());
    if (x != 0 || y != 0)
      context.tell(p.place(), "a screenwindow off the middle of a camera with a lens", "the one around the middle");
  } else {
    if (x != 0) give(node, "principal_point_offset_x", x, p.place());
    if (y != 0) give(node, "principal_point_offset_y", -y, p.place());
  }
  return node;
}

Node make_orthographic(Context& context, Parameters& p, Frame frame, const FilmSize& film) {
  const Window window = read_window(p, film);
  if (read_lens(p).radius > 0)
    context.tell(p.place(), "the lens of an orthographic camera is not supported", "a sharp picture");
  const double half_width = half_width_of(context, p, window, frame, film);
  const glm::dvec3 middle(-(window.left + window.right) / 2 * frame.scale.x,
                          (window.bottom + window.top) / 2 * frame.scale.y, 0);
  frame.to_world = glm::translate(frame.to_world, middle);
  frame.to_world = glm::scale(frame.to_world, glm::dvec3(half_width, half_width, 1));
  Node node = make_node("sensor", "orthographic", p.place());
  give_placement(node, frame, p.place());
  return node;
}

}  // namespace

Node make_camera(Context& context, const std::string& type, Parameters& p, const glm::dmat4& camera_from_world,
                 const FilmSize& film) {
  static const std::vector<std::string> kTypes = {"orthographic", "perspective", "realistic", "spherical"};
  p.number("shutteropen", 0);
  p.number("shutterclose", 1);
  const Frame frame = frame_of(context, p, camera_from_world);
  if (type == "orthographic") return make_orthographic(context, p, frame, film);
  if (type == "realistic") {
    const Optics optics = read_optics(context, p, film);
    const double aspect = film.aspect();
    Window window;
    window.left = -optics.half_width, window.right = optics.half_width;
    window.bottom = -optics.half_width / aspect, window.top = optics.half_width / aspect;
    return make_perspective(context, p, frame, film, std::atan(1.0), window, {optics.lens_radius, optics.focus});
  }
  if (type == "spherical") {
    p.choice("mapping", "equalarea", {"equalarea", "equirectangular"});
    read_window(p, film);
    read_lens(p);
    context.tell(p.place(), "camera 'spherical' is not supported", "a perspective camera of 90 degrees");
    Window window;
    (film.aspect() > 1 ? window.right : window.top) = std::max(film.aspect(), 1 / film.aspect());
    if (film.aspect() > 1)
      window.left = -window.right;
    else
      window.bottom = -window.top;
    return make_perspective(context, p, frame, film, glm::radians(45.0), window, {});
  }
  if (type != "perspective")
    p.error(nullptr, fmt::format("unknown camera {}{}", quoted(type), did_you_mean(type, kTypes)), join(kTypes));
  const double fov = p.number("fov", 90);
  if (!(fov > 0 && fov < 180))
    p.error(p.find("float", "fov"), fmt::format("'fov' of {} is {:g}", p.object(), fov),
            "degrees above 0 and below 180");
  const Window window = read_window(p, film);
  return make_perspective(context, p, frame, film, glm::radians(std::clamp(fov, 1e-3, 179.9) / 2), window,
                          read_lens(p));
}

}  // namespace norrsken::pbrt
