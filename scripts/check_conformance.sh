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
# Debian's own Python has the judge's packages.
timeout 600 /usr/bin/python3 "$peer/run.py" --renderer "$(realpath "$program")" "${filters[@]}"
