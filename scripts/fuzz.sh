#!/usr/bin/env bash
# Runs the fuzz targets of build/fuzz: `make fuzz` and `make fuzz-quick`.
#   scripts/fuzz.sh SECONDS JOBS [TARGET ...]
# What a target learns is kept in build/fuzz/learned/TARGET; an input that it fails on becomes out/fuzz/TARGET-..., its
# log out/fuzz/TARGET.log. FUZZ_SEED in the environment: the seed. (Runs of one seed are alike, not the same.) Exit status 1 if any
# target has failed.
set -euo pipefail
cd "$(dirname "$0")/.."

readonly seconds=${1:?seconds} jobs=${2:?jobs}
shift 2
readonly programs=build/fuzz/fuzz
if [[ $# -eq 0 ]]; then
  for program in "$programs"/fuzz_*; do [[ -x $program && ! -d $program ]] && set -- "$@" "${program##*/fuzz_}"; done
fi
[[ $# -gt 0 ]] || { echo "there is no fuzz target in $programs" >&2; exit 1; }

mkdir -p out/fuzz build/fuzz/learned
# Every plugin's and parameter's name, from the page that a test holds to them.
{
  sed -nE 's/^### (\w+)$/"\1"/p' docs/scenes.md
  grep -oE '`[A-Za-z_][A-Za-z0-9_]*`' docs/scenes.md | tr '`' '"'
  grep -o '"[A-Za-z_][A-Za-z0-9_]*"' fuzz/words.dict
} | sort -u > build/fuzz/xml.dict

fuzz_one() {
  local -r name=$1 log=out/fuzz/$1.log
  local corpora=(build/fuzz/learned/"$name")
  mkdir -p "${corpora[0]}"
  for folder in fuzz/corpus/"$name" fuzz/found/"$name"; do [[ -d $folder ]] && corpora+=("$folder"); done
  local options=(-max_total_time="$seconds" -timeout=25 -rss_limit_mb=2500 -malloc_limit_mb=1000 -print_final_stats=1
                 -artifact_prefix=out/fuzz/"$name"- -verbosity=1)
  [[ -n ${FUZZ_SEED:-} ]] && options+=(-seed="$FUZZ_SEED")
  [[ $name == xml ]] && options+=(-dict=build/fuzz/xml.dict)
  local status=0
  "$programs/fuzz_$name" "${options[@]}" "${corpora[@]}" > "$log" 2>&1 || status=$?
  # The leak checker stops all threads to look, which now and then it may not or cannot: that says nothing of the target.
  local note=
  if [[ $status -ne 0 ]] && grep -q 'LeakSanitizer has encountered a fatal error' "$log" && ! grep -q 'SUMMARY: ' "$log"; then
    status=0 note=" (leaks could not be looked for)"
    rm -f out/fuzz/"$name"-crash-da39a3ee5e6b4b0d3255bfef95601890afd80709  # of no bytes: it was about no input
  fi
  local runs coverage
  runs=$(sed -n 's/^stat::number_of_executed_units: *//p' "$log" | tail -n 1)
  coverage=$(grep -o 'cov: [0-9]*' "$log" | tail -n 1)
  if [[ $status -eq 0 ]]; then
    echo "$name: no finding in ${runs:-?} runs, ${coverage:-cov: ?}$note"
  else
    echo "$name: FAILED after ${runs:-?} runs, status $status; the end of $log:"
    tail -n 40 "$log"
    return 1
  fi
}
export -f fuzz_one
export seconds programs
export ASAN_OPTIONS=${ASAN_OPTIONS:-allocator_may_return_null=0:detect_stack_use_after_return=1}
export UBSAN_OPTIONS=${UBSAN_OPTIONS:-print_stacktrace=1}
printf '%s\n' "$@" | xargs -P "$jobs" -I NAME bash -c 'fuzz_one NAME' || exit 1
