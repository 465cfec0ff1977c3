// Which probe belongs to which instruction set.
#include <cstring>

#include "isa/probe_testing.h"

namespace norrsken {

#define NORRSKEN_BUILT_ISA(space)  \
  namespace space {                \
  extern const KernelProbe kProbe; \
  }
#include "isa/built.def"
#undef NORRSKEN_BUILT_ISA

const KernelProbe& probe_of(const KernelEntry& kernels) {
  const KernelProbe* found = nullptr;
  for (const KernelProbe* probe : {
#define NORRSKEN_BUILT_ISA(space) &space::kProbe,
#include "isa/built.def"
#undef NORRSKEN_BUILT_ISA
       }) {
    if (std::strcmp(probe->name, kernels.name) == 0) found = probe;
  }
  return *found;
}

}  // namespace norrsken
