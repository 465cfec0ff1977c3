// Which of the built instruction sets this processor can run.
#include <cstring>

#include "isa/entry.h"

#if defined(__x86_64__) || defined(__i386__)
#include <cpuid.h>
#endif

namespace norrsken {

#define NORRSKEN_BUILT_ISA(space)  \
  namespace space {                \
  extern const KernelEntry kEntry; \
  }
#include "isa/built.def"
#undef NORRSKEN_BUILT_ISA

namespace {

#if defined(__x86_64__) || defined(__i386__)
/// Half precision, which clang's __builtin_cpu_supports does not know.
bool has_f16c() {
  unsigned eax = 0, ebx = 0, ecx = 0, edx = 0;
  return __get_cpuid(1, &eax, &ebx, &ecx, &edx) != 0 && (ecx & bit_F16C) != 0;
}
#endif

bool processor_can_run(const char* name) {
#if defined(__x86_64__) || defined(__i386__)
  __builtin_cpu_init();
  const bool sse42 = __builtin_cpu_supports("sse4.2");
  const bool avx2 = sse42 && __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") &&
                    __builtin_cpu_supports("bmi") && __builtin_cpu_supports("bmi2") && has_f16c();
  const bool avx512 = avx2 && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
                      __builtin_cpu_supports("avx512cd") && __builtin_cpu_supports("avx512dq") &&
                      __builtin_cpu_supports("avx512vl");
  if (std::strcmp(name, "sse4.2") == 0) return sse42;
  if (std::strcmp(name, "avx2") == 0) return avx2;
  if (std::strcmp(name, "avx512") == 0) return avx512;
#endif
  return std::strcmp(name, "scalar") == 0 || std::strcmp(name, "neon") == 0;
}

struct Usable {
  const KernelEntry* entries[8] = {};
  Usable() {
    std::size_t n = 0;
    for (const KernelEntry* entry : {
#define NORRSKEN_BUILT_ISA(space) &space::kEntry,
#include "isa/built.def"
#undef NORRSKEN_BUILT_ISA
         }) {
      if (processor_can_run(entry->name)) entries[n++] = entry;
    }
  }
};

}  // namespace

const KernelEntry* const* usable_kernels() {
  static const Usable usable;
  return usable.entries;
}

const KernelEntry* find_kernels(const char* name) {
  const KernelEntry* const* entry = usable_kernels();
  if (std::strcmp(name, "auto") == 0) return *entry;
  while (*entry != nullptr && std::strcmp((*entry)->name, name) != 0) ++entry;
  return *entry;
}

}  // namespace norrsken
