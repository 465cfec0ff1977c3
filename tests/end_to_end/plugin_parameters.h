// The table of plugin_parameters_test.cpp: what every plugin takes.
#pragma once

#include <vector>

namespace norrsken::testing {

/// A parameter: its type, a value that is right, one that is not ("" if there is none) and what is accepted instead.
struct Row {
  const char* name;
  const char* type;
  const char* right;
  const char* wrong = "";
  const char* accepted = "";
};

struct Plugin {
  const char* kind;
  const char* name;
  const char* needed;  ///< what stands in it in any case, as elements
  std::vector<Row> rows;
  std::vector<const char*> required = {};  ///< parameters among the rows that `needed` has too
};

inline constexpr const char* kShare = "a number from 0 to 1";
inline constexpr const char* kComponents = "components from 0 to 1";
inline constexpr const char* kLight = "components of at least 0";
inline const Row kToWorld{"to_world", "transform", R"(<rotate z="1" angle="90"/>)", R"(<scale value="0"/>)",
                          "scale factors other than 0"};
/// Of what may be flattened.
inline const Row kToAnywhere{"to_world", "transform", R"(<rotate z="1" angle="90"/>)", R"(<translate x="1e13"/>)",
                             "elements up to 1e+12"};
inline const Row kToUv{"to_uv", "transform", R"(<scale value="2"/>)"};
inline const Row kFlip{"flip_normals", "boolean", "true"};
inline const Row kFaceNormals{"face_normals", "boolean", "true"};
inline const Row kSampleVisible{"sample_visible", "boolean", "false"};
inline const Row kDistribution{"distribution", "string", "ggx", "phong", "beckmann, ggx"};
inline const Row kAlpha{"alpha", "float", "0.2", "-1", "a number from 0 to 100"};
inline const Row kMaxDepth{"max_depth", "integer", "4", "-2", "an integer from -1 to 2147483647"};
inline const Row kBounces{"bounces", "integer", "4", "-1", "an integer from 0 to 2147483646"};
inline const Row kRouletteDepth{"rr_depth", "integer", "2", "0", "an integer from 1 to 2147483647"};
inline const Row kEmitterSamples{"emitter_samples", "integer", "2", "0", "an integer from 1 to 100000"};
inline const Row kWeight{"sampling_weight", "float", "2", "-1", "a number of at least 0"};
inline const Row kHide{"hide_emitters", "boolean", "true"};
inline const Row kSampleCount{"sample_count", "integer", "16", "0", "an integer from 1 to 2147483647"};
inline const Row kSeed{"seed", "integer", "3", "-1", "an integer of at least 0"};
inline const Row kJitter{"jitter", "boolean", "false"};
inline const Row kNear{"near_clip", "float", "0.1", "0", "a number above 0"};
inline const Row kFar{"far_clip", "float", "100", "0.005", "a near_clip smaller than the far_clip"};
inline const Row kFov{"fov", "float", "30", "180", "a number above 0 and below 180"};
inline const Row kFovAxis{"fov_axis", "string", "smaller", "z", "x, y, diagonal, smaller, larger"};
inline const Row kFocalLength{"focal_length", "string", "35mm", "wide",
                              "a length from 0.001mm to 1000000mm, such as 50mm"};
inline const Row kIndex{"int_ior", "float", "1.3", "0", "a number above 0 and at most 100"};
inline const Row kIndexOutside{"ext_ior", "float", "1.2", "-1", "a number above 0 and at most 100"};

inline Row color(const char* name) { return {name, "rgb", "0.1, 0.2, 0.3", "0.5, 2, 0", kComponents}; }
inline Row light(const char* name) { return {name, "rgb", "1, 2, 3", "1, -2, 3", kLight}; }
/// Beyond 0 and 1 it is clamped.
inline Row share(const char* name) { return {name, "float", "0.25"}; }
inline Row rate(const char* name) { return {name, "float", "2", "-1", "a number from 0 to 1e+06"}; }
inline Row file(const char* asset) { return {"filename", "string", asset, "missing.file"}; }

inline std::vector<Row> join(std::vector<Row> a, const std::vector<Row>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

inline const std::vector<Row> kInterface{kIndex, kIndexOutside, color("specular_reflectance"),
                                         color("specular_transmittance")};
inline const std::vector<Row> kRough{kDistribution,
                                     kSampleVisible,
                                     kAlpha,
                                     {"alpha_u", "float", "0.2", "-1", "a number from 0 to 100"},
                                     {"alpha_v", "float", "0.2", "-1", "a number from 0 to 100"}};
inline const std::vector<Row> kMetal{{"material", "string", "Au", "Xy"},
                                     {"eta", "float", "0.2", "-1", "components from 0 to 10000"},
                                     {"k", "float", "3", "-1", "components from 0 to 10000"},
                                     color("specular_reflectance")};
inline const std::vector<Row> kCoat{kIndex,
                                    kIndexOutside,
                                    color("specular_reflectance"),
                                    color("diffuse_reflectance"),
                                    {"nonlinear", "boolean", "true"}};
inline const std::vector<Row> kDisney{
    color("base_color"), share("roughness"), share("anisotropic"),
    share("spec_trans"), share("spec_tint"), share("sheen"),
    share("sheen_tint"), share("flatness"),  rate("diffuse_reflectance_sampling_rate")};
inline const std::vector<Row> kRelief{{"flip_invalid_normals", "boolean", "false"},
                                      {"use_shadowing_function", "boolean", "false"}};
inline const std::vector<Row> kMesh{kToAnywhere, kFlip, kFaceNormals};
inline const std::vector<Row> kPath{kMaxDepth, kBounces, kRouletteDepth, kEmitterSamples, kHide};
inline const std::vector<Row> kView{kToWorld, kNear, kFar};
inline const std::vector<Row> kAngles{kFov, kFovAxis, kFocalLength};
inline const std::vector<Row> kPoints{kSampleCount, kSeed};

#define NORRSKEN_DIFFUSE "<bsdf type=\"diffuse\"/>"
#define NORRSKEN_RELIEF "<texture type=\"bitmap\"><string name=\"filename\" value=\"relief.png\"/></texture>"

inline const Plugin kPlugins[] = {
    {"bsdf", "diffuse", "", {color("reflectance")}},
    {"bsdf", "conductor", "", kMetal},
    {"bsdf", "roughconductor", "", join(kMetal, kRough)},
    {"bsdf", "dielectric", "", kInterface},
    {"bsdf", "thindielectric", "", kInterface},
    {"bsdf", "roughdielectric", "", join(kInterface, kRough)},
    {"bsdf", "null", "", {}},
    {"bsdf", "plastic", "", kCoat},
    {"bsdf", "roughplastic", "",
     join(kCoat, {kDistribution,
                  kSampleVisible,
                  kAlpha,
                  {"alpha_u", "float", "0.3", "-1", "a number from 0 to 100"},
                  {"alpha_v", "float", "0.3", "-1", "a number from 0 to 100"}})},
    {"bsdf", "principled", "",
     join(kDisney, {share("metallic"),
                    share("specular"),
                    share("clearcoat"),
                    share("clearcoat_gloss"),
                    rate("main_specular_sampling_rate"),
                    rate("clearcoat_sampling_rate"),
                    {"eta", "float", "1.4", "0", "a number above 0 and at most 10000"}})},
    {"bsdf", "principledthin", "",
     join(kDisney, {{"diff_trans", "float", "1.5", "3", "a number from 0 to 2"},
                    {"eta", "float", "1.4", "0", "a number above 0 and at most 10000"},
                    rate("specular_reflectance_sampling_rate"),
                    rate("specular_transmittance_sampling_rate"),
                    rate("diffuse_transmittance_sampling_rate")})},
    {"bsdf", "mask", NORRSKEN_DIFFUSE, {share("opacity")}},
    {"bsdf", "blendbsdf", NORRSKEN_DIFFUSE NORRSKEN_DIFFUSE, {share("weight")}, {"weight"}},
    {"bsdf", "bumpmap", NORRSKEN_RELIEF NORRSKEN_DIFFUSE, join(kRelief, {{"scale", "float", "3"}})},
    {"bsdf", "normalmap", NORRSKEN_DIFFUSE, join(kRelief, {{"normalmap", "rgb", "0.5, 0.5, 1"}}), {"normalmap"}},
    {"bsdf", "twosided", NORRSKEN_DIFFUSE, {}},

    {"texture", "checkerboard", "", {{"color0", "rgb", "0.1, 0.2, 0.3"}, {"color1", "float", "0.3"}, kToUv}},
    {"texture",
     "bitmap",
     "",
     {file("card.png"),
      kToUv,
      {"filter_type", "string", "nearest", "cubic", "bilinear, nearest"},
      {"wrap_mode", "string", "mirror", "once", "repeat, mirror, clamp"},
      {"wrap_mode_u", "string", "mirror", "once", "repeat, mirror, clamp"},
      {"wrap_mode_v", "string", "mirror", "once", "repeat, mirror, clamp"},
      {"raw", "boolean", "true"},
      {"format", "string", "fp16", "fp8", "auto, variant, fp16"},
      {"accel", "boolean", "true"}},
     {"filename"}},
    {"texture", "mesh_attribute", "", {{"name", "string", "vertex_color"}, {"scale", "float", "2"}}, {"name"}},

    {"shape",
     "sphere",
     "",
     {kToAnywhere, kFlip, {"center", "point", "1, 2, 3"}, {"radius", "float", "2", "-1", "a number of at least 0"}}},
    {"shape",
     "cylinder",
     "",
     {kToAnywhere,
      kFlip,
      {"p0", "point", "1, 2, 3"},
      {"p1", "point", "1, 2, 3"},
      {"radius", "float", "2", "-1", "a number of at least 0"}}},
    {"shape", "rectangle", "", {kToAnywhere, kFlip}},
    {"shape", "disk", "", {kToAnywhere, kFlip}},
    {"shape", "cube", "", kMesh},
    {"shape",
     "mesh",
     "",
     join(kMesh, {{"positions", "string", "0 0 0, 1 0 0, 0 1 0", "x", "a string of numbers"},
                  {"triangles", "string", "0 1 2", "x", "a string of numbers"},
                  {"normals", "string", "0 0 1 0 0 1 0 0 1", "x", "a string of numbers"},
                  {"texcoords", "string", "0 0 1 0 0 1", "x", "a string of numbers"}}),
     {"positions", "triangles"}},
    {"shape", "obj", "", join(kMesh, {file("star.obj"), {"flip_tex_coords", "boolean", "false"}}), {"filename"}},
    {"shape", "ply", "", join(kMesh, {file("knot.ply"), {"flip_tex_coords", "boolean", "true"}}), {"filename"}},
    {"shape",
     "sdfgrid",
     "",
     {file("rings.vol"),
      {"normals", "string", "analytic", "flat", "analytic, smooth"},
      kToWorld,
      {"watertight", "boolean", "true"}},
     {"filename"}},
    {"shape",
     "serialized",
     "",
     join(kMesh, {file("gear.serialized"), {"shape_index", "integer", "0", "-1", "an integer from 0 to 4294967295"}}),
     {"filename"}},
    {"shape", "linearcurve", "", {file("grass.txt"), kToWorld}, {"filename"}},
    {"shape", "bsplinecurve", "", {file("tendrils.txt"), kToWorld}, {"filename"}},
    {"shape", "shapegroup", R"(<shape type="sphere"/>)", {}},
    {"shape", "instance", R"(<ref id="group"/>)", {kToWorld}},

    {"emitter", "area", "", {light("radiance"), kWeight}},
    {"emitter", "directionalarea", "", {light("radiance"), kWeight}},
    {"emitter", "point", "", {light("intensity"), {"position", "point", "1, 2, 3"}, kToWorld, kWeight}},
    {"emitter",
     "spot",
     "",
     {light("intensity"),
      kToWorld,
      kWeight,
      {"cutoff_angle", "float", "30", "180", "a number above 0 and below 180"},
      {"beam_width", "float", "5"},
      {"texture", "checkerboard", ""}}},
    {"emitter",
     "directional",
     "",
     {light("irradiance"), kToWorld, kWeight, {"direction", "vector", "1, 2, 3", "0, 0, 0", "a vector with a length"}}},
    {"emitter", "constant", "", {light("radiance"), kWeight}},
    {"emitter",
     "envmap",
     "",
     {file("sky.exr"),
      kToWorld,
      kWeight,
      {"scale", "float", "2", "-1", "a number of at least 0"},
      {"mis_compensation", "boolean", "true"}},
     {"filename"}},
    {"emitter", "projector", "",
     join(kAngles, {light("irradiance"), kToWorld, kWeight, {"scale", "float", "2", "-1", "a number of at least 0"}})},

    {"sensor", "perspective", "",
     join(join(kView, kAngles),
          {{"principal_point_offset_x", "float", "0.1"}, {"principal_point_offset_y", "float", "0.1"}})},
    {"sensor", "orthographic", "", kView},
    {"sensor",
     "thinlens",
     "",
     join(join(kView, kAngles), {{"aperture_radius", "float", "0.1", "0", "a number above 0"},
                                 {"focus_distance", "float", "3", "0", "a number above 0"}}),
     {"aperture_radius"}},

    {"film",
     "hdrfilm",
     "",
     {{"width", "integer", "10", "0", "an integer from 1 to 65536"},
      {"height", "integer", "10", "0", "an integer from 1 to 65536"},
      {"crop_offset_x", "integer", "10", "-1", "an integer from 0 to 767"},
      {"crop_offset_y", "integer", "10", "-1", "an integer from 0 to 575"},
      {"crop_width", "integer", "10", "0", "an integer from 1 to 768"},
      {"crop_height", "integer", "10", "0", "an integer from 1 to 576"},
      {"sample_border", "boolean", "true"},
      {"high_quality_edges", "boolean", "true"},
      {"file_format", "string", "openexr", "tiff", "openexr, exr, rgbe, pfm"},
      {"pixel_format", "string", "xyza", "bgr", "rgb, rgba, xyz, xyza, luminance, luminance_alpha"},
      {"component_format", "string", "float16", "float64", "float32, float16, uint32"},
      {"banner", "boolean", "true"}}},

    {"rfilter", "box", "", {}},
    {"rfilter", "tent", "", {{"radius", "float", "2", "0", "a number above 0 and at most 100"}}},
    {"rfilter", "gaussian", "", {{"stddev", "float", "1", "0", "a number above 0 and at most 25"}}},
    {"rfilter", "mitchell", "", {{"B", "float", "0.25", "1.5", kShare}, {"C", "float", "0.25", "1.5", kShare}}},
    {"rfilter", "catmullrom", "", {}},
    {"rfilter", "lanczos", "", {{"lobes", "integer", "2", "0", "an integer from 1 to 16"}}},

    {"sampler", "independent", "", kPoints},
    {"sampler", "sobol", "", kPoints},
    {"sampler", "ldsampler", "", kPoints},
    {"sampler", "multijitter", "", join(kPoints, {kJitter})},
    {"sampler", "stratified", "", join(kPoints, {kJitter})},
    {"sampler", "orthogonal", "",
     join(kPoints, {kJitter, {"strength", "integer", "3", "1", "an integer from 2 to 1024"}})},

    {"integrator", "path", "", kPath},
    {"integrator", "whitted", "", kPath},
    {"integrator",
     "direct",
     "",
     {kMaxDepth,
      kBounces,
      kRouletteDepth,
      kHide,
      {"emitter_samples", "integer", "2", "-1", "an integer from 0 to 100000"},
      {"bsdf_samples", "integer", "2", "-1", "an integer from 0 to 100000"},
      {"shading_samples", "integer", "2", "0", "an integer from 1 to 100000"}}},
    {"integrator", "ptracer", "", {kMaxDepth, kBounces, kRouletteDepth, kHide}},
    {"integrator", "volpath", "", kPath},
    {"integrator", "volpathmis", "", kPath},
    {"integrator", "depth", "", {}},
    {"integrator", "moment", R"(<integrator type="path"/>)", {}},
    {"integrator", "aov", "", {{"aovs", "string", "d:depth"}}, {"aovs"}},
};

#undef NORRSKEN_DIFFUSE
#undef NORRSKEN_RELIEF

}  // namespace norrsken::testing
