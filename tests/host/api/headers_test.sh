#!/usr/bin/env bash
# Each header of the library compiles alone, as C++20, without a warning.
#   bash tests/host/api/headers_test.sh FOLDER COMPILER...    compilers that are not there are left out
set -euo pipefail
folder="$1"
shift
cd "$folder"
compiled=0
for compiler in "$@"; do
  command -v "$compiler" >/dev/null || continue
  for header in quorum/*.h; do
    "$compiler" -std=c++20 -Wall -Wextra -Wpedantic -Wconversion -Wsign-conversion -Wshadow -Werror -fsyntax-only -I. \
      -x c++ - <<<"#include <$header>"
  done
  compiled=$((compiled + 1))
done
[[ $compiled -gt 0 ]] || { echo "no compiler is there"; exit 1; }
# Nothing of others is in them.
! grep -nE '#include <(opencv|vulkan|tbb|oneapi|Eigen|fmt|nlohmann)|#include "|std::expected' quorum/*.h
