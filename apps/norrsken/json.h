// JSON as the commands print it: values that are put together, without a reader.
#pragma once

#include <concepts>
#include <initializer_list>
#include <iterator>
#include <optional>
#include <string>
#include <string_view>

namespace norrsken::cli {

/// One JSON value as text. Numbers that are not finite become null, bytes that are not UTF-8 the replacement character.
class Json {
 public:
  struct Member;

  // NOLINTBEGIN(google-explicit-constructor): what is put into an object is a value of any type
  Json(std::nullptr_t = nullptr) : text_("null") {}
  Json(bool value) : text_(value ? "true" : "false") {}
  Json(std::integral auto value) : text_(std::to_string(value)) {}
  Json(double value);
  Json(std::string_view value);
  Json(const std::string& value) : Json(std::string_view(value)) {}
  Json(const char* value) : Json(std::string_view(value)) {}
  /// null if there is none
  template <class T>
  Json(const std::optional<T>& value) : Json(value ? Json(*value) : Json()) {}
  /// An array of all values.
  template <class Values>
  requires(requires(const Values& values) { std::begin(values); } &&
           !std::convertible_to<const Values&, std::string_view>) Json(const Values& values)
      : text_("[]") {
    for (const auto& value : values) add(value);
  }
  /// An object.
  Json(std::initializer_list<Member> members);
  // NOLINTEND(google-explicit-constructor)

  static Json array() { return std::initializer_list<int>(); }
  /// An object of pairs of name and value.
  template <class Pairs>
  static Json object(const Pairs& pairs) {
    Json result = std::initializer_list<Member>();
    for (const auto& [name, value] : pairs) result.add(name, value);
    return result;
  }

  /// Another member of an object.
  void add(std::string_view name, const Json& value);
  /// Another value of an array.
  void add(const Json& value) { append("", value); }

  const std::string& text() const { return text_; }

 private:
  /// `value` behind `prefix` as the last of an array or object.
  void append(const std::string& prefix, const Json& value);

  std::string text_;
};

struct Json::Member {
  std::string_view name;
  Json value;
};

}  // namespace norrsken::cli
