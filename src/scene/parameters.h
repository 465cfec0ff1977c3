// Typed reading of a node's parameters by the plugin that it names.
#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/memory.h"
#include "norrsken/plugins.h"
#include "scene/description.h"
#include "scene/parameter.h"
#include "scene/scene_color.h"

namespace norrsken {

class FileSystem;
struct BaseParameter;

/// A plugin reads the parameters that it declares (parameter.h); what it asks for is what is accepted. Every complaint
/// (wrong type, out of range, not finite, missing) goes to the diagnostics and the fallback is returned, so that reading
/// goes on. `finish` complains about what was given but never asked for, and notes what the format takes but has no effect
/// here (base_parameters.h).
class Parameters {
 public:
  Parameters(const Node& node, const Description& description, const FileSystem& files, Diagnostics& diagnostics);

  /// From now on, what is asked for is written there, too.
  void record(PluginInfo& asked) { record_ = &asked; }

  const Node& node() const { return node_; }
  Diagnostics& diagnostics() const { return diagnostics_; }

  bool has(std::string_view name) const;  ///< does not count as asking
  bool read(const BooleanParameter& boolean);
  std::int64_t read(const IntegerParameter& integer);
  /// Also takes an integer, or a `spectrum` or `texture` node of one value, of whose colour the mean counts; `rgb` and
  /// `spectrum` where the declaration says so. Always finite.
  double read(const NumberParameter& number);
  std::string read(const TextParameter& text);
  template <class T>
  T read(const ChoiceParameter<T>& choice) {
    std::vector<std::string> words;
    for (const auto& [word, value] : choice.words) {
      if (!word.empty()) words.emplace_back(word);
    }
    return choice.words[read_choice(choice.name, words, choice.fallback, choice.text)].value;
  }
  /// From `rgb`, `spectrum`, a grey `float`, or a `spectrum` or `texture` node of one value.
  SceneColor read(const ColorParameter& color);
  glm::dvec3 read(const PointParameter& point);
  /// Identity if not given; projective ones are an error, and singular ones where nothing flat will do.
  glm::dmat4 read(const TransformParameter& transform);
  /// An existing file's path as found in the search order; empty after a complaint.
  std::string read(const FileParameter& file);
  /// Null if it is not given, or after a complaint.
  const Node::Child* read(const TextureParameter& texture);
  /// The same of a volume.
  const Node::Child* read(const VolumeParameter& volume);
  /// Wavelengths in nm and values, spelled out; empty after a complaint.
  SceneColor::Spectrum read(const SpectrumParameter& spectrum);
  /// Empty after a complaint.
  std::vector<double> read(const NumbersParameter& numbers);
  /// The same in the memory budget, for what may be large: floats, all finite and at most kMaxCoordinate in size.
  Array<float> floats(const NumbersParameter& numbers);
  /// Whole numbers from 0 on.
  Array<std::uint32_t> indices(const NumbersParameter& numbers);

  /// The node of that name whose values differ from place to place: a `texture` (or `spectrum`) that `read` has no
  /// number or colour of. Null if there is none.
  const Node::Child* texture(std::string_view name);
  /// The `volume` of that name. Null if there is none.
  const Node::Child* volume(std::string_view name);
  /// What programs give in place of a file; null after a complaint, or if it was not given.
  std::shared_ptr<const Mesh> mesh(std::string_view name) {
    return shared<Mesh>(name, "a mesh, in scenes that a program makes");
  }
  std::shared_ptr<const Image> image(std::string_view name) {
    return shared<Image>(name, "an image, in scenes that a program makes");
  }

  /// The child nodes of one kind, in order; counts as asking for them.
  std::vector<const Node::Child*> children(std::string_view kind);
  /// The value of a node of one value, as the property that would say the same: a number, a colour or a spectrum. After a
  /// complaint anything.
  Property::Value constant(const Node& node);
  /// At most one child of that kind; more are an error.
  const Node::Child* child(std::string_view kind);

  /// Where to point for a complaint about parameter `name` (the node itself if it was not given).
  SourceLocation where(std::string_view name) const;
  void error(std::string_view name, std::string message, std::string accepted = {});

  /// Call last: unused properties and children become errors that list what was asked for.
  void finish();

 private:
  /// Asks for it: what plugins() tells is written down, and what is required and missing is complained about.
  template <class Declared>
  void ask(const Declared& declared, PluginParameter::Type type, std::string fallback);
  void note_range(std::string_view name, const Range& range);
  PluginParameter& recorded(std::string_view name);
  std::size_t read_choice(std::string_view name, const std::vector<std::string>& words, std::size_t fallback,
                          std::string_view text);
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
  /// A number, or the mean of a colour; nothing after a complaint.
  std::optional<double> value_of(const Property& property, std::string_view name);
  std::optional<SceneColor> color_of(const Property& property, std::string_view name, const Range& range, ColorOf of);

  const Node& node_;
  const Description& description_;
  const FileSystem& files_;
  Diagnostics& diagnostics_;
  PluginInfo* record_ = nullptr;
  std::set<std::string, std::less<>> asked_names_, asked_kinds_;
};

}  // namespace norrsken
