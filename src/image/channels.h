// Which of a file's channels are its colour, by their names.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace norrsken {

/// "View.Combined" of "View.Combined.R"; most files have no layers.
std::string_view layer_of(std::string_view channel);
/// "R" of "View.Combined.R".
std::string_view last_name(std::string_view channel);

/// The channels that make a colour, or the one that is grey.
struct ColorChannels {
  std::vector<std::size_t> numbers;
  bool is_xyz = false;  ///< CIE XYZ in place of red, green, blue
  std::string remark;   ///< "has ...", if that is a guess or a choice
};

/// R, G, B, or X, Y, Z, of the layer without a name ("R"), or else of the first layer that has them ("view.R"); or Y; or
/// the first three channels, or the first one. Letters may have any case.
ColorChannels color_channels(const std::vector<std::string>& names);

}  // namespace norrsken
