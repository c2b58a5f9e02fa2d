#!/usr/bin/env bash
# Builds the program for arm64 on another machine, and compares what it gives there, by qemu, with the bytes of
# docs/conformance.md. Takes the packages g++-aarch64-linux-gnu and qemu-user, which nothing else does, and once 260 MB of
# Debian's packages, which it unpacks in build/arm64.
#   bash tools/arm64.sh
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
for program in aarch64-linux-gnu-g++ qemu-aarch64; do
  command -v "$program" >/dev/null ||
    { echo "arm64: install first: apt-get install g++-aarch64-linux-gnu qemu-user" >&2; exit 1; }
done
folder="$PWD/build/arm64"
export QUORUM_ARM64_ROOT="$folder/root"

# The libraries of tools/packages.txt for arm64, by an apt that knows nothing of what is installed here.
if [[ ! -e "$folder/root.stamp" ]]; then
  mkdir -p "$folder"/apt/{state/lists,cache/archives}/partial "$QUORUM_ARM64_ROOT"
  : >"$folder/apt/state/status"
  apt=(apt-get -q -o APT::Architecture=arm64 -o APT::Architectures=arm64 -o Dir::State="$folder/apt/state"
    -o Dir::State::status="$folder/apt/state/status" -o Dir::Cache="$folder/apt/cache" -o APT::Sandbox::User=root)
  mapfile -t packages < <(sed -n '/^# Libraries/,/^# Checks/p' tools/packages.txt | sed 's/#.*//; s/ //g; /^$/d' |
    grep -vE '^(python3-dev|pybind11-dev)$')
  "${apt[@]}" update
  "${apt[@]}" install -y --no-install-recommends --download-only "${packages[@]}"
  for package in "$folder"/apt/cache/archives/*.deb; do dpkg-deb -x "$package" "$QUORUM_ARM64_ROOT"; done
  # Links that point from the root stay in it, and those that an installation makes are made.
  find "$QUORUM_ARM64_ROOT" -type l -lname '/*' | while read -r link; do
    ln -snf "$QUORUM_ARM64_ROOT$(readlink "$link")" "$link"
  done
  for library in blas lapack; do
    ln -sf "$library/lib$library.so.3" "$QUORUM_ARM64_ROOT/usr/lib/aarch64-linux-gnu/lib$library.so.3"
  done
  touch "$folder/root.stamp"
fi

cmake --preset release -B "$folder/release" --toolchain cmake/arm64.cmake -DQUORUM_TESTS=OFF -DQUORUM_PYTHON=OFF -DQUORUM_WERROR=OFF
cmake --build "$folder/release" --parallel "$(nproc)" --target quorum
qemu-aarch64 -L "$QUORUM_ARM64_ROOT" "$folder/release/quorum" verify --device cpu --quick
