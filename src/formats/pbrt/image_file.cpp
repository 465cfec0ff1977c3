#include "formats/pbrt/image_file.h"

#include "base/text.h"

namespace norrsken::pbrt {

std::shared_ptr<const ImageFile> ImageFiles::read(const Parameter& parameter) {
  const std::string path = context_.find_file(parameter);
  if (path.empty()) return nullptr;
  std::weak_ptr<const ImageFile>& known = files_[normal_path(path)];
  if (auto file = known.lock()) return file;
  const auto refuse = [&](const std::string& reason) -> std::shared_ptr<const ImageFile> {
    context_.diagnostics.error(parameter.value.location(), "cannot read the image " + quoted(path, 200) + ": " + reason,
                               "a PNG, JPEG, BMP, TGA, TIFF, PNM, PFM, EXR or HDR file");
    return nullptr;
  };
  std::string error;
  const auto contents = read_counted(context_.files, path, error);
  if (!contents) return refuse(error);
  auto file = decode_image_file(contents->bytes, error);
  if (!file) return refuse(error);
  known = file;
  return file;
}

}  // namespace norrsken::pbrt
