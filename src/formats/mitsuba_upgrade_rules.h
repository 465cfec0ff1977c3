// What has another name since Mitsuba 0.x, or none, as tables. Names of parameters are those after camelCase has become
// snake_case; lists of names are apart by blanks, and "*" is any.
// Sources: Mitsuba 0.6's manual, and the changes that its scene upgrades of 0.3, 0.4 and 0.5 (data/schema) and Mitsuba
// 3's own (src/core/parser.cpp) make.
#pragma once

#include <string_view>

namespace norrsken::upgrade {

/// Versions of a rule: it holds for scenes before 0.`before`.
inline constexpr int kAllOld = 1000;

struct ElementRule {
  int before;
  std::string_view from, to;
};
inline constexpr ElementRule kElements[] = {
    {4, "camera", "sensor"},
    {4, "luminaire", "emitter"},
    {kAllOld, "lookAt", "lookat"},
};

struct ParameterRule {
  int before;
  std::string_view kind, plugins, from, to;
};
/// In this order: the cylinder's p1 is free before p2 becomes p1.
inline constexpr ParameterRule kParameters[] = {
    {3, "shape", "sphere", "inverted", "flip_normals"},
    {3, "shape", "cylinder", "p1", "p0"},
    {3, "shape", "cylinder", "p2", "p1"},
    {3, "texture", "checkerboard", "bright_color", "color0"},
    {3, "texture", "checkerboard", "dark_color", "color1"},
    {3, "texture", "gridtexture", "bright_color", "color0"},
    {3, "texture", "gridtexture", "dark_color", "color1"},
    {3, "bsdf", "microfacet roughmetal roughglass", "alpha_b", "alpha"},
    {3, "bsdf", "ward", "alpha_x", "alpha_u"},
    {3, "bsdf", "ward", "alpha_y", "alpha_v"},
    {3, "medium", "*", "size_multiplier", "density_multiplier"},
    {3, "bsdf", "roughmetal", "ior", "eta"},
    {4, "emitter", "area constant", "intensity", "radiance"},
    {4, "emitter", "directional", "intensity", "irradiance"},
    {4, "emitter", "*", "intensity_scale", "scale"},
    {4, "integrator", "*", "luminaire_samples", "emitter_samples"},
    {4, "sampler", "*", "depth", "dimension"},
    {4, "sensor", "*", "focus_depth", "focus_distance"},
    {kAllOld, "bsdf", "diffuse lambertian", "diffuse_reflectance", "reflectance"},
};

struct LeftOutRule {
  std::string_view kind, plugins, names, why;
};
inline constexpr LeftOutRule kLeftOut[] = {
    {"bsdf", "*", "specular_sampling_weight", "it changes noise alone"},
    {"emitter", "envmap", "cache", "nothing is cached"},
    {"emitter", "envmap", "gamma", "the image's own format decides it"},
    {"film", "*", "attach_log", "no log is written into images"},
    {"film", "*", "channel_names", "the integrator names the layers"},
    {"film", "ldrfilm pngfilm mfilm", "file_format", "the name of the output decides it"},
    {"film", "*", "tonemap_method gamma exposure key burn", "tone mapping is chosen when the image is written"},
    {"film", "mfilm", "digits variable", "they are of another file format"},
    {"integrator", "*", "strict_normals", "paths are not judged by it"},
    {"integrator", "ptracer", "granularity brute_force", "it changes speed alone"},
    {"sampler", "*", "dimension scramble", "the sampler knows by itself"},
    {"shape", "obj", "collapse load_materials", "an OBJ file is one shape, without materials of its own"},
    {"shape", "obj ply serialized", "max_smooth_angle",
     "edges are smooth at any angle, or not at all by 'face_normals'"},
    {"shape", "ply", "srgb", "colours of vertices are linear"},
    {"texture", "bitmap", "cache max_anisotropy", "texels are looked up without mipmaps"},
};

struct PluginRule {
  int before;
  std::string_view kind, from, to;
  std::string_view keeps = "*";  ///< the parameters that mean the same to both
  std::string_view why = {};     ///< why the image is not quite the one that was asked for, which is worth a warning
};
inline constexpr PluginRule kPlugins[] = {
    {3, "bsdf", "composite", "mixturebsdf"},
    {3, "bsdf", "lambertian", "diffuse"},
    {3, "bsdf", "microfacet", "roughplastic"},
    {3, "bsdf", "roughglass", "roughdielectric"},
    {3, "bsdf", "roughmetal", "roughconductor"},
    {3, "texture", "exrtexture ldrtexture", "bitmap"},
    {4, "film", "exrfilm", "hdrfilm"},
    {4, "film", "pngfilm", "ldrfilm"},
    {4, "integrator", "errctrl", "adaptive"},
    {5, "bsdf", "bump", "bumpmap"},
    {kAllOld, "film", "ldrfilm tiledhdrfilm mfilm", "hdrfilm"},
    {kAllOld, "integrator", "bdpt erpt mlt photonmapper ppm pssmlt sppm vpl", "path",
     "max_depth rr_depth hide_emitters", "which finds the same light in another way"},
    {kAllOld, "integrator", "volpath_simple", "volpath"},
    {kAllOld, "sampler", "halton hammersley", "sobol"},
};

/// What the integrator `field` of Mitsuba 0.6 shows, as a layer of `aov`.
struct FieldRule {
  std::string_view from, to;
};
inline constexpr FieldRule kFields[] = {
    {"albedo", "albedo"},        {"distance", "depth"},     {"geoNormal", "geo_normal"},   {"position", "position"},
    {"primIndex", "prim_index"}, {"shNormal", "sh_normal"}, {"shapeIndex", "shape_index"}, {"uv", "uv"},
};

}  // namespace norrsken::upgrade
