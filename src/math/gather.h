// Members of a table's records in lanes: gather(scene.shapes, &ShapeRecord::smooth, shape, active).
#pragma once

#include <cstdint>
#include <type_traits>

#include "math/affine.h"

namespace norrsken::NORRSKEN_ISA {

/// Four numbers: three that are a vector, and one more.
struct VectorAndNumber {
  Vec3f vector;
  Float number;
};

/// What a member becomes in lanes: a number of 32 bits, three or four floats, or the twelve of an affine map.
NORRSKEN_INLINE Float gather_member(const float& first, UInt offset, Mask active) {
  return gather(&first, offset, active);
}
template <class T>
requires(std::is_same_v<T, std::uint32_t> ||
         (std::is_enum_v<T> && sizeof(T) == sizeof(std::uint32_t))) NORRSKEN_INLINE UInt
    gather_member(const T& first, UInt offset, Mask active) {
  return gather_uint(reinterpret_cast<const float*>(&first), offset, active);
}
NORRSKEN_INLINE Vec3f gather_member(const float (&first)[3], UInt offset, Mask active) {
  return gather3(first, offset, active);
}
NORRSKEN_INLINE VectorAndNumber gather_member(const float (&first)[4], UInt offset, Mask active) {
  return {gather3(first, offset, active), gather(first + 3, offset, active)};
}
NORRSKEN_INLINE Affine gather_member(const float (&first)[12], UInt offset, Mask active) {
  return gather_affine(first, offset, active);
}

/// Where a lane's record begins, counted in 32-bit words.
template <class Record>
NORRSKEN_INLINE UInt record_offset(UInt index) {
  static_assert(std::is_standard_layout_v<Record> && alignof(Record) == sizeof(float));
  return index * UInt(sizeof(Record) / sizeof(float));
}

/// records[index].*member in the active lanes. `records` has at least one, for inactive lanes may read the first.
template <class Record, class T>
NORRSKEN_INLINE auto gather(const Record* records, T Record::*member, UInt index, Mask active) {
  return gather_member(records->*member, record_offset<Record>(index), active);
}
/// Of a record within the record.
template <class Record, class Inner, class T>
NORRSKEN_INLINE auto gather(const Record* records, Inner Record::*inner, T Inner::*member, UInt index, Mask active) {
  return gather_member(records->*inner.*member, record_offset<Record>(index), active);
}

}  // namespace norrsken::NORRSKEN_ISA
