// Stanford PLY files.
#include "fuzz/mesh_check.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace norrsken;
  return fuzz::fuzz_mesh([&](Diagnostics& d) { return read_ply(fuzz::text_of(data, size), "input.ply", d); });
}
