#include "formats/image_file.h"

#include <vector>

#include "image/channels.h"
#include "image/texel_image.h"

namespace norrsken {

std::shared_ptr<const ImageFile> decode_image_file(std::string_view bytes, std::string& error) {
  const auto& budget = MemoryScope::current();
  auto file = std::make_shared<ImageFile>();
  error = read_image_contents(bytes, budget ? budget->left() : MemoryBudget::kUnlimited, file->image);
  if (!error.empty()) return nullptr;
  std::vector<std::string> names;
  std::size_t values = 0;
  for (const Channel& channel : file->image.channels) {
    names.push_back(channel.name);
    values += channel.values.size();
  }
  file->memory = MemoryReservation(sizeof(float) * values);
  const ColorChannels colors = color_channels(names);
  if (colors.numbers.empty()) {
    error = "it has no colours";
    return nullptr;
  }
  for (std::size_t c = 0; c < 3; ++c)
    file->color[c] = &file->image.channels[colors.numbers[colors.numbers.size() == 3 ? c : 0]];
  file->alpha = file->image.find("A");
  return file;
}

}  // namespace norrsken
