// Every lane type that was built and that this processor runs, against plain floats.
#include <gtest/gtest.h>

#include <memory>
#include <random>
#include <vector>

#include "isa/entry.h"
#include "simd/lanes_testing.h"

namespace norrsken {

#define NORRSKEN_BUILT_ISA(space)    \
  namespace space {                  \
  extern const LaneCheck kLaneCheck; \
  }
#include "isa/built.def"
#undef NORRSKEN_BUILT_ISA

namespace {

std::vector<const LaneCheck*> usable_checks() {
  std::vector<const LaneCheck*> checks;
  for (const LaneCheck* check : {
#define NORRSKEN_BUILT_ISA(space) &space::kLaneCheck,
#include "isa/built.def"
#undef NORRSKEN_BUILT_ISA
       }) {
    if (find_kernels(check->name) != nullptr) checks.push_back(check);
  }
  return checks;
}

void expect_clean(const LaneCheck& check, const LaneReport& report) {
  EXPECT_GT(report.checks, 0u);
  EXPECT_EQ(report.failures, 0u) << check.name << ": " << report.first << ", mask or tail " << report.pattern
                                 << ", lane " << report.lane << ": got " << report.got << ", wanted " << report.wanted;
}

TEST(Lanes, EveryMaskPattern) {
  for (const LaneCheck* check : usable_checks()) {
    LaneReport report;
    check->all_masks(report);
    expect_clean(*check, report);
  }
}

TEST(Lanes, EveryTailLength) {
  for (const LaneCheck* check : usable_checks()) {
    LaneReport report;
    check->tails(report);
    expect_clean(*check, report);
  }
}

TEST(Lanes, ArithmeticIsThatOfPlainFloats) {
  struct alignas(64) Block {
    float v[1024];
  };
  const auto a = std::make_unique<Block>(), b = std::make_unique<Block>(), c = std::make_unique<Block>();
  std::mt19937 random(7);
  std::uniform_real_distribution<float> value(-1000.0f, 1000.0f);
  for (int i = 0; i < 1024; ++i) a->v[i] = value(random), b->v[i] = value(random), c->v[i] = value(random);
  for (const LaneCheck* check : usable_checks()) {
    LaneReport report;
    check->arithmetic(a->v, b->v, c->v, 1024, report);
    expect_clean(*check, report);
  }
}

}  // namespace
}  // namespace norrsken
