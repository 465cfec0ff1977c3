#!/usr/bin/env python3
"""Measures Norrsken against Blender's Cycles on the hexagon room: same machine, two threads, in turn.

    scripts/compare_with_cycles.py [--isa avx512 avx2] [--spp 64] [--runs 5] [--json FILE] [--install | --bpy PYTHON]

Both scatter a path by 3 surfaces at most (what Cycles calls 2 bounces) with independent samples; Norrsken with one shadow
ray per hit. Cycles runs twice, with a lamp that shines downwards, as Norrsken's does, and with one that shines both ways,
which spares it a shader for each sample of the lamp but shows another image. A table goes to standard output: the median
over the runs of million camera samples per processor second, the least and the greatest, and how many times the median of
Cycles with the same lamp, and with the simpler one, that is. Blender 3.4 comes from Debian's package `blender`, which
--install installs; with --bpy a Python that has the package `bpy` takes its place.
"""
import argparse
import json
import os
import pathlib
import re
import resource
import shutil
import statistics
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
BOUNCES, THREADS, SIZE = 3, 2, 800


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--peer", type=pathlib.Path, default=ROOT / "../shared/peers/cycles_hexagon_room.py",
                        help="the room as a Blender script; default %(default)s")
    parser.add_argument("--norrsken", type=pathlib.Path, default=ROOT / "build/release/norrsken", metavar="PROGRAM")
    parser.add_argument("--isa", nargs="+", default=["auto"], help="instruction sets to measure; default %(default)s")
    parser.add_argument("--spp", type=int, default=64, help="samples per pixel of both; default %(default)s")
    parser.add_argument("--runs", type=int, default=5, help="of each, in turn; default %(default)s")
    parser.add_argument("--json", type=pathlib.Path, metavar="FILE", help="write every figure there")
    parser.add_argument("--install", action="store_true", help="apt-get install blender if it is missing")
    parser.add_argument("--bpy", type=pathlib.Path, metavar="PYTHON", help="a Python with bpy, in place of blender")
    return parser.parse_args()


def install_blender():
    as_root = [] if os.geteuid() == 0 else ["sudo"]
    command = ["env", "DEBIAN_FRONTEND=noninteractive", "apt-get", "-o", "DPkg::Lock::Timeout=600"]
    subprocess.run([*as_root, *command, "update", "-q"], check=True)
    subprocess.run([*as_root, *command, "install", "-y", "--no-install-recommends", "blender"], check=True)


def output_of(command):
    result = subprocess.run([str(word) for word in command], capture_output=True, text=True)
    if result.returncode != 0:
        sys.exit(f"{command[0]} failed with status {result.returncode}:\n{result.stdout[-2000:]}{result.stderr[-2000:]}")
    return result.stdout


def cycles_run(options, *lamp):
    """Million camera samples per processor second of one rendering by Cycles, and its version, by its script's account."""
    blender = [options.bpy] if options.bpy else ["blender", "-b", "-noaudio", "--python"]
    with tempfile.TemporaryDirectory() as folder:
        output = output_of([*blender, options.peer, *([] if options.bpy else ["--"]), *lamp, "--threads", THREADS,
                            options.spp, BOUNCES, pathlib.Path(folder, "room.png")])
    match = re.search(r"cycles ([\d.]+).* ([\d.]+) Msamples per processor second", output)
    if not match:  # Blender exits with 0 even where its script failed
        sys.exit(f"{options.peer} printed no Msamples per processor second:\n{output[-2000:]}")
    return float(match[2]), match[1]


def norrsken_run(options, isa):
    """Million camera samples per processor second of one rendering, its start included, and what the program says of it."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    result = json.loads(output_of([
        options.norrsken, "bench", "hexagon_room", "-Dshadow_rays=1", f"-Dbounces={BOUNCES}", "--sampler",
        "independent", "--spp", options.spp, "--threads", THREADS, "--isa", isa, "--repeat", 1]))
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    seconds = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    return SIZE * SIZE * options.spp / seconds / 1e6, result


def spread(values):
    return {"median": statistics.median(values), "min": min(values), "max": max(values), "all": values}


def main():
    options = arguments()
    if not options.bpy and not shutil.which("blender"):
        if not options.install:
            sys.exit("blender is not installed: apt-get install blender, run this with --install, or see --bpy")
        install_blender()

    speeds = {"cycles": [], "cycles, simple lamp": []}
    lanes = {}
    for run in range(options.runs):
        print(f"run {run + 1} of {options.runs}", file=sys.stderr)
        for name, lamp in zip(list(speeds)[:2], ([], ["--two-sided-lamp"])):
            speed, version = cycles_run(options, *lamp)
            speeds[name].append(speed)
        for isa in options.isa:
            speed, result = norrsken_run(options, isa)
            name = f"norrsken {result['isa']}"
            lanes[name] = result["lanes"]
            speeds.setdefault(name, []).append(speed)

    bases = [statistics.median(speeds[name]) for name in list(speeds)[:2]]
    report = {"cycles": version, "spp": options.spp, "bounces": BOUNCES, "threads": THREADS, "renderers": {}}
    print(f"hexagon room, {options.spp} spp, {BOUNCES} bounces, {THREADS} threads, {options.runs} runs in turn, "
          f"Cycles {version}; million camera samples per processor second")
    print(f"{'renderer':<20} {'lanes':>5} {'median':>8} {'min':>8} {'max':>8} {'x Cycles':>8} {'x simple lamp':>14}")
    for name, values in speeds.items():
        figures = spread(values) | {"ratios": [statistics.median(values) / base for base in bases]}
        report["renderers"][name] = figures
        print(f"{name:<20} {lanes.get(name, ''):>5} {figures['median']:>8.3f} {figures['min']:>8.3f} "
              f"{figures['max']:>8.3f} {figures['ratios'][0]:>8.1f} {figures['ratios'][1]:>14.1f}")
    if options.json:
        options.json.write_text(json.dumps(report, indent=2) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
