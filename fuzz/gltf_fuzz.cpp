// glTF, text or binary, compiled up to the tables that are rendered. What it may name lies beside it in memory.
#include "formats/gltf/read_gltf.h"
#include "fuzz/check_scene.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace norrsken;
  constexpr const char* kScene = "scene.gltf";
  const std::string_view text = fuzz::text_of(data, size);
  // Each draws a picture that takes as long as the rest of a scene many times over.
  int slow = 0;
  for (std::size_t at = text.find("spot"); at != text.npos; at = text.find("spot", at + 1)) ++slow;
  if (slow > 6) return 0;
  std::string buffer;
  for (int i = 0; i < 1024; ++i) buffer += static_cast<char>(i * 37 % 64);
  const MemoryFiles files({{kScene, std::string(text)},
                           {"b.bin", buffer},
                           {"a.ppm", "P3 2 2 255 255 0 0 0 255 0 0 0 255 255 255 255\n"}});
  fuzz::check_scene(files, [&](Diagnostics& diagnostics) { return read_gltf(kScene, files, {{"time", "0.5"}}, diagnostics); });
  return 0;
}
