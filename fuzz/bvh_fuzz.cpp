// The hierarchy of triangles, built of any numbers: two bytes of how many vertices and how their coordinates are read, the
// vertices, then triangles by their corners' numbers; whatever is left are rays.
#include <cmath>
#include <cstring>
#include <vector>

#include "accel/build.h"
#include "base/aligned.h"
#include "fuzz/byte_source.h"
#include "isa/probe_testing.h"
#include "render/scene_view.h"

namespace norrsken::fuzz {
namespace {

/// Any float at all, or one of a few, so that corners and planes coincide.
float coordinate(ByteSource& bytes, bool any) {
  if (!any) return static_cast<float>(bytes.below(7) - 3);
  const std::uint32_t word =
      bytes.byte() | bytes.byte() << 8 | bytes.byte() << 16 | static_cast<std::uint32_t>(bytes.byte()) << 24;
  float value;
  std::memcpy(&value, &word, sizeof value);
  return value;
}

SceneTables tables_of(ByteSource& bytes) {
  SceneTables tables;
  const int vertices = 1 + bytes.byte();
  const int any = bytes.below(3);
  for (int i = 0; i < 3 * vertices; ++i)
    tables.positions.push_back(coordinate(bytes, any == 2 || (any == 1 && i % 5 == 0)));
  const int triangles = bytes.byte() | (bytes.byte() & 3) << 8;
  for (int i = 0; i < 3 * triangles; ++i)
    tables.triangle_vertices.push_back(static_cast<std::uint32_t>(bytes.below(vertices)));
  tables.surfaces.resize(static_cast<std::size_t>(triangles));
  tables.shapes.resize(1);
  tables.shapes[0].primitive_count = static_cast<std::uint32_t>(triangles);
  return tables;
}

void check(ByteSource& bytes) {
  const SceneTables tables = tables_of(bytes);
  const Accel accel(tables, AccelKind::bvh, Variation::none, 1), by_many(tables, AccelKind::bvh, Variation::none, 3);
  const SceneView view = make_scene_view(tables, accel.view()), view_by_many = make_scene_view(tables, by_many.view());
  constexpr std::uint32_t kRays = 64;
  AlignedVector<float> values(7 * kRays), t(kRays), t_by_many(kRays);
  AlignedVector<std::uint32_t> primitive(kRays), primitive_by_many(kRays);
  AlignedVector<std::uint8_t> occluded(kRays);
  const bool any = bytes.flag();
  for (std::uint32_t i = 0; i < 6 * kRays; ++i) values[i] = coordinate(bytes, any && i % 3 == 0);
  for (std::uint32_t i = 0; i < kRays; ++i) values[6 * kRays + i] = __builtin_inff();
  const auto field = [&](std::uint32_t k) { return values.data() + k * kRays; };
  const RayArrays rays{field(0), field(1), field(2), field(3), field(4), field(5), kRays};
  for (const KernelEntry* const* k = usable_kernels(); *k != nullptr; ++k) {
    probe_of(**k).closest_rays(view, false, rays, t.data(), primitive.data());
    probe_of(**k).closest_rays(view_by_many, false, rays, t_by_many.data(), primitive_by_many.data());
    (*k)->occluded_rays(view, rays, field(6), occluded.data());
    for (std::uint32_t i = 0; i < kRays; ++i) {
      const bool hit = primitive[i] != kNone;
      require(!hit || (primitive[i] & 0x7fffffffu) < tables.triangle_count(), "what is hit is there");
      require(!hit || (t[i] > 0 && std::isfinite(t[i])), "at a distance");
      require(hit == (occluded[i] != 0), "what hits something is occluded");
      require(primitive[i] == primitive_by_many[i] && std::memcmp(&t[i], &t_by_many[i], sizeof t[i]) == 0,
              "the tree does not depend on the threads");
    }
  }
}

}  // namespace
}  // namespace norrsken::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  norrsken::fuzz::ByteSource bytes(data, size);
  norrsken::fuzz::check(bytes);
  return 0;
}
