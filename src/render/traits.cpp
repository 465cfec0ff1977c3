#include "render/traits.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/checksum.h"

namespace norrsken {
namespace {

/// The records hold words of 4 bytes and nothing in between, so their bytes are their values.
template <class Record>
constexpr bool kIsWords = alignof(Record) == 4 && sizeof(Record) % 4 == 0;
static_assert(kIsWords<SurfaceRecord> && kIsWords<ShapeRecord> && kIsWords<AnalyticRecord> &&
              kIsWords<InstanceRecord> && kIsWords<LightRecord> && kIsWords<CameraRecord> && kIsWords<MediumRecord> &&
              kIsWords<VolumeRecord>);

template <class... Arrays>
Trait fingerprint(const char* name, const Arrays&... arrays) {
  Fingerprint print;
  (print.add_all(arrays), ...);
  return {name, print.text(), true};
}

std::span<const std::uint32_t> words(const std::initializer_list<std::uint32_t>& list) {
  return {list.begin(), list.size()};
}

std::string describe(const IntegratorSettings& integrator) {
  // Every member: one more does not compile.
  const auto& [max_depth, rr_depth, emitter_samples, diffuse_bounces, bsdf_samples, distance, hide_emitters, media,
               from_lights] = integrator;
  return fmt::format("{} of depth {} with {} light and {} bsdf samples, roulette from {}{}{}",
                     distance      ? "distance"
                     : from_lights ? "paths from the lights"
                     : media       ? "paths through media"
                                   : "paths",
                     max_depth, emitter_samples, bsdf_samples, rr_depth, diffuse_bounces ? "" : ", mirrors only",
                     hide_emitters ? ", emitters hidden" : "");
}

std::string describe_size(const FilmSettings& film) {
  return fmt::format("{}x{} at ({}, {}) of {}x{}", film.width, film.height, film.crop_x, film.crop_y, film.full_width,
                     film.full_height);
}

/// What becomes of the sums in image files.
std::string describe_format(const FilmSettings& film) {
  constexpr const char* kNames[] = {"rgb", "rgba", "xyz", "xyza", "luminance", "luminance_alpha"};
  return fmt::format("{}{}{}", kNames[static_cast<std::uint32_t>(film.pixel_format)],
                     film.half_precision ? ", float16" : "", film.opaque ? ", opaque" : "");
}

std::string describe(const SceneLayers& layers) {
  std::string text;
  for (const FeatureLayer& layer : layers.features) text += fmt::format(" {}={}", layer.name, +layer.feature);
  for (const std::string& name : layers.image_copies) text += " " + name;
  for (const std::string& name : layers.moments) text += " m2_" + name;
  return text.empty() ? "none" : text.substr(1);
}

}  // namespace

Traits traits_of(const SceneTables& t, const SceneFrame& frame, const SceneView& view, const FilmSettings& film,
                 const SceneLayers& layers, const std::string& isa, const std::string& accelerator) {
  // What is computed from other members of the tables is left out.
  const FilterRecord& filter_record = film.filter;
  return {
      {"program", NORRSKEN_VERSION},
      {"instruction set", isa},
      {"accelerator", accelerator},
      {"size", describe_size(film)},
      {"sampler", frame.sampler.kind == SamplerKind::independent ? "independent" : "sobol"},
      {"seed", std::to_string(view.sampler.seed)},
      {"integrator", describe(view.integrator)},
      {"image format", describe_format(film)},
      {"layers", describe(layers)},
      fingerprint("reconstruction filter", frame.filter,
                  words({static_cast<std::uint32_t>(filter_record.kind), filter_record.nodes, filter_record.cells,
                         filter_record.edges, filter_record.signs, film.sample_border})),
      fingerprint("camera", std::span(&frame.camera, 1), frame.batch, frame.meter),
      fingerprint("shapes", t.positions, t.normals, t.texcoords, t.triangle_vertices, t.surfaces, t.shapes, t.analytics,
                  t.instances, words({t.group_count, t.first_analytic, t.needs_uv}), std::span(t.center),
                  std::span(&t.radius, 1)),
      fingerprint("materials", t.parameters, words({t.bsdf_kinds, t.texture_kinds})),
      fingerprint("textures", t.texels),
      fingerprint("media", t.media, t.volumes),
      fingerprint("lights", t.lights, words({t.environment})),
  };
}

std::string difference(const Traits& found, const Traits& expected) {
  std::string text;
  const auto add = [&](const std::string& part) { text += (text.empty() ? "" : "; ") + part; };
  for (const Trait& trait : expected) {
    const auto it = std::ranges::find(found, trait.name, &Trait::name);
    if (it != found.end() && *it == trait) continue;
    if (it == found.end() || it->is_fingerprint || trait.is_fingerprint) {
      add("other " + trait.name);
    } else {
      add(trait.name + " is " + it->value + ", not " + trait.value);
    }
  }
  if (text.empty() && found.size() != expected.size()) add("other settings");
  return text;
}

}  // namespace norrsken
