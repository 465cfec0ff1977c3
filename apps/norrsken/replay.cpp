#include "replay.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <limits>

#include "console.h"
#include "text_format.h"

namespace norrsken::cli {
namespace {

std::optional<int> whole(std::string_view text) {
  int value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size() && value >= 0 ? std::optional(value) : std::nullopt;
}

std::string text_of(const Triple& v) { return fmt::format("({:.6g}, {:.6g}, {:.6g})", v[0], v[1], v[2]); }

bool is_zero(const Triple& v) { return v == Triple{}; }

std::string describe_vertex(const PathVertex& v, std::size_t number, bool is_last) {
  std::string text = fmt::format("\n{:>3}  ray from {} along {}\n     throughput {}", number, text_of(v.origin),
                                 text_of(v.direction), text_of(v.throughput));
  if (v.pdf_sa != 0) text += fmt::format(", sampled with density {:.6g}", v.pdf_sa);
  if (v.hit) {
    const std::string id = v.shape_id.empty() ? "" : fmt::format(" '{}'", v.shape_id);
    text += fmt::format("\n     meets shape {}{}, primitive {}, after {:.6g} at {}: {}", v.shape, id, v.primitive,
                        v.distance, text_of(v.position), v.bsdf);
  } else {
    text += is_last && number > 1 ? "\n     meets nothing that emits" : "\n     meets nothing";
  }
  if (!is_zero(v.emission)) text += fmt::format("\n     emission adds {}", text_of(v.emission));
  for (const PathVertex::LightSample& light : v.light_samples) {
    text +=
        fmt::format("\n     light sample for {}: along {}, {:.6g} away, {} {}", light.bsdf, text_of(light.direction),
                    light.distance, light.reached ? "adds" : "hidden, would have added", text_of(light.contribution));
  }
  return text + "\n";
}

Json json_of(const PathVertex& v) {
  Json object = {{"origin", v.origin}, {"direction", v.direction}, {"throughput", v.throughput}, {"pdf_sa", v.pdf_sa},
                 {"hit", v.hit},       {"emission", v.emission}};
  if (v.hit) {
    object.add("distance", v.distance);
    object.add("position", v.position);
    object.add("shape", v.shape);
    object.add("shape_id", v.shape_id.empty() ? Json() : Json(v.shape_id));
    object.add("primitive", v.primitive);
    object.add("bsdf", v.bsdf);
  }
  Json light_samples = Json::array();
  for (const PathVertex::LightSample& light : v.light_samples) {
    light_samples.add({{"bsdf", light.bsdf},
                       {"origin", light.origin},
                       {"direction", light.direction},
                       {"distance", light.distance},
                       {"contribution", light.contribution},
                       {"reached", light.reached}});
  }
  object.add("light_samples", light_samples);
  return object;
}

/// As a shell takes it for one word.
std::string shell_word(const std::string& word) {
  const auto is_plain = [](unsigned char c) {
    return std::isalnum(c) != 0 || std::string_view("-_./=,:@%+").find(static_cast<char>(c)) != std::string_view::npos;
  };
  if (!word.empty() && std::all_of(word.begin(), word.end(), is_plain)) return word;
  std::string quoted = "'";
  for (const char c : word) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

}  // namespace

std::optional<std::pair<int, int>> parse_pixel(const std::string& text) {
  const auto comma = text.find(',');
  if (comma == std::string::npos) return std::nullopt;
  const auto x = whole(std::string_view(text).substr(0, comma)), y = whole(std::string_view(text).substr(comma + 1));
  if (!x || !y) return std::nullopt;
  return std::pair{*x, *y};
}

void ReplayArguments::add_to(Command& command) {
  const auto is_pixel = [](const std::string& text) {
    return parse_pixel(text) ? std::string() : fmt::format("'{}' is not X,Y, as in 12,40", text);
  };
  command.options.push_back({"--pixel", &pixel, "X,Y",
                             "Render one sample of this pixel again, the upper left one being 0,0, and print it in "
                             "place of an image",
                             is_pixel});
  command.options.push_back({.names = "--sample",
                             .target = &sample,
                             .value = "N",
                             .help = "Which of the pixel's samples, from 0 (default)",
                             .check = whole_number(0, std::numeric_limits<int>::max() - 1),
                             .needs = "--pixel"});
  command.options.push_back(
      {.names = "--trace", .target = &trace, .help = "Print its path vertex by vertex", .needs = "--pixel"});
}

std::string describe_path(const PathTrace& path, bool vertices) {
  std::string text;
  for (std::size_t i = 0; vertices && i < path.vertices.size(); ++i)
    text += describe_vertex(path.vertices[i], i + 1, i + 1 == path.vertices.size());
  return text + fmt::format("{}radiance {}", vertices ? "\n" : "", text_of(path.radiance));
}

ExitStatus replay(const Scene& scene, const RenderOptions& options, const ReplayArguments& arguments, bool json) {
  const auto [x, y] = parse_pixel(arguments.pixel).value();
  const auto path = trace_path(scene, options, x, y, static_cast<std::uint32_t>(arguments.sample));
  print_diagnostics(path.diagnostics());
  if (!path) return ExitStatus::usage;
  if (json) {
    Json object = {{"x", x}, {"y", y}, {"sample", arguments.sample}, {"radiance", path->radiance}};
    if (arguments.trace) {
      Json vertices = Json::array();
      for (const PathVertex& v : path->vertices) vertices.add(json_of(v));
      object.add("vertices", vertices);
    }
    print_json(object);
  } else {
    print_line(fmt::format("sample {} of pixel {}, {}", arguments.sample, x, y));
    print_line(describe_path(*path, arguments.trace));
  }
  return ExitStatus::done;
}

std::string replay_command(const SceneArguments& scene, std::uint64_t seed, const RenderStatistics& statistics, int x,
                           int y, std::uint32_t sample) {
  std::string text = "norrsken render " + shell_word(scene.scene);
  const auto add = [&](const char* option, const std::string& value) {
    text += fmt::format(" {} {}", option, shell_word(value));
  };
  for (const std::string& definition : scene.definitions) add("-D", definition);
  if (scene.integrator) add("--integrator", *scene.integrator);
  if (scene.sampler) add("--sampler", *scene.sampler);
  if (!scene.size.empty()) add("--size", scene.size);
  if (scene.spp > 0) add("--spp", std::to_string(scene.spp));
  if (seed != 0) add("--seed", std::to_string(seed));
  add("--isa", statistics.isa);
  add("--accel", statistics.accelerator);
  return text + fmt::format(" --pixel {},{} --sample {} --trace", x, y, sample);
}

}  // namespace norrsken::cli
