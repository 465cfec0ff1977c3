#!/usr/bin/env bash
# Says which lines of the sources clang-format would write otherwise; with --fix, rewrites them.
set -euo pipefail
cd "$(dirname "$0")/.."
mode=(--dry-run --Werror)
[[ ${1:-} != --fix ]] || mode=(-i)
find include src apps tests benchmarks -type f \( -name '*.h' -o -name '*.cpp' \) -print0 |
  xargs -0 -r clang-format "${mode[@]}"
[[ ${1:-} == --fix ]] || echo "format: as .clang-format says"
