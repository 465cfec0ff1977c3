// A glTF file in parts: its JSON, its buffers, and what all parts of the reader ask of it.
#pragma once

#include <fmt/format.h>

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/memory.h"
#include "formats/gltf/json.h"
#include "scene/description.h"
#include "scene/file_system.h"
#include "scene/source_text.h"

namespace norrsken::gltf {

/// What is chosen among what a file offers, with -D.
struct Choices {
  std::optional<std::size_t> scene;  ///< in place of the file's own
  std::string variant;               ///< name of a material variant; empty: none
  double time = 0;                   ///< seconds
  bool is_animated = false;          ///< whether a time was asked for
  double lumens_per_watt = 683;
  std::optional<bool> sky;     ///< otherwise where there is no light
  bool allow_outside = false;  ///< of the scene's folder
};

class Asset {
 public:
  Asset(const FileSystem& all_files, Diagnostics& complaints, const std::string& path);

  const FileSystem& files;
  Diagnostics& diagnostics;
  Choices choices;
  MemoryReservation memory{0};  ///< of nodes, and of what the description holds in ordinary arrays

  /// Reads and parses; false after a complaint.
  bool open(const std::string& path);
  const Json& root() const { return *root_; }
  const std::string& folder() const { return folder_; }

  SourceLocation place(const Json& value) const { return source_.location(value.offset, value.length); }
  /// The message ends with the JSON pointer to the value.
  void error(const Json& value, const std::string& message, std::string accepted = {});
  /// What is another picture than the specification's, and what there is instead: told once for each message.
  void tell(const Json& value, const std::string& message, const std::string& instead = {});

  // Members of objects; a wrong type, or a value out of range, is an error.
  const Json* member(const Json& object, std::string_view name, Json::Kind kind);
  /// What an array of that name holds; nothing if there is none.
  const std::vector<Json>& items(const Json& object, std::string_view name);
  /// The object `extensions/NAME`; null if there is none.
  const Json* extension(const Json& object, std::string_view name);
  double number(const Json& object, std::string_view name, double fallback, double min = -1e30, double max = 1e30);
  bool boolean(const Json& object, std::string_view name, bool fallback);
  std::string string(const Json& object, std::string_view name, const std::string& fallback = {});
  std::size_t whole(const Json& object, std::string_view name, std::size_t fallback);
  /// Empty if it is not given or not an index.
  std::optional<std::size_t> index(const Json& object, std::string_view name);
  template <std::size_t n>
  std::array<double, n> numbers(const Json& object, std::string_view name, std::array<double, n> fallback) {
    const Json* list = member(object, name, Json::Kind::array);
    if (list) fill(*list, fallback.data(), n);
    return fallback;
  }
  /// The element of the root's array `collection` that a member of `object` names; null if it names none, or after a
  /// complaint.
  const Json* referred(const Json& object, std::string_view name, std::string_view collection);
  const Json* element(const Json& named_at, std::string_view collection, std::size_t index);

  /// The bytes of a buffer view; empty after a complaint.
  std::optional<std::string_view> view(const Json& buffer_view);
  /// What a `uri` holds or names; null after a complaint. `owner` is what the uri is a member of.
  std::shared_ptr<const std::string> resource(const Json& owner);

 private:
  /// Leaves the values as they are after a complaint.
  void fill(const Json& list, double* values, std::size_t n);
  std::shared_ptr<const std::string> buffer(const Json& object);
  bool open_binary();

  std::string folder_;
  std::optional<FileContents> contents_;
  std::string_view binary_;
  bool has_binary_ = false;
  SourceText source_;
  std::shared_ptr<const Json> root_;
  std::set<std::string> told_;
  std::map<const Json*, std::shared_ptr<const std::string>> resources_;
  std::map<std::string, std::shared_ptr<const std::string>> files_by_path_;
};

/// Sets a value together with the place that it is from.
void give(Node& node, std::string name, Property::Value value, const SourceLocation& place);
Node make_node(std::string kind, std::string plugin, const SourceLocation& place);

}  // namespace norrsken::gltf
