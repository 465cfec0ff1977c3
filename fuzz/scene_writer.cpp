#include "fuzz/scene_writer.h"

#include <fmt/format.h>

#include <algorithm>

namespace norrsken::fuzz {
namespace {

constexpr double kHuge = 1e6, kMaxEmission = 1e18;

/// What a transform may do besides moving and turning.
enum class Scales { none, alike, any };

class SceneWriter {
 public:
  SceneWriter(ByteSource& choices, const SceneFiles& files) : c_(choices), files_(files) {}

  std::string write() {
    xml_ = "<scene version=\"3.0.0\">\n";
    integrator(0);
    sensor();
    const int emitters = c_.below(4);
    for (int i = 0; i < emitters; ++i) emitter();
    const int shapes = 1 + c_.below(5);
    for (int i = 0; i < shapes; ++i) shape(false);
    return xml_ + "</scene>\n";
  }

 private:
  // --- elements ---

  void open(const char* kind, const char* plugin, const char* attributes = "") {
    xml_ += fmt::format("<{} type=\"{}\"{}>\n", kind, plugin, attributes);
  }
  void close(const char* kind) { xml_ += fmt::format("</{}>\n", kind); }
  void value(const char* type, const char* name, const std::string& text) {
    xml_ += fmt::format("<{} name=\"{}\" value=\"{}\"/>\n", type, name, text);
  }
  void number(const char* name, double least, double most) {
    if (c_.flag()) value("float", name, fmt::format("{:.9g}", c_.number(least, most)));
  }
  void integer(const char* name, int least, int most) {
    if (c_.flag()) value("integer", name, std::to_string(least + c_.below(most - least + 1)));
  }
  void boolean(const char* name) {
    if (const int choice = c_.below(4); choice < 2) value("boolean", name, choice == 0 ? "false" : "true");
  }
  void word(const char* name, std::initializer_list<const char*> words) {
    if (c_.flag()) value("string", name, c_.one_of(words));
  }
  std::string triple(double least, double most) {
    return fmt::format("{:.9g}, {:.9g}, {:.9g}", c_.number(least, most), c_.number(least, most),
                       c_.number(least, most));
  }

  /// Colours and numbers that may be textures.
  void color(const char* name, double most = 1) {
    switch (c_.below(5)) {
      case 0:
        return;
      case 1:
        return texture(name, most);
      default:
        return value("rgb", name, triple(0, most));
    }
  }
  void share(const char* name) {
    switch (c_.below(5)) {
      case 0:
        return;
      case 1:
        return texture(name, 1);
      default:
        return value("float", name, fmt::format("{:.9g}", c_.number(0, 1)));
    }
  }

  void texture(const char* name, double most) {
    const std::string attributes = fmt::format(" name=\"{}\"", name);
    switch (c_.below(has_attributes_ ? 3 : 2)) {
      case 0:
        open("texture", "checkerboard", attributes.c_str());
        value("rgb", "color0", triple(0, most));
        value("rgb", "color1", triple(0, most));
        transform("to_uv");
        break;
      case 1:
        bitmap(attributes);
        return;
      default:
        open("texture", "mesh_attribute", attributes.c_str());
        value("string", "name", c_.one_of({"vertex_color", "face_color", "vertex_weight"}));
        number("scale", 0, 1);
    }
    close("texture");
  }
  void bitmap(const std::string& attributes) {
    open("texture", "bitmap", attributes.c_str());
    value("string", "filename", files_.picture);
    word("filter_type", {"bilinear", "nearest"});
    word("wrap_mode", {"repeat", "mirror", "clamp"});
    boolean("raw");
    transform("to_uv");
    close("texture");
  }

  void transform(const char* name, Scales scales = Scales::any) {
    if (c_.flag()) return;
    xml_ += fmt::format("<transform name=\"{}\">", name);
    const int steps = 1 + c_.below(3);
    for (int i = 0; i < steps; ++i) {
      switch (c_.below(4 + static_cast<int>(scales))) {
        case 0:
        case 1:
          xml_ += fmt::format("<translate value=\"{}\"/>", triple(-5, 5));
          break;
        case 2:
          xml_ += fmt::format("<rotate value=\"{}\" angle=\"{:.9g}\"/>", triple(-1, 1), c_.number(-360, 360));
          break;
        case 3:
          lookat();
          break;
        case 4:
          xml_ += fmt::format("<scale value=\"{:.9g}\"/>", c_.number(1e-6, kHuge));
          break;
        default:
          xml_ += fmt::format("<scale value=\"{}\"/>", triple(-2, 2));
      }
    }
    close("transform");
  }
  void lookat() {
    xml_ += fmt::format("<lookat origin=\"{}\" target=\"{}\" up=\"{}\"/>", triple(-5, 5), triple(-2, 2), triple(-1, 1));
  }

  // --- what is seen ---

  void bsdf(int depth) {
    constexpr int kPlain = 11, kNesting = 5;
    switch (c_.below(depth < 3 ? kPlain + kNesting : kPlain)) {
      case 0:
        open("bsdf", "diffuse");
        color("reflectance");
        break;
      case 1:
        open("bsdf", "conductor");
        metal();
        break;
      case 2:
        open("bsdf", "roughconductor");
        metal();
        rough();
        break;
      case 3:
        open("bsdf", c_.flag() ? "dielectric" : "thindielectric");
        interface();
        break;
      case 4:
        open("bsdf", "roughdielectric");
        interface();
        rough();
        break;
      case 5:
        open("bsdf", "null");
        break;
      case 6:
        open("bsdf", "plastic");
        coat();
        break;
      case 7:
        // A table of its own for each: more than a few take longer than all the rest.
        open("bsdf", rough_plastics_++ < 1 ? "roughplastic" : "plastic");
        coat();
        break;
      case 8:
        open("bsdf", "principled");
        disney();
        for (const char* name : {"metallic", "clearcoat", "clearcoat_gloss"}) share(name);
        number("main_specular_sampling_rate", 0, kHuge);
        c_.flag() ? number("eta", 1e-3, 100) : number("specular", 0, 1);
        break;
      case 9:
        open("bsdf", "principledthin");
        disney();
        number("diff_trans", 0, 2);
        number("eta", 1e-3, 100);
        break;
      case 10:
        open("bsdf", "diffuse");
        break;
      case kPlain:
        open("bsdf", "mask");
        share("opacity");
        bsdf(depth + 1);
        break;
      case kPlain + 1:
        open("bsdf", "blendbsdf");
        value("float", "weight", fmt::format("{:.9g}", c_.number(0, 1)));
        bsdf(depth + 1);
        bsdf(depth + 1);
        break;
      case kPlain + 2:
        open("bsdf", "bumpmap");
        bitmap("");
        number("scale", -kHuge, kHuge);
        relief(depth);
        break;
      case kPlain + 3:
        open("bsdf", "normalmap");
        texture("normalmap", 1);
        relief(depth);
        break;
      default:
        open("bsdf", "twosided");
        bsdf(depth + 1);
    }
    close("bsdf");
  }
  void metal() {
    if (c_.flag()) {
      value("string", "material", c_.one_of({"Au", "Cu", "Al", "none"}));
    } else {
      number("eta", 1e-3, 1e4);
      number("k", 0, 1e4);
    }
    color("specular_reflectance");
  }
  void rough() {
    word("distribution", {"ggx", "beckmann"});
    boolean("sample_visible");
    if (c_.flag()) return number("alpha", 0, 100);
    value("float", "alpha_u", fmt::format("{:.9g}", c_.number(0, 100)));
    value("float", "alpha_v", fmt::format("{:.9g}", c_.number(0, 100)));
  }
  void interface() {
    number("int_ior", 1e-3, 100);
    number("ext_ior", 1e-3, 100);
    color("specular_reflectance");
    color("specular_transmittance");
  }
  void coat() {
    number("int_ior", 1.001, 100);
    color("specular_reflectance");
    color("diffuse_reflectance");
    boolean("nonlinear");
  }
  void disney() {
    color("base_color");
    for (const char* name : {"roughness", "anisotropic", "spec_trans", "spec_tint", "sheen", "sheen_tint", "flatness"})
      share(name);
    number("diffuse_reflectance_sampling_rate", 0, kHuge);
  }
  void relief(int depth) {
    boolean("flip_invalid_normals");
    boolean("use_shadowing_function");
    bsdf(depth + 1);
  }

  static constexpr int kWithAttributes = 6;

  void shape(bool in_group) {
    const int kind = c_.below(in_group ? 11 : 12);
    has_attributes_ = kind == kWithAttributes;
    switch (kind) {
      case 0:
        open("shape", "sphere");
        value("point", "center", triple(-3, 3));
        number("radius", 1e-6, kHuge);
        boolean("flip_normals");
        break;
      case 1:
        open("shape", "cylinder");
        value("point", "p0", triple(-3, 3));
        value("point", "p1", triple(-3, 3));
        number("radius", 1e-6, kHuge);
        boolean("flip_normals");
        break;
      case 2:
        open("shape", "rectangle");
        boolean("flip_normals");
        break;
      case 3:
        open("shape", "disk");
        boolean("flip_normals");
        break;
      case 4:
        open("shape", "cube");
        boolean("face_normals");
        break;
      case 5:
        mesh("obj", files_.obj);
        break;
      case kWithAttributes:
        mesh("ply", files_.ply);
        break;
      case 7:
        mesh("serialized", files_.serialized);
        break;
      case 8:
        file("sdfgrid", files_.volume);
        word("normals", {"analytic", "smooth"});
        break;
      case 9:
        file("linearcurve", files_.curves);
        break;
      case 10:
        file("bsplinecurve", files_.curves);
        break;
      default:
        return instances();
    }
    // Spheres, cylinders and disks stay what they are.
    transform("to_world", kind <= 3 && kind != 2 ? Scales::alike : Scales::any);
    bsdf(0);
    if (!in_group && c_.below(4) == 0) {
      open("emitter", c_.below(4) == 0 ? "directionalarea" : "area");
      color("radiance", kMaxEmission);
      close("emitter");
    }
    has_attributes_ = false;
    close("shape");
  }
  void file(const char* plugin, const std::string& path) {
    open("shape", plugin);
    value("string", "filename", path);
  }
  void mesh(const char* plugin, const std::string& path) {
    file(plugin, path);
    boolean("face_normals");
    boolean("flip_normals");
  }
  void instances() {
    const std::string id = fmt::format("group{}", groups_++);
    open("shape", "shapegroup", fmt::format(" id=\"{}\"", id).c_str());
    const int shapes = 1 + c_.below(3);
    for (int i = 0; i < shapes; ++i) shape(true);
    close("shape");
    const int copies = 1 + c_.below(3);
    for (int i = 0; i < copies; ++i) {
      open("shape", "instance");
      xml_ += fmt::format("<ref id=\"{}\"/>", id);
      transform("to_world");
      close("shape");
    }
  }

  // --- light ---

  void emitter() {
    switch (c_.below(6)) {
      case 0:
        if (surroundings_++ > 0) return;
        open("emitter", "constant");
        value("rgb", "radiance", triple(0, kMaxEmission));
        break;
      case 1:
        if (surroundings_++ > 0) return;
        open("emitter", "envmap");
        value("string", "filename", files_.sky);
        number("scale", 0, kMaxEmission);
        boolean("mis_compensation");
        transform("to_world", Scales::none);
        break;
      case 2:
        open("emitter", "point");
        value("rgb", "intensity", triple(0, kMaxEmission));
        value("point", "position", triple(-5, 5));
        break;
      case 3:
        open("emitter", "spot");
        value("rgb", "intensity", triple(0, kMaxEmission));
        number("cutoff_angle", 20, 179);
        number("beam_width", 0, 19);
        transform("to_world", Scales::none);
        break;
      case 4:
        open("emitter", "directional");
        value("rgb", "irradiance", triple(0, kMaxEmission));
        c_.flag() ? transform("to_world", Scales::none) : value("vector", "direction", triple(-1, 1));
        break;
      default:
        open("emitter", "projector");
        color("irradiance", kMaxEmission);
        number("scale", 0, 1e6);
        number("fov", 1e-3, 179.9);
        transform("to_world", Scales::none);
    }
    close("emitter");
  }

  // --- the picture ---

  void sensor() {
    const int kind = c_.below(3);
    open("sensor", kind == 0 ? "perspective" : kind == 1 ? "orthographic" : "thinlens");
    if (c_.below(4) == 0) {
      transform("to_world", Scales::none);
    } else {
      xml_ += "<transform name=\"to_world\">";
      lookat();
      close("transform");
    }
    if (kind != 1) {
      number("fov", 1e-3, 179.9);
      word("fov_axis", {"x", "y", "diagonal", "smaller", "larger"});
    }
    if (kind == 2) {
      // No lens may be wider than 10000 times its focus.
      const double focus = c_.number(1e-3, kHuge);
      value("float", "aperture_radius", fmt::format("{:.9g}", c_.number(1e-6, std::min(kHuge, 9999 * focus))));
      value("float", "focus_distance", fmt::format("{:.9g}", focus));
    }
    if (c_.below(4) == 0) value("float", "near_clip", "0.5");
    sampler();
    film();
    close("sensor");
  }
  void sampler() {
    open("sampler", c_.one_of({"independent", "sobol", "ldsampler", "multijitter", "stratified", "orthogonal"}));
    value("integer", "sample_count", std::to_string(1 + c_.below(5)));
    integer("seed", 0, 3);
    close("sampler");
  }
  void film() {
    open("film", "hdrfilm");
    value("integer", "width", "4");
    value("integer", "height", "4");
    if (c_.below(4) == 0) {
      for (const char* name : {"crop_offset_x", "crop_offset_y"}) value("integer", name, std::to_string(c_.below(2)));
      for (const char* name : {"crop_width", "crop_height"}) value("integer", name, std::to_string(1 + c_.below(3)));
    }
    word("pixel_format", {"rgb", "rgba", "xyz", "xyza", "luminance", "luminance_alpha"});
    word("component_format", {"float32", "float16"});
    boolean("sample_border");
    const char* filter = c_.one_of({"box", "tent", "gaussian", "mitchell", "catmullrom", "lanczos"});
    open("rfilter", filter);
    if (std::string_view(filter) == "tent") number("radius", 1e-3, 100);
    close("rfilter");
    close("film");
  }

  void integrator(int depth) {
    const char* plugin = c_.one_of({"path", "path", "whitted", "direct", "ptracer", "depth", "aov", "moment"});
    const std::string_view name = plugin;
    const bool nests = name == "aov" || name == "moment";
    if (nests && depth > 1) plugin = "path";
    open("integrator", plugin);
    if (nests && depth <= 1) {
      if (name == "aov")
        value("string", "aovs",
              c_.one_of({"d:depth,n:sh_normal", "a:albedo,u:uv", "p:prim_index,du:dp_du", "s:shape_index"}));
      integrator(depth + 1);
    } else if (name != "depth") {
      if (c_.flag()) value("integer", "max_depth", c_.one_of({"-1", "1", "2", "3", "8", "2147483647"}));
      if (c_.flag()) value("integer", "rr_depth", c_.one_of({"1", "2", "5", "2147483647"}));
      boolean("hide_emitters");
      if (name == "path" || name == "whitted") integer("emitter_samples", 1, 4);
      if (name == "direct") {
        integer("emitter_samples", 0, 3);
        value("integer", "bsdf_samples", std::to_string(1 + c_.below(3)));
      }
    }
    close("integrator");
  }

  ByteSource& c_;
  const SceneFiles& files_;
  std::string xml_;
  int groups_ = 0, surroundings_ = 0, rough_plastics_ = 0;
  bool has_attributes_ = false;  ///< of the shape that is being written
};

}  // namespace

std::string write_scene(ByteSource& choices, const SceneFiles& files) { return SceneWriter(choices, files).write(); }

}  // namespace norrsken::fuzz
