#include "simd/lanes_testing.h"

#include <type_traits>

#include "simd/lanes.h"

namespace norrsken::NORRSKEN_ISA {

static_assert(kLanes == 1 || (!std::is_convertible_v<bool, Mask> && !std::is_constructible_v<Mask, bool>),
              "a comparison of plain numbers is no mask: it would be the first lane's");

namespace {

void expect(bool ok, const char* what, std::uint32_t pattern, int lane, float got, float wanted, LaneReport& report) {
  ++report.checks;
  if (ok) return;
  if (report.failures++ == 0) {
    report.first = what, report.pattern = pattern, report.lane = lane, report.got = got, report.wanted = wanted;
  }
}

bool same_bits(float a, float b) { return __builtin_memcmp(&a, &b, sizeof a) == 0; }

Mask mask_of(std::uint32_t pattern) {
  alignas(64) float on[kLanes];
  for (int i = 0; i < kLanes; ++i) on[i] = static_cast<float>((pattern >> i) & 1u);
  return load(on) > Float(0.5f);
}

void check_all_masks(LaneReport& report) {
  alignas(64) float a[kLanes], b[kLanes], index[kLanes], table[3 * kLanes], out[3 * kLanes];
  for (int i = 0; i < kLanes; ++i) a[i] = static_cast<float>(i + 1), b[i] = static_cast<float>(-i - 1);
  for (int i = 0; i < 3 * kLanes; ++i) table[i] = static_cast<float>(1000 + i);
  for (std::uint32_t pattern = 0; pattern < (1u << kLanes); ++pattern) {
    const Mask m = mask_of(pattern);
    const auto active = static_cast<std::uint32_t>(__builtin_popcount(pattern));
    const std::uint32_t full = (1u << kLanes) - 1u;
    expect(to_bits(m) == pattern, "to_bits", pattern, 0, static_cast<float>(to_bits(m)), 0, report);
    expect(count(m) == active, "count", pattern, 0, static_cast<float>(count(m)), static_cast<float>(active), report);
    expect(any(m) == (pattern != 0), "any", pattern, 0, any(m), pattern != 0, report);
    expect(none(m) == (pattern == 0), "none", pattern, 0, none(m), pattern == 0, report);
    expect(all(m) == (pattern == full), "all", pattern, 0, all(m), pattern == full, report);
    expect(to_bits(!m) == (pattern ^ full), "not", pattern, 0, static_cast<float>(to_bits(!m)), 0, report);

    store(out, select(m, load(a), load(b)));
    for (int i = 0; i < kLanes; ++i) {
      const float wanted = (pattern >> i) & 1u ? a[i] : b[i];
      expect(out[i] == wanted, "select", pattern, i, out[i], wanted, report);
    }

    // Inactive lanes hold an index far outside: touching it would crash.
    for (int i = 0; i < kLanes; ++i) {
      const std::uint32_t word = (pattern >> i) & 1u ? static_cast<std::uint32_t>(3 * i) : 0x3fffffffu;
      __builtin_memcpy(&index[i], &word, sizeof word);
    }
    store(out, gather(table, load_uint(index), m));
    for (int i = 0; i < kLanes; ++i) {
      if (((pattern >> i) & 1u) == 0) continue;
      expect(out[i] == table[3 * i], "gather", pattern, i, out[i], table[3 * i], report);
    }

    for (float& value : out) value = -7.0f;
    compress_store(out + 1, load(a), make_compaction(m));
    int at = 1;
    for (int i = 0; i < kLanes; ++i) {
      if (((pattern >> i) & 1u) == 0) continue;
      expect(out[at] == a[i], "compress_store", pattern, i, out[at], a[i], report);
      ++at;
    }
    expect(out[0] == -7.0f, "compress_store, before", pattern, 0, out[0], -7.0f, report);
    expect(out[1 + kLanes] == -7.0f, "compress_store, behind", pattern, kLanes, out[1 + kLanes], -7.0f, report);
  }
}

void check_tails(LaneReport& report) {
  for (std::uint32_t n = 0; n <= 2u * kLanes; ++n) {
    const std::uint32_t wanted = n >= static_cast<std::uint32_t>(kLanes) ? (1u << kLanes) - 1u : (1u << n) - 1u;
    expect(to_bits(first_lanes(n)) == wanted, "first_lanes", n, 0, static_cast<float>(to_bits(first_lanes(n))),
           static_cast<float>(wanted), report);
  }
}

#define NORRSKEN_CHECK_LANES(lanes, scalar)                                    \
  do {                                                                         \
    store(out, lanes);                                                         \
    for (int k = 0; k < kLanes; ++k) {                                         \
      const float x = a[i + k], y = b[i + k], z = c[i + k];                    \
      (void)x, (void)y, (void)z;                                               \
      const float wanted = scalar;                                             \
      expect(same_bits(out[k], wanted), #lanes, 0, k, out[k], wanted, report); \
    }                                                                          \
  } while (false)

float plain_fma(float x, float y, float z) {
#if defined(__FMA__) || defined(__aarch64__)
  return __builtin_fmaf(x, y, z);
#else
  return x * y + z;
#endif
}

std::uint32_t word_of(float x) {
  std::uint32_t word;
  __builtin_memcpy(&word, &x, sizeof word);
  return word;
}
float float_of(std::uint32_t word) {
  float x;
  __builtin_memcpy(&x, &word, sizeof x);
  return x;
}

void check_arithmetic(const float* a, const float* b, const float* c, std::uint32_t count, LaneReport& report) {
  alignas(64) float out[kLanes];
  for (std::uint32_t i = 0; i < count; i += kLanes) {
    const Float p = load(a + i), q = load(b + i), r = load(c + i);
    NORRSKEN_CHECK_LANES(p + q, x + y);
    NORRSKEN_CHECK_LANES(p - q, x - y);
    NORRSKEN_CHECK_LANES(p * q, x * y);
    NORRSKEN_CHECK_LANES(p / q, x / y);
    NORRSKEN_CHECK_LANES(-p, -x);
    NORRSKEN_CHECK_LANES(fma(p, q, r), plain_fma(x, y, z));
    NORRSKEN_CHECK_LANES(fms(p, q, r), plain_fma(x, y, -z));
    NORRSKEN_CHECK_LANES(fnma(p, q, r), plain_fma(-x, y, z));
    NORRSKEN_CHECK_LANES(sqrt(abs(p)), __builtin_sqrtf(__builtin_fabsf(x)));
    NORRSKEN_CHECK_LANES(min(p, q), (x < y ? x : y));
    NORRSKEN_CHECK_LANES(max(p, q), (x > y ? x : y));
    NORRSKEN_CHECK_LANES(round(p), __builtin_rintf(x));
    NORRSKEN_CHECK_LANES(floor(p), __builtin_floorf(x));
    NORRSKEN_CHECK_LANES(copysign(p, q), __builtin_copysignf(x, y));
    NORRSKEN_CHECK_LANES(select(p < q, p, r), (x < y ? x : z));
    NORRSKEN_CHECK_LANES(select(p >= q, p, r), (x >= y ? x : z));
    // The root of what is negative is no number: not even equal to itself.
    NORRSKEN_CHECK_LANES(select(sqrt(p) == sqrt(p), p, r), (x < 0 ? z : x));
    NORRSKEN_CHECK_LANES(select(sqrt(p) != sqrt(p), p, r), (x < 0 ? x : z));
    NORRSKEN_CHECK_LANES(from_bits(bits(p) * bits(q)), float_of(word_of(x) * word_of(y)));
    NORRSKEN_CHECK_LANES(from_bits(bits(p) + bits(q)), float_of(word_of(x) + word_of(y)));
    NORRSKEN_CHECK_LANES(from_bits(shift_right<3>(bits(p)) ^ shift_left<5>(bits(q))),
                         float_of((word_of(x) >> 3) ^ (word_of(y) << 5)));
    NORRSKEN_CHECK_LANES(to_float(shift_right<8>(bits(p))), static_cast<float>(word_of(x) >> 8));
    NORRSKEN_CHECK_LANES(to_float(to_uint(abs(p))), static_cast<float>(static_cast<std::uint32_t>(__builtin_fabsf(x))));
  }
}

}  // namespace

extern const LaneCheck kLaneCheck;
const LaneCheck kLaneCheck = {NORRSKEN_ISA_NAME, kLanes, check_all_masks, check_tails, check_arithmetic};

}  // namespace norrsken::NORRSKEN_ISA
