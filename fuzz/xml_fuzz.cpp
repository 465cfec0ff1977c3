// Scene files, compiled up to the tables that are rendered. What they may name lies beside them in memory.
#include "compile/compile.h"
#include "formats/mitsuba_xml.h"
#include "fuzz/fuzz.h"
#include "scene/memory_files.h"

namespace {

constexpr const char* kScene = "scene.xml";
constexpr const char* kPart = R"(<scene version="3.0.0">
  <default name="r" value="0.5"/><bsdf type="diffuse" id="m"><float name="reflectance" value="$r"/></bsdf>
</scene>)";
constexpr const char* kObj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nf 1/1 2/1 3/1\n";
constexpr const char* kPly =
    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nproperty float r\n"
    "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0 1\n1 0 0 1\n0 1 0 1\n3 0 1 2\n";
constexpr const char* kCurve = "0 0 0 .1\n0 1 0 .1\n0 2 0 .1\n0 3 0 .1\n";

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace norrsken;
  // Each may compute a table of its own, which takes as long as the rest of a scene many times over.
  constexpr std::string_view kSlow = "roughplastic";
  const std::string_view text = fuzz::text_of(data, size);
  int slow = 0;
  for (std::size_t at = text.find(kSlow); at != text.npos; at = text.find(kSlow, at + 1)) ++slow;
  if (slow > 8) return 0;
  const MemoryFiles files({{kScene, std::string(text)},
                           {"part.xml", kPart},
                           {"self.xml", "<scene version=\"3.0.0\"><include filename=\"self.xml\"/></scene>"},
                           {"a.obj", kObj},
                           {"a.ply", kPly},
                           {"a.txt", kCurve},
                           {"a.spd", "400 0.1\n700 0.5\n"},
                           {"folder/a.obj", kObj}});
  Diagnostics diagnostics;
  const auto description = read_mitsuba_xml(kScene, files, {}, diagnostics);
  fuzz::require(description || diagnostics.has_errors(), "a description or errors");
  if (!description) return 0;
  const auto scene = compile(*description, files, {}, diagnostics);
  diagnostics.sort();
  fuzz::check_complaints(scene.has_value(), diagnostics);
  return 0;
}
