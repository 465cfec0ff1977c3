#include "arguments.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>

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
CLI::Validator accepting(std::string_view accepted, IsRight is_right) {
  return CLI::Validator([=](const std::string& text) { return is_right(text) ? std::string() : found(text, accepted); },
                        "");
}

/// Names of a command's options as they are typed: "--spp", "-o".
std::vector<std::string> option_names(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    for (const std::string& name : option->get_snames()) names.push_back("-" + name);
  }
  return names;
}

/// Of a mistyped or misplaced option the name as it is declared: "--spp" of "--spp=4", "-D" of "-Dlight=point".
std::string declared_name(const std::string& option) {
  return option.starts_with("--") ? option.substr(0, option.find('=')) : option.substr(0, 2);
}

std::vector<const CLI::App*> commands(const CLI::App& app) {
  return app.get_subcommands([](const CLI::App*) { return true; });
}

/// An argument that stands before the command, or where there is no command.
std::string describe_stray_argument(const CLI::App& app, const std::string& argument) {
  if (!argument.starts_with('-')) return fmt::format("unexpected argument '{}'", argument);
  const auto chosen = app.get_subcommands();
  const std::string option = declared_name(argument);
  const auto has_option = [&](const CLI::App* command) {
    const auto names = option_names(*command);
    return std::find(names.begin(), names.end(), option) != names.end();
  };
  const auto candidates = chosen.empty() ? commands(app) : std::vector<const CLI::App*>(chosen.begin(), chosen.end());
  if (std::any_of(candidates.begin(), candidates.end(), has_option))
    return fmt::format("'{0}' belongs after the command: norrsken {1} {0}", option,
                       chosen.empty() ? "COMMAND" : chosen.front()->get_name());
  const std::string name = argument.substr(0, argument.find('='));
  return fmt::format("unknown option '{}'{}", name, did_you_mean(name, option_names(app)));
}

/// Of an option the value's name is told; that it is required or may be repeated is said in words.
class HelpFormatter : public CLI::Formatter {
 public:
  HelpFormatter() {
    label("Positionals", "Arguments");
    label("SUBCOMMAND", "COMMAND");
  }
  std::string make_option_opts(const CLI::Option* option) const override {
    return option->get_type_size() == 0 || option->get_type_name().empty() ? "" : " " + option->get_type_name();
  }
};

}  // namespace

std::shared_ptr<CLI::Formatter> help_formatter() { return std::make_shared<HelpFormatter>(); }

std::vector<std::string> command_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* command : commands(app)) names.push_back(command->get_name());
  return names;
}

std::string unknown_word(std::string_view what, std::string_view word, const std::vector<std::string>& accepted) {
  const std::string hint = did_you_mean(word, accepted);
  return fmt::format("unknown {} '{}'{} accepted: {}", what, word, hint.empty() ? ";" : hint,
                     fmt::join(accepted, ", "));
}

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

CLI::Validator whole_number(std::int64_t min, std::int64_t max) {
  return CLI::Validator(
      [=](const std::string& text) {
        const auto value = parse_number<std::int64_t>(text);
        if (value && *value >= min && *value <= max) return std::string();
        return found(text, fmt::format("a whole number from {} to {}", min, max));
      },
      "");
}

CLI::Validator seed_number() {
  return CLI::Validator(
      [](const std::string& text) {
        if (parse_number<std::uint64_t>(text)) return std::string();
        return found(text, fmt::format("a whole number from 0 to {}", std::numeric_limits<std::uint64_t>::max()));
      },
      "");
}

CLI::Validator real_number(double min, double max) {
  return CLI::Validator(
      [=](const std::string& text) {
        const auto value = parse_number<double>(text);
        if (value && std::isfinite(*value) && *value >= min && *value <= max) return std::string();
        return found(text, fmt::format("a number from {} to {}", min, max));
      },
      "");
}

CLI::Validator one_of(std::vector<std::string> words) {
  return CLI::Validator(
      [words = std::move(words)](const std::string& text) {
        if (std::find(words.begin(), words.end(), text) != words.end()) return std::string();
        return unknown_word("value", text, words);
      },
      "");
}

CLI::Validator image_size() {
  return accepting("WIDTHxHEIGHT in pixels, as in 800x600",
                   [](const std::string& text) { return parse_size(text).first > 0; });
}

CLI::Validator definition() {
  return accepting("NAME=VALUE, as in -Dlight=point",
                   [](const std::string& text) { return !parse_definition(text).first.empty(); });
}

CLI::Validator duration() {
  return accepting("a time with its unit, as in 90s, 1.5m or 2h",
                   [](const std::string& text) { return parse_duration(text).has_value(); });
}

CLI::Validator file_name() {
  return accepting("the name of a file", [](const std::string& text) { return !text.empty(); });
}

CLI::Validator share() {
  return accepting("a share greater than 0 and less than 1, as in 1% or 0.01",
                   [](const std::string& text) { return parse_share(text).has_value(); });
}

CLI::Validator sample_range() {
  return accepting("FIRST:END, as in 0:64 for the samples 0 to 63",
                   [](const std::string& text) { return parse_samples(text).has_value(); });
}

CLI::Validator memory_size() {
  return accepting("a size in bytes, as in 4G or 512M (of 1024), or none",
                   [](const std::string& text) { return parse_memory_size(text).has_value(); });
}

void MemoryArguments::add_to(CLI::App& command) {
  command
      .add_option("--max-memory", size,
                  "Memory that the program may take, as in 4G or 512M; what does not fit is refused before it is\n"
                  "loaded. Default: nine tenths of what is available; none: no limit")
      ->check(memory_size())
      ->type_name("SIZE");
}

std::shared_ptr<MemoryBudget> MemoryArguments::budget() const {
  if (size.empty()) return MemoryBudget::of_machine();
  return MemoryBudget::of_process(parse_memory_size(size).value());
}

void SceneArguments::add_to(CLI::App& command) {
  command.add_option("SCENE", scene, "Mitsuba XML file, or a name that 'norrsken scenes' lists")
      ->required()
      ->type_name("");
  command.add_option("-D", definitions, "Set the scene's $NAME, as in -Dlight=point; may be repeated")
      ->check(definition())
      ->take_all()
      ->allow_extra_args(false)
      ->type_name("NAME=VALUE");
  command
      .add_option("--sensor", sensor,
                  "Which of the scene's sensors: its number from 0 (default) in the file's order, or its id")
      ->type_name("N|ID");
  command
      .add_option("--integrator", integrator,
                  "Integrator in place of the scene's: path, direct, whitted, ptracer, depth")
      ->type_name("NAME");
  command
      .add_option("--sampler", sampler,
                  "Sampler in place of the scene's: sobol, independent, stratified, multijitter, ldsampler, orthogonal")
      ->type_name("NAME");
  command.add_option("--size", size, "Image size in pixels in place of the scene's")
      ->check(image_size())
      ->type_name("WxH");
  command.add_option("--spp", spp, "Samples per pixel in place of the scene's; sets $spp too, unless -D does")
      ->check(whole_number(1, std::numeric_limits<int>::max()))
      ->type_name("N");
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

void MachineArguments::add_to(CLI::App& command, bool with_accelerator) {
  command.add_option("--threads", threads, "Worker threads; 0 (default): one per hardware thread")
      ->check(whole_number(0, kMaxThreads))
      ->type_name("N");
  command.add_option("--isa", isa, "Instruction set: auto (default), avx512, avx2, sse4.2, scalar")->type_name("NAME");
  if (!with_accelerator) return;
  command
      .add_option("--accel", accelerator,
                  "How rays find what they hit: auto (default), planes, moller_trumbore, bvh, embree")
      ->type_name("NAME");
}

void MachineArguments::apply_to(RenderOptions& options) const {
  options.threads = threads;
  options.isa = isa;
  options.accelerator = accelerator;
}

void ToneArguments::add_to(CLI::App& command) {
  command.add_option("--exposure", exposure, "Brighten PNG and JPEG by this many stops (factor 2 each); default 0")
      ->check(real_number(-64, 64))
      ->type_name("STOPS");
  command.add_option("--tone", curve, "Tone curve of PNG and JPEG: srgb (default), filmic")
      ->check(one_of({"srgb", "filmic"}))
      ->type_name("CURVE");
}

ToneMapping ToneArguments::tone_mapping() const {
  return {curve == "filmic" ? ToneMapping::Curve::filmic : ToneMapping::Curve::srgb, exposure};
}

std::string describe_usage_error(const CLI::App& app, const CLI::ParseError& error) {
  if (dynamic_cast<const CLI::ArgumentMismatch*>(&error) != nullptr) {
    const std::string text = error.what();
    return fmt::format("option '{}' needs a value", text.substr(0, text.find(':')));
  }
  const bool is_required = dynamic_cast<const CLI::RequiredError*>(&error) != nullptr;
  const bool is_extra = dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr;
  const auto stray = app.remaining(false);
  if ((is_required || is_extra) && !stray.empty()) return describe_stray_argument(app, stray.front());
  const auto chosen = app.get_subcommands();
  if (is_required && chosen.empty())
    return fmt::format("a command is required; accepted: {}", fmt::join(command_names(app), ", "));
  if (!is_extra) return error.what();
  const CLI::App& command = chosen.empty() ? app : *chosen.front();
  const auto extras = app.remaining(true);
  if (extras.empty()) return error.what();
  const std::string& extra = extras.front();
  if (!extra.starts_with('-')) return fmt::format("unexpected argument '{}'", extra);
  const std::string name = extra.substr(0, extra.find('='));
  return fmt::format("unknown option '{}'{}", name, did_you_mean(name, option_names(command)));
}

}  // namespace norrsken::cli
