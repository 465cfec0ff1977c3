// JSON as a tree that knows where each value stands. Depth and memory are bounded.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/memory.h"

namespace norrsken::gltf {

struct Json {
  enum class Kind { null, boolean, number, string, array, object };

  Kind kind = Kind::null;
  bool boolean = false;
  double number = 0;
  std::size_t offset = 0, length = 1;  ///< in the text
  std::string text = {};               ///< of a string
  std::vector<Json> items = {};
  std::vector<std::pair<std::string, Json>> members = {};

  /// The member of that name; null if there is none. Of several of one name the last counts.
  const Json* find(std::string_view name) const;
};

/// An object without members: of what is not given all is as the specification says.
const Json& no_members();

/// "an array".
std::string_view name_of(Json::Kind kind);

/// What is wrong with a text, and where.
struct JsonFault {
  std::string message;
  std::size_t offset = 0;
};

/// Null after a fault. What the tree takes is added to `memory` as it grows; may throw MemoryExceeded.
std::shared_ptr<const Json> parse_json(std::string_view text, MemoryReservation& memory, JsonFault& fault);

/// "/materials/0/name": the JSON pointer (RFC 6901) to a value of the tree.
std::string pointer_to(const Json& root, const Json& value);

}  // namespace norrsken::gltf
