// The `$parameters` of a Mitsuba scene file: `<default>`s, what the command line says instead, and their use.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "norrsken/diagnostics.h"

namespace norrsken {

/// `$name` is the longest run of letters, digits and underscores behind a dollar (Mitsuba replaces the longest defined
/// name that fits, so that a misspelt one can pass unnoticed). Values are filled in once: a dollar in a value that came
/// from the command line stays.
class SceneParameters {
 public:
  using Values = std::vector<std::pair<std::string, std::string>>;
  /// `preferred` win over `<default>`s as overrides do, but only where there are any.
  SceneParameters(const Values& overrides, Values preferred, Diagnostics& diagnostics);

  /// `<default>`. The first definition wins, and an override wins over all. `raw` is the value before it was filled in.
  void define(const std::string& name, const std::string& value, std::string_view raw);

  /// Replaces every `$name` in `text`. False after a complaint: undefined, no name, or grown beyond all measure.
  bool fill_in(std::string& text, const SourceLocation& location);

  /// The override that decides what becomes of `raw`, through defaults made of others too: "-Dspp=0"; or nothing.
  std::string set_by(std::string_view raw) const;

  /// Complains about overrides that were never used.
  void finish() const;

  /// Names and values of those in use, in order of definition; an override without a default counts from its first use.
  std::vector<std::pair<std::string, std::string>> values() const;

  static bool is_name(std::string_view text);

 private:
  struct Entry {
    std::string name, value;
    std::string set_by = {};
    bool overridden = false, defined = false, used = false;
  };
  /// The entry of that name; `created` is told whether it is a new one.
  std::size_t entry_of(const std::string& name, bool& created);
  void mark_defined(std::size_t index);

  Values preferred_;
  std::vector<Entry> entries_;
  std::unordered_map<std::string, std::size_t> index_;  // of the entry of a name
  std::vector<std::size_t> order_;                      // of definition
  std::size_t filled_in_bytes_ = 0;
  Diagnostics& diagnostics_;
};

}  // namespace norrsken
