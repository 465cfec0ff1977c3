// Scenes in pbrt's language, compiled up to the tables that are rendered. What they may name lies beside them in memory.
#include "formats/pbrt/read_pbrt.h"
#include "fuzz/check_scene.h"

namespace {

constexpr const char* kScene = "scene.pbrt";
constexpr const char* kPly =
    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
    "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace norrsken;
  // Each may compute a table, or draw a picture, that takes as long as the rest of a scene many times over.
  constexpr std::string_view kSlow[] = {"coateddiffuse", "subsurface", "plastic", "substrate", "uber", "spot", "loopsubdiv"};
  const std::string_view text = fuzz::text_of(data, size);
  int slow = 0;
  for (const std::string_view word : kSlow) {
    for (std::size_t at = text.find(word); at != text.npos; at = text.find(word, at + 1)) ++slow;
  }
  if (slow > 4) return 0;
  const MemoryFiles files({{kScene, std::string(text)},
                           {"part.pbrt", "Translate 1 0 0\nShape \"sphere\"\n"},
                           {"self.pbrt", "Include \"self.pbrt\"\n"},
                           {"a.ply", kPly},
                           {"a.ppm", "P3 2 2 255 255 0 0 0 255 0 0 0 255 255 255 255\n"},
                           {"a.spd", "400 0.1\n700 0.5\n"},
                           {"lens.dat", "100 0 1.5 20\n0 5 0 10\n-100 90 1 20\n"}});
  fuzz::check_scene(files, [&](Diagnostics& diagnostics) { return read_pbrt(kScene, files, diagnostics); });
  return 0;
}
