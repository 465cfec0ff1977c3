#include "base/numbers.h"

#include <charconv>
#include <cmath>
#include <system_error>

namespace norrsken {
namespace {

std::string_view without_plus(std::string_view text) {
  return text.size() > 1 && text[0] == '+' && text[1] != '-' ? text.substr(1) : text;
}

// std::from_chars says "out of range" both for 1e-999 and for 1e999.
bool is_underflow(std::string_view text) {
  const std::size_t exponent = text.find_first_of("eE");
  if (exponent != std::string_view::npos) return text.substr(exponent + 1).starts_with('-');
  return text.substr(0, text.find('.')).find_first_of("123456789") == std::string_view::npos;
}

template <typename Real>
NumberStatus parse_real(std::string_view text, Real& value) {
  text = without_plus(text);
  const char* const end = text.data() + text.size();
  Real parsed{};
  const auto [stop, error] = std::from_chars(text.data(), end, parsed);
  if (error == std::errc::invalid_argument || stop != end) return NumberStatus::malformed;
  if (error == std::errc::result_out_of_range) {
    if (!is_underflow(text)) return NumberStatus::overflow;
    parsed = 0;
  }
  if (!std::isfinite(parsed)) return NumberStatus::not_finite;
  value = parsed;
  return NumberStatus::ok;
}

}  // namespace

NumberStatus parse_number(std::string_view text, double& value) { return parse_real(text, value); }
NumberStatus parse_number(std::string_view text, float& value) { return parse_real(text, value); }

NumberStatus parse_integer(std::string_view text, std::int64_t& value) {
  text = without_plus(text);
  const char* const end = text.data() + text.size();
  std::int64_t parsed = 0;
  const auto [stop, error] = std::from_chars(text.data(), end, parsed);
  if (error == std::errc::invalid_argument || stop != end) return NumberStatus::malformed;
  if (error == std::errc::result_out_of_range) return NumberStatus::overflow;
  value = parsed;
  return NumberStatus::ok;
}

std::string_view describe(NumberStatus status) {
  switch (status) {
    case NumberStatus::malformed:
      return "is not a number";
    case NumberStatus::not_finite:
      return "is not finite";
    case NumberStatus::overflow:
      return "is too large";
    case NumberStatus::ok:
      break;
  }
  return {};
}

}  // namespace norrsken
