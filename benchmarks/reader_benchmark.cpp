// How fast mesh files are parsed, in bytes of the file a second: from memory to MeshData, one core. Reading whole scenes
// is measured by scripts/measure_reading.py.
#include <benchmark/benchmark.h>

#include <sstream>
#include <string>

#include "displaced_sphere.h"
#include "formats/mesh_readers.h"

namespace norrsken {
namespace {

using Read = std::optional<MeshData>(std::string_view, const std::string&, Diagnostics&);
using Write = void(const SphereGrid&, std::ostream&);

void parse(benchmark::State& state, Write& write, Read& read, bool bare) {
  std::ostringstream out;
  write(sphere_grid(500000, bare), out);
  const std::string bytes = std::move(out).str();
  for (auto _ : state) {
    Diagnostics diagnostics;
    const auto mesh = read(bytes, "mesh", diagnostics);
    if (!mesh) return state.SkipWithError("the mesh is refused");
    benchmark::DoNotOptimize(mesh->positions.data());
  }
  state.SetBytesProcessed(static_cast<std::int64_t>(state.iterations() * bytes.size()));
}

BENCHMARK_CAPTURE(parse, ply_with_normals_and_uv, write_ply, read_ply, false)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(parse, ply_bare, write_ply, read_ply, true)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(parse, obj_with_normals_and_uv, write_obj, read_obj, false)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(parse, obj_bare, write_obj, read_obj, true)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace norrsken

BENCHMARK_MAIN();
