#include "mutants.h"

#include <cstdlib>
#include <string_view>

namespace norrsken::mutants {
namespace {

bool is_switched_on(std::string_view name) {
  const char* wanted = std::getenv("NORRSKEN_MUTANT");
  return wanted != nullptr && name == wanted;
}

}  // namespace

#define NORRSKEN_MUTANT(name) extern const bool name = is_switched_on(#name);
#include "mutants.def"
#undef NORRSKEN_MUTANT

}  // namespace norrsken::mutants
