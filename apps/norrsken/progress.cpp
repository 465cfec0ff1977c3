#include "progress.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numeric>
#include <utility>

#include "console.h"
#include "text_format.h"

namespace norrsken::cli {
namespace {

using namespace std::chrono_literals;

/// A log wants a line now and then, a program that reads JSON wants to follow.
constexpr auto kTextInterval = 10s;
constexpr auto kJsonInterval = 500ms;

/// Without digits that change faster than they can be read.
std::string coarse_duration(double seconds) {
  return seconds < 59.5 ? fmt::format("{:.{}f} s", seconds, seconds < 9.95 ? 1 : 0) : format_duration(seconds);
}

bool is_last(const RenderProgress& progress) { return progress.fraction >= 1; }

}  // namespace

std::string progress_line(const std::string& label, const RenderProgress& progress, int columns) {
  const double total = static_cast<double>(progress.samples_total), done = static_cast<double>(progress.samples_done);
  // Rounded down: 100 % is said only when everything is done.
  const double percent = std::floor(100 * std::clamp(progress.fraction, 0.0, 1.0));
  enum Part { kPercent, kSamples, kTime, kSpeed, kError, kPartCount };
  std::array<std::string, kPartCount> parts;
  parts[kPercent] = fmt::format("{}{:3.0f} %", label, percent);
  parts[kSamples] = fmt::format("  {}/{} samples", format_count(done), format_count(total));
  parts[kTime] = "  " + coarse_duration(progress.elapsed_seconds);
  if (progress.seconds_left > 0) parts[kTime] += fmt::format(", {} left", coarse_duration(progress.seconds_left));
  if (progress.samples_per_second > 0)
    parts[kSpeed] = fmt::format("  {} Msamples/s", format_digits(progress.samples_per_second / 1e6));
  if (progress.error.value > 0) parts[kError] = "  error " + format_percent(progress.error.value);

  const auto length = [&] {
    return std::accumulate(parts.begin(), parts.end(), 0,
                           [](int sum, const std::string& part) { return sum + static_cast<int>(part.size()); });
  };
  for (const Part part : {kSamples, kSpeed, kTime, kError})
    if (length() > columns) parts[part].clear();
  return fmt::format("{}", fmt::join(parts, "")).substr(0, static_cast<std::size_t>(std::max(columns, 0)));
}

void add_error(Json& object, const RelativeError& error) {
  object.add("relative_error", error.value < 0 ? Json() : Json(error.value));
  object.add("relative_error_interval", error.value > 0 ? Json(std::array{error.low, error.high}) : Json());
}

void ProgressMeter::start(std::string label) {
  finish();
  label_ = std::move(label);
  last_ = Clock::now();
  has_announced_ = false;
}

void ProgressMeter::update(const RenderProgress& progress) {
  const auto now = Clock::now();
  if (verbosity_ == Verbosity::json) {
    if (now - last_ < kJsonInterval && !is_last(progress)) return;
    Json object = {{"event", "progress"},
                   {"samples_done", progress.samples_done},
                   {"samples_total", progress.samples_total},
                   {"elapsed_seconds", progress.elapsed_seconds},
                   {"left_seconds", progress.seconds_left >= 0 ? Json(progress.seconds_left) : Json()},
                   {"samples_per_second", progress.samples_per_second},
                   {"fraction", progress.fraction}};
    add_error(object, progress.error);
    print_json(object);
  } else if (verbosity_ == Verbosity::text && stderr_is_terminal()) {
    // One column stays free: a full last column makes some terminals wrap.
    const std::string line = progress_line(label_, progress, stderr_columns() - 1);
    fmt::print(stderr, "\r{}\x1b[K", line);
    std::fflush(stderr);
    line_is_shown_ = true;
  } else if (verbosity_ == Verbosity::text) {
    if (now - last_ < kTextInterval) return;
    print_note(progress_line(label_, progress, 1000));
  } else {
    return;
  }
  last_ = now;
}

void ProgressMeter::announce(std::string_view message) {
  if (verbosity_ != Verbosity::text || std::exchange(has_announced_, true)) return;
  finish();
  print_note(message);
}

void ProgressMeter::warn(const std::string& message) {
  if (std::exchange(warned_, message) == message) return;
  finish();
  print_warning(message);
}

void ProgressMeter::finish() {
  if (!std::exchange(line_is_shown_, false)) return;
  fmt::print(stderr, "\r\x1b[K");
  std::fflush(stderr);
}

}  // namespace norrsken::cli
