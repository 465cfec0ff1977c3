// Textures of materials: images, decoded and multiplied with the factors beside them, as nodes.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "formats/gltf/asset.h"
#include "formats/image_file.h"

namespace norrsken::gltf {

/// What a material says of one of its textures.
struct TextureUse {
  const Json* info = nullptr;     ///< the textureInfo
  const Json* texture = nullptr;  ///< what it names
  const Json* image = nullptr;
  std::size_t set = 0;  ///< of texture coordinates
  Property::Transform to_uv;
  bool is_moved = false;  ///< whether to_uv is not the identity
};

class Images {
 public:
  explicit Images(Asset& asset) : asset_(asset) {}

  /// Empty if the object has no such texture, or after a complaint.
  std::optional<TextureUse> use(const Json& object, std::string_view name);

  /// A bitmap of what `of` makes of each texel's red, green, blue, decoded from sRGB, and alpha. Uses with the same `key` are
  /// one image. Null after a complaint.
  using TexelFunction = std::function<std::array<float, 3>(const std::array<float, 4>& texel)>;
  std::shared_ptr<const Node> bitmap(const TextureUse& use, const std::string& key, bool is_grey,
                                     const TexelFunction& of);

  /// The coverage that an alpha cut off at `cutoff` makes: 0 or 1, in a finer grid than the image's, so that edges are sharp.
  std::shared_ptr<const Node> cut_out(const TextureUse& use, double factor, double cutoff);

 private:
  std::shared_ptr<const ImageFile> read(const Json& image);
  bool is_nearest(const TextureUse& use);
  Node node_of(const TextureUse& use, std::shared_ptr<const Image> image);

  Asset& asset_;
  std::map<const Json*, std::shared_ptr<const ImageFile>> files_;
  std::map<std::pair<const Json*, std::string>, std::shared_ptr<const Image>> images_;
};

}  // namespace norrsken::gltf
