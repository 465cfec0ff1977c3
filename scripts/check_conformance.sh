#!/usr/bin/env bash
# Holds Norrsken against a peer's own test scenes and reference images, where they stand beside the project.
#
#     scripts/check_conformance.sh [PROGRAM [FILTER ...]]
#
# PROGRAM is build/release/norrsken unless given; FILTERs pick scenes by parts of their paths. Without the folder
# ../shared/conformance there is nothing to hold against: that is said, and is no failure. Ten minutes at most.
set -euo pipefail
cd "$(dirname "$0")/.."

program=${1:-build/release/norrsken}
filters=("${@:2}")
peer=../shared/conformance
if [[ ! -f $peer/run.py ]]; then
  echo "conformance: skipped, there is no $peer"
  exit 0
fi
# What is not reached yet, each with its reason; a folder or a scene.
not_yet=(
  participating_media/         # media are not supported
)
if [[ ${#filters[@]} -eq 0 ]]; then
  for scene in "$peer"/tests/scenes/*/*_*.xml; do
    name=${scene#"$peer"/tests/scenes/}
    for missing in "${not_yet[@]}"; do
      [[ $name != *"$missing"* ]] || continue 2
    done
    filters+=("/$name")
  done
  echo "conformance: ${#filters[@]} scenes; not yet: ${not_yet[*]}"
fi
# Debian's own Python has the judge's packages.
timeout 600 /usr/bin/python3 "$peer/run.py" --renderer "$(realpath "$program")" "${filters[@]}"
