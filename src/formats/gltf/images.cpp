#include "formats/gltf/images.h"

#include <algorithm>
#include <cmath>

#include "base/text.h"
#include "color/srgb.h"

namespace norrsken::gltf {
namespace {

constexpr int kFinest = 4096;  // texels along a side of what is made finer

std::size_t pixels_of(const Image& image) {
  return static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
}

std::string wrap_word(Asset& asset, const Json& sampler, std::string_view name) {
  switch (asset.whole(sampler, name, 10497)) {
    case 10497:
      return "repeat";
    case 33071:
      return "clamp";
    case 33648:
      return "mirror";
    default:
      asset.error(sampler, fmt::format("unknown '{}'", name),
                  "10497 (repeat), 33071 (clamp to edge) or 33648 (mirrored repeat)");
      return "repeat";
  }
}

/// What the two extensions that name another image in a texture's place are called.
constexpr const char* kOtherSources[] = {"EXT_texture_webp", "KHR_texture_basisu", "EXT_texture_avif",
                                         "MSFT_texture_dds"};

}  // namespace

std::optional<TextureUse> Images::use(const Json& object, std::string_view name) {
  TextureUse use;
  use.info = asset_.member(object, name, Json::Kind::object);
  if (!use.info) return std::nullopt;
  if (!use.info->find("index")) {
    asset_.error(*use.info, fmt::format("'{}' has no 'index'", name), "the index of a texture");
    return std::nullopt;
  }
  use.texture = asset_.referred(*use.info, "index", "textures");
  if (!use.texture) return std::nullopt;
  use.set = asset_.whole(*use.info, "texCoord", 0);
  if (const Json* transform = asset_.extension(*use.info, "KHR_texture_transform")) {
    const auto offset = asset_.numbers<2>(*transform, "offset", {0, 0});
    const auto scale = asset_.numbers<2>(*transform, "scale", {1, 1});
    const double turn = asset_.number(*transform, "rotation", 0), c = std::cos(turn), s = std::sin(turn);
    use.to_uv.rows[0] = {c * scale[0], s * scale[1], 0, offset[0]};
    use.to_uv.rows[1] = {-s * scale[0], c * scale[1], 0, offset[1]};
    use.set = asset_.whole(*transform, "texCoord", use.set);
    use.is_moved = true;
  }
  use.image = asset_.referred(*use.texture, "source", "images");
  if (!use.image && !use.texture->find("source")) {
    for (const char* extension : kOtherSources) {
      if (asset_.extension(*use.texture, extension))
        asset_.tell(*use.texture, fmt::format("textures of {} alone are not supported", extension), "none");
    }
  }
  if (!use.image) return std::nullopt;
  return use;
}

std::shared_ptr<const ImageFile> Images::read(const Json& json) {
  if (const auto known = files_.find(&json); known != files_.end()) return known->second;
  std::shared_ptr<const ImageFile>& result = files_[&json];
  const auto refuse = [&](const std::string& reason) {
    asset_.error(json, "cannot read the image: " + reason, "a PNG or JPEG file");
    return nullptr;
  };
  std::string_view bytes;
  std::shared_ptr<const std::string> data;
  if (json.find("uri")) {
    data = asset_.resource(json);
    if (!data) return nullptr;
    bytes = *data;
  } else {
    const Json* view = asset_.referred(json, "bufferView", "bufferViews");
    if (!view) return json.find("bufferView") ? nullptr : refuse("it has neither 'uri' nor 'bufferView'");
    const auto found = asset_.view(*view);
    if (!found) return nullptr;
    bytes = *found;
  }
  std::string error;
  const auto file = decode_image_file(bytes, error);
  if (!file) return refuse(error);
  return result = file;
}

bool Images::is_nearest(const TextureUse& use) {
  constexpr std::size_t kNearest = 9728;
  const Json* sampler = asset_.referred(*use.texture, "sampler", "samplers");
  return sampler && asset_.whole(*sampler, "magFilter", 0) == kNearest;
}

Node Images::node_of(const TextureUse& use, std::shared_ptr<const Image> image) {
  const SourceLocation place = asset_.place(*use.info);
  Node node = make_node("texture", "bitmap", place);
  give(node, "image", std::move(image), place);
  const Json* sampler = asset_.referred(*use.texture, "sampler", "samplers");
  if (sampler) {
    const std::string u = wrap_word(asset_, *sampler, "wrapS"), v = wrap_word(asset_, *sampler, "wrapT");
    if (u == v) {
      if (u != "repeat") give(node, "wrap_mode", u, place);
    } else {
      give(node, "wrap_mode_u", u, place);
      give(node, "wrap_mode_v", v, place);
    }
  }
  if (is_nearest(use)) give(node, "filter_type", std::string("nearest"), place);
  if (use.is_moved) give(node, "to_uv", use.to_uv, place);
  return node;
}

std::shared_ptr<const Node> Images::bitmap(const TextureUse& use, const std::string& key, bool is_grey,
                                           const TexelFunction& of) {
  std::shared_ptr<const Image>& known = images_[{use.image, key}];
  if (!known) {
    const auto file = read(*use.image);
    if (!file) return nullptr;
    const std::size_t pixels = pixels_of(file->image), channels = is_grey ? 1 : 3;
    asset_.memory.grow(sizeof(float) * channels * pixels);
    Image image;
    image.width = file->image.width, image.height = file->image.height;
    for (std::size_t c = 0; c < channels; ++c)
      image.channels.push_back({is_grey ? "Y" : std::string(1, "RGB"[c]), std::vector<float>(pixels)});
    for (std::size_t i = 0; i < pixels; ++i) {
      const std::array<float, 3> values = of({file->color[0]->values[i], file->color[1]->values[i],
                                              file->color[2]->values[i], file->alpha ? file->alpha->values[i] : 1.0f});
      for (std::size_t c = 0; c < channels; ++c) image.channels[c].values[i] = values[c];
    }
    known = std::make_shared<const Image>(std::move(image));
  }
  return std::make_shared<const Node>(node_of(use, known));
}

std::shared_ptr<const Node> Images::cut_out(const TextureUse& use, double factor, double cutoff) {
  // Texels that are not blended need no finer ones for their edge.
  const bool nearest = is_nearest(use);
  std::shared_ptr<const Image>& known = images_[{use.image, fmt::format("cut {} {} {}", factor, cutoff, nearest)}];
  if (!known) {
    const auto file = read(*use.image);
    if (!file) return nullptr;
    const int width = file->image.width, height = file->image.height;
    const int finer = nearest ? 1 : std::clamp(kFinest / std::max(width, height), 1, 4);
    Image image;
    image.width = width * finer, image.height = height * finer;
    asset_.memory.grow(sizeof(float) * pixels_of(image));
    image.channels.push_back({"Y", std::vector<float>(pixels_of(image), 1.0f)});
    const auto alpha = [&](int x, int y) {
      const std::size_t column = static_cast<std::size_t>(std::clamp(x, 0, width - 1));
      const std::size_t row = static_cast<std::size_t>(std::clamp(y, 0, height - 1));
      return file->alpha ? double{file->alpha->values[row * static_cast<std::size_t>(width) + column]} : 1.0;
    };
    std::size_t i = 0;
    for (int row = 0; row < image.height; ++row) {
      for (int column = 0; column < image.width; ++column) {
        const double x = (column + 0.5) / finer - 0.5, y = (row + 0.5) / finer - 0.5;
        const double x0 = std::floor(x), y0 = std::floor(y), dx = x - x0, dy = y - y0;
        const int c = static_cast<int>(x0), r = static_cast<int>(y0);
        const double value = (1 - dy) * ((1 - dx) * alpha(c, r) + dx * alpha(c + 1, r)) +
                             dy * ((1 - dx) * alpha(c, r + 1) + dx * alpha(c + 1, r + 1));
        image.channels[0].values[i++] = factor * value >= cutoff ? 1.0f : 0.0f;
      }
    }
    known = std::make_shared<const Image>(std::move(image));
  }
  return std::make_shared<const Node>(node_of(use, known));
}

}  // namespace norrsken::gltf
