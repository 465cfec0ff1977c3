#include "image/channels.h"

#include <algorithm>
#include <initializer_list>
#include <string_view>
#include <utility>

#include "base/text.h"

namespace norrsken {

std::string_view layer_of(std::string_view channel) {
  const std::size_t dot = channel.rfind('.');
  return channel.substr(0, dot == std::string_view::npos ? 0 : dot);
}
std::string_view last_name(std::string_view channel) { return channel.substr(channel.rfind('.') + 1); }

namespace {

using Names = std::vector<std::string>;

// Some programs write the names out.
bool is_named(std::string_view channel, std::string_view wanted) {
  constexpr std::pair<std::string_view, std::string_view> kLong[] = {{"R", "Red"}, {"G", "Green"}, {"B", "Blue"}};
  return equal_ignoring_case(channel, wanted) || std::ranges::any_of(kLong, [&](const auto& names) {
           return names.first == wanted && equal_ignoring_case(channel, names.second);
         });
}

// The channels of a layer with these last names; none if one is missing.
std::vector<std::size_t> channels_of(const Names& names, std::string_view layer,
                                     std::initializer_list<std::string_view> wanted) {
  std::vector<std::size_t> found;
  for (const std::string_view last : wanted) {
    const auto channel = std::ranges::find_if(
        names, [&](const std::string& name) { return layer_of(name) == layer && is_named(last_name(name), last); });
    if (channel == names.end()) return {};
    found.push_back(static_cast<std::size_t>(channel - names.begin()));
  }
  return found;
}

std::string names_of(const Names& names, const std::vector<std::size_t>& channels) {
  Names chosen;
  for (const std::size_t channel : channels) chosen.push_back(shortened(names[channel], 100));
  return join(chosen);
}

// Three channels in each of some layers; empty if there are none.
ColorChannels colors_of_layers(const Names& names) {
  Names layers = {""}, with_colors;
  for (const std::string& name : names) {
    if (std::ranges::find(layers, layer_of(name)) == layers.end()) layers.emplace_back(layer_of(name));
  }
  ColorChannels chosen;
  for (const std::string& layer : layers) {
    const std::vector<std::size_t> rgb = channels_of(names, layer, {"R", "G", "B"});
    const std::vector<std::size_t> xyz = channels_of(names, layer, {"X", "Y", "Z"});
    if (rgb.empty() && xyz.empty()) continue;
    with_colors.push_back(layer);
    if (!chosen.numbers.empty()) continue;
    chosen = {rgb.empty() ? xyz : rgb, rgb.empty(), {}};
    // In a layer these may be directions as well.
    if (chosen.is_xyz && !layer.empty())
      chosen.remark = "has " + names_of(names, xyz) + ", which are taken for CIE X, Y, Z";
  }
  // An image that belongs to no layer is the image, whatever layers there are beside it.
  if (with_colors.size() > 1 && !with_colors[0].empty())
    chosen.remark = "has the layers " + listed(with_colors) + ", of which the first is taken";
  return chosen;
}

}  // namespace

ColorChannels color_channels(const Names& names) {
  const auto has_all = [&](std::initializer_list<std::string_view> last) {
    return !channels_of(names, "", last).empty();
  };
  // An image that belongs to no layer is the image, grey ones too.
  const std::vector<std::size_t> grey = channels_of(names, "", {"Y"});
  if (!grey.empty() && !has_all({"R", "G", "B"}) && !has_all({"X", "Y", "Z"}))
    return {grey, false,
            has_all({"RY"}) || has_all({"BY"})
                ? "has colours in channels RY and BY, which are not read: Y is taken for grey"
                : ""};
  if (ColorChannels colors = colors_of_layers(names); !colors.numbers.empty()) return colors;
  if (names.size() >= 3) {
    const std::vector<std::size_t> first = {0, 1, 2};
    return {first, false,
            "has no channels R, G, B or Y: " + names_of(names, first) + " are taken for red, green, blue"};
  }
  constexpr std::string_view kGreys[] = {"R", "Y", "V", "L", "A", "grey", "gray", "luminance"};
  const bool is_grey = std::ranges::any_of(
      kGreys, [&](std::string_view known) { return equal_ignoring_case(last_name(names[0]), known); });
  const bool is_alone = names.size() == 1 || equal_ignoring_case(last_name(names[1]), "A");
  return {{0},
          false,
          is_grey && is_alone ? "" : "has no channels R, G, B or Y: " + names_of(names, {0}) + " is taken for grey"};
}

}  // namespace norrsken
