#!/usr/bin/env bash
# Builds Quorum twice, by g++ and, with address and undefined-behavior sanitizers, by clang++; checks the sources, searches
# for inputs that break a reader, and runs the tests, with sanitizers and then all of them optimized. Software Vulkan
# (lavapipe) stands in where there is no GPU; a test that finds no device fails.
#   bash tools/test.sh
set -uo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.." || exit 1

bash tools/install_packages.sh || exit 1
cmake --preset release || exit 1
cmake --build --preset release --parallel "$(nproc)" || exit 1
# The tests are compiled once; the sanitizers look at what they call.
cmake --preset fuzz -DQUORUM_TEST_OBJECTS="$PWD/build/release" || exit 1
cmake --build build/fuzz --parallel "$(nproc)" || exit 1

export QUORUM_REQUIRE_DEVICE=1
export UBSAN_OPTIONS="print_stacktrace=1:allow_addr2line=1" ASAN_OPTIONS="allow_addr2line=1"
failed=0
bash tools/check.sh || failed=1
echo "Fuzzing"
bash tools/fuzz.sh 30 || failed=1
# A test that fails runs a second time: software Vulkan fails now and then where all is right. Those that passed only then
# are named, for a result that changes from run to run is a fault.
for preset in fuzz release; do
  echo
  echo "Tests of the $preset build"
  log="build/$preset/tests.log"
  ctest --preset "$preset" --parallel 2 --repeat until-pass:2 2>&1 | tee "$log"
  [[ "${PIPESTATUS[0]}" -eq 0 ]] || failed=1
  sed -nE 's/^.*Test +#[0-9]+: ([^ ]+) \.*[^.]*\*\*\*(Failed|Exception|Timeout).*/Failed once: \1/p' "$log" | sort -u
done
exit "$failed"
