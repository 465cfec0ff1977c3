#include "math/special_testing.h"

#include "math/special.h"

namespace norrsken::NORRSKEN_ISA {
namespace {

Float evaluate(SpecialFunction f, Float a, Float b) {
  switch (f) {
    case SpecialFunction::exp:
      return exp(a);
    case SpecialFunction::log:
      return log(a);
    case SpecialFunction::pow:
      return pow(a, b);
    case SpecialFunction::atan2:
      return atan2(a, b);
    case SpecialFunction::acos:
      return acos(a);
    case SpecialFunction::asin:
      return asin(a);
    case SpecialFunction::erf:
      return erf(a);
    case SpecialFunction::erf_inv:
      return erf_inv(a);
  }
  return Float(0.0f);
}

void evaluate_all(SpecialFunction f, const float* a, const float* b, float* out, std::uint32_t count) {
  for (std::uint32_t i = 0; i < count; i += kLanes) store(out + i, evaluate(f, load(a + i), load(b + i)));
}

}  // namespace

extern const SpecialCheck kSpecialCheck;
const SpecialCheck kSpecialCheck = {NORRSKEN_ISA_NAME, evaluate_all};

}  // namespace norrsken::NORRSKEN_ISA
