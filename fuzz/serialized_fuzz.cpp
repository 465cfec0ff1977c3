// Mitsuba's serialized meshes. The last byte is the number of the mesh; without it the rest is the file.
#include "fuzz/mesh_check.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace norrsken;
  if (size == 0) return 0;
  return fuzz::fuzz_mesh([&](Diagnostics& d) {
    return read_serialized(fuzz::text_of(data, size - 1), data[size - 1], "input.serialized", d);
  });
}
