// Materials beside OBJ files.
#pragma once

#include <array>
#include <map>
#include <string>
#include <string_view>

#include "norrsken/diagnostics.h"

namespace norrsken {

struct MtlMaterial {
  std::array<double, 3> diffuse{0.8, 0.8, 0.8}, specular{0, 0, 0}, emission{0, 0, 0};
  double exponent = 0;    ///< Ns, Phong's
  double index = 1.5;     ///< Ni
  double opacity = 1;     ///< d
  double roughness = -1;  ///< Pr; below 0: not given
  double metallic = 0;    ///< Pm
  std::string diffuse_map = {}, opacity_map = {}, emission_map = {};
  SourceLocation diffuse_map_place = {}, opacity_map_place = {}, emission_map_place = {};
};

/// By name, from MTL (Wavefront, "Material Library File (.mtl)", and the additions Pr and Pm of Exocortex). What is not
/// known is skipped, as programs add much; a number that is none is an error.
std::map<std::string, MtlMaterial> read_mtl(std::string_view bytes, const std::string& path, Diagnostics& diagnostics);

}  // namespace norrsken
