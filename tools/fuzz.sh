#!/usr/bin/env bash
# Searches for inputs that break the readers: each fuzzer of tests/fuzz for a while, from the seeds there. Prints a line a
# fuzzer: what it ran, the edges of the code that it reached and what it found; an input that breaks a reader is left in
# build/fuzz/found, and the exit code is 1.
#   bash tools/fuzz.sh [SECONDS [FUZZER]...]    30 seconds and all of them, if nothing is said
set -uo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.." || exit 1

bash tools/install_packages.sh || exit 1
mkdir -p build
cmake --preset fuzz >build/fuzz.log && cmake --build --preset fuzz --parallel "$(nproc)" >>build/fuzz.log ||
  { tail -n 20 build/fuzz.log; exit 1; }

export ASAN_OPTIONS="allow_addr2line=1"
seconds="${1:-30}"
fuzzers=("${@:2}")
[[ ${#fuzzers[@]} -gt 0 ]] || mapfile -t fuzzers < <(basename -as .cc tests/fuzz/*_fuzz.cc)
mkdir -p build/fuzz/found
# Inputs that lead somewhere new are kept in build/fuzz/corpus and begin the next search.
fuzz() {
  local name="$1" corpus="build/fuzz/corpus/$1" log="build/fuzz/$1.log" code=0
  mkdir -p "$corpus"
  build/fuzz/"$name" "$corpus" "tests/fuzz/seeds/$name" -max_total_time="$2" -max_len=65536 -timeout=20 \
    -rss_limit_mb=4096 -artifact_prefix="build/fuzz/found/$name-" -print_final_stats=1 >"$log" 2>&1 || code=1
  echo "$name: $(sed -nE 's/^stat::number_of_executed_units: *//p' "$log") runs," \
    "$(sed -nE 's/.* cov: ([0-9]+).*/\1/p' "$log" | tail -n 1) edges," \
    "$( ((code == 0)) && echo "nothing found" || echo "FOUND: $(grep -m 1 -E 'ERROR|SUMMARY|deadly' "$log")")"
  return "$code"
}
export -f fuzz
printf '%s\n' "${fuzzers[@]}" | xargs -P "$(nproc)" -I{} bash -c "fuzz {} $seconds"
