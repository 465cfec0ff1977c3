// Acceleration structures from the scene's tables, on the host.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <span>
#include <stdexcept>
#include <vector>

#include "accel/bvh/layout.h"
#include "base/memory.h"
#include "tables/accel_tables.h"
#include "tables/scene_tables.h"

namespace norrsken {

/// What the planes and spheres of a small scene are held in. Polygons of every set are in their own planes.
struct PlaneTables {
  std::vector<PlaneRecord> planes;
  std::vector<PolygonRecord> polygons;
  std::vector<PolygonRow> rows;
  PlaneSet all, occluders, emitters;
};

/// Merges coplanar triangles into convex polygons and sorts them into planes.
/// Triangles that differ in what they show by `variation` (layers may show what the surfaces' models do not look at) stay
/// apart.
PlaneTables build_planes(const SceneTables& scene, Variation variation = Variation::none);

/// The spheres in order of their primitives.
Array<SphereRecord> build_spheres(const SceneTables& scene);

/// A shape made of elements, as Embree's callbacks find it.
struct ElementShape {
  const AnalyticRecord* record;
  const float* table;  ///< what its host file left for it
};

/// What an Embree device allocates, in the budget of the scope that it was made in.
class EmbreeMemory {
 public:
  ~EmbreeMemory();
  /// Counts `bytes` that are taken or, below 0, given back. False if there are not so many.
  bool report(std::int64_t bytes, bool is_done) noexcept;
  /// MemoryExceeded if a report was answered so.
  void throw_if_exceeded() const;

 private:
  std::shared_ptr<MemoryBudget> budget_ = MemoryScope::current();
  std::atomic<std::int64_t> taken_{0};
  std::atomic<std::uint64_t> refused_{0};            ///< bytes of the first that was
  std::atomic<std::uint64_t> used_when_refused_{0};  ///< of the budget: a build that fails gives back before it says so
};

/// The world as an Embree scene, with a scene of its own for every group that instances place in it.
class EmbreeScene {
 public:
  /// Borrows both arguments.
  EmbreeScene(const SceneTables& scene, std::span<const SphereRecord> spheres);
  ~EmbreeScene();
  EmbreeScene(const EmbreeScene&) = delete;
  EmbreeScene& operator=(const EmbreeScene&) = delete;

  /// Fills in what the view has of Embree.
  void show(AccelView& view) const;

 private:
  EmbreeScene();  // nothing but a device; from here on the destructor cleans up whatever fails

  void build(const SceneTables& scene, std::span<const SphereRecord> spheres);
  std::uint32_t add_group(const SceneTables& scene, std::span<const SphereRecord> spheres, std::uint32_t group);
  void add_instances(const SceneTables& scene, const std::vector<std::uint32_t>& group_geometries);

  EmbreeMemory memory_;  ///< outlives the device, which reports to it
  void* device_ = nullptr;
  void* positions_ = nullptr;                 ///< RTCBuffer of all vertices
  std::vector<void*> scenes_;                 ///< RTCScene: the world, then the groups
  std::vector<ElementShape> element_shapes_;  ///< one for each of the scene's `analytics`, made of elements or not
  std::vector<EmbreeGeometry> geometries_;
  std::vector<std::uint32_t> instance_geometries_;
  std::uint32_t first_instance_ = 0;
};

/// Up to how many primitives the planes win against Embree: the planes' rate grows with the register's width, Embree's
/// (asked ray by ray) does not. Measured by `benchmarks/intersect_benchmark`, see docs/performance.md; one lane
/// is given the small scenes too, since it serves to debug what the wide ones do.
constexpr std::uint32_t planes_up_to(std::uint32_t lanes) { return lanes > 3 ? 10 * lanes : 32; }

/// Beyond this many the planes are refused even if asked for: merging is quadratic.
inline constexpr std::uint32_t kPlanesAtMost = 4096;

/// Whether a hierarchy of triangles can hold the scene: without groups, and without shapes made of elements.
bool bvh_knows(const SceneTables& scene);

/// What stands beside its triangles is tried one by one; for more than so many Embree is chosen.
inline constexpr std::size_t kBesideBvhAtMost = 32;

/// A structure that could not be built for want of threads, or of memory that nobody counts.
class AccelFailed : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// One of them, with all that its view borrows.
class Accel {
 public:
  /// Analytic primitives and instances are for Embree, the former if bvh_knows() them for the hierarchy too. `threads`: that build a hierarchy, 0 for all of the machine;
  /// Embree decides by itself.
  Accel(const SceneTables& scene, AccelKind kind, Variation variation = Variation::none, int threads = 0);
  const AccelView& view() const { return view_; }

 private:
  PlaneTables planes_;
  Array<SphereRecord> spheres_;
  Array<float> rounding_extents_;
  Bvh bvh_;
  std::unique_ptr<EmbreeScene> embree_;
  AccelView view_;
};

}  // namespace norrsken
