// Little-endian values taken from the front of a file's bytes.
#pragma once

#include <bit>
#include <cstddef>
#include <cstring>
#include <optional>
#include <string_view>
#include <type_traits>

namespace norrsken {

/// Bytes that have not been looked at. What takes more than there are takes nothing.
class Bytes {
  static_assert(std::endian::native == std::endian::little);

 public:
  explicit Bytes(std::string_view bytes) : left_(bytes) {}

  bool empty() const { return left_.empty(); }
  std::size_t size() const { return left_.size(); }
  char front() const { return left_.front(); }

  std::optional<std::string_view> take(std::size_t count) {
    if (count > left_.size()) return std::nullopt;
    const std::string_view taken = left_.substr(0, count);
    left_.remove_prefix(count);
    return taken;
  }
  /// A text and the zero that ends it.
  std::optional<std::string_view> take_word() {
    const std::size_t end = left_.find('\0');
    if (end == std::string_view::npos) return std::nullopt;
    const std::string_view word = left_.substr(0, end);
    left_.remove_prefix(end + 1);
    return word;
  }
  template <class T>
  requires std::is_arithmetic_v<T> std::optional<T> take() {
    T value{};
    const auto bytes = take(sizeof value);
    if (!bytes) return std::nullopt;
    std::memcpy(&value, bytes->data(), sizeof value);
    return value;
  }

 private:
  std::string_view left_;
};

}  // namespace norrsken
