#include "norrsken/image.h"

#include <algorithm>

namespace norrsken {

const Channel* Image::find(std::string_view name) const {
  const auto found = std::ranges::find(channels, name, &Channel::name);
  return found == channels.end() ? nullptr : &*found;
}

Channel& Image::channel(std::string_view name) {
  const auto found = std::ranges::find(channels, name, &Channel::name);
  if (found != channels.end()) return *found;
  const auto pixels = static_cast<std::size_t>(std::max(width, 0)) * static_cast<std::size_t>(std::max(height, 0));
  return channels.emplace_back(Channel{std::string(name), std::vector<float>(pixels)});
}

}  // namespace norrsken
