// The namespace that everything whose code depends on the instruction set lives in. Kernels are compiled once per set,
// each time with NORRSKEN_ISA and NORRSKEN_LANES given by the build, so that the linker can never take one set's
// inline function for another's. Code that is compiled once (the host's) sees the one-lane types in `isa_host`.
#pragma once

#ifndef NORRSKEN_ISA
#define NORRSKEN_ISA isa_host
#define NORRSKEN_LANES 1
#endif

/// Kernel functions are small, nested deeply and must end up in one loop body: a call would spill every register.
#define NORRSKEN_INLINE inline __attribute__((always_inline))
