// plugins() of include/norrsken/plugins.h: every plugin is asked for what it declares.
#include "norrsken/plugins.h"

#include <algorithm>
#include <iterator>
#include <string_view>
#include <utility>

#include "compile/builder.h"
#include "compile/plugins.h"

namespace norrsken {
namespace {

/// What each plugin is, from the header blocks of the sources.
struct PluginTitle {
  std::string_view kind, plugin, text;
};
constexpr PluginTitle kTitles[] = {
#include "compile/plugin_titles.inc"
};

void add_title(PluginInfo& plugin) {
  const auto* found = std::ranges::find_if(
      kTitles, [&](const PluginTitle& line) { return line.kind == plugin.kind && line.plugin == plugin.name; });
  if (found != std::end(kTitles)) plugin.text = found->text;
}

/// `ask(compile, parameters, tools)` calls a plugin of the family. It is given nothing, so that it asks for everything; its
/// complaints about that are of no interest.
template <class Tools, class Function, class Ask>
void add_family(const char* kind, std::span<const Plugin<Function>> table, const Ask& ask,
                std::vector<PluginInfo>& plugins) {
  for (const Plugin<Function>& plugin : table) {
    const Node node(kind, std::string(plugin.name));
    const Description description;
    const FileSystem files;
    Diagnostics unheard;
    Builder builder(description, files, unheard);
    Tools tools(builder);
    PluginInfo info{kind, node.plugin, {}, {}, {}};
    Parameters p(node, description, files, unheard);
    p.record(info);
    ask(plugin.compile, p, tools);
    add_title(info);
    plugins.push_back(std::move(info));
  }
}

}  // namespace

std::vector<PluginInfo> plugins() {
  std::vector<PluginInfo> all;
  const auto ask = [](auto* compile, Parameters& p, auto& tools) { compile(p, tools); };
  FilmSettings film;
  film.width = film.full_width = film.height = film.full_height = 1;
  add_family<Integrators>("integrator", integrator_plugins(), ask, all);
  add_family<Sensors>(
      "sensor", sensor_plugins(),
      [&](auto* compile, Parameters& p, Sensors& sensors) {
        compile(p, sensors, film);
        for (const char* kind : {"film", "medium", "sampler"}) p.children(kind);
      },
      all);
  add_family<Films>("film", film_plugins(), ask, all);
  add_family<PluginTools>(
      "rfilter", rfilter_plugins(),
      [](auto* compile, Parameters& p, PluginTools&) {
        Array<float> table;
        compile(p, table);
      },
      all);
  add_family<PluginTools>(
      "sampler", sampler_plugins(), [](auto* compile, Parameters& p, PluginTools&) { compile(p); }, all);
  add_family<Materials>("bsdf", bsdf_plugins(), ask, all);
  add_family<Textures>("texture", texture_plugins(), ask, all);
  add_family<Media>("medium", medium_plugins(), ask, all);
  add_family<Media>("phase", phase_plugins(), ask, all);
  add_family<Media>("volume", volume_plugins(), ask, all);
  add_family<Lights>(
      "emitter", emitter_plugins(),
      [](auto* compile, Parameters& p, Lights& lights) {
        read_sampling_weight(p);
        p.children("medium");
        compile(p, lights, kNone);
      },
      all);
  add_family<Shapes>(
      "shape", shape_plugins(),
      [](auto* compile, Parameters& p, Shapes& shapes) {
        const std::optional<ShapeGeometry> geometry = compile(p, shapes);
        if (geometry && geometry->of_shapes) return;
        for (const char* kind : {"bsdf", "emitter", "medium", "sensor"}) p.children(kind);
      },
      all);
  return all;
}

}  // namespace norrsken
