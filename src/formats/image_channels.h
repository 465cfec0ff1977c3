// Which of a file's channels are its colour, by their names.
#pragma once

#include <string>
#include <vector>

namespace norrsken {

/// The channels that make a colour, or the one that is grey.
struct ColorChannels {
  std::vector<int> numbers;
  bool is_xyz = false;  ///< CIE XYZ in place of red, green, blue
  std::string remark;   ///< "has ...", if that is a guess or a choice
};

/// R, G, B, or X, Y, Z, of the layer without a name ("R"), or else of the first layer that has them ("view.R"); or Y; or
/// the first three channels, or the first one. Letters may have any case.
ColorChannels color_channels(const std::vector<std::string>& names);

}  // namespace norrsken
