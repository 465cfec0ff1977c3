#!/usr/bin/env python3
"""Runs clang-tidy with the checks of .clang-tidy; every complaint is an error.

    scripts/check_tidy.py [--build build/release] [-j N] [--all | FILE...]

Without files: every source of the library and the command line. --all adds tests and benchmarks, whose GoogleTest
macros take clang-tidy several times as long. A file that is compiled once per instruction set is checked for one.
"""
import argparse
import concurrent.futures
import json
import os
import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
PREFERRED_SET = "isa_avx2"  # of a file that is compiled several times: the richest code that Clang 14 knows well
# Options of GCC that Clang does not have.
UNKNOWN_TO_CLANG = ("-mprefer-vector-width=512", "-fno-fast-math", "-Wno-restrict", "--param=", "-mmove-max=",
                    "-mstore-max=")


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--build", type=pathlib.Path, default=ROOT / "build/release", help="a configured build folder")
    parser.add_argument("-j", type=int, default=os.cpu_count(), help="files at a time")
    parser.add_argument("--all", action="store_true", help="tests and benchmarks as well")
    parser.add_argument("files", nargs="*", type=pathlib.Path)
    return parser.parse_args()


def is_wanted(path, options):
    if options.files:
        return path in [file.resolve() for file in options.files]
    if not path.is_relative_to(ROOT) or "build" in path.relative_to(ROOT).parts:
        return False
    return options.all or (not path.stem.endswith("_test") and path.relative_to(ROOT).parts[0] in ("src", "apps"))


def commands_to_check(options):
    """The entries of the compilation database to check, one per file."""
    chosen = {}
    for entry in json.loads((options.build / "compile_commands.json").read_text(encoding="utf-8")):
        path = pathlib.Path(entry["file"]).resolve()
        if is_wanted(path, options) and (path not in chosen or PREFERRED_SET in entry["command"]):
            words = [word for word in entry["command"].split(" ") if not word.startswith(UNKNOWN_TO_CLANG)]
            chosen[path] = entry | {"command": " ".join(words)}
    return chosen


def main():
    options = arguments()
    chosen = commands_to_check(options)
    if not chosen:
        sys.exit(f"nothing to check in {options.build}/compile_commands.json")
    with tempfile.TemporaryDirectory() as folder, concurrent.futures.ThreadPoolExecutor(options.j) as pool:
        pathlib.Path(folder, "compile_commands.json").write_text(json.dumps(list(chosen.values())), encoding="utf-8")

        def tidy(path):
            return subprocess.run(["clang-tidy", "--quiet", "-p", folder, str(path)], capture_output=True, text=True)

        failed = 0
        for future in concurrent.futures.as_completed(pool.submit(tidy, path) for path in chosen):
            result = future.result()
            if result.returncode != 0:
                failed += 1
                print(result.stdout or result.stderr, flush=True)
    if failed:
        sys.exit(f"clang-tidy: complaints about {failed} of {len(chosen)} files")
    print(f"clang-tidy: nothing to complain about in {len(chosen)} files")


if __name__ == "__main__":
    main()
