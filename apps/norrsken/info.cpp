// norrsken info: what a scene contains.
#include <fmt/format.h>

#include <algorithm>

#include "arguments.h"
#include "commands.h"
#include "console.h"
#include "image_info.h"
#include "norrsken/merge.h"
#include "session.h"
#include "text_format.h"

namespace norrsken::cli {
namespace {

struct Arguments {
  SceneArguments scene;
  bool json = false;
};

void print_as_json(const std::string& scene, const SceneInfo& info) {
  Json items = Json::array();
  for (const SceneInfo::Item& item : info.items)
    items.add({{"kind", item.kind}, {"plugin", item.plugin}, {"id", item.id}, {"detail", item.detail}});
  Json object = {{"scene", scene},
                 {"width", info.width},
                 {"height", info.height},
                 {"samples_per_pixel", info.samples_per_pixel},
                 {"sensor", info.sensor},
                 {"sensor_id", info.sensor_id},
                 {"sampler", info.sampler},
                 {"integrator", info.integrator},
                 {"max_depth", info.max_depth},
                 {"rr_depth", info.rr_depth},
                 {"emitter_samples", info.emitter_samples},
                 {"triangles", info.triangles},
                 {"spheres", info.spheres},
                 {"other_shapes", info.other_shapes},
                 {"instances", info.instances},
                 {"lights", info.lights},
                 {"bounds_min", info.bounds_min},
                 {"bounds_max", info.bounds_max},
                 {"table_bytes", info.memory.tables()},
                 {"memory",
                  {{"geometry_bytes", info.memory.geometry},
                   {"texture_bytes", info.memory.textures},
                   {"film_bytes", info.memory.film},
                   {"image_bytes", info.memory.image},
                   {"loading_peak_bytes", info.memory.loading},
                   {"acceleration_estimate_bytes", info.memory.acceleration}}},
                 {"parameters", Json::object(info.parameters)},
                 {"changes", info.changes},
                 {"files", info.files},
                 {"hash", info.hash},
                 {"items", items}};
  if (!info.accelerator.empty()) object.add("accelerator", info.accelerator);
  print_json(object);
}

void print_as_text(const std::string& scene, const SceneInfo& info) {
  const auto row = [](std::string_view name, const std::string& value) {
    print_line(fmt::format("  {:<12}{}", name, value));
  };
  print_line(scene);
  row("image", fmt::format("{} x {} pixels, {} per pixel ({})", info.width, info.height,
                           format_plural(info.samples_per_pixel, "sample"), info.sampler));
  row("sensor",
      info.sensor_id.empty() ? fmt::to_string(info.sensor) : fmt::format("{} ({})", info.sensor, info.sensor_id));
  row("integrator", fmt::format("{}, max_depth {}{}, rr_depth {}, {} per hit", info.integrator, info.max_depth,
                                info.max_depth < 0 ? " (unbounded)" : "", info.rr_depth,
                                format_plural(info.emitter_samples, "shadow ray")));
  std::string geometry =
      fmt::format("{}, {}", format_plural(info.triangles, "triangle"), format_plural(info.spheres, "sphere"));
  if (info.other_shapes > 0) geometry += ", " + format_plural(info.other_shapes, "other shape");
  if (info.instances > 0) geometry += ", " + format_plural(info.instances, "instance");
  row("geometry", geometry + ", " + format_plural(info.lights, "light"));
  row("bounds",
      fmt::format("({:.6g}, {:.6g}, {:.6g}) to ({:.6g}, {:.6g}, {:.6g})", info.bounds_min[0], info.bounds_min[1],
                  info.bounds_min[2], info.bounds_max[0], info.bounds_max[1], info.bounds_max[2]));
  if (!info.accelerator.empty()) row("accelerator", info.accelerator);
  const SceneInfo::Memory& memory = info.memory;
  row("memory", fmt::format("geometry {}, textures {}, other tables {}; film {}, its image {}",
                            format_bytes(memory.geometry), format_bytes(memory.textures),
                            format_bytes(memory.other_tables), format_bytes(memory.film), format_bytes(memory.image)));
  row("", fmt::format("{} at most while it was loaded, without film and image; about {} for its acceleration structure",
                      format_bytes(memory.loading), format_bytes(memory.acceleration)));
  row("hash", fmt::format("{} of its files ({} beside what is built in)", info.hash, info.files.size()));

  if (!info.parameters.empty()) {
    print_line("parameters (-DNAME=VALUE)");
    for (const auto& [name, value] : info.parameters) row(name, value);
  }
  if (!info.changes.empty()) {
    print_line("upgraded from an older version of the format");
    for (const std::string& change : info.changes) print_line("  " + change);
  }
  if (info.items.empty()) return;
  print_line("contents");
  std::size_t kind = 0, plugin = 0, id = 0;
  for (const SceneInfo::Item& item : info.items) {
    kind = std::max(kind, item.kind.size());
    plugin = std::max(plugin, item.plugin.size());
    id = std::max(id, item.id.size());
  }
  for (const SceneInfo::Item& item : info.items) {
    std::string line =
        fmt::format("  {:<{}}  {:<{}}  {:<{}}  {}", item.kind, kind, item.plugin, plugin, item.id, id, item.detail);
    line.erase(line.find_last_not_of(' ') + 1);
    print_line(line);
  }
}

/// Images are what they are: nothing is set in them.
ExitStatus print_info_of_image(const Arguments& arguments) {
  const SceneArguments& scene = arguments.scene;
  if (!scene.definitions.empty() || scene.integrator || scene.sampler || !scene.size.empty() || scene.spp > 0 ||
      scene.sensor)
    throw Failure(ExitStatus::usage,
                  fmt::format("'{}' is an image: options of scenes have no place beside it", scene.scene));
  return print_image_info(scene.scene, arguments.json);
}

ExitStatus print_info(const Arguments& arguments) {
  const std::string& name = arguments.scene.scene;
  if (has_image_header(name)) return print_info_of_image(arguments);
  if (is_checkpoint(name))
    throw Failure(ExitStatus::data_error,
                  fmt::format("'{0}' is a checkpoint, neither a scene nor an image: 'norrsken merge {0} -o image.exr' "
                              "makes an image of it, which says how it was made",
                              name));
  LoadOptions options = arguments.scene.load_options();
  options.reserve_film = false;
  const SceneInfo info = load_scene(arguments.scene.scene, options).info();
  arguments.json ? print_as_json(arguments.scene.scene, info) : print_as_text(arguments.scene.scene, info);
  return ExitStatus::done;
}

}  // namespace

Command info_command() {
  auto arguments = std::make_shared<Arguments>();
  Command command = {.name = "info", .summary = "Tell what a scene contains, or how an image was made"};
  arguments->scene.add_to(command);
  command.options.push_back({.names = "--json", .target = &arguments->json, .help = "Print one JSON object"});
  command.footer =
      "Examples:\n  norrsken info hexagon_room\n  norrsken info hexagon_room -Dlight=point --json\n  norrsken info "
      "room.exr";
  command.run = [arguments] { return print_info(*arguments); };
  return command;
}

}  // namespace norrsken::cli
