#include "isa/entry.h"
#include "model_kernels.h"

namespace norrsken {

#define NORRSKEN_BUILT_ISA(space)          \
  namespace space {                        \
  extern const ModelKernels kModelKernels; \
  }
#include "isa/built.def"
#undef NORRSKEN_BUILT_ISA

std::vector<const ModelKernels*> usable_model_kernels() {
  std::vector<const ModelKernels*> usable;
  for (const ModelKernels* kernels : {
#define NORRSKEN_BUILT_ISA(space) &space::kModelKernels,
#include "isa/built.def"
#undef NORRSKEN_BUILT_ISA
       }) {
    if (find_kernels(kernels->name) != nullptr) usable.push_back(kernels);
  }
  return usable;
}

}  // namespace norrsken
