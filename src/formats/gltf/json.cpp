#include "formats/gltf/json.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>

namespace norrsken::gltf {
namespace {

constexpr std::size_t kMostDepth = 64;

/// Reads the text for the parser and tells how far it has come.
class CountingIterator {
 public:
  // NOLINTBEGIN(readability-identifier-naming): the standard's names
  using iterator_category = std::input_iterator_tag;
  using value_type = char;
  using difference_type = std::ptrdiff_t;
  using pointer = const char*;
  using reference = const char&;
  // NOLINTEND(readability-identifier-naming)

  CountingIterator(const char* at, const char** reached) : at_(at), reached_(reached) {}
  reference operator*() const { return *at_; }
  CountingIterator& operator++() {
    *reached_ = ++at_;
    return *this;
  }
  CountingIterator operator++(int) {
    CountingIterator before = *this;
    ++*this;
    return before;
  }
  friend bool operator==(const CountingIterator& a, const CountingIterator& b) { return a.at_ == b.at_; }
  friend bool operator!=(const CountingIterator& a, const CountingIterator& b) { return a.at_ != b.at_; }

 private:
  const char* at_;
  const char** reached_;
};

/// Receives what the parser finds and puts the tree together.
class TreeBuilder {
 public:
  using Parser = nlohmann::json;

  TreeBuilder(std::string_view text, const char*& reached, MemoryReservation& memory, JsonFault& fault)
      : text_(text), reached_(reached), memory_(memory), fault_(fault) {}

  std::shared_ptr<Json> root = std::make_shared<Json>();

  // The parser's interface; false ends the parsing.
  bool null() { return add(Json::Kind::null) != nullptr; }
  bool boolean(bool value) {
    Json* json = add(Json::Kind::boolean);
    if (json) json->boolean = value;
    return json != nullptr;
  }
  bool number_integer(Parser::number_integer_t value) { return add_number(static_cast<double>(value)); }
  bool number_unsigned(Parser::number_unsigned_t value) { return add_number(static_cast<double>(value)); }
  bool number_float(Parser::number_float_t value, const std::string& /*written*/) { return add_number(value); }
  bool string(std::string& value) {
    memory_.grow(value.capacity());
    Json* json = add(Json::Kind::string);
    if (json) json->text = std::move(value);
    return json != nullptr;
  }
  bool binary(Parser::binary_t& /*value*/) { return false; }
  bool start_object(std::size_t /*count*/) { return open(Json::Kind::object); }
  bool start_array(std::size_t /*count*/) { return open(Json::Kind::array); }
  bool key(std::string& name) {
    memory_.grow(name.capacity());
    key_ = std::move(name);
    begin_ = offset_reached();
    return true;
  }
  bool end_object() { return close(); }
  bool end_array() { return close(); }
  bool parse_error(std::size_t position, const std::string& /*token*/, const nlohmann::detail::exception& error) {
    // "[json.exception.parse_error.101] parse error at line 1, column 2: syntax error while ..."
    std::string_view message = error.what();
    if (const std::size_t colon = message.find(": "); colon != std::string_view::npos) message.remove_prefix(colon + 2);
    fault_ = {std::string(message), std::min(position > 0 ? position - 1 : 0, text_.size())};
    return false;
  }

 private:
  std::size_t offset_reached() const { return static_cast<std::size_t>(reached_ - text_.data()); }

  /// Where the value that has just been read begins.
  std::size_t begin_of_value() const {
    const std::size_t at = text_.find_first_not_of(" \t\r\n:,[{", begin_);
    return std::min(at, offset_reached());
  }

  Json* add(Json::Kind kind) {
    Json* parent = open_.empty() ? nullptr : open_.back();
    // Arrays grow by doubling, and have both at that time.
    memory_.grow(3 * (sizeof(Json) + sizeof(std::string)));
    Json* json = root.get();
    if (parent && parent->kind == Json::Kind::array) {
      json = &parent->items.emplace_back();
    } else if (parent) {
      json = &parent->members.emplace_back(std::move(key_), Json{}).second;
    }
    json->kind = kind;
    const bool is_container = kind == Json::Kind::array || kind == Json::Kind::object;
    json->offset = is_container ? offset_reached() - 1 : begin_of_value();
    json->length = std::max<std::size_t>(offset_reached() - json->offset, 1);
    begin_ = offset_reached();
    // A number ends where the next character has been read already.
    if (kind == Json::Kind::number && json->length > 1 && offset_reached() < text_.size()) --json->length, --begin_;
    return json;
  }
  bool add_number(double value) {
    Json* json = add(Json::Kind::number);
    json->number = value;
    return true;
  }
  bool open(Json::Kind kind) {
    if (open_.size() >= kMostDepth) {
      fault_ = {fmt::format("more than {} objects and arrays inside each other", kMostDepth), offset_reached() - 1};
      return false;
    }
    open_.push_back(add(kind));
    return true;
  }
  bool close() {
    open_.back()->length = offset_reached() - open_.back()->offset;
    open_.pop_back();
    begin_ = offset_reached();
    return true;
  }

  std::string_view text_;
  const char*& reached_;
  MemoryReservation& memory_;
  JsonFault& fault_;
  std::vector<Json*> open_;
  std::string key_;
  std::size_t begin_ = 0;
};

/// As RFC 6901 writes it.
std::string escaped(std::string_view name) {
  std::string result;
  for (const char c : name.substr(0, 60)) result += c == '~' ? "~0" : c == '/' ? "~1" : std::string(1, c);
  return result;
}

}  // namespace

const Json* Json::find(std::string_view name) const {
  const auto found = std::find_if(members.rbegin(), members.rend(), [&](const auto& m) { return m.first == name; });
  return found != members.rend() ? &found->second : nullptr;
}

const Json& no_members() {
  static const Json empty{.kind = Json::Kind::object};
  return empty;
}

std::string_view name_of(Json::Kind kind) {
  static constexpr std::string_view kNames[] = {"null", "a boolean", "a number", "a string", "an array", "an object"};
  return kNames[static_cast<std::size_t>(kind)];
}

std::shared_ptr<const Json> parse_json(std::string_view text, MemoryReservation& memory, JsonFault& fault) {
  const char* reached = text.data();
  TreeBuilder builder(text, reached, memory, fault);
  const bool ok = nlohmann::json::sax_parse(CountingIterator(text.data(), &reached),
                                            CountingIterator(text.data() + text.size(), &reached), &builder);
  return ok ? builder.root : nullptr;
}

std::string pointer_to(const Json& root, const Json& value) {
  std::string pointer;
  const Json* at = &root;
  const auto holds = [&](const Json& part) {
    return part.offset <= value.offset && value.offset < part.offset + part.length;
  };
  while (at != &value) {
    const Json* next = nullptr;
    for (std::size_t i = 0; i < at->items.size() && !next; ++i) {
      if (holds(at->items[i])) next = &at->items[i], pointer += fmt::format("/{}", i);
    }
    for (const auto& [name, member] : at->members) {
      if (!next && holds(member)) next = &member, pointer.append("/").append(escaped(name));
    }
    if (!next) break;
    at = next;
  }
  return pointer;
}

}  // namespace norrsken::gltf
