// Queues between stages, and their records as they are stored.
//
// Owner     a worker's WaveArena (render/wave_arena.h), which holds all its queues in one allocation. A queue is moved and
//           swapped, never copied: two counts for one memory would contradict each other.
// Capacity  fixed when the arena is made. Whoever starts a stage makes sure that what it pushes fits (wave/schedule.h cuts
//           its work into portions where it might not); builds with assertions check it at every push.
// Order     that of the pushes. A stage reads its input from the front, and the lanes of a register are pushed in
//           ascending order, so what has one source stands in the order of its source, whatever the register's width.
// Access    what a stage reads it takes as a const queue, whose fields are const: it cannot be written to.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>

#include "tables/film_view.h"
#include "tables/scene_tables.h"

namespace norrsken {

/// Records as queues store them, in 32-bit words.
namespace stored {

using Float = float;
using UInt = std::uint32_t;
using Vec2f = std::array<float, 2>;
using Vec3f = std::array<float, 3>;
using Color = std::array<float, 3>;
using MapWords = std::array<std::uint32_t, kMostMaps>;
using FeatureValues = std::array<float, kFeatureCount>;

#define NORRSKEN_RECORD(Name) struct Name {
#define NORRSKEN_FIELD(Type, name) Type name;
#define NORRSKEN_FIELD_IF(condition, Type, name, otherwise) Type name;
#define NORRSKEN_RECORD_END \
  }                         \
  ;
#include "tables/records.def"

}  // namespace stored

/// Records in structure-of-arrays form: word k of record i is field(k)[i], integers as their bits. Every field begins at a
/// multiple of 64 bytes and has kMaxLanes values to spare at its end.
template <class Record>
class Queue {
  static_assert(std::is_trivially_copyable_v<Record> && alignof(Record) == sizeof(float));

 public:
  /// One for each word of a record.
  static constexpr std::uint32_t kFields = sizeof(Record) / sizeof(float);

  std::uint32_t count = 0;  ///< records in it

  /// Without memory.
  Queue() = default;
  /// `data` holds kFields times `stride` values.
  Queue(float* data, std::uint32_t stride, std::uint32_t capacity)
      : data_(data), stride_(stride), capacity_(capacity) {}
  Queue(Queue&&) noexcept = default;
  Queue& operator=(Queue&&) noexcept = default;

  std::uint32_t capacity() const { return capacity_; }
  std::size_t stride() const { return stride_; }

  [[gnu::always_inline]] float* field(std::uint32_t k) { return data_ + k * stride(); }
  [[gnu::always_inline]] const float* field(std::uint32_t k) const { return data_ + k * stride(); }
  /// By name; `element` is for vectors and arrays.
  template <class T>
  [[gnu::always_inline]] float* field(T Record::*member, std::uint32_t element = 0) {
    return field(word_of(member) + element);
  }
  template <class T>
  [[gnu::always_inline]] const float* field(T Record::*member, std::uint32_t element = 0) const {
    return field(word_of(member) + element);
  }
  /// Of a record within the record.
  template <class Inner, class T>
  [[gnu::always_inline]] const float* field(Inner Record::*inner, T Inner::*member, std::uint32_t element = 0) const {
    return field(word_of(inner) + Queue<Inner>::word_of(member) + element);
  }

  /// A whole record, for the host.
  Record operator[](std::uint32_t i) const {
    float words[kFields];
    for (std::uint32_t k = 0; k < kFields; ++k) words[k] = field(k)[i];
    Record record;
    std::memcpy(&record, words, sizeof record);
    return record;
  }
  void set(std::uint32_t i, const Record& record) {
    float words[kFields];
    std::memcpy(words, &record, sizeof record);
    for (std::uint32_t k = 0; k < kFields; ++k) field(k)[i] = words[k];
  }

  /// Which word of a record a member begins at.
  template <class T>
  [[gnu::always_inline]] static std::uint32_t word_of(T Record::*member) {
    Record record;
    const auto* const begin = reinterpret_cast<const char*>(&record);
    return static_cast<std::uint32_t>(reinterpret_cast<const char*>(&(record.*member)) - begin) / sizeof(float);
  }

 private:
  float* data_ = nullptr;
  std::uint32_t stride_ = 0;
  std::uint32_t capacity_ = 0;
};

}  // namespace norrsken
