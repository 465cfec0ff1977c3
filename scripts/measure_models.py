#!/usr/bin/env python3
"""Tells what a path pays for every scattering model and every kind of light, with registers of all widths.

    scripts/measure_models.py [--build FOLDER] [--all] [--filter REGEX] [--runs N]

Runs bsdf_benchmark and emitter_benchmark and prints a row for each model: nanoseconds per path on every instruction set
(the least of the runs, because whatever else the machine does only adds), and the cost with the widest register over
that with one lane. Of BSDFs that is all that a hit asks: parameters, value and density for a light, a sample. `--all`
tells each operation.
"""
import argparse
import collections
import json
import pathlib
import subprocess

LIMIT = 0.3


def measure(program, arguments):
    """{model: {operation: {instruction set: nanoseconds}}}, sets and models in the program's order."""
    output = subprocess.run(
        [program, "--benchmark_format=json", f"--benchmark_filter={arguments.filter}",
         f"--benchmark_min_time={arguments.seconds}", f"--benchmark_repetitions={arguments.runs}"],
        check=True, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL).stdout
    costs = collections.defaultdict(lambda: collections.defaultdict(dict))
    for result in json.loads(output)["benchmarks"]:
        if result["run_type"] != "iteration":
            continue
        model, operation, lanes = result["run_name"].rsplit("/", 2)
        cost = costs[model][operation]
        cost[lanes] = min(cost.get(lanes, float("inf")), result["ns/path"])
    return costs


def print_table(title, costs, operations):
    rows = [(f"{model}, {operation}" if len(operations) != 1 else model, cost) for model, of_model in costs.items()
            for operation, cost in of_model.items() if not operations or operation in operations]
    if not rows:
        return
    sets = list(rows[0][1])
    print(f"\n| {title} | {' | '.join(sets)} | {sets[0]} / {sets[-1]} |\n|{'---|' * (len(sets) + 2)}")
    for name, cost in rows:
        ratio = cost[sets[0]] / cost[sets[-1]]
        print(f"| {name} | {' | '.join(f'{cost[s]:.2f}' for s in sets)} | {ratio:.2f}{' (!)' if ratio > LIMIT else ''} |")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", type=pathlib.Path, default=pathlib.Path("build/release"))
    parser.add_argument("--all", action="store_true", help="each operation alone")
    parser.add_argument("--filter", default=".", help="which of MODEL/OPERATION/SET to run")
    parser.add_argument("--runs", type=int, default=3)
    parser.add_argument("--seconds", type=float, default=0.05, help="of each run at least")
    arguments = parser.parse_args()
    folder = arguments.build / "benchmarks"
    print_table("bsdf, ns per path", measure(folder / "bsdf_benchmark", arguments), [] if arguments.all else ["hit"])
    print_table("light, ns per path", measure(folder / "emitter_benchmark", arguments),
                [] if arguments.all else ["sample"])


if __name__ == "__main__":
    main()
