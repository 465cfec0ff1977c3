#include "light/light_host.h"

#include <fmt/core.h>

#include <glm/matrix.hpp>

namespace norrsken {
namespace {

constexpr NumberParameter kSamplingWeight{
    .name = "sampling_weight",
    .fallback = 1,
    .range = {0, 1e12},
    .text =
        "factor on how often the emitter is chosen when light is sampled. With 0 it never is: surfaces and "
        "environments "
        "are then found by rays alone, and what no ray finds is lost, with a warning. Not all may be 0"};

}  // namespace

double read_sampling_weight(Parameters& emitter) { return emitter.read(kSamplingWeight); }

void set_values(float (&out)[3], const glm::dvec3& v) {
  for (int i = 0; i < 3; ++i) out[i] = static_cast<float>(v[i]);
}

void set_axes(LightRecord& light, const glm::dmat3& local_from_world) {
  const glm::dmat3 rows = glm::transpose(local_from_world);
  set_values(light.edge1, rows[0]);
  set_values(light.edge2, rows[1]);
  set_values(light.normal, rows[2]);
}

void refuse_shape(Parameters& p, std::uint32_t shape, const char* reason) {
  if (shape == kNone) return;
  p.diagnostics().error(p.node().plugin_location,
                        fmt::format("emitter '{}' {} and cannot belong to a shape", p.node().plugin, reason), "area");
}

std::optional<Texture> slide_texture(Parameters& p, Lights& lights, std::string_view name, const Node::Child* child) {
  if (!child) return std::nullopt;
  const Texture texture = lights.texture(*child->node);
  if (texture_kind(texture.word) == TextureKind::mesh_attribute) {
    p.error(name, fmt::format("'{}' is an attribute of meshes", name), "a texture that needs no mesh, such as bitmap");
    return Texture{};
  }
  return lights.within_range(p, name, texture, kFromZero);
}

}  // namespace norrsken
