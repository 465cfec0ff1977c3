#include "formats/write_mitsuba_xml.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>
#include <utility>

#include "base/atomic_file.h"
#include "base/text.h"
#include "formats/write_ply.h"

namespace norrsken {
namespace {

std::string escaped(std::string_view text) {
  std::string result;
  for (const char c : text) {
    switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      case '\n':
        result += "&#10;";
        break;
      case '\t':
        result += "&#9;";
        break;
      case '\r':
        result += "&#13;";
        break;
      default:
        result += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
    }
  }
  return result;
}

const Property* find(const Node& node, std::string_view name) {
  const auto found = std::ranges::find(node.properties, name, &Property::name);
  return found != node.properties.end() ? &*found : nullptr;
}

double number_of(const Node& node, std::string_view name, double fallback) {
  const Property* property = find(node, name);
  const auto* number = property ? std::get_if<double>(&property->value) : nullptr;
  return number ? *number : fallback;
}

bool flag_of(const Node& node, std::string_view name, bool fallback) {
  const Property* property = find(node, name);
  const auto* flag = property ? std::get_if<bool>(&property->value) : nullptr;
  return flag ? *flag : fallback;
}

bool has(const Node& node, std::string_view name) {
  return find(node, name) != nullptr ||
         std::ranges::any_of(node.children, [&](const Node::Child& c) { return c.name == name; });
}

/// Gives `to` the number, colour or texture `name` of `from`; false if there is none.
bool pass_on(const Node& from, const char* name, Node& to, const char* as) {
  for (const Node::Child& child : from.children) {
    if (child.name == name) return to.add(child.node, as), true;
  }
  const Property* property = find(from, name);
  if (property) to.set(as, property->value);
  return property != nullptr;
}

class Writer {
 public:
  Writer(const Description& description, const std::string& path, const FileSystem& files, Diagnostics& diagnostics)
      : description_(description), path_(path), files_(files), diagnostics_(diagnostics) {
    const std::filesystem::path target(path);
    folder_name_ = target.stem().string() + "_files";
    folder_ = (target.parent_path() / folder_name_).string();
  }

  std::vector<std::string> write() {
    count_uses(*description_.scene);
    text_ = "<scene version=\"3.0.0\">\n";
    write_inside(*description_.scene, 1);
    text_ += "</scene>\n";
    if (diagnostics_.has_errors()) return {};
    write_file(path_, text_);
    if (diagnostics_.has_errors()) return {};
    return written_;
  }

 private:
  // --- nodes ---

  void count_uses(const Node& node) {
    for (const Node::Child& child : node.children) {
      if (++uses_[child.node.get()] == 1) count_uses(*child.node);
      if (!child.node->id.empty()) ids_.insert(child.node->id);
    }
  }

  void line(int depth, const std::string& text) {
    text_ += std::string(4 * static_cast<std::size_t>(depth), ' ') + text + "\n";
  }

  void tell(const std::string& message, const std::string& instead) {
    if (told_.insert(message).second) diagnostics_.warning({}, message + "; instead: " + instead);
  }

  std::string name_attribute(const std::string& name) {
    return name.empty() ? "" : fmt::format(" name=\"{}\"", escaped(name));
  }

  /// The id that others refer to a node by; empty if nobody does.
  std::string id_of(const Node& node) {
    // Mitsuba gives an emitter to one shape alone.
    if (node.kind == "emitter" ? uses_[&node] > 1 || node.id.empty() : uses_[&node] < 2 && node.id.empty()) return {};
    std::string& id = id_of_node_[&node];
    if (!id.empty()) return id;
    id = node.id;
    for (int k = 0; id.empty() || !given_.insert(id).second; ++k) {
      id = fmt::format("{}_{}", node.id.empty() ? node.kind : node.id, k);
      if (ids_.contains(id)) id.clear();
    }
    return id;
  }

  /// Whether it is a `gltf` that transmits, or a map around one.
  static bool transmits(const Node& bsdf) {
    if (bsdf.plugin == "gltf") return has(bsdf, "transmission");
    return std::ranges::any_of(bsdf.children,
                               [](const Node::Child& c) { return c.node->kind == "bsdf" && transmits(*c.node); });
  }

  void write_child(const Node::Child& child, int depth) {
    const Node& node = *child.node;
    if (node.plugin == "twosided" && transmits(node))
      return write_child({child.name, node.children.front().node, {}}, depth);
    if (const auto known = id_of_node_.find(&node); known != id_of_node_.end())
      return line(depth, fmt::format("<ref id=\"{}\"{}/>", escaped(known->second), name_attribute(child.name)));
    const std::string id = id_of(node);
    if (node.kind == "bsdf" && node.plugin == "gltf") {
      tell("Mitsuba has no bsdf 'gltf'", "its materials nearest to it, 'principled' and 'principledthin'");
      return write_node(without_gltf(node, diagnostics_), child.name, id, depth);
    }
    write_node(node, child.name, id, depth);
  }

  void write_node(const Node& node, const std::string& name, const std::string& id, int depth) {
    std::string plugin = node.plugin;
    if (node.kind == "shape" && plugin == "mesh") plugin = "ply";
    if (node.kind == "sampler" && plugin == "sobol") {
      tell("Mitsuba has no sampler 'sobol'", "'independent'");
      plugin = "independent";
    }
    const std::string begin =
        fmt::format("<{} type=\"{}\"{}{}", node.kind, escaped(plugin),
                    id.empty() ? "" : fmt::format(" id=\"{}\"", escaped(id)), name_attribute(name));
    if (node.properties.empty() && node.children.empty()) return line(depth, begin + "/>");
    line(depth, begin + ">");
    write_inside(node, depth + 1);
    line(depth, fmt::format("</{}>", node.kind));
  }

  void write_inside(const Node& node, int depth) {
    for (const Property& property : node.properties) write_property(node, property, depth);
    for (const Node::Child& child : node.children) {
      if (node.kind == "bsdf" && node.plugin == "twosided" && &child != &node.children.front() &&
          child.node->plugin == "null") {
        tell("Mitsuba has no bsdf 'twosided' of which one side is not there", "the front on both sides");
      } else {
        write_child(child, depth);
      }
    }
  }

  // --- values ---

  /// Mitsuba has one mode for both axes.
  void write_wrap_mode(const Node& bitmap, int depth) {
    const auto mode = [&](const char* name) {
      const Property* property = find(bitmap, name);
      const auto* text = property ? std::get_if<std::string>(&property->value) : nullptr;
      return text ? *text : std::string("repeat");
    };
    const std::string u = mode("wrap_mode_u"), v = mode("wrap_mode_v");
    if (u != v) tell("Mitsuba has no bitmap that is continued in two ways", "both axes as 'repeat'");
    line(depth, fmt::format("<string name=\"wrap_mode\" value=\"{}\"/>", u == v ? u : "repeat"));
  }

  void write_property(const Node& node, const Property& property, int depth) {
    if (node.plugin == "bitmap" && property.name == "wrap_mode_u") return write_wrap_mode(node, depth);
    if (node.plugin == "bitmap" && property.name == "wrap_mode_v") {
      if (!has(node, "wrap_mode_u")) write_wrap_mode(node, depth);
      return;
    }
    const std::string& name = property.name;
    const auto element = [&](const char* type, const std::string& value) {
      line(depth, fmt::format("<{} name=\"{}\" value=\"{}\"/>", type, escaped(name), escaped(value)));
    };
    // Parameters of our own.
    if (node.kind == "integrator" && name == "emitter_samples" && node.plugin != "direct")
      return tell("Mitsuba's integrators have no 'emitter_samples'", "1");
    if (node.kind == "integrator" && name == "bounces") {
      if (const auto* bounces = std::get_if<std::int64_t>(&property.value))
        line(depth, fmt::format("<integer name=\"max_depth\" value=\"{}\"/>", *bounces + 1));
      return;
    }
    if (const auto* flag = std::get_if<bool>(&property.value)) {
      element("boolean", *flag ? "true" : "false");
    } else if (const auto* whole = std::get_if<std::int64_t>(&property.value)) {
      element("integer", fmt::to_string(*whole));
    } else if (const auto* number = std::get_if<double>(&property.value)) {
      element("float", fmt::format("{}", *number));
    } else if (const auto* text = std::get_if<std::string>(&property.value)) {
      element("string", name == "filename" ? copy_of(property, *text) : *text);
    } else if (const auto* rgb = std::get_if<Property::Rgb>(&property.value)) {
      element("rgb", fmt::format("{}", fmt::join(rgb->value, ", ")));
    } else if (const auto* vector = std::get_if<Property::Vector>(&property.value)) {
      line(depth, fmt::format("<{} name=\"{}\" x=\"{}\" y=\"{}\" z=\"{}\"/>", name == "direction" ? "vector" : "point",
                              escaped(name), vector->value[0], vector->value[1], vector->value[2]));
    } else if (const auto* spectrum = std::get_if<Property::Spectrum>(&property.value)) {
      element("spectrum", text_of(*spectrum));
    } else if (const auto* transform = std::get_if<Property::Transform>(&property.value)) {
      line(depth, fmt::format("<transform name=\"{}\">", escaped(name)));
      std::string rows;
      for (const auto& row : transform->rows) rows += fmt::format("{}{}", rows.empty() ? "" : " ", fmt::join(row, " "));
      line(depth + 1, fmt::format("<matrix value=\"{}\"/>", rows));
      line(depth, "</transform>");
    } else if (const auto* mesh = std::get_if<std::shared_ptr<const Mesh>>(&property.value)) {
      line(depth, fmt::format("<string name=\"filename\" value=\"{}\"/>", escaped(file_of(**mesh))));
    } else if (const auto* image = std::get_if<std::shared_ptr<const Image>>(&property.value)) {
      line(depth, fmt::format("<string name=\"filename\" value=\"{}\"/>", escaped(file_of(**image))));
      const bool is_grey = (*image)->find("R") == nullptr;
      const bool says_raw = std::ranges::any_of(node.properties, [](const Property& p) { return p.name == "raw"; });
      if (node.kind == "texture" && is_grey && !says_raw) line(depth, R"(<boolean name="raw" value="true"/>)");
    } else {
      tell(fmt::format("arrays of {} '{}' cannot be written", node.kind, node.plugin), "nothing there");
    }
  }

  static std::string text_of(const Property::Spectrum& spectrum) {
    if (spectrum.samples.size() == 1) return fmt::format("{}", spectrum.samples[0].second);
    std::string text;
    for (const auto& [wavelength, value] : spectrum.samples)
      text += fmt::format("{}{}:{}", text.empty() ? "" : ", ", wavelength, value);
    return text;
  }

  // --- files ---

  void fail(const std::string& message) { diagnostics_.error({}, message); }

  void write_file(const std::string& path, const std::string& bytes) {
    AtomicFile file;
    if (const IoStatus status = file.create(path); !status) return fail(status.error);
    file.write(bytes.data(), bytes.size());
    if (const IoStatus status = file.commit(); !status) return fail(status.error);
    written_.push_back(path);
  }

  /// A path in the folder of files, which is made; relative to the scene's own in `relative`.
  std::string new_file(const std::string& name, std::string& relative) {
    std::error_code error;
    std::filesystem::create_directories(folder_, error);
    if (error) fail(fmt::format("cannot make the folder '{}': {}", folder_, error.message()));
    relative = folder_name_ + "/" + name;
    return folder_ + "/" + name;
  }

  std::string file_of(const Mesh& mesh) {
    std::string& relative = file_of_[&mesh];
    if (!relative.empty()) return relative;
    const std::string path = new_file(fmt::format("mesh_{:04}.ply", meshes_++), relative);
    const std::string error = write_ply(path, mesh);
    if (!error.empty()) fail(error);
    written_.push_back(path);
    return relative;
  }

  std::string file_of(const Image& image) {
    std::string& relative = file_of_[&image];
    if (!relative.empty()) return relative;
    const std::string path = new_file(fmt::format("image_{:04}.exr", images_++), relative);
    if (const IoStatus status = write_image(path, image); !status) fail(status.error);
    written_.push_back(path);
    return relative;
  }

  std::string copy_of(const Property& property, const std::string& name) {
    std::vector<std::string> folders = description_.search_paths;
    folders.push_back(folder_of(property.location.file));
    const std::string source = resolve_file(files_, name, folders);
    if (source.empty()) {
      diagnostics_.error(property.location, fmt::format("cannot find {}", quoted(name, 200)),
                         accepted_files(name, folders));
      return name;
    }
    std::string& relative = copies_[normal_path(source)];
    if (!relative.empty()) return relative;
    std::string file_name = std::filesystem::path(source).filename().string();
    while (!names_.insert(file_name).second) file_name = "_" + file_name;
    const std::string path = new_file(file_name, relative);
    std::string error;
    const auto contents = read_counted(files_, source, error);
    if (!contents) {
      diagnostics_.error(property.location, fmt::format("cannot read {}: {}", quoted(source, 200), error));
    } else {
      write_file(path, contents->bytes);
    }
    return relative;
  }

  const Description& description_;
  const std::string& path_;
  const FileSystem& files_;
  Diagnostics& diagnostics_;
  std::string folder_name_, folder_, text_;
  std::vector<std::string> written_;
  std::map<const Node*, int> uses_;
  std::map<const Node*, std::string> id_of_node_;
  std::set<std::string> ids_, given_, told_, names_;
  std::map<const void*, std::string> file_of_;
  std::map<std::string, std::string> copies_;
  std::size_t meshes_ = 0, images_ = 0;
};

}  // namespace

Node without_gltf(const Node& bsdf, Diagnostics& diagnostics) {
  const bool transmits = has(bsdf, "transmission"), is_sheet = transmits && flag_of(bsdf, "thin", true);
  Node result("bsdf", is_sheet ? "principledthin" : "principled");
  const bool has_vertex_color = has(bsdf, "vertex_color");
  const Property* base = find(bsdf, "base_color");
  const auto* rgb = base ? std::get_if<Property::Rgb>(&base->value) : nullptr;
  const bool is_white = rgb ? rgb->value == std::array<double, 3>{1, 1, 1} : !has(bsdf, "base_color");
  if (has_vertex_color && is_white) {
    pass_on(bsdf, "vertex_color", result, "base_color");
  } else {
    if (has_vertex_color)
      diagnostics.warning({}, "Mitsuba multiplies no colors of vertices with a base color; instead: the base color");
    if (!pass_on(bsdf, "base_color", result, "base_color")) result.set("base_color", Property::Rgb{{1, 1, 1}});
  }
  if (!pass_on(bsdf, "roughness", result, "roughness")) result.set("roughness", 1.0);
  if (transmits) pass_on(bsdf, "transmission", result, "spec_trans");
  const double ior = number_of(bsdf, "ior", 1.5);
  if (is_sheet) {
    result.set("eta", ior);
    return result;
  }
  if (!pass_on(bsdf, "metallic", result, "metallic")) result.set("metallic", 1.0);
  if (pass_on(bsdf, "clearcoat", result, "clearcoat"))
    result.set("clearcoat_gloss", 1 - number_of(bsdf, "clearcoat_roughness", 0));
  if (transmits) {
    result.set("eta", ior);
    return result;
  }
  const double head_on = ior == 0 ? 1 : (ior - 1) / (ior + 1) * ((ior - 1) / (ior + 1));
  result.set("specular", std::clamp(head_on * number_of(bsdf, "specular", 1) / 0.08, 0.0, 1.0));
  return result;
}

std::vector<std::string> write_mitsuba_xml(const Description& description, const std::string& path,
                                           const FileSystem& files, Diagnostics& diagnostics) {
  return Writer(description, path, files, diagnostics).write();
}

}  // namespace norrsken
