#include "render/provenance.h"

#include <fmt/format.h>

#include <charconv>
#include <cstdlib>
#include <ctime>
#include <optional>
#include <string_view>

#include "base/text.h"
#include "compile/compile.h"

namespace norrsken {
namespace {

/// reproducible-builds.org/specs/source-date-epoch
std::optional<std::time_t> given_date() {
  const char* text = std::getenv("SOURCE_DATE_EPOCH");
  if (text == nullptr) return std::nullopt;
  const std::string_view digits = text;
  std::time_t seconds = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), seconds);
  if (error != std::errc() || end != digits.data() + digits.size()) return std::nullopt;
  return seconds;
}

/// "2026-11-30T16:26:45Z"
std::string date_text(std::time_t seconds) {
  std::tm date{};
  if (gmtime_r(&seconds, &date) == nullptr) return "unknown";
  char text[64];
  return {text, std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &date)};
}

}  // namespace

Metadata settings_of(const Scene& scene, const RenderOptions& options, const std::string& isa,
                     const std::string& accelerator) {
  const SceneInfo& info = scene.tables().info;
  const SceneFrame& frame = scene.frame();
  std::string parameters;
  for (const auto& [name, value] : info.parameters)
    parameters += fmt::format("{}{}={}", parameters.empty() ? "" : " ", name, value);
  Metadata settings = {{"Software", "norrsken " NORRSKEN_VERSION},
                       {"norrsken.scene", scene.tables().file},
                       {"norrsken.scene_hash", info.hash},
                       {"norrsken.sensor", fmt::format("{} {}", frame.sensor, frame.sensor_id)},
                       {"norrsken.integrator", frame.integrator_name},
                       {"norrsken.max_depth", fmt::to_string(frame.integrator.max_depth)},
                       {"norrsken.rr_depth", fmt::to_string(frame.integrator.rr_depth)},
                       {"norrsken.emitter_samples", fmt::to_string(frame.integrator.emitter_samples)},
                       {"norrsken.sampler", frame.sampler_name},
                       {"norrsken.seed", fmt::to_string(options.seed)},
                       {"norrsken.isa", isa},
                       {"norrsken.accelerator", accelerator}};
  if (!parameters.empty()) settings["norrsken.parameters"] = parameters;
  if (!frame.changes.empty()) settings["norrsken.camera"] = frame.changes;
  if (options.adaptive) settings["norrsken.adaptive"] = "true";
  for (auto& [name, text] : settings) text = printable(trim(text));
  return settings;
}

Metadata metadata_of(const Provenance& made, const Outcome& outcome) {
  Metadata metadata = made.settings;
  const auto add = [&](const char* name, std::string text) {
    metadata[std::string("norrsken.") + name] = std::move(text);
  };
  add("samples_per_pixel", fmt::format("{:.6g}", outcome.samples_per_pixel));
  std::string ranges;
  for (const SampleRange& range : outcome.ranges)
    ranges += fmt::format("{}{}:{}", ranges.empty() ? "" : " ", range.first, range.end);
  if (!ranges.empty()) add("samples", ranges);
  if (outcome.error.value >= 0) {
    add("relative_error", fmt::format("{:.6g}", outcome.error.value));
    add("relative_error_interval", fmt::format("{:.6g} {:.6g}", outcome.error.low, outcome.error.high));
  }
  if (outcome.dropped_samples > 0) add("dropped_samples", fmt::to_string(outcome.dropped_samples));
  if (outcome.interrupted) add("interrupted", "true");
  const std::optional<std::time_t> date = given_date();
  if (!date) add("seconds", fmt::format("{:.3f}", made.seconds));
  add("date", date_text(date.value_or(std::time(nullptr))));
  return metadata;
}

}  // namespace norrsken
