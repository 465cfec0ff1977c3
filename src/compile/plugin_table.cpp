#include "compile/plugin_table.h"

#include <map>

#include "base/text.h"

namespace norrsken {
namespace {

/// The plugins of Mitsuba 3 by kind, as its manual lists them: what a scene may rightly ask for.
const std::map<std::string_view, std::vector<std::string_view>>& mitsuba_plugins() {
  static const std::map<std::string_view, std::vector<std::string_view>> plugins = {
      {"bsdf", {"blendbsdf",    "bumpmap",        "circular", "conductor",      "dielectric",
                "diffuse",      "hair",           "mask",     "measured",       "measured_polarized",
                "normalmap",    "null",           "plastic",  "polarizer",      "pplastic",
                "principled",   "principledthin", "retarder", "roughconductor", "roughdielectric",
                "roughplastic", "thindielectric", "twosided"}},
      {"emitter",
       {"area", "constant", "directional", "directionalarea", "envmap", "point", "projector", "spot", "sunsky",
        "timed_sunsky", "volumelight"}},
      {"film", {"hdrfilm", "specfilm"}},
      {"integrator",
       {"aov", "depth", "direct", "direct_projective", "moment", "path", "prb", "prb_basic", "prb_projective",
        "prbvolpath", "ptracer", "stokes", "volpath", "volpathmis"}},
      {"medium", {"heterogeneous", "homogeneous"}},
      {"phase", {"blendphase", "hg", "isotropic", "rayleigh", "sggx", "tabphase"}},
      {"rfilter", {"box", "catmullrom", "gaussian", "lanczos", "mitchell", "tent"}},
      {"sampler", {"independent", "ldsampler", "multijitter", "orthogonal", "stratified"}},
      {"sensor", {"batch", "distant", "irradiancemeter", "orthographic", "perspective", "radiancemeter", "thinlens"}},
      {"shape",
       {"bsplinecurve", "cube", "cylinder", "disk", "ellipsoids", "ellipsoidsmesh", "instance", "linearcurve", "merge",
        "obj", "ply", "rectangle", "sdfgrid", "serialized", "shapegroup", "sphere"}},
      {"spectrum", {"blackbody", "d65", "irregular", "rawconstant", "regular", "srgb", "uniform"}},
      {"texture", {"bitmap", "checkerboard", "mesh_attribute", "rawconstant", "volume"}},
      {"volume", {"constvolume", "gridvolume"}},
  };
  return plugins;
}

}  // namespace

bool is_mitsuba_plugin(std::string_view kind, std::string_view name) {
  const auto found = mitsuba_plugins().find(kind);
  return found != mitsuba_plugins().end() && std::ranges::find(found->second, name) != found->second.end();
}

void complain_about_plugin(const Node& node, std::vector<std::string> accepted, Diagnostics& diagnostics) {
  std::ranges::sort(accepted);
  std::string message;
  if (is_mitsuba_plugin(node.kind, node.plugin)) {
    message = node.kind + " " + quoted(node.plugin) + " is not supported yet";
  } else {
    message = "unknown " + node.kind + " " + quoted(node.plugin) + did_you_mean(node.plugin, accepted);
  }
  diagnostics.error(node.plugin_location, std::move(message), join(accepted));
}

}  // namespace norrsken
