// The functions of special.h on arrays, compiled once per instruction set for special_test.cpp.
#pragma once

#include <cstdint>

namespace norrsken {

enum class SpecialFunction { exp, log, pow, atan2, acos, asin, erf, erf_inv };

struct SpecialCheck {
  const char* name;  ///< the instruction set's
  /// out[i] = f(a[i]), or f(a[i], b[i]) of those that take two. Arrays are aligned to a register and as long as a
  /// multiple of its width.
  void (*evaluate)(SpecialFunction f, const float* a, const float* b, float* out, std::uint32_t count);
};

}  // namespace norrsken
