// pbrt's textures, by their names.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "formats/pbrt/image_file.h"
#include "formats/pbrt/pattern.h"

namespace norrsken::pbrt {

/// Texture "name" "spectrum" "imagemap" ...
struct TextureDefinition {
  std::string type;
  Parameters parameters;
  const ColorSpace* space;
};

class Textures {
 public:
  explicit Textures(Context& context) : context_(context), images_(context) {}

  /// False if there is one of that kind ("float" or "spectrum") and name.
  bool define(const std::string& kind, const std::string& name, TextureDefinition definition);

  /// A `float` or a `texture`.
  Pattern number(Parameters& p, std::string_view name, double fallback);
  /// A colour or a `texture`; empty if neither is given.
  std::optional<Pattern> color(Parameters& p, std::string_view name, Slot slot, const ColorSpace& space);
  Pattern color(Parameters& p, std::string_view name, Slot slot, const ColorSpace& space, const glm::dvec3& fallback);

  /// Reads those, too, that nothing uses, so that what is wrong with them is told.
  void finish();

  ImageFiles& images() { return images_; }

 private:
  using Key = std::pair<std::string, std::string>;  ///< kind and name

  Pattern of(const Key& key, Slot slot, Parameters& user, const Parameter& reference);
  Pattern read(const Key& key, TextureDefinition& definition, Slot slot);
  Pattern read_image(const Key& key, TextureDefinition& definition);
  /// A parameter of a texture of that kind.
  Pattern operand(const Key& key, TextureDefinition& definition, std::string_view name, double fallback, Slot slot);

  Context& context_;
  ImageFiles images_;
  std::map<Key, TextureDefinition> definitions_;
  std::map<std::pair<Key, Slot>, Pattern> patterns_;
  std::vector<Key> open_;  ///< those that are being read, each inside of the one before
};

}  // namespace norrsken::pbrt
