#include "formats/pbrt/image_file.h"

#include <utility>

#include "base/text.h"
#include "image/channels.h"
#include "image/texel_image.h"

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
  const auto& budget = MemoryScope::current();
  auto file = std::make_shared<ImageFile>();
  error = read_image_contents(contents->bytes, budget ? budget->left() : MemoryBudget::kUnlimited, file->image);
  if (!error.empty()) return refuse(error);
  std::vector<std::string> names;
  std::size_t values = 0;
  for (const Channel& channel : file->image.channels) {
    names.push_back(channel.name);
    values += channel.values.size();
  }
  file->memory = MemoryReservation(sizeof(float) * values);
  const ColorChannels colors = color_channels(names);
  if (colors.numbers.empty()) return refuse("it has no colours");
  for (std::size_t c = 0; c < 3; ++c)
    file->color[c] = &file->image.channels[colors.numbers[colors.numbers.size() == 3 ? c : 0]];
  file->alpha = file->image.find("A");
  known = file;
  return file;
}

}  // namespace norrsken::pbrt
