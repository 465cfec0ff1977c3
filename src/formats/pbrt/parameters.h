// The parameters of a pbrt directive: "float radius" 2.
#pragma once

#include <glm/vec3.hpp>
#include <initializer_list>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/memory.h"
#include "formats/pbrt/lexer.h"

namespace norrsken::pbrt {

struct Parameter {
  std::string type, name;
  Array<double> numbers;  ///< all components, one after the other; of a bool 0 or 1
  Array<std::string> strings;
  Place place;         ///< of "type name"
  Place value;         ///< of the first value
  bool given = false;  ///< by an Attribute directive rather than for the object itself
};
using SharedParameters = std::vector<std::shared_ptr<const Parameter>>;

/// What follows a directive's name, up to what is no parameter. Complains, and leaves out what cannot be read.
SharedParameters read_parameters(Lexer& lexer, Diagnostics& diagnostics);

/// An object asks for its parameters by type and name; what it asks for is what is accepted, as in pbrt. Complaints go to
/// the diagnostics, and then the fallback is the answer.
class Parameters {
 public:
  static constexpr double kInfinity = std::numeric_limits<double>::infinity();

  /// `object` is what they are of: "material 'conductor'". Of two of one type and name the later one counts.
  Parameters(std::string object, Place place, SharedParameters parameters, Diagnostics& diagnostics)
      : object_(std::move(object)),
        place_(place),
        parameters_(std::move(parameters)),
        asked_(parameters_.size()),
        diagnostics_(&diagnostics) {}

  const std::string& object() const { return object_; }
  const Place& place() const { return place_; }
  Diagnostics& diagnostics() const { return *diagnostics_; }

  /// Null if it is not given.
  const Parameter* find(std::string_view type, std::string_view name);
  /// The last given of several types.
  const Parameter* find(std::initializer_list<std::string_view> types, std::string_view name);
  bool has(std::string_view name) const;  ///< of any type; does not count as asking
  /// Whether one of them goes by (u, v): a texture, an image, or what differs along u and v.
  bool depends_on_uv() const;

  double number(std::string_view name, double fallback, double min = -kInfinity, double max = kInfinity);
  /// A number above 0.
  double positive(std::string_view name, double fallback);
  std::int64_t integer(std::string_view name, std::int64_t fallback,
                       std::int64_t min = std::numeric_limits<std::int32_t>::min(),
                       std::int64_t max = std::numeric_limits<std::int32_t>::max());
  bool flag(std::string_view name, bool fallback);
  std::string text(std::string_view name, std::string_view fallback);
  /// One of the words, exactly; otherwise an error that lists them.
  std::string choice(std::string_view name, std::string_view fallback, std::initializer_list<std::string_view> words);
  std::optional<glm::dvec3> vector(std::string_view type, std::string_view name);
  /// All values of a list; null if it is not given, or not in whole elements of so many numbers.
  const Array<double>* list(std::string_view type, std::string_view name, std::size_t per_element = 1);

  /// Whether the parameter has so many values; complains otherwise.
  bool has_values(const Parameter& parameter, std::size_t count);
  void error(const Parameter* at, std::string message, std::string accepted = {});
  void note(const Parameter* at, std::string message, std::string accepted = {});

  /// Complains about what nobody has asked for, as pbrt does.
  void finish();

 private:
  const Parameter* ranged(std::string_view type, std::string_view name, double min, double max, bool above);

  std::string object_;
  Place place_;
  SharedParameters parameters_;
  std::vector<bool> asked_;  ///< for each of them
  std::vector<std::string> accepted_;
  Diagnostics* diagnostics_;
};

}  // namespace norrsken::pbrt
