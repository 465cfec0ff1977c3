// From the description to the tables: the common part of each kind, and what the families' tools (plugin_tools.h) are
// views of.
#pragma once

#include <algorithm>
#include <functional>
#include <glm/vec3.hpp>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <tuple>
#include <vector>

#include "base/memory.h"
#include "compile/compile.h"
#include "compile/frame_tools.h"
#include "compile/geometry_builder.h"
#include "compile/images.h"
#include "compile/light_choice.h"
#include "compile/media.h"
#include "compile/mesh_attributes.h"
#include "compile/plugin_table.h"
#include "compile/scene_children.h"
#include "compile/shapes.h"
#include "compile/texture.h"
#include "scene/parameters.h"

namespace norrsken {

/// Bounds on what a scene may ask for.
inline constexpr std::uint64_t kMaxFilmPixels = std::uint64_t{1} << 28;

class Builder {
 public:
  Builder(const Description& description, const FileSystem& files, Diagnostics& diagnostics)
      : description_(with_sensors_of_shapes(description)), files_(files), diagnostics_(diagnostics) {}

  /// Compiles the whole scene; look at the diagnostics before using what comes out.
  LoadedScene build(const LoadOptions& options);
  /// The frame alone, of a description that need have no more than sensors and integrators.
  /// `media`: those of the scene, where its sensors may stand.
  SceneFrame build_frame(const ViewOptions& view, const std::map<const Node*, std::uint32_t>& media);

  // --- for the families' tools (plugin_tools.h) ----------------------------------------------------------------------
  const FileSystem& files() const { return files_; }
  Diagnostics& diagnostics() const { return diagnostics_; }
  /// Triangles come first in `surfaces`; spheres are added behind them when all shapes are known.
  SceneTables& tables() { return scene_.tables; }

  /// The material of a `bsdf` node; a node that several shapes refer to is compiled once.
  Material bsdf(const Node& node);
  ColorOrTexture read(Parameters& p, const ColorParameter& color);
  NumberOrTexture read(Parameters& p, const NumberParameter& number);
  /// The texture of a `texture` node; one that several parameters refer to is compiled once.
  Texture texture(const Node& node);
  /// The texture of parameter `name` if its values are in range; else a warning, and one whose values are clamped. What was
  /// written by hand is an error there.
  Texture within_range(Parameters& p, std::string_view name, const Texture& texture, const Range& range);
  /// Stores a texture's parameters and returns the word that leads to them.
  TextureWord add_texture(TextureKind kind, std::span<const float> block);
  ImageStore& images() { return images_; }
  MeshAttributes& attributes() { return attributes_; }
  /// Stores floats among the scene's parameters and returns their offset.
  std::uint32_t add_parameters(std::span<const float> values);
  /// Stores a model's parameters and returns the word that leads to them.
  MaterialWord add_material(BsdfKind kind, std::span<const float> block);
  /// Says that models look at texture coordinates or tangents, which surface points then have.
  void need_uv() {
    tables().needs_uv = true;
    vary(Variation::over_uv);
  }
  /// `light.prob` and the alias fields are filled in later. Returns the record's index.
  std::uint32_t add_light(const LightRecord& light, const LightPower& power);
  /// A light that surrounds the scene, of which there may be one.
  void add_environment(const Node& node, const LightRecord& light, const LightPower& power);
  /// The group of shapes that a `shapegroup` node is; one that several instances refer to is compiled once.
  std::uint32_t shape_group(const Node& node);
  GeometryBuilder& geometry() { return geometry_; }
  /// The medium of a `medium` node, its phase function, and a volume; each is compiled once. kNone after a complaint.
  std::uint32_t medium(const Node& node);
  PhaseWord phase(const Node& node);
  Volume volume(const Node& node);
  /// The settings of an integrator inside another one.
  IntegratorSettings integrator(const Node& node);
  /// What the integrator does about lights. Tables that depend on it serve no other integrator: the rest of the scene
  /// should not ask.
  bool paths_begin_at_lights() { return *(scene_.asked.from_lights = tables().integrator.from_lights); }
  bool paths_find_lights() { return *(scene_.asked.finds_lights = tables().integrator.finds_lights()); }
  /// What is asked for besides the image.
  SceneLayers& layers() { return scene_.layers; }
  /// The filter of a film node; Mitsuba's, gaussian, if it names none.
  FilterRecord rfilter(Parameters& film);
  /// The surface of a shape of which a sensor measures; empty after a complaint, which `is_heard` or not.
  std::optional<ShapeGeometry> surface(const Node& shape, bool is_heard);
  /// The camera of a sensor inside another one, for a part of its film.
  CameraRecord sensor_inside(const Node& sensor, const FilmSettings& film);
  /// A line for `norrsken info`.
  void describe(const Node& node, std::string detail);

 private:
  Parameters parameters(const Node& node) { return {node, description_, files_, diagnostics_}; }
  /// Complains about textures and volumes by name; for nodes whose children's names mean nothing yet.
  void refuse_kinds_to_come(Parameters& parameters);
  /// The texture of that name, if it has one, within its range.
  std::optional<Texture> texture_of(Parameters& p, std::string_view name, const Range& range);
  /// Integrator and sensor; `reserve`: see measure_film.
  void compile_frame(Parameters& scene, const std::set<const Node*>& inside, const ViewOptions& view, bool reserve);
  void compile_sensor(Parameters& scene, const ViewOptions& view, bool reserve);
  /// The sensor that is chosen, with what `view` says otherwise of it; null if there is none, or after a complaint.
  std::shared_ptr<const Node> sensor_node(Parameters& scene, const ViewOptions& view);
  void compile_sampler(Parameters& sensor, const ViewOptions& view);
  void compile_camera(Parameters& sensor, CompileSensor* compile);
  /// That of a scene without a sensor, once its bounds are known.
  void compile_default_camera();
  /// `place`: where the film's size comes from.
  FilmSettings film(Parameters& sensor, const ViewOptions& view, SourceLocation& place);
  /// How much memory film and image take; `reserve`: which stays free for them while the scene is loaded.
  void measure_film(const SourceLocation& place, bool reserve);
  void compile_shape(const Node& node);
  void compile_shape(Parameters& p, CompileShape* compile);
  Material material_of(Parameters& shape);
  /// A warning if the textures of a shape without texture coordinates look them up.
  void want_texcoords(const Node& shape);
  /// A texture below a node that looks up texture coordinates, or null.
  const Node* texture_by_uv(const Node& node);
  void compile_emitter(const Node& node, std::uint32_t shape);
  /// Reads what lies on either side of a shape.
  void compile_media_of(Parameters& shape, ShapeRecord& record);
  /// The one that an emitter or a sensor stands in, or kNone.
  std::uint32_t medium_around(Parameters& p);
  void choose_lights();
  /// Remembers the shape that was added last, if the camera cannot see that far.
  void remember_if_beyond_view(const Node& node);
  void tell_what_is_beyond_view();
  void summarise();
  /// What is being compiled varies so, at least.
  void vary(Variation variation) { variation_ = std::max(variation_, variation); }

  /// What stands in the place of a node of the scene: another plugin, which takes its parameters, or another node.
  struct Replacement {
    const std::optional<std::string>& plugin;
    const std::optional<Node>& node;
  };
  template <class Function, class... Tools>
  auto compile_node(const Node& node, std::span<const Plugin<Function>> table, bool tolerates, Tools&&... tools);
  template <class Function, class... Tools>
  auto compile_chosen(const Node::Child* child, const char* kind, const char* fallback, const Replacement& replacement,
                      std::span<const Plugin<Function>> table, std::string& plugin_name, Tools&&... tools);

  const Description description_;
  const FileSystem& files_;
  Diagnostics& diagnostics_;
  LoadedScene scene_;
  MemoryReservation film_memory_;
  GeometryBuilder geometry_{scene_.tables, diagnostics_};
  std::map<const Node*, std::uint32_t> groups_;
  ImageStore images_{files_, diagnostics_, scene_.tables};
  MeshAttributes attributes_{scene_.tables};
  std::map<const Node*, Material> materials_;
  std::map<const Node*, Texture> textures_;
  std::map<const Node*, PhaseWord> phases_;
  std::map<const Node*, Volume> volumes_;
  int phase_depth_ = 0;
  std::map<std::tuple<TextureWord, double, double>, Texture> clamped_textures_;
  std::map<const Node*, const Node*> textures_by_uv_;
  std::optional<Material> default_material_;
  bool is_frame_alone_ = false;
  bool is_silent_ = false;              ///< nothing is described
  std::shared_ptr<const Node> sensor_;  ///< that is used
  std::optional<Node> default_sensor_;  ///< of a scene that has none
  bool is_whole_ = true;  ///< whether the scene was read without errors: what is missing is not in the file
  Variation variation_ = Variation::none;  ///< of what is being compiled
  int bsdf_depth_ = 0;
  int texture_depth_ = 0;
  int integrator_depth_ = 0;
  double sampling_weight_ = 1;  ///< of the emitter that is being compiled
  std::vector<const Node*> beyond_view_;
  double farthest_ = 0;  ///< depth of what is beyond the camera's view
  SourceLocation view_place_;
  Array<LightPower> light_powers_;
};

}  // namespace norrsken
