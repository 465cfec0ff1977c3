#include "formats/pbrt/texture_mapping.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

#include "base/numbers.h"
#include "base/text.h"
#include "color/srgb.h"

namespace norrsken::pbrt {
namespace {

/// A texel number beyond the image's sides; -1 where there is nothing.
int wrapped(int i, int size, const std::string& wrap) {
  if (i >= 0 && i < size) return i;
  if (wrap == "black") return -1;
  if (wrap == "repeat") return ((i % size) + size) % size;
  return std::clamp(i, 0, size - 1);
}

/// The image at (s, t) with t upwards.
class Lookup {
 public:
  Lookup(std::shared_ptr<const ImageFile> file, ImageLookup how, bool alpha, bool is_png)
      : file_(std::move(file)), how_(std::move(how)), alpha_(alpha), is_png_(is_png) {}

  glm::dvec3 operator()(const glm::dvec2& st) const {
    const double x = std::clamp(st.x, -1e6, 1e6) * file_->image.width,
                 y = (1 - std::clamp(st.y, -1e6, 1e6)) * file_->image.height;
    if (how_.filter == "point") return texel(static_cast<int>(std::floor(x)), static_cast<int>(std::floor(y)));
    const double left = std::floor(x - 0.5), top = std::floor(y - 0.5);
    const double a = x - 0.5 - left, b = y - 0.5 - top;
    const int i = static_cast<int>(left), j = static_cast<int>(top);
    return glm::mix(glm::mix(texel(i, j), texel(i + 1, j), a), glm::mix(texel(i, j + 1), texel(i + 1, j + 1), a), b);
  }

 private:
  glm::dvec3 texel(int x, int y) const {
    x = wrapped(x, file_->image.width, how_.wrap);
    y = wrapped(y, file_->image.height, how_.wrap);
    if (x < 0 || y < 0) return finish(glm::dvec3(0));
    if (alpha_) return finish(glm::dvec3(file_->alpha->values[file_->index(x, y)]));
    glm::dvec3 color = file_->texel(x, y);
    if (is_png_ && how_.gamma != 0) {
      for (int c = 0; c < 3; ++c) color[c] = std::pow(std::max(srgb_from_linear(color[c]), 0.0), how_.gamma);
    }
    return finish(color);
  }
  glm::dvec3 finish(const glm::dvec3& color) const {
    const glm::dvec3 value = how_.invert ? 1.0 - how_.scale * color : how_.scale * color;
    // Numbers, such as heights, may be negative if nothing inverts them.
    return how_.is_number && !how_.invert ? value : glm::max(value, glm::dvec3(0));
  }

  std::shared_ptr<const ImageFile> file_;
  ImageLookup how_;
  bool alpha_, is_png_;
};

bool has_ending(const std::string& path, std::string_view ending) {
  return path.size() >= ending.size() && equal_ignoring_case(path.substr(path.size() - ending.size()), ending);
}

}  // namespace

Pattern TextureMapping::squares() const {
  Pattern pattern;
  pattern.is_constant = false;
  pattern.is_sharp = true;
  pattern.at = [mapping = *this](const glm::dvec2& uv) {
    const glm::dvec2 cell = glm::floor(mapping.at(uv));
    return glm::dvec3(std::fmod(std::abs(cell.x + cell.y), 2) < 0.5 ? 1 : 0);
  };
  for (int axis = 0; axis < 2; ++axis) {
    if (scale[axis] == 0) continue;
    pattern.period[axis] = 2 / std::abs(scale[axis]);
    pattern.texels[axis] = std::abs(scale[axis]);
    pattern.origin[axis] = -shift[axis] / scale[axis];
  }
  return pattern;
}

TextureMapping read_mapping(Context& context, Parameters& p) {
  const std::string type = p.choice("mapping", "uv", {"uv", "spherical", "cylindrical", "planar"});
  TextureMapping mapping;
  mapping.is_uv = type == "uv";
  if (type == "uv") mapping.scale = {p.number("uscale", 1), p.number("vscale", 1)};
  if (type == "planar") {
    p.vector("vector3", "v1");
    p.vector("vector3", "v2");
  }
  if (type == "uv" || type == "planar") mapping.shift = {p.number("udelta", 0), p.number("vdelta", 0)};
  if (!mapping.is_uv)
    context.tell(p.place(), fmt::format("texture mapping '{}' is not supported", type),
                 "the texture's mean value is taken");
  return mapping;
}

ImageLookup read_lookup(Parameters& p) {
  ImageLookup lookup;
  lookup.filter = p.choice("filter", "bilinear", {"point", "bilinear", "trilinear", "ewa", "EWA"});
  p.number("maxanisotropy", 8);
  lookup.wrap = p.choice("wrap", "repeat", {"repeat", "black", "clamp", "octahedralsphere"});
  lookup.scale = p.number("scale", 1);
  lookup.invert = p.flag("invert", false);
  const std::string encoding = p.text("encoding", "sRGB");
  if (encoding == "linear") {
    lookup.gamma = 1;
  } else if (encoding != "sRGB") {
    double gamma = 0;
    if (!encoding.starts_with("gamma ") || parse_number(trim(encoding.substr(6)), gamma) != NumberStatus::ok ||
        !(gamma > 0)) {
      p.error(p.find("string", "encoding"), fmt::format("unknown encoding {} of {}", quoted(encoding), p.object()),
              "sRGB, linear, gamma VALUE");
    } else {
      lookup.gamma = gamma;
    }
  }
  return lookup;
}

namespace {

/// The file itself as a texture, where nothing is done to its values.
Node file_node(const Parameter& filename, const ImageLookup& lookup, const TextureMapping& mapping, bool is_raw) {
  Node node = make_node("texture", "bitmap", filename.place);
  give(node, "filename", filename.strings[0], filename.value);
  if (is_raw) give(node, "raw", true, filename.value);
  if (lookup.filter == "point") give(node, "filter_type", std::string("nearest"), filename.value);
  if (lookup.wrap != "repeat") give(node, "wrap_mode", std::string("clamp"), filename.value);
  Property::Transform to_uv;
  to_uv.rows[0][0] = mapping.scale.x, to_uv.rows[0][3] = mapping.shift.x;
  to_uv.rows[1][1] = -mapping.scale.y, to_uv.rows[1][3] = 1 - mapping.shift.y;
  give(node, "to_uv", to_uv, filename.place);
  return node;
}

/// The image with its values changed as `lookup` says.
Pattern drawn_pattern(ImageFiles& images, const Parameter& filename, const ImageLookup& lookup,
                      const TextureMapping& mapping, bool is_png, bool is_alpha) {
  const std::shared_ptr<const ImageFile> file = images.read(filename);
  if (!file) return Pattern::constant(glm::dvec3(0.5));
  Pattern pattern;
  pattern.is_constant = false;
  pattern.at = [at = Lookup(file, lookup, is_alpha, is_png), mapping](const glm::dvec2& uv) {
    return at(mapping.at(uv));
  };
  const glm::dvec2 size(file->image.width, file->image.height);
  for (int axis = 0; axis < 2; ++axis) {
    if (mapping.scale[axis] == 0) continue;
    pattern.period[axis] = lookup.wrap == "repeat" ? 1 / std::abs(mapping.scale[axis]) : Pattern::kNoPeriod;
    pattern.texels[axis] = size[axis] * std::abs(mapping.scale[axis]);
  }
  return pattern;
}

}  // namespace

Pattern image_pattern(Context& context, ImageFiles& images, const Parameter& filename, const ImageLookup& lookup,
                      const TextureMapping& mapping) {
  if (lookup.wrap == "octahedralsphere")
    context.tell(filename.place, "wrap 'octahedralsphere' of an image is not supported", "wrap 'clamp'");
  const bool is_png = has_ending(filename.strings[0], ".png");
  bool is_alpha = false;
  if (lookup.is_number && lookup.filter == "bilinear") {
    const std::shared_ptr<const ImageFile> file = images.read(filename);
    is_alpha = file && file->alpha && std::ranges::any_of(file->alpha->values, [](float a) { return a != 1; });
  }
  const auto whole = [&images, filename, lookup, mapping, is_png, is_alpha] {
    return drawn_pattern(images, filename, lookup, mapping, is_png, is_alpha);
  };
  if (!mapping.is_uv) return Pattern::constant(whole().mean());
  const bool is_plain = lookup.scale == 1 && !lookup.invert && !is_alpha && lookup.wrap != "black" &&
                        (!is_png || lookup.gamma == 0 || lookup.gamma == 1);
  if (!is_plain) return whole();
  if (context.find_file(filename).empty()) return Pattern::constant(glm::dvec3(0.5));
  Pattern pattern;
  pattern.is_constant = false;
  pattern.node = std::make_shared<const Node>(file_node(filename, lookup, mapping, is_png && lookup.gamma == 1));
  pattern.whole = whole;
  return pattern;
}

}  // namespace norrsken::pbrt
