#!/usr/bin/env python3
"""Checks that the sources include each other only along the arrows of the architecture.

    scripts/check_includes.py [ROOT]
    scripts/check_includes.py --self-test

Prints `file:line: what is wrong` for each violation; exit status 1 if there is any. The tables below are the
architecture's one place; docs/dev/architecture.md explains it in words.
"""
import pathlib
import re
import sys
import tempfile

# The plugin families. A file of one never includes another's but where the table says so. The models of a family, which
# are what its models.h includes, never include each other: only models.h and a model's own files include it.
FAMILIES = ["bsdf", "camera", "integrator", "light", "medium", "rfilter", "sampler", "shape", "texture"]

PUBLIC = "norrsken"  # include/norrsken

# Which rooms (folders below src/, and PUBLIC) a room may include, besides itself. Kernel code runs per ray, host code once
# per scene or image.
KERNEL_BASE = ["base", "lists", "simd", "math", "color", "tables"]
KERNEL_ROOMS = {
    "simd": ["base"],
    "math": ["base", "simd"],
    **{family: KERNEL_BASE for family in FAMILIES},
    "bsdf": KERNEL_BASE + ["texture"],            # whose parameters may be textures
    "light": KERNEL_BASE + ["shape", "texture"],  # which may have the form of any shape
    "medium": KERNEL_BASE + ["texture"],          # whose slots it reads
    "wave": KERNEL_BASE + FAMILIES + ["accel"],
}
HOST_ROOMS = {
    "base": [PUBLIC],
    "lists": [],
    "color": [PUBLIC, "base", "simd", "math"],
    "tables": ["base", "lists"],
    "scene": [PUBLIC, "base", "color"],
    "image": [PUBLIC, "base", "color"],
    "formats": [PUBLIC, "base", "color", "scene", "image"],
    "compile": [PUBLIC, "base", "lists", "color", "tables", "image", "scene", "formats"],
    "accel": [PUBLIC, "shape"] + KERNEL_BASE,
    "isa": [PUBLIC, "accel", "wave"] + KERNEL_BASE,
    "film": [PUBLIC, "base", "color", "tables"],
    "render": [PUBLIC, "base", "lists", "color", "tables", "scene", "formats", "compile", "accel", "isa", "film"],
}
# The host's side of a family, its .cpp files and *_host.h: it reads the description and the files that it names, and
# writes the tables through what src/compile offers to plugins.
FAMILY_HOST = [PUBLIC, "scene", "formats", "compile"]

# Libraries and where they may be included; unlisted libraries are free.
LIBRARIES = {
    "hwy/": ["simd"],
    "embree3/": ["accel", "benchmarks"],
    "OpenEXR/": ["image"],
    "png.h": ["image"],
    "jpeglib.h": ["image"],
    "tiffio.h": ["image"],
    "pugixml.hpp": ["formats"],
    "nlohmann/": ["formats", "apps"],
    "zlib.h": ["formats"],
    "xxhash.h": ["base"],
    "CLI/": ["apps"],
    "gtest/": ["tests"],
    "gmock/": ["tests"],
    "benchmark/": ["benchmarks"],
}

# What allocates, locks, prints or throws has no business in a kernel's header.
KERNEL_HEADER_BANS = {
    "deque", "exception", "filesystem", "fstream", "functional", "future", "iostream", "istream", "list", "map",
    "memory", "mutex", "ostream", "queue", "regex", "set", "shared_mutex", "sstream", "stdexcept", "string", "thread",
    "unordered_map", "unordered_set", "vector",
}

ROOMS = {**KERNEL_ROOMS, **HOST_ROOMS}

INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]')
SOURCES = {".h", ".cpp", ".def", ".inl"}


class File:
    """A source file: where it stands in the architecture."""

    def __init__(self, path):
        self.path = path  # relative to the root, pathlib.PurePath
        parts = path.parts
        self.is_test = path.stem.endswith(("_test", "_testing")) or parts[0] in ("tests", "benchmarks", "fuzz")
        self.room = parts[1] if parts[0] == "src" and len(parts) > 2 else parts[0]
        is_header = path.suffix != ".cpp"
        self.is_family_host = self.room in FAMILIES and (not is_header or path.stem.endswith("_host"))
        self.is_kernel_header = is_header and self.room in KERNEL_ROOMS and not self.is_family_host


def forbidden_project_include(file, target, models):
    """Why `file` may not include the project's header `target` ("room/name.h"), or None. `models`: FAMILY/NAME.h of all."""
    room = target.split("/")[0]
    if room != PUBLIC and room not in ROOMS:
        return None
    if file.room == "apps":
        return None if room == PUBLIC else "the command line uses nothing but include/norrsken"
    if file.room == "include":
        return None if room == PUBLIC else "a public header includes only public headers"
    if file.room not in ROOMS:
        return f"src/{file.room} is not in the table of rooms (scripts/check_includes.py)"
    stem = target.split("/")[1].rsplit(".", 1)[0]
    if room in FAMILIES and stem.endswith("_host") and not file.is_family_host:
        return f"{target} is for the host's side of src/{room}"
    if room == file.room:
        if target in models and file.path.stem not in (stem, "models"):
            return f"the models of src/{room} do not include each other"
        return None
    allowed = list(ROOMS[file.room]) + (FAMILY_HOST if file.is_family_host else [])
    if room not in allowed:
        if room == PUBLIC:
            return "the public headers are not for kernels"
        return f"src/{file.room} may include {', '.join(sorted(allowed)) or 'no other room'}; not {room}"
    return None


def forbidden_library_include(file, target):
    """Why `file` may not include the library header `target`, or None."""
    for prefix, users in LIBRARIES.items():
        if target.startswith(prefix):
            return None if file.room in users else f"{prefix} is for {', '.join(users)} only"
    if file.is_kernel_header and target in KERNEL_HEADER_BANS:
        return f"<{target}> in a kernel header: kernels neither allocate nor lock, print or throw"
    return None


def includes_of(path):
    """Line, quote and target of each include of a file."""
    for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
        if match := INCLUDE.match(line):
            yield number, *match.groups()


def check(root):
    """Yields `file:line: message` for every violation below `root`."""
    models = {target for family in FAMILIES if (path := root / "src" / family / "models.h").exists()
              for _, _, target in includes_of(path)}
    for top in ("include", "src", "apps"):
        for path in sorted((root / top).rglob("*")):
            if path.suffix not in SOURCES:
                continue
            file = File(path.relative_to(root))
            for number, quote, target in includes_of(path):
                reason = None
                if ".." in target.split("/"):
                    reason = "include by the path from src/ or include/, not a relative one"
                elif file.is_test:
                    pass  # a test may look at everything
                elif (root / "src" / target).exists() or target.startswith("norrsken/"):
                    reason = forbidden_project_include(file, target, models)
                else:
                    reason = forbidden_library_include(file, target)
                if reason:
                    yield f"{file.path}:{number}: {quote}{target}: {reason}"


def check_acyclic():
    """Raises if the table of rooms has a ring, the host's side of the families counted."""
    below = {room: set(others) for room, others in ROOMS.items()}
    for family in FAMILIES:
        below[family].update(FAMILY_HOST)
    done, path = set(), []

    def visit(room):
        if room in path:
            raise SystemExit(f"the table of rooms has a ring: {' -> '.join(path + [room])}")
        if room not in done:
            path.append(room)
            for other in below.get(room, ()):
                visit(other)
            done.add(path.pop())

    for room in ROOMS:
        visit(room)


PLANTED = {  # file: (includes, how many of them are wrong)
    "src/math/vec.h": (['"simd/lanes.h"', "<vector>", '"tables/scene_tables.h"'], 2),
    "src/simd/lanes.h": (["<hwy/highway.h>"], 0),
    "src/tables/scene_tables.h": (["<vector>", '"lists/bsdf.def"'], 0),
    "src/lists/bsdf.def": ([], 0),
    "src/bsdf/diffuse.h": (['"math/vec.h"', '"bsdf/mirror.h"', '"light/area.h"', '"norrsken/api.h"'], 3),
    "src/bsdf/diffuse.cpp": (['"bsdf/diffuse.h"', '"scene/node.h"', '"norrsken/api.h"', "<vector>", "<hwy/highway.h>"], 1),
    "src/bsdf/bsdf_host.h": (["<vector>", '"compile/compile.h"', '"light/area.h"'], 1),
    "src/bsdf/rough.cpp": (['"bsdf/bsdf_host.h"', '"bsdf/diffuse.h"', '"compile/compile.h"'], 1),
    "src/bsdf/rough.h": (['"bsdf/bsdf_host.h"', '"compile/compile.h"'], 2),
    "src/compile/compile.h": ([], 0),
    "src/film/film.cpp": (['"compile/compile.h"', '"image/exr.h"'], 2),
    "src/image/exr.h": ([], 0),
    "src/image/exr.cpp": (['"image/exr.h"', '"norrsken/api.h"', "<OpenEXR/ImfHeader.h>", '"scene/node.h"', '"film/film.h"'], 2),
    "src/film/film.h": ([], 0),
    "src/formats/obj.cpp": (["<png.h>", '"image/exr.h"', '"film/film.h"'], 2),
    "src/camera/hdrfilm.cpp": (['"compile/compile.h"'], 0),
    "src/bsdf/models.h": (['"bsdf/diffuse.h"', '"bsdf/mirror.h"'], 0),
    "src/wave/dispatch.h": (['"bsdf/models.h"', '"bsdf/bsdf_host.h"'], 1),
    "src/bsdf/diffuse_test.cpp": (['"bsdf/diffuse.h"', '"light/area.h"', "<gtest/gtest.h>"], 0),
    "src/bsdf/mirror.h": (['"../math/vec.h"', '"bsdf/bsdf.h"'], 1),
    "src/bsdf/bsdf.h": (['"bsdf/diffuse.h"'], 1),
    "src/bsdf/dispatch.h": (['"bsdf/models.h"'], 0),
    "src/compile/compile.cpp": (['"lists/bsdf.def"', '"light/area.h"'], 1),
    "src/light/area.h": (["<iostream>"], 1),
    "src/scene/node.h": (['"norrsken/api.h"', '"math/vec.h"', "<gtest/gtest.h>"], 2),
    "src/render/session.cpp": (['"isa/entry.h"', '"wave/stage.h"', "<thread>"], 1),
    "src/isa/entry.h": (['"tables/scene_tables.h"'], 0),
    "src/wave/stage.h": (['"bsdf/diffuse.h"', '"isa/entry.h"', '"norrsken/api.h"'], 2),
    "src/novel/new.h": (['"math/vec.h"'], 1),
    "include/norrsken/api.h": (["<vector>", '"tables/scene_tables.h"'], 1),
    "apps/norrsken/main.cpp": (['"norrsken/api.h"', '"tables/scene_tables.h"', "<CLI/CLI.hpp>"], 1),
}


def self_test():
    """Plants violations in a made-up tree and counts what is found of them, file by file."""
    with tempfile.TemporaryDirectory() as folder:
        root = pathlib.Path(folder)
        for name, (includes, _) in PLANTED.items():
            (root / name).parent.mkdir(parents=True, exist_ok=True)
            (root / name).write_text("".join(f"#include {target}\n" for target in includes), encoding="utf-8")
        messages = list(check(root))
    for name, (_, expected) in PLANTED.items():
        found = [message for message in messages if message.startswith(name + ":")]
        if len(found) != expected:
            raise SystemExit(f"self-test: {expected} violations planted in {name}, found {found}")
    print(f"self-test: found all {len(messages)} planted violations and nothing else")


def main():
    check_acyclic()
    if sys.argv[1:] == ["--self-test"]:
        self_test()
        return
    root = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else pathlib.Path(__file__).parent.parent)
    messages = list(check(root))
    print("\n".join(messages) if messages else "include arrows: as designed")
    sys.exit(1 if messages else 0)


if __name__ == "__main__":
    main()
