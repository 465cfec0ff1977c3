// pbrt's lights, as nodes of a description.
#pragma once

#include <glm/mat4x4.hpp>
#include <memory>
#include <string>
#include <vector>

#include "formats/pbrt/image_file.h"
#include "formats/pbrt/pattern.h"
#include "formats/pbrt/shapes.h"

namespace norrsken::pbrt {

/// All that shines from around the scene: pbrt takes any number of lights there, which are added up.
struct Environment {
  struct Map {
    std::shared_ptr<const ImageFile> file;
    glm::dvec3 (*look_up)(const ImageFile& file, const glm::dvec3& direction);  ///< in the light's space
    glm::dmat3 light_from_world;
    glm::dvec3 scale;
  };
  glm::dvec3 radiance{0};  ///< from all directions
  std::vector<Map> maps;
  Place place;  ///< of the last of them; nowhere if there is none
};

/// LightSource "type" ...: adds what it is to the scene, or to its environment.
void add_light(Context& context, ImageFiles& images, const std::string& type, Parameters& p, const ColorSpace& space,
               const glm::dmat4& to_world, Node& scene, Environment& environment);

/// LightSource "infinite" ...
void add_infinite_light(Context& context, ImageFiles& images, Parameters& p, const ColorSpace& space,
                        const glm::dmat4& to_world, Environment& environment);
/// Makes an emitter of all of them.
void add_environment(Context& context, const Environment& environment, Node& scene);

/// What AreaLightSource says of the shapes that follow.
struct AreaLight {
  bool two_sided = false;
  double scale = 1;   ///< with the film's exposure
  double power = -1;  ///< of each primitive; not above 0: not given
  glm::dvec3 radiance{1};
  std::shared_ptr<const ImageFile> image = {};  ///< in place of the radiance
  double image_luminance = 1;                   ///< its mean
  Place place;
};
/// Empty after a complaint.
std::optional<AreaLight> read_area_light(Context& context, ImageFiles& images, const std::string& type, Parameters& p,
                                         const ColorSpace& space);
/// Makes a shape shine.
void add_area_light(Context& context, const AreaLight& light, Geometry& geometry);

/// The emission `name` of a light, 1 by default, before its scale.
glm::dvec3 read_emission(Context& context, Parameters& p, std::string_view name, const ColorSpace& space);
double luminance_of(const glm::dvec3& color);

/// Clarberg's map between the square and the sphere, "Fast Equal-Area Mapping of the (Hemi)Sphere using SIMD", 2008.
glm::dvec2 square_of_direction(const glm::dvec3& direction);
glm::dvec3 direction_of_square(const glm::dvec2& square);

/// The texel of an equal-area image in a direction.
glm::dvec3 equal_area_texel(const ImageFile& file, const glm::dvec3& direction);

}  // namespace norrsken::pbrt
