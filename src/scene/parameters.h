// Typed reading of a node's parameters by the plugin that it names.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/memory.h"
#include "norrsken/plugins.h"
#include "scene/description.h"

namespace norrsken {

class FileSystem;
struct BaseParameter;

/// Whether the bounds of a range belong to it.
enum class Ends { closed, open_below, open };

/// Whether a placement may take space to a plane.
enum class Flat { no, yes };

/// A plugin asks for its parameters by name; what it asks for is what is accepted. Every complaint (wrong type, out of
/// range, not finite, missing) goes to the diagnostics and the default is returned, so that reading goes on.
/// `finish` complains about what was given but never asked for, and notes what the format takes but has no effect here
/// (scene/base_parameters.h).
class Parameters {
 public:
  Parameters(const Node& node, const Description& description, const FileSystem& files, Diagnostics& diagnostics);

  /// From now on, what is asked for is written there, too.
  void record(PluginInfo& asked) { record_ = &asked; }

  const Node& node() const { return node_; }
  Diagnostics& diagnostics() const { return diagnostics_; }

  bool has(std::string_view name) const;  ///< does not count as asking
  bool boolean(std::string_view name, bool fallback);
  /// Inclusive bounds.
  std::int64_t integer(std::string_view name, std::int64_t fallback, std::int64_t min, std::int64_t max);
  /// Also takes an integer, or a `spectrum` or `texture` node of one value, of whose colour the mean counts. Always
  /// finite.
  double number(std::string_view name, double fallback, double min, double max, Ends ends = Ends::closed);
  /// A number where the format has a texture: also an `rgb` or `spectrum`, of which the mean counts and is held against
  /// the range.
  double mean(std::string_view name, double fallback, double min, double max, Ends ends = Ends::closed);
  /// As `number` and `mean`, but what is out of range is brought into it, with a warning or a note.
  double number_clamped(std::string_view name, double fallback, double min, double max,
                        Diagnostic::Severity severity = Diagnostic::Severity::warning);
  double mean_clamped(std::string_view name, double fallback, double min, double max);
  std::string text(std::string_view name, std::string_view fallback);
  /// One of the words, in any case; otherwise an error that lists them.
  std::string choice(std::string_view name, std::string_view fallback, std::initializer_list<std::string_view> words);
  /// Linear sRGB from `rgb`, `spectrum`, a grey `float`, or a `spectrum` or `texture` node of one value; components, or
  /// the values of the spectrum, within [min, max]. `emission`: a spectrum is a light's, otherwise a reflectance (see
  /// color/spectrum.h).
  glm::dvec3 color(std::string_view name, glm::dvec3 fallback, double min, double max, bool emission = false);
  /// The node of that name whose values differ from place to place: a `texture` (or `spectrum`) that `color` and
  /// `number` have no answer to. Null if there is none.
  const Node::Child* texture(std::string_view name);
  /// Wavelengths in nm and values, spelled out; empty after a complaint.
  std::vector<std::pair<double, double>> spectrum(std::string_view name);
  /// Numbers in a string, apart by blanks or commas, or an array; empty after a complaint.
  std::vector<double> numbers(std::string_view name);
  /// The same in the memory budget, for what may be large: floats, `per_element` for each element, all finite and at
  /// most kMaxCoordinate in size.
  Array<float> floats(std::string_view name, std::size_t per_element);
  /// Whole numbers from 0 on, `per_element` for each element.
  Array<std::uint32_t> indices(std::string_view name, std::size_t per_element);
  /// What programs give in place of a file; null after a complaint, or if it was not given.
  std::shared_ptr<const Mesh> mesh(std::string_view name) {
    return shared<Mesh>(name, "a mesh, in scenes that a program makes");
  }
  std::shared_ptr<const Image> image(std::string_view name) {
    return shared<Image>(name, "an image, in scenes that a program makes");
  }
  glm::dvec3 point(std::string_view name, glm::dvec3 fallback);
  /// Identity if not given; projective ones are an error, and singular ones where nothing flat will do.
  glm::dmat4 transform(std::string_view name, Flat flat = Flat::no);
  /// An existing file's path as found in the search order; empty after a complaint.
  std::string file(std::string_view name);

  /// The child nodes of one kind, in order; counts as asking for them.
  std::vector<const Node::Child*> children(std::string_view kind);
  /// At most one child of that kind; more are an error.
  const Node::Child* child(std::string_view kind);

  /// Whether the parameter was given; complains if not, with what could be written.
  bool require(std::string_view name, std::string_view example);

  /// Where to point for a complaint about parameter `name` (the node itself if it was not given).
  SourceLocation where(std::string_view name) const;
  void error(std::string_view name, std::string message, std::string accepted = {});

  /// Call last: unused properties and children become errors that list what was asked for.
  void finish();

 private:
  /// Writes down that a parameter was asked for.
  void note(std::string_view name, PluginParameter::Type type, std::string fallback = {});
  void note_range(std::string_view name, double min, double max, Ends ends);
  PluginParameter& recorded(std::string_view name);
  void accept_without_effect(const BaseParameter& parameter);
  const Property* find(std::string_view name);
  const Node::Child* find_child(std::string_view name) const;
  /// The property if it has one of the types; a complaint if it has another or is a child node.
  template <typename... Types>
  const Property* find_as(std::string_view name, std::string_view accepted);
  /// The same, or what a node of one value says, which is put into `storage`.
  template <typename... Types>
  const Property* find_value(std::string_view name, std::string_view accepted, Property& storage);
  template <class T>
  std::shared_ptr<const T> shared(std::string_view name, std::string_view accepted);
  /// The mean of a colour; nothing after a complaint.
  std::optional<double> value_of(const Property& property, std::string_view name);
  double clamped(const Property* property, std::string_view name, double fallback, double min, double max,
                 Diagnostic::Severity severity);
  double number_of(const Property& property, std::string_view name, double fallback, double min, double max, Ends ends);
  std::optional<glm::dvec3> color_of(const Property& property, std::string_view name, double min, double max,
                                     bool emission);

  const Node& node_;
  const Description& description_;
  const FileSystem& files_;
  Diagnostics& diagnostics_;
  PluginInfo* record_ = nullptr;
  std::set<std::string, std::less<>> asked_names_, asked_kinds_;
};

}  // namespace norrsken
