// What pbrt's directives change and blocks of attributes save.
#pragma once

#include <array>
#include <glm/mat4x4.hpp>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "formats/pbrt/lights.h"
#include "formats/pbrt/materials.h"

namespace norrsken::pbrt {

/// The current transforms: at the start and at the end of the shutter's time. What moves is shown at the start.
struct Transforms {
  glm::dmat4 start{1}, end{1};
};

struct GraphicsState {
  Transforms transforms;
  bool changes_start = true, changes_end = true;  ///< ActiveTransform
  bool reverse = false;
  const ColorSpace* space = &srgb_space();
  MaterialUse material;
  std::shared_ptr<const AreaLight> area_light;
  std::array<SharedParameters, 5> attributes;  ///< of Attribute, in the order of kAttributeTargets
};
inline constexpr std::string_view kAttributeTargets[] = {"shape", "light", "material", "medium", "texture"};

/// What stands before WorldBegin, each as it was when the file named it.
struct Settings {
  struct Object {
    std::string type;
    Parameters parameters;
    Transforms transforms;
  };
  std::map<std::string, Object> objects;  ///< by directive: "Camera", "Film", ...
  const ColorSpace* film_space = &srgb_space();
  std::int64_t seed = 0;
};

/// Camera, Film, PixelFilter, Sampler and Integrator become nodes of the scene.
void add_settings(Context& context, Settings& settings, Node& scene);
/// What the film multiplies all samples with: exposure time and sensitivity.
double imaging_ratio_of(Settings& settings);

/// The film's size as its camera has to know it.
struct FilmSize {
  int width = 1280, height = 720;
  double diagonal = 0.035;  ///< of what is exposed, m
  double aspect() const { return static_cast<double>(width) / height; }
};
/// Camera "type" ...: a sensor without its film.
Node make_camera(Context& context, const std::string& type, Parameters& p, const glm::dmat4& camera_from_world,
                 const FilmSize& film);

}  // namespace norrsken::pbrt
