#!/usr/bin/env python3
"""Checks that every test that docs/promises.md names exists.

    scripts/check_promises.py [--self-test]

Tests are named there in backquotes as ctest has them, `Suite.Name`, without what GoogleTest adds for parameters; those that
are no GoogleTest are named by their CMake name.
"""
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
FOLDERS = ("src", "apps", "tests", "fuzz")


def tests_there():
    names = set()
    for folder in FOLDERS:
        for path in (ROOT / folder).rglob("*"):
            if path.suffix == ".cpp":
                text = path.read_text(encoding="utf-8", errors="replace")
                names.update(".".join(match) for match in re.findall(r"TEST(?:_F|_P)?\(\s*(\w+),\s*(\w+)\s*\)", text))
                names.update(".".join(match) for match in re.findall(r"TYPED_TEST(?:_P)?\(\s*(\w+),\s*(\w+)\s*\)", text))
            elif path.name == "CMakeLists.txt":
                text = path.read_text(encoding="utf-8")
                names.update(re.findall(r"add_test\(\s*NAME\s+(\S+)", text))
                names.update("Fuzz." + name for name in re.findall(r"norrsken_fuzz_target\(\s*(\w+)", text))
                for listed in re.findall(r"foreach\(name ([\w\s]+)\)\s*norrsken_fuzz_target", text):
                    names.update("Fuzz." + name for name in listed.split())
            elif path.suffix == ".cmake":
                text = path.read_text(encoding="utf-8")
                names.update("Mutants." + name for name in re.findall(r"norrsken_mutant\(\s*(\w+)", text))
    return names


def tests_named(text):
    """What stands in backquotes in the tables' last columns."""
    named = []
    for line in text.splitlines():
        if line.startswith("| ") and "`" in line.rsplit("|", 2)[-2]:
            named += re.findall(r"`([^`]+)`", line.rsplit("|", 2)[-2])
    return named


def missing(text):
    there = tests_there()
    return [name for name in tests_named(text) if name not in there]


def main():
    if sys.argv[1:] == ["--self-test"]:
        found = missing("| a promise | `Cli.InterruptSavesAndSays`, `Cli.NobodyWroteThis` |\n")
        sys.exit(0 if found == ["Cli.NobodyWroteThis"] else f"expected one missing test, found {found}")
    text = (ROOT / "docs/promises.md").read_text(encoding="utf-8")
    if not tests_named(text):
        sys.exit("docs/promises.md names no test")
    absent = missing(text)
    for name in absent:
        print(f"docs/promises.md names {name}, which is no test", file=sys.stderr)
    sys.exit(1 if absent else 0)


if __name__ == "__main__":
    main()
