// Telling how far a rendering is: a line rewritten in place, occasional lines, or JSON objects.
#pragma once

#include <chrono>
#include <string>
#include <string_view>

#include "json.h"
#include "norrsken/render.h"

namespace norrsken::cli {

/// `relative_error` and `relative_error_interval`, null while unknown; the interval also as long as no noise was seen.
void add_error(Json& object, const RelativeError& error);

/// " 42 %  3.20 M/7.68 M samples  12 s, 16 s left  17.2 Msamples/s  error 1.83 %", with `label` in front. Of what does
/// not fit into `columns` characters, the samples are left out first, then speed, time and error.
std::string progress_line(const std::string& label, const RenderProgress& progress, int columns);

/// How a command reports on itself; what --quiet and --json choose.
enum class Verbosity { text, json, quiet };

/// Shows the progress of one rendering, or of several in turn.
class ProgressMeter {
 public:
  explicit ProgressMeter(Verbosity verbosity) : verbosity_(verbosity) {}
  ~ProgressMeter() { finish(); }
  ProgressMeter(const ProgressMeter&) = delete;
  ProgressMeter& operator=(const ProgressMeter&) = delete;

  /// What the lines begin with ("figure 9: "); starts a new rendering.
  void start(std::string label);
  void update(const RenderProgress& progress);
  /// Says something, in text only and once in a rendering however often it is called.
  void announce(std::string_view message);
  /// A warning, whatever is asked for, whenever it is another one than the last.
  void warn(const std::string& message);
  /// Removes the rewritten line, so that other text can follow.
  void finish();

 private:
  using Clock = std::chrono::steady_clock;

  Verbosity verbosity_;
  std::string label_;
  Clock::time_point last_ = Clock::now();
  std::string warned_;
  bool line_is_shown_ = false, has_announced_ = false;
};

}  // namespace norrsken::cli
