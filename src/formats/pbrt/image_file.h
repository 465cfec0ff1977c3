// Image files that textures and lights are made of.
#pragma once

#include <map>
#include <memory>
#include <string>

#include "formats/image_file.h"
#include "formats/pbrt/context.h"

namespace norrsken::pbrt {

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
