// What scenes may be made of: every plugin and its parameters, for programs that draw forms or check descriptions.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace norrsken {

struct PluginParameter {
  /// What it is read as; `text`, `file` and `numbers` are strings in scene files. A number may be an integer there, too.
  enum class Type { boolean, integer, number, text, file, numbers, color, spectrum, point, transform, texture, volume };

  std::string name;
  Type type = Type::texture;
  bool may_be_texture = false;       ///< a texture may stand in place of the number or colour
  bool may_be_volume = false;        ///< a volume may stand in place of the number or colour
  bool is_required = false;          ///< otherwise `fallback` is taken where it is not given
  std::string fallback = {};         ///< as scene files write it; empty: none, or it depends on others
  std::vector<std::string> choices;  ///< of a text that is one of some words
  /// Of numbers, and of each component of a colour; empty: no bound but what can be calculated with.
  std::optional<double> min = {}, max = {};
  bool min_belongs = true, max_belongs = true;  ///< whether the bounds themselves are in range
  bool is_clamped = false;                      ///< what is out of range is brought into it, with a warning
  std::string unit = {};                        ///< "degrees", "pixels", "scene units"; empty: none
  std::string in_place_of = {};                 ///< the parameters that it stands for, if it is given
  std::string text = {};                        ///< what it means, in a line for people; may be empty
};

struct PluginInfo {
  std::string kind;  ///< as in Node: "bsdf", "shape", ...
  std::string name;
  std::string text;  ///< what it is, in a line
  std::vector<PluginParameter> parameters;
  std::vector<std::string> children;  ///< kinds of nodes that it takes beside its parameters
};

/// All of them, kind by kind. The parameters are what the plugins ask for when they are given nothing, so there is no second
/// list of them; a range or a fallback that depends on other parameters is the one for their fallbacks.
std::vector<PluginInfo> plugins();

}  // namespace norrsken
