#!/usr/bin/env bash
# Quorum's folder as part of another project, built whole: by add_subdirectory, or as FetchContent gets it from git. No test
# of its own, since it compiles the engine once more.
#   bash tests/host/api/added_build.sh add_subdirectory|fetch_content SOURCE BUILD [option of cmake]...
# BUILD is the folder of the build. One beside build/release takes what ccache has of that, if QUORUM_WERROR is ON there, too.
set -euo pipefail
way="$1" source="$(cd "$2" && pwd)" build="$3"
shift 3
mkdir -p "$build/project"
{
  printf 'cmake_minimum_required(VERSION 3.25)\nproject(Other CXX)\n'
  if [[ "$way" == fetch_content ]]; then
    printf 'include(FetchContent)\nFetchContent_Declare(quorum GIT_REPOSITORY "%s" GIT_TAG HEAD)\n' "$source"
    printf 'FetchContent_MakeAvailable(quorum)\n'
  else
    printf 'add_subdirectory("%s" quorum EXCLUDE_FROM_ALL)\n' "$source"
  fi
  printf 'add_executable(ball "%s/docs/examples/ball.cc")\ntarget_link_libraries(ball PRIVATE Quorum::quorum)\n' "$source"
} >"$build/project/CMakeLists.txt"
cmake -S "$build/project" -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=Release "$@"
cmake --build "$build" --target ball
said="$("$build/ball")"
echo "$said"
depth="$(sed -nE 's/.*view 2: ([0-9.]+),.*/\1/p' <<<"$said")"
awk -v depth="$depth" 'BEGIN { exit !(depth > 2.98 && depth < 3.02) }'
