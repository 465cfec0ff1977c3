// Numbers out of text: strict, independent of the locale, and never silently infinite.
#pragma once

#include <cstdint>
#include <string_view>

namespace norrsken {

enum class NumberStatus {
  ok,
  malformed,   ///< not a number, or something follows it
  not_finite,  ///< "nan", "inf"
  overflow,    ///< beyond what the type holds
};

/// The whole of `text` as a decimal floating-point number; a leading '+' is allowed, blanks and hexadecimal are not.
/// What is too small to be told from 0 is 0.
NumberStatus parse_number(std::string_view text, double& value);
NumberStatus parse_number(std::string_view text, float& value);

/// The whole of `text` as a decimal integer.
NumberStatus parse_integer(std::string_view text, std::int64_t& value);

/// For a complaint: "is not a number", "is not finite", "is too large"; empty for ok.
std::string_view describe(NumberStatus status);

}  // namespace norrsken
