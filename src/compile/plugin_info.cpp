// plugins() of include/norrsken/plugins.h: every plugin is asked what it asks for.
#include "norrsken/plugins.h"

#include <algorithm>
#include <iterator>
#include <string_view>
#include <utility>

#include "compile/builder.h"
#include "compile/plugins.h"

namespace norrsken {
namespace {

/// Lines of the header blocks of the sources, which docs/scenes.md is made of too; `parameter` is empty for the plugin itself.
struct PluginText {
  std::string_view kind, plugin, parameter, unit, text;
};
constexpr PluginText kTexts[] = {
#include "compile/plugin_texts.inc"
};

void add_texts(PluginInfo& plugin) {
  for (const PluginText& line : kTexts) {
    if (line.kind != plugin.kind || line.plugin != plugin.name) continue;
    if (line.parameter.empty()) plugin.text = line.text;
    const auto parameter = std::ranges::find(plugin.parameters, line.parameter, &PluginParameter::name);
    if (parameter == plugin.parameters.end()) continue;
    parameter->unit = line.unit;
    parameter->text = line.text;
  }
}

/// `ask(compile, parameters, builder)` calls a plugin of the family. It is given nothing, so that it asks for everything;
/// its complaints about that are of no interest.
template <class Function, class Ask>
void add_family(const char* kind, std::span<const Plugin<Function>> table, const Ask& ask,
                std::vector<PluginInfo>& plugins) {
  for (const Plugin<Function>& plugin : table) {
    const Node node(kind, std::string(plugin.name));
    const Description description;
    const FileSystem files;
    Diagnostics unheard;
    Builder builder(description, files, unheard);
    PluginInfo info{kind, node.plugin, {}, {}, {}};
    Parameters p(node, description, files, unheard);
    p.record(info);
    ask(plugin.compile, p, builder);
    add_texts(info);
    plugins.push_back(std::move(info));
  }
}

}  // namespace

std::vector<PluginInfo> plugins() {
  std::vector<PluginInfo> all;
  const auto ask = [](auto* compile, Parameters& p, Builder& builder) { compile(p, builder); };
  add_family("integrator", integrator_plugins(), ask, all);
  FilmSettings film;
  film.width = film.full_width = film.height = film.full_height = 1;
  add_family(
      "sensor", sensor_plugins(),
      [&](auto* compile, Parameters& p, Builder& builder) {
        compile(p, builder, film);
        for (const char* kind : {"film", "sampler"}) p.children(kind);
      },
      all);
  add_family("film", film_plugins(), ask, all);
  add_family("rfilter", rfilter_plugins(), ask, all);
  add_family("sampler", sampler_plugins(), ask, all);
  add_family("bsdf", bsdf_plugins(), ask, all);
  add_family("texture", texture_plugins(), ask, all);
  add_family(
      "emitter", emitter_plugins(),
      [](auto* compile, Parameters& p, Builder& builder) {
        read_sampling_weight(p);
        compile(p, builder, kNone);
      },
      all);
  add_family(
      "shape", shape_plugins(),
      [](auto* compile, Parameters& p, Builder& builder) {
        const std::optional<ShapeGeometry> geometry = compile(p, builder);
        if (geometry && geometry->of_shapes) return;
        for (const char* kind : {"bsdf", "emitter"}) p.children(kind);
      },
      all);
  return all;
}

}  // namespace norrsken
