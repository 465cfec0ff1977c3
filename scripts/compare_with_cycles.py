#!/usr/bin/env python3
"""Measures Norrsken against Blender's Cycles on the hexagon room: same machine, two threads, in turn.

    scripts/compare_with_cycles.py [--isa avx512 avx2] [--spp 64] [--runs 5] [--json FILE] [--install]

Both trace 3 bounces with independent samples; Norrsken one shadow ray per hit. A table goes to standard output: the
median over the runs of million camera samples a second, the least and the greatest, and how many times Cycles' median
that is. Blender 3.4 comes from Debian's package `blender`, which --install installs.
"""
import argparse
import json
import os
import pathlib
import re
import shutil
import statistics
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
BOUNCES, THREADS = 3, 2


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


def cycles_speed(options):
    """Million camera samples a second of one rendering by Cycles, by its script's own account."""
    with tempfile.TemporaryDirectory() as folder:
        image = pathlib.Path(folder, "room.png")
        output = output_of(["blender", "-b", "-noaudio", "--python", options.peer, "--", options.spp, BOUNCES, image])
    match = re.search(r"([\d.]+) Msamples/s", output)
    if not match:  # Blender exits with 0 even where its script failed
        sys.exit(f"{options.peer} printed no Msamples/s:\n{output[-2000:]}")
    return float(match[1])


def norrsken_run(options, isa):
    """What `norrsken bench` says of one rendering."""
    return json.loads(output_of([
        options.norrsken, "bench", "hexagon_room", "-Dshadow_rays=1", f"-Dbounces={BOUNCES}", "--sampler",
        "independent", "--spp", options.spp, "--threads", THREADS, "--isa", isa, "--repeat", 1]))


def spread(values):
    return {"median": statistics.median(values), "min": min(values), "max": max(values), "all": values}


def main():
    options = arguments()
    if not shutil.which("blender"):
        if not options.install:
            sys.exit("blender is not installed: apt-get install blender, or run this with --install")
        install_blender()

    speeds = {"cycles": []}
    lanes = {}
    for run in range(options.runs):
        print(f"run {run + 1} of {options.runs}", file=sys.stderr)
        speeds["cycles"].append(cycles_speed(options))
        for isa in options.isa:
            result = norrsken_run(options, isa)
            name = f"norrsken {result['isa']}"
            lanes[name] = result["lanes"]
            speeds.setdefault(name, []).append(result["msamples_per_second"]["median"])

    version = output_of(["blender", "--version"]).splitlines()[0]
    base = statistics.median(speeds["cycles"])
    report = {"blender": version, "spp": options.spp, "bounces": BOUNCES, "threads": THREADS, "renderers": {}}
    print(f"hexagon room, {options.spp} spp, {BOUNCES} bounces, {THREADS} threads, {options.runs} runs in turn, {version}")
    print(f"{'renderer':<20} {'lanes':>5} {'Msamples/s':>10} {'min':>8} {'max':>8} {'x Cycles':>8}")
    for name, values in speeds.items():
        figures = spread(values) | {"ratio": statistics.median(values) / base}
        report["renderers"][name] = figures
        print(f"{name:<20} {lanes.get(name, ''):>5} {figures['median']:>10.3f} {figures['min']:>8.3f} "
              f"{figures['max']:>8.3f} {figures['ratio']:>8.1f}")
    if options.json:
        options.json.write_text(json.dumps(report, indent=2) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
