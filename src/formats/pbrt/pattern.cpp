#include "formats/pbrt/pattern.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <utility>

namespace norrsken::pbrt {
namespace {

constexpr double kMostTexels = 4096;  // along a side of an image that is drawn
constexpr int kSamplesOfMean = 64;    // along a side
constexpr int kMostPeriods = 64;      // of one pattern in the period of two

/// The least common multiple of two periods; none if it is too many of either.
double common_period(double a, double b) {
  if (a == 0 || b == 0) return std::max(a, b);
  for (int n = 1; n <= kMostPeriods; ++n) {
    const double times = n * a / b;
    if (std::abs(times - std::round(times)) < 1e-6 && std::round(times) >= 1) return n * a;
  }
  return Pattern::kNoPeriod;
}

/// The part of (u, v) that an image is drawn of.
struct Domain {
  glm::dvec2 origin{0}, size{1};
  bool repeats[2] = {true, true};
  int texels[2] = {1, 1};
};

Domain domain_of(const Pattern& pattern) {
  Domain domain{.origin = pattern.origin};
  for (int axis = 0; axis < 2; ++axis) {
    const double period = pattern.period[axis];
    domain.repeats[axis] = std::isfinite(period);
    domain.size[axis] = domain.repeats[axis] && period > 0 ? period : 1;
    const double wanted = period == 0 ? 1 : pattern.texels[axis] * domain.size[axis];
    domain.texels[axis] = static_cast<int>(std::clamp(std::round(wanted), 1.0, kMostTexels));
  }
  return domain;
}

Property::Transform to_uv_of(const Domain& domain) {
  Property::Transform to_uv;
  for (std::size_t axis = 0; axis < 2; ++axis) {
    const auto i = static_cast<int>(axis);
    to_uv.rows[axis][axis] = 1 / domain.size[i];
    to_uv.rows[axis][3] = -domain.origin[i] / domain.size[i];
  }
  return to_uv;
}

}  // namespace

Pattern Pattern::constant(const glm::dvec3& color) {
  return {.at = [color](const glm::dvec2&) { return color; }};
}

glm::dvec3 Pattern::mean() const {
  if (whole) return whole().mean();
  if (is_constant) return value();
  const Domain domain = domain_of(*this);
  glm::dvec3 sum(0);
  for (int y = 0; y < kSamplesOfMean; ++y) {
    for (int x = 0; x < kSamplesOfMean; ++x)
      sum += at(domain.origin + domain.size * (glm::dvec2(x, y) + 0.5) / double{kSamplesOfMean});
  }
  return sum / double{kSamplesOfMean * kSamplesOfMean};
}

Pattern map(const Pattern& a, const std::function<glm::dvec3(const glm::dvec3&)>& f) {
  if (a.whole) return map(a.whole(), f);
  Pattern result = a;
  result.node = nullptr;
  if (a.is_constant) return Pattern::constant(f(a.value()));
  result.at = [at = a.at, f](const glm::dvec2& uv) { return f(at(uv)); };
  return result;
}

Pattern map(const std::vector<Pattern>& given, const std::function<glm::dvec3(const std::vector<glm::dvec3>&)>& f) {
  std::vector<Pattern> all;
  for (const Pattern& pattern : given) all.push_back(pattern.whole ? pattern.whole() : pattern);
  const auto at = [all, f](const glm::dvec2& uv) {
    std::vector<glm::dvec3> values;
    for (const Pattern& pattern : all) values.push_back(pattern.at(uv));
    return f(values);
  };
  const auto varying = std::ranges::count_if(all, [](const Pattern& pattern) { return !pattern.is_constant; });
  if (varying == 0) return Pattern::constant(at({0, 0}));
  Pattern result{.at = at, .is_constant = false};
  for (const Pattern& pattern : all) {
    if (pattern.is_constant) continue;
    if (varying == 1) {
      result.origin = pattern.origin;
      result.is_sharp = pattern.is_sharp;
    }
    for (int axis = 0; axis < 2; ++axis) {
      result.period[axis] = common_period(result.period[axis], pattern.period[axis]);
      // Edges within an image need finer texels than those of its own.
      const double fine = pattern.is_sharp && varying > 1 ? 32 : 1;
      result.texels[axis] = std::max(result.texels[axis], fine * pattern.texels[axis]);
    }
  }
  return result;
}

Node image_node(Context& context, Image image, const Place& place) {
  std::size_t values = 0;
  for (const Channel& channel : image.channels) values += channel.values.size();
  context.memory.grow(sizeof(float) * values);
  Node node = make_node("texture", "bitmap", place);
  give(node, "image", std::make_shared<const Image>(std::move(image)), place);
  return node;
}

std::shared_ptr<const Node> texture_node(Context& context, const Pattern& pattern, const Place& place, bool grey) {
  if (pattern.node) return pattern.node;
  const Domain domain = domain_of(pattern);
  Image image;
  image.width = domain.texels[0], image.height = domain.texels[1];
  const std::size_t pixels = static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
  const std::vector<std::string> names = grey ? std::vector<std::string>{"Y"} : std::vector<std::string>{"R", "G", "B"};
  const MemoryReservation drawing(sizeof(float) * pixels * names.size());
  for (const std::string& name : names) image.channels.push_back({name, std::vector<float>(pixels)});
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const glm::dvec2 uv =
          domain.origin + domain.size * (glm::dvec2(x, y) + 0.5) / glm::dvec2(image.width, image.height);
      const glm::dvec3 color = pattern.at(uv);
      const std::size_t pixel =
          static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) + static_cast<std::size_t>(x);
      if (grey) {
        image.channels[0].values[pixel] = static_cast<float>((color.r + color.g + color.b) / 3);
      } else {
        for (int c = 0; c < 3; ++c)
          image.channels[static_cast<std::size_t>(c)].values[pixel] = static_cast<float>(color[c]);
      }
    }
  }
  Node node = image_node(context, std::move(image), place);
  give(node, "to_uv", to_uv_of(domain), place);
  if (pattern.is_sharp) give(node, "filter_type", std::string("nearest"), place);
  if (!domain.repeats[0] || !domain.repeats[1]) {
    if (!domain.repeats[0]) give(node, "wrap_mode_u", std::string("clamp"), place);
    if (!domain.repeats[1]) give(node, "wrap_mode_v", std::string("clamp"), place);
    context.tell(place, "a texture that does not repeat is drawn where u and v are 0 to 1, and its edges go on beyond");
  }
  return std::make_shared<const Node>(std::move(node));
}

void give_number(Context& context, Node& node, const std::string& name, const Pattern& pattern, const Place& place) {
  if (pattern.is_constant) {
    const glm::dvec3 value = pattern.value();
    give(node, name, (value.r + value.g + value.b) / 3, place);
  } else {
    add_child(node, texture_node(context, pattern, place, /*grey=*/true), name, place);
  }
}

void give_color(Context& context, Node& node, const std::string& name, const Pattern& pattern, const Place& place) {
  if (pattern.is_constant) {
    give(node, name, to_rgb(pattern.value()), place);
  } else {
    add_child(node, texture_node(context, pattern, place, /*grey=*/false), name, place);
  }
}

}  // namespace norrsken::pbrt
