// Every family's tools lead to the Builder.
#include "compile/plugin_tools.h"

#include <utility>

#include "compile/builder.h"
#include "compile/frame_tools.h"
#include "compile/lights.h"
#include "compile/materials.h"
#include "compile/media.h"
#include "compile/shapes.h"
#include "compile/textures.h"

namespace norrsken {

void PluginTools::describe(const Node& node, std::string detail) { builder_.describe(node, std::move(detail)); }

ColorOrTexture TexturedTools::read(Parameters& p, const ColorParameter& color) { return builder_.read(p, color); }
NumberOrTexture TexturedTools::read(Parameters& p, const NumberParameter& number) { return builder_.read(p, number); }
Texture TexturedTools::texture(const Node& node) { return builder_.texture(node); }
Texture TexturedTools::within_range(Parameters& p, std::string_view name, const Texture& texture, const Range& range) {
  return builder_.within_range(p, name, texture, range);
}

MaterialWord Materials::add(BsdfKind kind, std::span<const float> block) { return builder_.add_material(kind, block); }
Material Materials::inside(const Node& node) { return builder_.bsdf(node); }
void Materials::need_uv() { builder_.need_uv(); }
bool Materials::paths_begin_at_lights() const { return builder_.tables().integrator.from_lights; }

TextureWord Textures::add(TextureKind kind, std::span<const float> block) { return builder_.add_texture(kind, block); }
ImageStore& Textures::images() { return builder_.images(); }
void Textures::look_up_attribute(const std::string& name, TextureWord texture, std::uint32_t floats_before) {
  builder_.attributes().look_up(name, (texture & kTextureOffsetMask) + floats_before);
}

const FileSystem& Media::files() const { return builder_.files(); }
SceneTables& Media::tables() { return builder_.tables(); }
PhaseWord Media::add(PhaseKind kind, std::span<const float> block) {
  builder_.tables().phase_kinds |= 1u << static_cast<std::uint32_t>(kind);
  return make_phase(kind, builder_.add_parameters(block));
}
PhaseWord Media::phase(const Node& node) { return builder_.phase(node); }
Volume Media::volume(const Node& node) { return builder_.volume(node); }

std::uint32_t Lights::store(std::span<const float> block) { return builder_.add_parameters(block); }
std::uint32_t Lights::add(const LightRecord& light, const LightPower& power) {
  return builder_.add_light(light, power);
}
void Lights::add_environment(const Node& node, const LightRecord& light, const LightPower& power) {
  builder_.add_environment(node, light, power);
}
ImageStore& Lights::images() { return builder_.images(); }
Array<float>& Lights::texels() { return builder_.tables().texels; }
std::span<SurfaceRecord> Lights::surfaces_of(std::uint32_t shape) { return builder_.geometry().surfaces_of(shape); }
bool Lights::is_sphere(std::uint32_t shape) const { return builder_.geometry().is_sphere(shape); }
bool Lights::is_analytic(std::uint32_t shape) const { return builder_.geometry().is_analytic(shape); }
void Lights::set_light(std::uint32_t shape, std::uint32_t primitive, std::uint32_t light) {
  builder_.geometry().set_light(shape, primitive, light);
}
const SceneTables& Lights::tables() const { return builder_.tables(); }
bool Lights::paths_begin_at_lights() { return builder_.paths_begin_at_lights(); }
bool Lights::paths_find_lights() { return builder_.paths_find_lights(); }

const FileSystem& Shapes::files() const { return builder_.files(); }
std::uint32_t Shapes::store_rotation(std::span<const float, 9> rows) { return builder_.add_parameters(rows); }
std::size_t Shapes::texel_count() const { return builder_.tables().texels.size(); }
bool Shapes::in_group() const { return builder_.geometry().in_group(); }
std::uint32_t Shapes::group(const Node& node) { return builder_.shape_group(node); }
bool Shapes::add_instance(std::uint32_t group, const glm::dmat4& world_from_object) {
  return builder_.geometry().add_instance(group, world_from_object);
}

std::optional<ShapeGeometry> Sensors::surface(const Node& shape, IsInScene is_in_scene) {
  return builder_.surface(shape, /*is_heard=*/is_in_scene == IsInScene::no);
}
Array<float>& Sensors::meter() { return builder_.tables().meter; }
CameraRecord Sensors::inside(const Node& sensor, const FilmSettings& film) {
  return builder_.sensor_inside(sensor, film);
}
void Sensors::join(const CameraRecord& camera) { builder_.tables().batch.push_back(camera); }
FilterRecord Films::rfilter(Parameters& film) { return builder_.rfilter(film); }
SceneLayers& Integrators::layers() { return builder_.layers(); }
IntegratorSettings Integrators::inside(const Node& node) { return builder_.integrator(node); }

}  // namespace norrsken
