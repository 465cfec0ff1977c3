// The values of a PLY file's body, one after the other: numbers of either byte order, or words.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string_view>

#include "base/numbers.h"
#include "base/text.h"
#include "formats/mesh_complaints.h"
#include "formats/ply_header.h"

namespace norrsken {

static_assert(std::endian::native == std::endian::little, "byte order is swapped for big-endian files only");

template <typename T, bool Swap>
double load_ply_value(const char* bytes) {
  std::array<char, sizeof(T)> raw;
  std::memcpy(raw.data(), bytes, sizeof(T));
  if constexpr (Swap) std::reverse(raw.begin(), raw.end());
  return static_cast<double>(std::bit_cast<T>(raw));
}

// Values of a binary body, one after the other.
template <bool Swap>
class PlyBinaryInput {
 public:
  PlyBinaryInput(std::string_view body, MeshComplaints&) : at_(body.data()), end_(body.data() + body.size()) {}

  /// False at the end of the file.
  bool read(PlyType type, double& value) {
    if (remaining() < size_of(type)) return false;
    switch (type) {
      case PlyType::int8:
        value = load_ply_value<std::int8_t, Swap>(at_);
        break;
      case PlyType::uint8:
        value = load_ply_value<std::uint8_t, Swap>(at_);
        break;
      case PlyType::int16:
        value = load_ply_value<std::int16_t, Swap>(at_);
        break;
      case PlyType::uint16:
        value = load_ply_value<std::uint16_t, Swap>(at_);
        break;
      case PlyType::int32:
        value = load_ply_value<std::int32_t, Swap>(at_);
        break;
      case PlyType::uint32:
        value = load_ply_value<std::uint32_t, Swap>(at_);
        break;
      case PlyType::float32:
        value = load_ply_value<float, Swap>(at_);
        break;
      case PlyType::float64:
        value = load_ply_value<double, Swap>(at_);
        break;
    }
    at_ += size_of(type);
    return true;
  }

  bool failed() const { return false; }
  std::string_view last() const { return {}; }
  /// The fewest bytes that a value of the type can take.
  static std::size_t least_size(PlyType type) { return size_of(type); }
  std::size_t remaining() const { return static_cast<std::size_t>(end_ - at_); }

 private:
  const char* at_;
  const char* end_;
};

// Values of a body of text, apart by blanks and line breaks.
class PlyTextInput {
 public:
  PlyTextInput(std::string_view body, MeshComplaints& complaints) : body_(body), complaints_(complaints) {}

  /// False at the end of the file, or after a complaint: then `failed`.
  bool read(PlyType type, double& value) {
    at_ = std::min(body_.find_first_not_of(kBlanks, at_), body_.size());
    if (at_ == body_.size()) return false;
    const std::size_t stop = std::min(body_.find_first_of(kBlanks, at_), body_.size());
    last_ = body_.substr(at_, stop - at_);
    at_ = stop;
    NumberStatus status = parse_number(last_, value);
    // These are for whoever asked for the value to judge; it may be a property that nobody asks for.
    if (status == NumberStatus::not_finite || status == NumberStatus::overflow) {
      constexpr double kHuge = std::numeric_limits<double>::max();
      value = status == NumberStatus::overflow ? kHuge : std::numeric_limits<double>::quiet_NaN();
      status = NumberStatus::ok;
    }
    const bool fits = type >= PlyType::float32 || std::isnan(value) || value == std::floor(value);
    if (status == NumberStatus::ok && fits) return true;
    failed_ = true;
    complaints_.at(last_, fmt::format("{} is no {}", quoted(last_), type >= PlyType::float32 ? "number" : "integer"),
                   "values as the header says");
    return false;
  }

  bool failed() const { return failed_; }
  /// The word that was read last.
  std::string_view last() const { return last_; }
  static std::size_t least_size(PlyType) { return 2; }
  std::size_t remaining() const { return body_.size() - at_; }

 private:
  static constexpr std::string_view kBlanks = " \t\r\n";

  std::string_view body_;
  MeshComplaints& complaints_;
  std::size_t at_ = 0;
  std::string_view last_;
  bool failed_ = false;
};

}  // namespace norrsken
