// Figures as people read them.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "norrsken/render.h"

namespace norrsken::cli {

/// A value of at least 0 with three significant digits and no exponent: "0.13", "1.23", "12.3", "1234".
std::string format_digits(double value);

/// "1.7 ms", "0.42 s", "12.3 s", "4 min 07 s", "7 h 03 min", "2 d 04 h". Negative and unknown (not finite) times are
/// "?".
std::string format_duration(double seconds);

/// A count with three significant digits and an SI suffix: "950", "12.3 k", "41.0 M", "43.1 G".
std::string format_count(double count);

/// A share as percent with three significant digits: 0.0123 is "1.23 %"; negative or not finite is "?".
std::string format_percent(double share);

/// "estimated error 9.45 % (9.1 % to 9.8 %)", or why there is none to tell of an image with so many samples.
std::string error_text(const RelativeError& error, double samples_per_pixel);

/// "1 sphere", "2 spheres", "0 lights".
std::string format_plural(std::uint64_t count, std::string_view noun);

/// Bytes with a binary suffix: "512 B", "1.5 KiB", "12 MiB".
std::string format_bytes(std::uint64_t bytes);

}  // namespace norrsken::cli
