#!/usr/bin/env python3
"""Measures how long `norrsken info` takes to read large meshes, and how much memory.

    scripts/measure_reading.py [--build FOLDER] [--megabytes N] [--runs N]

Writes binary PLY, OBJ and serialized files of about so many megabytes, with and without normals and texture coordinates, to a
temporary folder, reads each a few times on one core, and prints a row for each: the least processor time (which other
load on the machine disturbs less than the clock's), the least time by the clock, and the peak of resident memory,
also as a multiple of the file.
"""
import argparse
import os
import pathlib
import subprocess
import tempfile
import time

# Bytes of the file per triangle, about: for the number of triangles that makes the size wanted.
MESHES = [("ply", False, 29.0), ("ply", True, 19.0), ("obj", False, 102.0), ("obj", True, 38.4),
          ("serialized", False, 15.5), ("serialized", True, 8.7)]


def run(command):
    """Processor seconds, clock seconds and peak resident bytes of one run on the first core."""
    start = time.perf_counter()
    process = subprocess.Popen(command, stdout=subprocess.DEVNULL, preexec_fn=lambda: os.sched_setaffinity(0, {0}))
    _, status, usage = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode != 0:
        raise SystemExit(f"{command} failed")
    return usage.ru_utime + usage.ru_stime, time.perf_counter() - start, usage.ru_maxrss * 1024


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", type=pathlib.Path, default=pathlib.Path("build/release"))
    parser.add_argument("--megabytes", type=float, default=100)
    parser.add_argument("--runs", type=int, default=3)
    arguments = parser.parse_args()
    make_mesh, norrsken = arguments.build / "benchmarks" / "make_mesh", arguments.build / "norrsken"

    print("| file | MB | triangles | processor s | clock s | peak MB | times the file |")
    print("|---|---|---|---|---|---|---|")
    for format, bare, bytes_per_triangle in MESHES:
        with tempfile.TemporaryDirectory() as folder:
            triangles = int(arguments.megabytes * 1e6 / bytes_per_triangle)
            command = [make_mesh, folder, "--triangles", str(triangles), "--format", format]
            subprocess.run(command + (["--bare"] if bare else []), check=True, stdout=subprocess.DEVNULL)
            size = (pathlib.Path(folder) / f"mesh.{format}").stat().st_size
            runs = [run([norrsken, "info", f"{folder}/scene.xml"]) for _ in range(arguments.runs)]
            processor, clock, peak = (min(column) for column in zip(*runs))
            name = f"{format}, positions only" if bare else f"{format}, normals and uv"
            print(f"| {name} | {size / 1e6:.0f} | {triangles / 1e6:.2f} M | {processor:.2f} | {clock:.2f} "
                  f"| {peak / 1e6:.0f} | {peak / size:.2f} |", flush=True)


if __name__ == "__main__":
    main()
