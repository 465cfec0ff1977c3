#!/usr/bin/env bash
# Installs what Norrsken needs from Debian 12, and does nothing if all of it is there.
#   scripts/install_dependencies.sh [build|test]
# `build` (the default): compiling, rendering and running the tests; `test`: what the checks of style and of a peer's scenes and the fuzzers need as well.
set -euo pipefail

packages=(
  g++ cmake ninja-build pkg-config python3
  libembree-dev libopenexr-dev libpng-dev libjpeg-dev libtiff-dev zlib1g-dev
  libpugixml-dev libfmt-dev libglm-dev libhwy-dev libxxhash-dev
  libcli11-dev nlohmann-json3-dev
  libgtest-dev libgmock-dev libbenchmark-dev
)
case "${1:-build}" in
  build) ;;
  test) packages+=(clang clang-format clang-tidy libclang-rt-14-dev python3-numpy python3-openimageio) ;;
  *) echo "usage: $0 [build|test]" >&2; exit 64 ;;
esac

missing=()
for package in "${packages[@]}"; do
  state=$(dpkg-query -W -f='${db:Status-Status}' "$package" 2>/dev/null || true)
  [[ $state == installed ]] || missing+=("$package")
done
[[ ${#missing[@]} -gt 0 ]] || exit 0

command=(apt-get install -y --no-install-recommends "${missing[@]}")
as_root=()
if [[ $(id -u) -ne 0 ]]; then
  if ! command -v sudo >/dev/null; then
    echo "Norrsken needs packages that are not installed, and installing them takes root or sudo." >&2
    echo "Have somebody who may do so run: ${command[*]}" >&2
    exit 77
  fi
  as_root=(sudo)
fi
echo "Installing: ${missing[*]}"
# `env` because sudo does not pass variables on. Another apt at work is waited for.
run=("${as_root[@]}" env DEBIAN_FRONTEND=noninteractive)
"${run[@]}" apt-get -o DPkg::Lock::Timeout=600 update -q
"${run[@]}" apt-get -o DPkg::Lock::Timeout=600 "${command[@]:1}"
