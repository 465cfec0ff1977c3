#include "text_format.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

namespace norrsken::cli {

std::string format_digits(double value) {
  if (value < 9.995) return fmt::format("{:.2f}", value);
  if (value < 99.95) return fmt::format("{:.1f}", value);
  return fmt::format("{:.0f}", value);
}

std::string format_duration(double seconds) {
  if (!std::isfinite(seconds) || seconds < 0) return "?";
  if (seconds > 0 && seconds < 0.0995) return fmt::format("{:.2g} ms", 1e3 * seconds);
  if (seconds < 59.95) return format_digits(seconds) + " s";
  const double rounded = std::round(seconds);
  if (rounded < 3600) return fmt::format("{:.0f} min {:02.0f} s", std::floor(rounded / 60), std::fmod(rounded, 60.0));
  const double minutes = std::round(seconds / 60);
  if (minutes < 24 * 60)
    return fmt::format("{:.0f} h {:02.0f} min", std::floor(minutes / 60), std::fmod(minutes, 60.0));
  const double hours = std::round(seconds / 3600);
  return fmt::format("{:.0f} d {:02.0f} h", std::floor(hours / 24), std::fmod(hours, 24.0));
}

std::string format_count(double count) {
  if (count < 999.5) return fmt::format("{:.0f}", count);
  constexpr std::array<char, 5> kSuffixes = {'k', 'M', 'G', 'T', 'P'};
  std::size_t i = 0;
  count /= 1000;
  for (; count >= 999.5 && i + 1 < kSuffixes.size(); ++i) count /= 1000;
  return fmt::format("{} {}", format_digits(count), kSuffixes[i]);
}

std::string format_percent(double share) {
  if (!std::isfinite(share) || share < 0) return "?";
  const double percent = 100 * share;
  if (percent > 0 && percent < 0.995) return fmt::format("{:.2g} %", percent);
  return format_digits(percent) + " %";
}

std::string error_text(const RelativeError& error, double samples_per_pixel) {
  if (error.value > 0) {
    return fmt::format("estimated error {} ({} to {})", format_percent(error.value), format_percent(error.low),
                       format_percent(error.high));
  }
  if (error.value == 0) return "no noise seen";
  return samples_per_pixel < 2 ? "error not known before every pixel has two samples" : "error unknown: no light seen";
}

std::string format_plural(std::uint64_t count, std::string_view noun) {
  return fmt::format("{} {}{}", count, noun, count == 1 ? "" : "s");
}

std::string format_bytes(std::uint64_t bytes) {
  if (bytes < 1024) return fmt::format("{} B", bytes);
  constexpr std::array<char, 5> kPrefixes = {'K', 'M', 'G', 'T', 'P'};
  double value = static_cast<double>(bytes) / 1024;
  std::size_t i = 0;
  for (; value >= 1023.5 && i + 1 < kPrefixes.size(); ++i) value /= 1024;
  return fmt::format("{:.{}f} {}iB", value, value < 9.95 ? 1 : 0, kPrefixes[i]);
}

}  // namespace norrsken::cli
