// What a plugin declares of each of its parameters, once, in its NAME.cpp:
//
//   constexpr NumberParameter kScale{.name = "scale", .fallback = 1, .range = {-1e6, 1e6}, .text = "factor on the heights"};
//
// From a declaration follow how it is read, with every complaint (Parameters::read), what plugins() tells of it, its row in
// docs/scenes.md and the values that tests/end_to_end/plugin_parameters_test.cpp tries.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <limits>
#include <string_view>

namespace norrsken {

/// Whether the bounds of a range belong to it.
enum class Ends { closed, open_below, open };

struct Range {
  double min = -std::numeric_limits<double>::infinity(), max = std::numeric_limits<double>::infinity();
  Ends ends = Ends::closed;
};
inline constexpr Range kAnyNumber{}, kShare{0, 1}, kFromZero{.min = 0};
constexpr Range above(double min, double max = std::numeric_limits<double>::infinity()) {
  return {min, max, Ends::open_below};
}

/// What becomes of a number that is out of range.
enum class Beyond { is_an_error, is_clamped, is_clamped_with_a_note };

/// Whether a placement may take space to a plane.
enum class Flat { no, yes };

// Members that several of them have:
//   text         a line for people: what it means. Type, range, fallback and unit are told by the others
//   unit         "degrees", "pixels", "scene units"
//   in_place_of  the parameters that it stands for: it has no fallback of its own then
//   example      of what is required, an element that gives it

struct BooleanParameter {
  std::string_view name;
  bool fallback = false;
  std::string_view text = {};
  constexpr BooleanParameter or_else(bool value) const { return {name, value, text}; }
};

struct IntegerParameter {
  std::string_view name;
  std::int64_t fallback = 0;
  std::int64_t min = std::numeric_limits<std::int64_t>::min(), max = std::numeric_limits<std::int64_t>::max();
  std::string_view text = {}, unit = {}, in_place_of = {};
  constexpr IntegerParameter or_else(std::int64_t value) const {
    IntegerParameter other = *this;
    other.fallback = value;
    return other;
  }
  constexpr IntegerParameter at_most(std::int64_t value) const {
    IntegerParameter other = *this;
    other.max = value;
    return other;
  }
};

struct NumberParameter {
  std::string_view name;
  double fallback = 0;
  Range range = {};
  std::string_view text = {}, unit = {}, in_place_of = {}, example = {};
  Beyond beyond = Beyond::is_an_error;
  bool takes_colors = false;  ///< where the format has a texture: of a colour the mean counts
  constexpr NumberParameter or_else(double value) const {
    NumberParameter other = *this;
    other.fallback = value;
    return other;
  }
  constexpr NumberParameter within(Range other_range) const {
    NumberParameter other = *this;
    other.range = other_range;
    return other;
  }
};

/// Whose reflectance a colour is, or whose radiance: of a spectrum the two have not the same rgb.
enum class ColorOf { surface, light };

struct ColorParameter {
  std::string_view name;
  double fallback = 0;  ///< grey
  Range range = {};     ///< of each component, or of the values of a spectrum
  std::string_view text = {}, unit = {}, example = {};
  ColorOf of = ColorOf::surface;
};

struct TextParameter {
  std::string_view name, fallback = {}, text = {}, example = {};
};

/// One of some words, in any case, and what each stands for. The first is the fallback.
template <class T>
struct ChoiceParameter {
  struct Word {
    std::string_view word;
    T value{};
  };
  std::string_view name;
  std::array<Word, 6> words;
  std::string_view text = {};
  std::size_t fallback = 0;
  constexpr ChoiceParameter or_else(T value) const {
    ChoiceParameter other = *this;
    other.fallback = 0;
    while (words[other.fallback].value != value) ++other.fallback;
    return other;
  }
};

struct PointParameter {
  std::string_view name;
  glm::dvec3 fallback{0};
  std::string_view text = {}, unit = {};
};

/// Identity if it is not given.
struct TransformParameter {
  std::string_view name, text = {}, in_place_of = {};
  Flat flat = Flat::no;
};

/// A path, required.
struct FileParameter {
  std::string_view name, text = {};
};

/// A node whose values differ from place to place.
struct TextureParameter {
  std::string_view name, text = {};
};

/// A `volume`, required.
struct VolumeParameter {
  std::string_view name, text = {};
};

/// Wavelengths and values.
struct SpectrumParameter {
  std::string_view name, text = {};
};

/// Numbers in a string, or an array of a program; a multiple of `per_element`.
struct NumbersParameter {
  std::string_view name;
  std::size_t per_element = 1;
  std::string_view text = {}, example = {};
};

}  // namespace norrsken
