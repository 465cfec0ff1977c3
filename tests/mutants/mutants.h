// The faults, of which NORRSKEN_MUTANT in the environment switches one on. Included before everything else into sources
// that have them; mutants.def is written by the build, from the list in CMakeLists.txt.
#pragma once

namespace norrsken::mutants {

#define NORRSKEN_MUTANT(name) extern const bool name;
#include "mutants.def"
#undef NORRSKEN_MUTANT

}  // namespace norrsken::mutants
