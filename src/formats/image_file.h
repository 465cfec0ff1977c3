// Image files that scenes of other languages name, whose readers make textures and lights of their texels.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>

#include <glm/vec3.hpp>

#include "base/memory.h"
#include "norrsken/image.h"

namespace norrsken {

/// An image in memory, with its part of the budget, its colours decoded from sRGB.
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

/// Of a file's bytes. Null with `error` set if they are no image with colours. May throw MemoryExceeded.
std::shared_ptr<const ImageFile> decode_image_file(std::string_view bytes, std::string& error);

}  // namespace norrsken
