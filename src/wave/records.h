// Records of paths in lanes, and how they go in and out of queues. What they hold is told in tables/records.def.
#pragma once

#include <cassert>
#include <concepts>
#include <cstddef>
#include <type_traits>

#include "color/color.h"
#include "math/warp.h"
#include "tables/wave_types.h"

namespace norrsken::NORRSKEN_ISA {

using MapWords = UInt[kMostMaps];
using FeatureValues = Float[kFeatureCount];

#define NORRSKEN_RECORD(Name) \
  struct Name {               \
    using Stored = stored::Name;
#define NORRSKEN_FIELD(Type, name) Type name;
#define NORRSKEN_FIELD_IF(condition, Type, name, otherwise) Type name = otherwise;
#define NORRSKEN_RECORD_END \
  }                         \
  ;
#include "tables/records.def"

using Slots = Queue<stored::Slot>;
using Rays = Queue<stored::Ray>;
using Hits = Queue<stored::Hit>;
using ShadowRays = Queue<stored::ShadowRay>;
using Scatters = Queue<stored::Scatter>;
using Connections = Queue<stored::Connection>;
using Splats = Queue<stored::Splat>;

/// Calls visit(k, field) for the fields that a queue of this scene holds; k is the field's first word.
#define NORRSKEN_RECORD(Name)                                                                  \
  template <class Scene, class Lanes, class Visit>                                             \
  requires std::same_as<std::remove_const_t<Lanes>, Name> NORRSKEN_INLINE void for_each_field( \
      [[maybe_unused]] const Scene& scene, Lanes& record, const Visit& visit) {                \
    using Stored = stored::Name;
#define NORRSKEN_FIELD(Type, name) visit(std::uint32_t{offsetof(Stored, name) / sizeof(float)}, record.name);
#define NORRSKEN_FIELD_IF(condition, Type, name, otherwise) \
  if (condition) NORRSKEN_FIELD(Type, name)
#define NORRSKEN_RECORD_END }
#include "tables/records.def"

/// A struct of lanes that queues store as `Stored`.
template <class T>
concept LaneRecord = requires {
  typename T::Stored;
};

/// Loads the fields whose first register is `at`, their words `stride` apart.
template <class Scene>
struct FieldLoader {
  const Scene& scene;
  const float* at;
  std::size_t stride;

  NORRSKEN_INLINE void operator()(std::uint32_t k, Float& value) const { value = load(at + k * stride); }
  NORRSKEN_INLINE void operator()(std::uint32_t k, UInt& value) const { value = load_uint(at + k * stride); }
  NORRSKEN_INLINE void operator()(std::uint32_t k, Vec2f& value) const { (*this)(k, value.x), (*this)(k + 1, value.y); }
  NORRSKEN_INLINE void operator()(std::uint32_t k, Vec3f& value) const {
    (*this)(k, value.x), (*this)(k + 1, value.y), (*this)(k + 2, value.z);
  }
  NORRSKEN_INLINE void operator()(std::uint32_t k, Color& value) const {
    (*this)(k, value.r), (*this)(k + 1, value.g), (*this)(k + 2, value.b);
  }
  template <class T, std::size_t n>
  NORRSKEN_INLINE void operator()(std::uint32_t k, T (&values)[n]) const {
    for (std::uint32_t i = 0; i < n; ++i) (*this)(k + i, values[i]);
  }
  template <LaneRecord T>
  NORRSKEN_INLINE void operator()(std::uint32_t k, T& record) const {
    for_each_field(scene, record, FieldLoader{scene, at + k * stride, stride});
  }
};

/// Stores the active lanes of fields one behind the other.
template <class Scene>
struct FieldStorer {
  const Scene& scene;
  float* at;
  std::size_t stride;
  const Compaction& lanes;

  NORRSKEN_INLINE void operator()(std::uint32_t k, Float value) const { compress_store(at + k * stride, value, lanes); }
  NORRSKEN_INLINE void operator()(std::uint32_t k, UInt value) const { compress_store(at + k * stride, value, lanes); }
  NORRSKEN_INLINE void operator()(std::uint32_t k, const Vec2f& value) const {
    (*this)(k, value.x), (*this)(k + 1, value.y);
  }
  NORRSKEN_INLINE void operator()(std::uint32_t k, const Vec3f& value) const {
    (*this)(k, value.x), (*this)(k + 1, value.y), (*this)(k + 2, value.z);
  }
  NORRSKEN_INLINE void operator()(std::uint32_t k, const Color& value) const {
    (*this)(k, value.r), (*this)(k + 1, value.g), (*this)(k + 2, value.b);
  }
  template <class T, std::size_t n>
  NORRSKEN_INLINE void operator()(std::uint32_t k, const T (&values)[n]) const {
    for (std::uint32_t i = 0; i < n; ++i) (*this)(k + i, values[i]);
  }
  template <LaneRecord T>
  NORRSKEN_INLINE void operator()(std::uint32_t k, const T& record) const {
    for_each_field(scene, record, FieldStorer{scene, at + k * stride, stride, lanes});
  }
};

/// The records from `i` on, which begins a register. `Scene`, here and below: SceneView or PlainScene.
template <LaneRecord T, class Scene>
NORRSKEN_INLINE T load(const Scene& scene, const Queue<typename T::Stored>& queue, std::uint32_t i) {
  T record;
  for_each_field(scene, record, FieldLoader<Scene>{scene, queue.field(0u) + i, queue.stride()});
  return record;
}

/// Puts the active lanes behind the queue's end.
template <LaneRecord T, class Scene>
NORRSKEN_INLINE void push(const Scene& scene, Queue<typename T::Stored>& queue, const T& record, Mask active) {
  const Compaction lanes = make_compaction(active);
  assert(lanes.count <= queue.capacity() - queue.count);
  for_each_field(scene, record, FieldStorer<Scene>{scene, queue.field(0u) + queue.count, queue.stride(), lanes});
  queue.count += lanes.count;
}

}  // namespace norrsken::NORRSKEN_ISA
