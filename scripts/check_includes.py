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

# The plugin families. A file of one never includes another's, and its models never include each other. What is no model:
# FAMILY/FAMILY.h, the interface or the dispatch over the models, and the headers in SHARED.
FAMILIES = ["bsdf", "camera", "integrator", "light", "rfilter", "sampler", "shape", "texture"]

# Mathematics that several models of a family use.
SHARED = {"bsdf/coat.h", "bsdf/fresnel.h", "bsdf/microfacet.h", "bsdf/principled_lobes.h",
          "bsdf/resolved.h", "camera/connect.h", "light/area_point.h", "light/emit.h", "light/light_tree.h",
          "sampler/dimensions.h", "sampler/hash.h", "shape/curve.h"}

# Loops over the kinds of a family, besides FAMILY/FAMILY.h.
DISPATCH = {"light/emit_lights.h", "light/sample_lights.h", "texture/parameter_reader.h"}

# Headers of families that compute tables: for src/compile as well. (What only a family's own host files share is in a
# header that ends in _host.)
HOST_HEADERS = {"light/light_choice.h", "sampler/sampler_host.h"}

# Host files of plugins that stand in a folder that is no family.
HOST_PLUGINS = {"film/hdrfilm.cpp"}

KERNEL_BASE = ["base", "simd", "math", "color", "tables"]

# Which folders below src/ a folder may include, besides itself and `api`, the public headers (see below). Kernel code
# runs per ray, host code once per scene or image.
KERNEL_LAYERS = {
    "simd": ["base"],
    "math": ["base", "simd"],
    "color": ["base", "simd", "math"],
    **{family: KERNEL_BASE for family in FAMILIES},
    # Parameters of these may be textures.
    "bsdf": KERNEL_BASE + ["texture"],
    # So may that of a light, which may have the form of any shape.
    "light": KERNEL_BASE + ["shape", "texture"],
    "accel": KERNEL_BASE + ["shape"],
    "wave": KERNEL_BASE + FAMILIES + ["accel"],
    "isa": KERNEL_BASE + FAMILIES + ["accel", "wave"],
}
HOST_LAYERS = {
    "base": [],
    "tables": ["base"],
    "scene": ["base", "color"],
    "image": ["base", "color"],
    "formats": ["base", "color", "scene"],
    "compile": ["base", "color", "tables", "image", "scene", "formats"],
    "film": ["base", "color", "tables"],
    "render": ["base", "color", "tables", "scene", "formats", "compile", "accel", "isa", "film"],
}
LAYERS = {**KERNEL_LAYERS, **HOST_LAYERS}

# Families have host files (NAME.cpp, *_host.h: parameters, packing), which read the description and the files that it
# names, and write the tables through what src/compile offers to plugins.
FAMILY_HOST_EXTRA = ["scene", "formats", "compile"]

# Who may include the public headers: host layers and the kernel layers that have host headers too. (Of a family, only
# the .cpp files.)
API_USERS = set(HOST_LAYERS) | {"color", "accel", "isa"}

# Libraries and where they may be included; unlisted libraries are free.
LIBRARIES = {
    "hwy/": ["simd"],
    "embree3/": ["accel", "benchmarks"],
    "OpenEXR/": ["image"],
    "png.h": ["image"],
    "jpeglib.h": ["image"],
    "tiffio.h": ["image"],
    "pugixml.hpp": ["formats"],
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

INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]')
SOURCES = {".h", ".cpp", ".def", ".inl"}


class File:
    """A source file: where it stands in the architecture."""

    def __init__(self, path):
        self.path = path  # relative to the root, pathlib.PurePath
        parts = path.parts
        self.is_test = path.stem.endswith(("_test", "_testing")) or parts[0] in ("tests", "benchmarks", "fuzz")
        self.layer = parts[1] if parts[0] == "src" and len(parts) > 2 else parts[0]
        self.is_header = path.suffix != ".cpp"
        name = "/".join(path.parts[1:])
        self.is_family_host = name in HOST_PLUGINS or self.layer in FAMILIES and (
            not self.is_header or path.stem.endswith("_host") or name in HOST_HEADERS)
        self.is_kernel_header = (
            self.is_header and self.layer in KERNEL_LAYERS and self.layer not in API_USERS and not self.is_family_host)
        self.is_dispatch = path.stem == self.layer or name in DISPATCH


def forbidden_project_include(file, target):
    """Why `file` may not include the project's header `target` ("layer/name.h"), or None."""
    layer = target.split("/")[0]
    if layer == "norrsken":
        if file.layer in LAYERS and file.layer not in API_USERS and not file.is_family_host:
            return "the public headers are not for kernels"
        return None
    if layer not in LAYERS:
        return None
    if file.layer == "apps":
        return "the command line uses nothing but include/norrsken"
    if file.layer == "include":
        return "a public header includes only public headers"
    if file.layer not in LAYERS:
        return f"src/{file.layer} is not in the table of layers (scripts/check_includes.py)"
    if target.endswith(".def"):
        return None  # lists of names: data, which every layer may expand
    stem = target.split("/")[1].rsplit(".", 1)[0]
    if layer == file.layer:
        is_model = layer in FAMILIES and stem != layer and target not in SHARED | DISPATCH | HOST_HEADERS
        is_shared_host = file.is_family_host and stem.endswith("_host")
        if is_model and stem != file.path.stem and not file.is_dispatch and not is_shared_host:
            return f"the models of src/{layer} do not include each other"
        return None
    if target in HOST_HEADERS and file.layer == "compile":
        return None
    allowed = list(LAYERS[file.layer])
    if file.is_family_host:
        allowed += FAMILY_HOST_EXTRA
    if layer not in allowed:
        return f"src/{file.layer} may include {', '.join(sorted(allowed)) or 'no other layer'}; not {layer}"
    return None


def forbidden_library_include(file, target):
    """Why `file` may not include the library header `target`, or None."""
    for prefix, users in LIBRARIES.items():
        if target.startswith(prefix):
            return None if file.layer in users else f"{prefix} is for {', '.join(users)} only"
    if file.is_kernel_header and target in KERNEL_HEADER_BANS:
        return f"<{target}> in a kernel header: kernels neither allocate nor lock, print or throw"
    return None


def check(root):
    """Yields `file:line: message` for every violation below `root`."""
    for top in ("include", "src", "apps"):
        for path in sorted((root / top).rglob("*")):
            if path.suffix not in SOURCES:
                continue
            file = File(path.relative_to(root))
            for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
                match = INCLUDE.match(line)
                if not match:
                    continue
                quote, target = match.groups()
                reason = None
                if ".." in target.split("/"):
                    reason = "include by the path from src/ or include/, not a relative one"
                elif file.is_test:
                    pass  # a test may look at everything
                elif (root / "src" / target).exists() or target.startswith("norrsken/"):
                    reason = forbidden_project_include(file, target)
                else:
                    reason = forbidden_library_include(file, target)
                if reason:
                    yield f"{file.path}:{number}: {quote}{target}: {reason}"


def check_acyclic():
    """Raises if the table of layers has a cycle."""
    done, path = set(), []

    def visit(layer):
        if layer in path:
            raise SystemExit(f"the table of layers has a cycle: {' -> '.join(path + [layer])}")
        if layer not in done:
            path.append(layer)
            for below in LAYERS[layer]:
                visit(below)
            done.add(path.pop())

    for layer in LAYERS:
        visit(layer)


PLANTED = {  # file: (includes, how many of them are wrong)
    "src/math/vec.h": (['"simd/lanes.h"', "<vector>", '"tables/scene_tables.h"'], 2),
    "src/simd/lanes.h": (["<hwy/highway.h>"], 0),
    "src/tables/scene_tables.h": (["<vector>", '"bsdf/list.def"'], 0),
    "src/bsdf/list.def": ([], 0),
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
    "src/formats/obj.cpp": (["<png.h>", '"image/exr.h"'], 2),
    "src/film/hdrfilm.cpp": (['"compile/compile.h"'], 0),
    "src/bsdf/diffuse_test.cpp": (['"bsdf/diffuse.h"', '"light/area.h"', "<gtest/gtest.h>"], 0),
    "src/bsdf/mirror.h": (['"../math/vec.h"', '"bsdf/bsdf.h"'], 1),
    "src/bsdf/bsdf.h": (['"bsdf/diffuse.h"', '"bsdf/mirror.h"'], 0),
    "src/light/light_choice.h": (["<vector>"], 0),
    "src/compile/compile.cpp": (['"bsdf/list.def"', '"light/light_choice.h"', '"light/area.h"'], 1),
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
