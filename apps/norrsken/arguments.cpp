#include "arguments.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>
#include <tuple>

namespace norrsken::cli {
namespace {

/// The whole of `text` as a number.
template <class Number>
std::optional<Number> parse_number(std::string_view text) {
  if (text.starts_with('+')) text.remove_prefix(1);
  Number value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

std::string found(const std::string& text, std::string_view accepted) {
  return fmt::format("found '{}', accepted is {}", text, accepted);
}

/// Values for which `is_right(text)`; `accepted` says in words which those are.
template <class IsRight>
Check accepting(std::string_view accepted, IsRight is_right) {
  return [=](const std::string& text) { return is_right(text) ? std::string() : found(text, accepted); };
}

}  // namespace

std::pair<std::string, std::string> parse_definition(const std::string& text) {
  const auto equals = text.find('=');
  if (equals == std::string::npos) return {};
  return {text.substr(0, equals), text.substr(equals + 1)};
}

std::pair<int, int> parse_size(const std::string& text) {
  const auto x = text.find_first_of("xX");
  if (x == std::string::npos) return {0, 0};
  const auto width = parse_number<int>(std::string_view(text).substr(0, x));
  const auto height = parse_number<int>(std::string_view(text).substr(x + 1));
  if (!width || !height || *width < 1 || *height < 1) return {0, 0};
  return {*width, *height};
}

std::optional<double> parse_duration(const std::string& text) {
  constexpr double kLongest = 1e9;  // 30 years
  constexpr std::pair<char, double> kUnits[] = {{'s', 1}, {'m', 60}, {'h', 3600}};
  for (const auto& [unit, seconds] : kUnits) {
    if (text.empty() || text.back() != unit) continue;
    const auto count = parse_number<double>(std::string_view(text).substr(0, text.size() - 1));
    if (count && *count > 0 && *count * seconds <= kLongest) return *count * seconds;
  }
  return std::nullopt;
}

std::optional<double> parse_share(const std::string& text) {
  const bool is_percent = text.ends_with('%');
  const auto number = parse_number<double>(std::string_view(text).substr(0, text.size() - (is_percent ? 1 : 0)));
  const double share = number.value_or(0) / (is_percent ? 100 : 1);
  return share > 0 && share < 1 ? std::optional(share) : std::nullopt;
}

std::optional<std::uint64_t> parse_memory_size(const std::string& text) {
  constexpr double kLargest = 0x1p62;
  if (text == "none") return MemoryBudget::kUnlimited;
  std::string_view digits = text;
  double unit = 1;
  for (const auto& [letter, bytes] : {std::pair{'K', 0x1p10}, {'M', 0x1p20}, {'G', 0x1p30}, {'T', 0x1p40}}) {
    if (digits.empty() || digits.back() != letter) continue;
    unit = bytes;
    digits.remove_suffix(1);
    break;
  }
  const auto count = parse_number<double>(digits);
  if (!count || !(*count * unit >= 1 && *count * unit <= kLargest)) return std::nullopt;
  return static_cast<std::uint64_t>(*count * unit);
}

std::optional<SampleRange> parse_samples(const std::string& text) {
  const auto colon = text.find(':');
  if (colon == std::string::npos) return std::nullopt;
  const auto first = parse_number<int>(std::string_view(text).substr(0, colon));
  const auto end = parse_number<int>(std::string_view(text).substr(colon + 1));
  if (!first || !end || *first < 0 || *end <= *first) return std::nullopt;
  return SampleRange{static_cast<std::uint32_t>(*first), static_cast<std::uint32_t>(*end)};
}

Check whole_number(std::int64_t min, std::int64_t max) {
  return [=](const std::string& text) {
    const auto value = parse_number<std::int64_t>(text);
    if (value && *value >= min && *value <= max) return std::string();
    return found(text, fmt::format("a whole number from {} to {}", min, max));
  };
}

Check seed_number() {
  return [](const std::string& text) {
    if (parse_number<std::uint64_t>(text)) return std::string();
    return found(text, fmt::format("a whole number from 0 to {}", std::numeric_limits<std::uint64_t>::max()));
  };
}

Check real_number(double min, double max) {
  return [=](const std::string& text) {
    const auto value = parse_number<double>(text);
    if (value && std::isfinite(*value) && *value >= min && *value <= max) return std::string();
    return found(text, fmt::format("a number from {} to {}", min, max));
  };
}

Check one_of(std::vector<std::string> words) {
  return [words = std::move(words)](const std::string& text) {
    if (std::find(words.begin(), words.end(), text) != words.end()) return std::string();
    return unknown_word("value", text, words);
  };
}

Check image_size() {
  return accepting("WIDTHxHEIGHT in pixels, as in 800x600",
                   [](const std::string& text) { return parse_size(text).first > 0; });
}

Check definition() {
  return accepting("NAME=VALUE, as in -Dlight=point",
                   [](const std::string& text) { return !parse_definition(text).first.empty(); });
}

Check duration() {
  return accepting("a time with its unit, as in 90s, 1.5m or 2h",
                   [](const std::string& text) { return parse_duration(text).has_value(); });
}

Check file_name() {
  return accepting("the name of a file", [](const std::string& text) { return !text.empty(); });
}

Check share() {
  return accepting("a share greater than 0 and less than 1, as in 1% or 0.01",
                   [](const std::string& text) { return parse_share(text).has_value(); });
}

Check sample_range() {
  return accepting("FIRST:END, as in 0:64 for the samples 0 to 63",
                   [](const std::string& text) { return parse_samples(text).has_value(); });
}

Check memory_size() {
  return accepting("a size in bytes, as in 4G or 512M (of 1024), or none",
                   [](const std::string& text) { return parse_memory_size(text).has_value(); });
}

void MemoryArguments::add_to(Command& command) {
  command.options.push_back(
      {"--max-memory", &size, "SIZE",
       "Memory that the program may take, as in 4G or 512M; what does not fit is refused before it is\n"
       "loaded. Default: nine tenths of what is available; none: no limit",
       memory_size()});
}

std::shared_ptr<MemoryBudget> MemoryArguments::budget() const {
  if (size.empty()) return MemoryBudget::of_machine();
  return MemoryBudget::of_process(parse_memory_size(size).value());
}

void SceneArguments::add_to(Command& command) {
  const std::initializer_list<Option> options = {
      {.names = "SCENE",
       .target = &scene,
       .help = "scene file (Mitsuba XML, pbrt, glTF), mesh (PLY, OBJ, STL), or a name that 'norrsken scenes' lists",
       .is_required = true},
      {"-D", &definitions, "NAME=VALUE", "Set the scene's $NAME, as in -Dlight=point; may be repeated", definition()},
      {"--sensor", &sensor, "N|ID",
       "Which of the scene's sensors: its number from 0 (default) in the file's order, or its id"},
      {"--integrator", &integrator, "NAME",
       "Integrator in place of the scene's: path, direct, whitted, ptracer, depth"},
      {"--sampler", &sampler, "NAME",
       "Sampler in place of the scene's: sobol, independent, stratified, multijitter, ldsampler, orthogonal"},
      {"--size", &size, "WxH", "Image size in pixels in place of the scene's", image_size()},
      {"--spp", &spp, "N", "Samples per pixel in place of the scene's; sets $spp too, unless -D does",
       whole_number(1, std::numeric_limits<int>::max())},
  };
  command.options.insert(command.options.end(), options);
  memory.add_to(command);
}

LoadOptions SceneArguments::load_options() const {
  LoadOptions options;
  for (const std::string& text : definitions) options.parameters.push_back(parse_definition(text));
  options.sensor = sensor;
  options.integrator = integrator;
  options.sampler = sampler;
  if (!size.empty()) std::tie(options.width, options.height) = parse_size(size);
  if (spp > 0) options.samples_per_pixel = spp;
  options.memory = memory.budget();
  return options;
}

void MachineArguments::add_to(Command& command) {
  command.options.push_back({"--threads", &threads, "N", "Worker threads; 0 (default): one per hardware thread",
                             whole_number(0, kMaxThreads)});
  command.options.push_back({"--isa", &isa, "NAME", "Instruction set: auto (default), avx512, avx2, sse4.2, scalar"});
  command.options.push_back({"--accel", &accelerator, "NAME",
                             "How rays find what they hit: auto (default), planes, moller_trumbore, bvh, embree"});
}

void MachineArguments::apply_to(RenderOptions& options) const {
  options.threads = threads;
  options.isa = isa;
  options.accelerator = accelerator;
}

void ToneArguments::add_to(Command& command) {
  command.options.push_back({"--exposure", &exposure, "STOPS",
                             "Brighten PNG and JPEG by this many stops (factor 2 each); default 0",
                             real_number(-64, 64)});
  command.options.push_back(
      {"--tone", &curve, "CURVE", "Tone curve of PNG and JPEG: srgb (default), filmic", one_of({"srgb", "filmic"})});
}

ToneMapping ToneArguments::tone_mapping() const {
  return {curve == "filmic" ? ToneMapping::Curve::filmic : ToneMapping::Curve::srgb, exposure};
}

}  // namespace norrsken::cli
