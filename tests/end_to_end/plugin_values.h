// Of plugin_parameters_test.cpp: what no rule can make of what plugins() tells.
#pragma once

namespace norrsken::testing {

/// What has to stand in a plugin in any case, as elements.
struct Needed {
  const char* kind;
  const char* plugin;
  const char* elements;
};

/// A string that is right, and one that is not ("" if there is none) with what is accepted instead. `plugin` may be empty:
/// of all that have such a parameter.
struct Value {
  const char* plugin;
  const char* parameter;
  const char* right;
  const char* wrong = "";
  const char* accepted = "";
};

#define NORRSKEN_DIFFUSE "<bsdf type=\"diffuse\"/>"
#define NORRSKEN_RELIEF "<texture type=\"bitmap\"><string name=\"filename\" value=\"relief.png\"/></texture>"

inline constexpr Needed kNeeded[] = {{"bsdf", "mask", NORRSKEN_DIFFUSE},
                                     {"bsdf", "blendbsdf", NORRSKEN_DIFFUSE NORRSKEN_DIFFUSE},
                                     {"bsdf", "bumpmap", NORRSKEN_RELIEF NORRSKEN_DIFFUSE},
                                     {"bsdf", "normalmap", NORRSKEN_DIFFUSE},
                                     {"bsdf", "twosided", NORRSKEN_DIFFUSE},
                                     {"sensor", "batch", R"(<sensor type="perspective"/>)"},
                                     {"shape", "shapegroup", R"(<shape type="sphere"/>)"},
                                     {"shape", "instance", R"(<ref id="group"/>)"},
                                     {"phase", "blendphase", R"(<phase type="hg"/><phase type="isotropic"/>)"},
                                     {"integrator", "moment", R"(<integrator type="path"/>)"}};

#undef NORRSKEN_DIFFUSE
#undef NORRSKEN_RELIEF

inline constexpr Value kValues[] = {
    {"bitmap", "filename", "card.png", "missing.file"},
    {"envmap", "filename", "sky.exr", "missing.file"},
    {"obj", "filename", "star.obj", "missing.file"},
    {"ply", "filename", "knot.ply", "missing.file"},
    {"serialized", "filename", "gear.serialized", "missing.file"},
    {"sdfgrid", "filename", "rings.vol", "missing.file"},
    {"gridvolume", "filename", "rings.vol", "missing.file"},
    {"linearcurve", "filename", "grass.txt", "missing.file"},
    {"bsplinecurve", "filename", "tendrils.txt", "missing.file"},
    {"serialized", "shape_index", "0"},
    {"", "material", "Au", "Xy"},
    {"", "far_clip", "100", "0.005", "a near_clip smaller than the far_clip"},
    {"directional", "direction", "1, 2, 3", "0, 0, 0", "a vector with a length"},
    {"", "focal_length", "35mm", "wide", "a length from 0.001mm to 1000000mm, such as 50mm"},
    {"aov", "aovs", "d:depth", "d", "pairs such as position:position, normal:sh_normal"},
    {"mesh_attribute", "name", "vertex_color"},
    {"tabphase", "values", "1, 2", "1", "2 to 1048576"},
    {"mesh", "positions", "0 0 0, 1 0 0, 0 1 0", "x", "a string of numbers"},
    {"mesh", "triangles", "0 1 2", "x", "a string of numbers"},
    {"mesh", "normals", "0 0 1 0 0 1 0 0 1", "x", "a string of numbers"},
    {"mesh", "texcoords", "0 0 1 0 0 1", "x", "a string of numbers"},
};

}  // namespace norrsken::testing
