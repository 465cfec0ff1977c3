// glTF, text or binary, compiled up to the tables that are rendered. What it may name lies beside it in memory.
#include "compile/compile.h"
#include "formats/gltf/read_gltf.h"
#include "fuzz/fuzz.h"
#include "scene/memory_files.h"

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
  const MemoryScope scope(std::make_shared<MemoryBudget>(std::uint64_t{256} << 20));
  Diagnostics diagnostics;
  try {
    const auto description = read_gltf(kScene, files, {{"time", "0.5"}}, diagnostics);
    fuzz::require(description.has_value() != diagnostics.has_errors(), "a description or errors");
    if (!description) return 0;
    const auto scene = compile(*description, files, {}, diagnostics);
    diagnostics.sort();
    fuzz::check_complaints(scene.has_value(), diagnostics);
  } catch (const MemoryExceeded&) {
    // Its reader's caller tells of it.
  }
  return 0;
}
