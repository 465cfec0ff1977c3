#include "formats/other_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <limits>

#include "base/file_signature.h"
#include "base/text.h"
#include "formats/mesh_readers.h"

namespace norrsken {
namespace {

using namespace std::string_view_literals;

constexpr std::string_view kByBlender =
    "a scene of Mitsuba's XML; Blender's add-on mitsuba-blender writes one (File, Export, Mitsuba)";

// What to give in its place.
std::string_view accepted_instead_of(FileKind kind) {
  switch (kind) {
    case FileKind::read_image:
    case FileKind::other_image:
      return "a scene; images are a part of it as <texture type=\"bitmap\"> or <emitter type=\"envmap\">";
    case FileKind::volume:
      return "a scene; volumes are a part of it as <volume type=\"gridvolume\">";
    case FileKind::scene:
      return kByBlender;
    case FileKind::packed:
      return "the file that is packed in it; unpack it first";
    case FileKind::checkpoint:
      return "a scene; 'norrsken merge' makes an image of a checkpoint";
    case FileKind::other:
      break;
  }
  return "a scene";
}

bool has_extension(std::string_view path, std::string_view extension) {
  return path.size() > extension.size() && equal_ignoring_case(path.substr(path.size() - extension.size()), extension);
}

std::string_view file_name(std::string_view path) { return path.substr(path.rfind('/') + 1); }

std::string in_xml(std::string_view text) {
  std::string result;
  for (const char c : text) {
    if (c == '&') {
      result += "&amp;";
    } else if (c == '<') {
      result += "&lt;";
    } else if (c == '"') {
      result += "&quot;";
    } else {
      result += c;
    }
  }
  return result;
}

// The step that brings a mesh into the unit sphere about the origin, where the camera of `scene_around` looks; empty if
// the mesh cannot be read.
std::string into_view(const std::optional<MeshData>& mesh) {
  if (!mesh || mesh->positions.empty()) return {};
  glm::dvec3 low(std::numeric_limits<double>::infinity()), high = -low;
  for (const auto& p : mesh->positions) {
    low = glm::min(low, glm::dvec3(p[0], p[1], p[2]));
    high = glm::max(high, glm::dvec3(p[0], p[1], p[2]));
  }
  const glm::dvec3 shift = -0.5 * (low + high);
  const double radius = 0.5 * glm::length(high - low);
  if (!(radius > 0) || !std::isfinite(radius)) return {};
  return fmt::format(
      "<transform name=\"to_world\"><translate value=\"{:.5g} {:.5g} {:.5g}\"/><scale value=\"{:.4g}\"/></transform>",
      shift.x + 0.0, shift.y + 0.0, shift.z + 0.0, 1 / radius);
}

std::string scene_around(std::string_view path, std::string_view plugin, const std::optional<MeshData>& mesh) {
  return fmt::format(
      "a scene that has the mesh, such as this one beside it\n"
      "<scene version=\"3.0.0\">\n"
      "  <sensor type=\"perspective\"><transform name=\"to_world\"><lookat origin=\"3 2 4\" target=\"0 0 0\" up=\"0 1 "
      "0\"/>"
      "</transform></sensor>\n"
      "  <emitter type=\"constant\"/>\n"
      "  <shape type=\"{}\"><string name=\"filename\" value=\"{}\"/>{}</shape>\n"
      "</scene>",
      plugin, in_xml(file_name(path)), into_view(mesh));
}

bool contains_ignoring_case(std::string_view text, std::string_view word) {
  for (std::size_t at = 0; at + word.size() <= text.size(); ++at) {
    if (equal_ignoring_case(text.substr(at, word.size()), word)) return true;
  }
  return false;
}

bool any_follows(std::string_view) { return true; }

// Whether one of the first lines begins with one of the words and a blank, and the rest of it is `follows`; comments and
// empty lines are none.
bool has_line(std::string_view text, std::initializer_list<std::string_view> words,
              bool (*follows)(std::string_view) = any_follows) {
  for (int lines = 0; lines < 200 && !text.empty();) {
    const std::size_t end = std::min(text.find_first_of("\r\n"), text.size());
    const std::string_view line = trim(text.substr(0, end));
    if (!line.empty() && line.front() != '#') ++lines;
    for (const std::string_view word : words) {
      if (!line.starts_with(word)) continue;
      const std::string_view rest = line.substr(word.size());
      if (rest.empty() || ((rest[0] == ' ' || rest[0] == '\t') && follows(trim(rest)))) return true;
    }
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return false;
}

bool contains(std::string_view text, std::string_view word) { return text.find(word) != std::string_view::npos; }

// Whether it is anything but text: XML of 16 and 32 bits a character has zeros too, but beside each '<'.
bool is_binary(std::string_view bytes) {
  if (bytes.starts_with("\xFE\xFF"sv) || bytes.starts_with("\xFF\xFE"sv) || bytes.substr(0, 4) == "\0\0\xFE\xFF"sv)
    return false;
  const std::string_view head = bytes.substr(0, 4096);
  return contains(head, "\0"sv) && !contains(head.substr(0, 8), "<"sv);
}

// Binary STL: a header of 80 bytes, how many triangles there are, and 50 bytes for each.
bool is_binary_stl(std::string_view bytes) {
  if (bytes.size() < 84) return false;
  std::uint64_t triangles = 0;
  for (std::size_t i = 4; i-- > 0;) triangles = triangles << 8 | static_cast<unsigned char>(bytes[80 + i]);
  return bytes.size() == 84 + 50 * triangles;
}

// What pbrt's directives take, unlike sentences that begin with the same word.
bool is_pbrt_value(std::string_view rest) {
  return rest.empty() || std::string_view("\"[-+.#0123456789").find(rest[0]) != std::string_view::npos;
}

// Words that begin lines of pbrt's files, parts of scenes too.
bool has_pbrt_line(std::string_view text) {
  return has_line(text,
                  {"WorldBegin",
                   "WorldEnd",
                   "AttributeBegin",
                   "AttributeEnd",
                   "TransformBegin",
                   "Camera",
                   "LookAt",
                   "Film",
                   "Integrator",
                   "Sampler",
                   "SurfaceIntegrator",
                   "PixelFilter",
                   "Accelerator",
                   "ColorSpace",
                   "Option",
                   "Include",
                   "Import",
                   "Shape",
                   "Material",
                   "MakeNamedMaterial",
                   "NamedMaterial",
                   "Texture",
                   "LightSource",
                   "AreaLightSource",
                   "ObjectBegin",
                   "ObjectInstance",
                   "ConcatTransform",
                   "Transform",
                   "Translate",
                   "Scale",
                   "Rotate",
                   "MakeNamedMedium",
                   "MediumInterface",
                   "ReverseOrientation",
                   "CoordinateSystem",
                   "CoordSysTransform"},
                  is_pbrt_value);
}

}  // namespace

std::optional<OtherFile> recognise_other_file(const std::string& path, std::string_view bytes) {
  const auto is = [&path](std::string_view what, std::string_view accepted) {
    // What is a scene of another format is not to be told that it is none.
    const std::string_view wanted = what.ends_with(" scene") ? "a scene of Mitsuba's XML" : "a scene";
    return OtherFile{fmt::format("{} is {}, not {}", quoted(file_name(path), 200), what, wanted),
                     std::string(accepted)};
  };
  if (has_extension(path, ".usdz")) return is("a USD scene", kByBlender);
  if (const FileSignature* signature = file_signature(bytes))
    return is(signature->what, accepted_instead_of(signature->kind));
  Diagnostics unheard;  // of a mesh that is damaged; whoever names it in a scene will hear of that
  if (bytes.starts_with("ply\n") || bytes.starts_with("ply\r"))
    return is("a PLY mesh", scene_around(path, "ply", read_ply(bytes, path, unheard)));
  if (has_extension(path, ".serialized") && bytes.starts_with("\x1c\x04"))
    return is("a mesh file of Mitsuba", scene_around(path, "serialized", read_serialized(bytes, 0, path, unheard)));

  std::string_view text = trim(bytes);
  if (text.starts_with("\xEF\xBB\xBF")) text = trim(text.substr(3));
  if (text.empty()) return is("empty", "a file with a <scene> in it");
  if (text.starts_with('<')) {
    const std::string_view head = text.substr(0, 4096);
    if (contains(head, "<scene")) return std::nullopt;
    if (contains_ignoring_case(head, "<!doctype html") || contains_ignoring_case(head, "<html") ||
        contains_ignoring_case(head.substr(0, 200), "<head>"))
      return is("a page of HTML", "a scene; was the page of a download saved in its place?");
    if (contains(head, "<COLLADA")) return is("a COLLADA scene", kByBlender);
    if (contains(head, "<X3D")) return is("an X3D scene", kByBlender);
    if (contains(head, "<svg")) return is("a drawing (SVG)", "a scene");
    return std::nullopt;
  }
  if (has_extension(path, ".stl") || is_binary_stl(bytes) || text.starts_with("solid "))
    return is("an STL mesh", "a scene; save the mesh as PLY or OBJ for it");
  if (bytes.starts_with("BM") && has_extension(path, ".bmp"))
    return is("a BMP image", accepted_instead_of(FileKind::read_image));
  if (has_extension(path, ".tga")) return is("a TGA image", accepted_instead_of(FileKind::read_image));
  if (is_binary(bytes)) return is("a file of binary data", "a scene of Mitsuba's XML");
  if (contains(bytes.substr(0, 4096), "\0"sv) || bytes.starts_with("\xFE\xFF") || bytes.starts_with("\xFF\xFE"))
    return std::nullopt;  // XML in another encoding
  if (text.starts_with('{') || text.starts_with('[')) {
    if (contains(text, "\"asset\"") && (contains(text, "\"version\"") || has_extension(path, ".gltf")))
      return is("a glTF scene", "a scene of Mitsuba's XML here; glTF's are scenes of their own, named .gltf or .glb");
    if (!has_extension(path, ".pbrt")) return is("JSON", "a scene of Mitsuba's XML");
  }
  if (text.starts_with("version https://git-lfs"))
    return is("the address of a file in Git LFS", "the file itself; 'git lfs pull' fetches it");
  if (has_extension(path, ".pbrt") || has_pbrt_line(text))
    return is("a pbrt scene", "a scene of Mitsuba's XML here; pbrt's are scenes of their own");
  if (has_line(text, {"newmtl"})) return is("a material library of an OBJ mesh", "a scene of Mitsuba's XML");
  if (has_line(text, {"OFF", "COFF", "NOFF", "CNOFF", "STOFF", "4OFF"}))
    return is("an OFF mesh", "a scene; save the mesh as PLY or OBJ for it");
  if (has_line(text, {"v", "vn", "vt", "f", "mtllib"}))
    return is("a Wavefront OBJ mesh", scene_around(path, "obj", read_obj(bytes, path, unheard)));
  if (has_extension(path, ".py") || has_line(text, {"import", "from"}))
    return is("a program in Python", "a scene of Mitsuba's XML; mi.xml.dict_to_xml writes one of a dictionary");
  if (contains(text, "<scene")) return std::nullopt;  // XML behind something else, of which there is more to say
  return is("plain text", "a scene of Mitsuba's XML, which begins with <scene version=\"3.0.0\">");
}

}  // namespace norrsken
