// Image files that textures and lights are made of.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <map>
#include <memory>
#include <string>

#include "formats/pbrt/context.h"

namespace norrsken::pbrt {

/// An image in memory, with its part of the budget.
struct ImageFile {
  Image image;
  MemoryReservation memory;
  const Channel* color[3] = {};  ///< red, green, blue; of a grey image three times the same
  const Channel* alpha = nullptr;

  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) + static_cast<std::size_t>(x);
  }
  glm::dvec3 texel(int x, int y) const {
    const std::size_t i = index(x, y);
    return {color[0]->values[i], color[1]->values[i], color[2]->values[i]};
  }
};

class ImageFiles {
 public:
  explicit ImageFiles(Context& context) : context_(context) {}

  /// The image that a parameter names, in linear sRGB; null after a complaint.
  std::shared_ptr<const ImageFile> read(const Parameter& parameter);

 private:
  Context& context_;
  std::map<std::string, std::weak_ptr<const ImageFile>> files_;  ///< those that somebody still needs
};

}  // namespace norrsken::pbrt
