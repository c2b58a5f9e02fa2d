#!/usr/bin/env bash
# Which lines of the engine its tests run, in percent, by file and in all. Takes the package gcovr, which nothing else does.
#   bash tools/coverage.sh [FILTER]    # of the tests, as --gtest_filter takes it
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

command -v gcovr >/dev/null || { echo "coverage: install gcovr first: apt-get install gcovr" >&2; exit 1; }
cmake --preset coverage
cmake --build --preset coverage --parallel "$(nproc)"
find build/coverage -name '*.gcda' -delete
build/coverage/engine_tests --gtest_brief=1 --gtest_filter="${1:-*}"
gcovr --root . --object-directory build/coverage --filter engine/ --exclude-throw-branches --print-summary
