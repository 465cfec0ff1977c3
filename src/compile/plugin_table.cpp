#include "compile/plugin_table.h"

#include <algorithm>
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
      {"integrator", {"aov", "depth", "direct", "moment", "path", "ptracer", "stokes", "volpath", "volpathmis"}},
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

/// Those that Mitsuba 3 has for derivatives of images (its folder python/ad/integrators).
const std::map<std::string_view, std::vector<std::string_view>>& differentiable_plugins() {
  static const std::map<std::string_view, std::vector<std::string_view>> plugins = {
      {"integrator",
       {"direct_projective", "emission_reparam", "direct_reparam", "prb", "prb_basic", "prb_projective", "prb_reparam",
        "prbvolpath", "projective", "rb", "volprim_rf_basic"}},
  };
  return plugins;
}

/// Those of Mitsuba 0.x that have no counterpart, as its manual lists them.
const std::map<std::string_view, std::vector<std::string_view>>& older_plugins() {
  static const std::map<std::string_view, std::vector<std::string_view>> plugins = {
      {"bsdf",
       {"coating", "difftrans", "hk", "irawan", "mixturebsdf", "phong", "roughcoating", "roughdiffuse", "sssbrdf",
        "ward"}},
      {"emitter", {"collimated", "sky", "sun"}},
      {"integrator",
       {"adaptive", "ao", "field", "irrcache", "motion", "multichannel", "bdpt", "erpt", "mlt", "photonmapper", "ppm",
        "pssmlt", "sppm", "vpl"}},
      {"phase", {"kkay", "microflake", "mixturephase"}},
      {"sensor", {"fluencemeter", "perspective_rdist", "spherical", "telecentric"}},
      {"shape", {"deformable", "hair", "heightfield"}},
      {"texture", {"curvature", "gridtexture", "scale", "wireframe"}},
  };
  return plugins;
}

bool lists(const std::map<std::string_view, std::vector<std::string_view>>& plugins, std::string_view kind,
           std::string_view name) {
  const auto found = plugins.find(kind);
  return found != plugins.end() && std::ranges::find(found->second, name) != found->second.end();
}

}  // namespace

bool is_mitsuba_plugin(std::string_view kind, std::string_view name) { return lists(mitsuba_plugins(), kind, name); }

std::string complaint_about_plugin(const Node& node, const std::vector<std::string>& accepted) {
  const std::string name = node.kind + " " + quoted(node.plugin);
  if (lists(differentiable_plugins(), node.kind, node.plugin))
    return name + " is for differentiable rendering, which this program does not do";
  if (is_mitsuba_plugin(node.kind, node.plugin)) return name + " is not supported yet";
  if (lists(older_plugins(), node.kind, node.plugin)) return name + " of Mitsuba 0.6 is not supported";
  return "unknown " + name + did_you_mean(node.plugin, accepted);
}

void complain_about_plugin(const Node& node, std::vector<std::string> accepted, Diagnostics& diagnostics) {
  std::ranges::sort(accepted);
  std::string message = complaint_about_plugin(node, accepted);
  diagnostics.error(node.plugin_location, std::move(message), join(accepted));
}

}  // namespace norrsken
