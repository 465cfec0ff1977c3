// aov: layers that describe the first surface that is seen, beside the image of another integrator.
//
// Types
//   albedo        .R .G .B: diffuse reflectance
//   depth         .T: distance from the camera, scene units
//   position      .X .Y .Z: scene units
//   uv            .U .V: texture coordinates
//   geo_normal    .X .Y .Z: of the surface, on the side that the shape has it on
//   sh_normal     .X .Y .Z: of shading, the same
//   dp_du, dp_dv  .X .Y .Z: how the position moves with u and v
//   prim_index    .I: of the triangle within its mesh, counted from 0
//   shape_index   .I: of the shape within the scene, counted from 1
// Children: integrator (at most one; Mitsuba takes several). Its image is the image; if it has a name, it is a layer of
// that name too. Without one the image is black.
// Departures: prim_index and shape_index are those of a pixel's first sample, not a mean. duv_dx, duv_dy and
// boundary_test are not supported yet.
#include <fmt/core.h>

#include <algorithm>
#include <span>
#include <string>
#include <vector>

#include "base/text.h"
#include "integrator/integrator_host.h"

namespace norrsken {
namespace {

constexpr TextParameter kAovs{.name = "aovs",
                              .text =
                                  "pairs NAME:TYPE, separated by commas; the layer NAME gets the channels of its type. "
                                  "All are 0 where nothing is "
                                  "seen",
                              .example = R"(<string name="aovs" value="NAME:TYPE,..."/>)"};

struct AovType {
  const char* name;
  const char* channels;  ///< a letter each
  Feature first;
};

constexpr AovType kTypes[] = {{"albedo", "RGB", kFeatureAlbedoRed},      {"depth", "T", kFeatureDistance},
                              {"position", "XYZ", kFeaturePositionX},    {"uv", "UV", kFeatureU},
                              {"geo_normal", "XYZ", kFeatureGeometricX}, {"sh_normal", "XYZ", kFeatureShadingX},
                              {"dp_du", "XYZ", kFeatureDpDuX},           {"dp_dv", "XYZ", kFeatureDpDvX},
                              {"prim_index", "I", kFeaturePrimitive},    {"shape_index", "I", kFeatureObject}};

void add_aov(Parameters& p, std::string_view pair, std::vector<FeatureLayer>& layers) {
  const std::size_t colon = pair.find(':');
  const std::string_view name = trim(pair.substr(0, colon));
  const std::string type(colon == std::string_view::npos ? std::string_view() : trim(pair.substr(colon + 1)));
  if (name.empty() || type.empty()) {
    p.error(kAovs.name, fmt::format("'aovs' has {} in it", quoted(pair)),
            "pairs such as position:position, normal:sh_normal");
    return;
  }
  std::vector<std::string> known;
  for (const AovType& t : kTypes) known.emplace_back(t.name);
  const auto found = std::ranges::find(known, type);
  if (found == known.end()) {
    const bool to_come = type == "duv_dx" || type == "duv_dy" || type == "boundary_test";
    p.error(kAovs.name,
            to_come ? fmt::format("aov {} is not supported yet", quoted(type))
                    : fmt::format("unknown aov {}{}", quoted(type), did_you_mean(type, known)),
            join(known));
    return;
  }
  const AovType& t = kTypes[found - known.begin()];
  for (std::uint32_t i = 0; t.channels[i] != 0; ++i) {
    std::string channel = fmt::format("{}.{}", name, t.channels[i]);
    if (std::ranges::find(layers, channel, &FeatureLayer::name) != layers.end()) {
      p.error(kAovs.name, fmt::format("'aovs' has two layers {}", quoted(channel)), "a name of its own for each");
      return;
    }
    layers.push_back({std::move(channel), static_cast<Feature>(t.first + i)});
  }
}

}  // namespace

IntegratorSettings compile_integrator_aov(Parameters& p, Integrators& integrators) {
  NestedIntegrator nested = read_nested_integrator(p, integrators);
  if (nested.plugin.empty()) nested.settings.max_depth = 0;
  if (nested.has_name) integrators.layers().image_copies.push_back(nested.name);

  const std::string aovs = p.read(kAovs);
  std::string_view rest = aovs;
  if (p.has(kAovs.name) && trim(rest).empty())
    p.error(kAovs.name, "integrator 'aov' names no layers", std::string(kAovs.example));
  while (!trim(rest).empty()) {
    const std::size_t comma = std::min(rest.find(','), rest.size());
    add_aov(p, trim(rest.substr(0, comma)), integrators.layers().features);
    rest.remove_prefix(std::min(comma + 1, rest.size()));
  }
  return nested.settings;
}

}  // namespace norrsken
