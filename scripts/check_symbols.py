#!/usr/bin/env python3
"""Checks that code compiled for one instruction set cannot be reached before that set was chosen.

    scripts/check_symbols.py SET OBJECT...      SET: scalar, sse42, avx2 or avx512
    scripts/check_symbols.py --self-test [C++ COMPILER]

The kernels are compiled once per instruction set. If such an object also defined, say, the weak symbol
std::vector<float>::resize, the linker might keep that copy for the whole program, and an older processor would meet
an AVX instruction before anything asked what it can do. So every global or weak symbol that an object defines has to
name the object's own namespace, norrsken::isa_SET, or Highway's namespace of that target; and nothing in it may run
before main. Needs nm and c++filt (binutils).
"""
import pathlib
import re
import subprocess
import sys
import tempfile

# The namespaces whose names make a symbol the set's own: ours, and those of Highway's targets that the set may use.
NAMESPACES = {
    "scalar": ["isa_scalar", "N_SCALAR", "N_EMU128"],
    "sse42": ["isa_sse42", "N_SSE4"],
    "avx2": ["isa_avx2", "N_AVX2"],
    "avx512": ["isa_avx512", "N_AVX3", "N_AVX3_DL"],
}

# Code that the loader runs: constructors of globals (GCC, Clang) and resolvers of indirect functions.
STARTUP_NAME = re.compile(r"_GLOBAL__sub_[ID]_|__static_initialization_and_destruction|__cxx_global_var_init")


def own_name(instruction_set):
    """What a mangled name contains if any part of it, arguments included, comes from the set's namespaces.

    Mangled identifiers are length-prefixed. Naming the namespace anywhere is enough: only code that knows that
    namespace can refer to the symbol.
    """
    names = "|".join(f"{len(name)}{name}" for name in NAMESPACES[instruction_set])
    return re.compile(rf"(?<![0-9])(?:{names})")


def violations(instruction_set, objects):
    """Yields a message for every symbol of `objects` that may not be there."""
    own = own_name(instruction_set)
    for path in objects:
        output = subprocess.run(["nm", "--defined-only", str(path)], check=True, capture_output=True, text=True).stdout
        for line in output.splitlines():
            fields = line.split(maxsplit=2)
            if len(fields) != 3:
                continue
            _, kind, name = fields
            if STARTUP_NAME.search(name):
                yield f"{path}: runs before main: {demangle(name)}"
            elif kind == "i":
                yield f"{path}: indirect function, resolved before main: {demangle(name)}"
            elif (kind.isupper() or kind in "uvw") and not own.search(name):
                yield f"{path}: defined outside norrsken::isa_{instruction_set}: {demangle(name)}"


def demangle(name):
    return subprocess.run(["c++filt", name], check=True, capture_output=True, text=True).stdout.strip()


PLANTED = {  # one definition each, and whether it may stand in an object of avx2
    "namespace norrsken::isa_avx2 { int own(int x) { return x + 1; } }": True,
    "namespace norrsken::isa_avx2 { struct S { virtual ~S(); }; S::~S() {} }": True,
    "namespace norrsken::isa_avx2 { struct Ray {}; } template <class T> struct Q { __attribute__((noinline)) "
    "void push(T) { n++; } int n; }; template struct Q<norrsken::isa_avx2::Ray>;": True,
    "namespace norrsken::isa_avx2 { struct V { int x; }; V operator+(V a, V b) { return {a.x + b.x}; } }": True,
    "namespace hwy::N_AVX2 { int own(int x) { return x + 1; } }": True,
    "static int hidden(int x) { return x + 1; } namespace norrsken::isa_avx2 { auto own = &hidden; }": True,
    "namespace norrsken { int shared(int x) { return x + 1; } }": False,
    "namespace norrsken::isa_avx512 { int other(int x) { return x + 1; } }": False,
    "namespace hwy::N_AVX3 { int other(int x) { return x + 1; } }": False,
    "namespace norrsken::isa_avx2x { int longer_name(int x) { return x + 1; } }": False,
    "template <class T> struct V { void grow() { n++; } int n; }; template struct V<float>;": False,
    "inline int counter = 0; namespace norrsken::isa_avx2 { int own() { return ++counter; } }": False,
    "extern \"C\" int plain_c(int x) { return x + 1; }": False,
    "int f(); namespace norrsken::isa_avx2 { int initialised_at_start = f(); }": False,
}


def self_test(compiler):
    """Compiles each planted definition on its own and compares the verdict."""
    with tempfile.TemporaryDirectory() as folder:
        for number, (code, is_fine) in enumerate(PLANTED.items()):
            source, planted = pathlib.Path(folder, f"{number}.cpp"), pathlib.Path(folder, f"{number}.o")
            source.write_text(code + "\n", encoding="utf-8")
            subprocess.run([compiler, "-std=c++20", "-O2", "-c", source, "-o", planted], check=True)
            found = list(violations("avx2", [planted]))
            if is_fine == bool(found):
                raise SystemExit(f"self-test: {'complained about' if found else 'missed'}: {code}\n" + "\n".join(found))
    print(f"self-test: right about all {len(PLANTED)} planted objects")


def main():
    if len(sys.argv) > 1 and sys.argv[1] == "--self-test":
        self_test(sys.argv[2] if len(sys.argv) > 2 else "c++")
        return
    if len(sys.argv) < 3 or sys.argv[1] not in NAMESPACES:
        sys.exit(__doc__)
    messages = list(violations(sys.argv[1], sys.argv[2:]))
    print("\n".join(messages) if messages else f"{len(sys.argv) - 2} objects for {sys.argv[1]}: as designed")
    sys.exit(1 if messages else 0)


if __name__ == "__main__":
    main()
