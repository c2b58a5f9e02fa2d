#!/usr/bin/env bash
# The library as others get it: installed under a prefix, its examples built from there by find_package and pkg-config
# and run, and Quorum's folder added to a project.
#   bash tests/host/api/install_test.sh BUILD SOURCE COMPILER
set -euo pipefail
build="$1"
source="$2"
export CXX="$3"
place="$(mktemp -d)"
trap 'rm -rf "$place"' EXIT
for component in quorum libquorum libquorum-dev; do
  cmake --install "$build" --prefix "$place/prefix" --component "$component" >/dev/null
done
cp -r "$place"/prefix/share/doc/*/examples "$place/examples"

# By CMake
cmake -S "$place/examples" -B "$place/build" -G Ninja -DCMAKE_PREFIX_PATH="$place/prefix" >/dev/null
cmake --build "$place/build" --target ball >/dev/null
"$place/build/ball" | tee "$place/ball.txt"
depth="$(sed -nE 's/.*view 2: ([0-9.]+),.*/\1/p' "$place/ball.txt")"
awk -v depth="$depth" 'BEGIN { exit !(depth > 2.98 && depth < 3.02) }' || { echo "depth $depth, expected 3"; exit 1; }

# By pkg-config
export PKG_CONFIG_PATH="$(dirname "$(find "$place/prefix" -name quorum.pc)")"
read -r -a flags <<<"$(pkg-config --cflags --libs quorum) -Wl,-rpath,$(pkg-config --variable=libdir quorum)"
"$CXX" -std=c++20 "$place/examples/folder.cc" -o "$place/folder" "${flags[@]}"
"$place/prefix/bin/quorum" synthesize "$place/scene" --views 4 --width 64 >/dev/null 2>&1
options=(quality draft min-component 0 min-confidence 0)
"$place/folder" "$place/scene" "$place/out" "${options[@]}" 2>/dev/null | tail -n 1
cmp -s "$place/out/mesh.ply" <(
  "$place/prefix/bin/quorum" reconstruct "$place/scene" -o "$place/program" --quality draft --min-component 0 \
    --min-confidence 0 --quiet && cat "$place/program/mesh.ply") || { echo "the program's mesh is another one"; exit 1; }

# A version that is too new, and a component that is not there
for wanted in "9.0" "0.1 COMPONENTS Metal"; do
  printf 'cmake_minimum_required(VERSION 3.25)\nproject(Other CXX)\nfind_package(Quorum %s REQUIRED)\n' "$wanted" \
    >"$place/examples/CMakeLists.txt"
  ! cmake -S "$place/examples" -B "$place/refused" -G Ninja -DCMAKE_PREFIX_PATH="$place/prefix" >/dev/null 2>&1 ||
    { echo "find_package(Quorum $wanted) finds it"; exit 1; }
  rm -rf "$place/refused"
done

# As a folder of another project: the target is there, and neither tests nor rules to install.
mkdir "$place/other"
printf 'cmake_minimum_required(VERSION 3.25)\nproject(Other CXX)\nadd_subdirectory("%s" quorum)\n' "$source" \
  >"$place/other/CMakeLists.txt"
printf 'add_executable(ball "%s/docs/examples/ball.cc")\n' "$source" >>"$place/other/CMakeLists.txt"
printf 'target_link_libraries(ball PRIVATE Quorum::quorum)\n' >>"$place/other/CMakeLists.txt"
cmake -S "$place/other" -B "$place/added" -G Ninja -DQUORUM_VULKAN=OFF >/dev/null
ninja="$(<"$place/added/build.ninja")"
[[ "$ninja" == *libquorum.so* ]] || { echo "an added folder has no library"; exit 1; }
[[ "$ninja" != *engine_tests* ]] || { echo "an added folder has tests"; exit 1; }
ball="$(grep -A 8 'build CMakeFiles/ball.dir/.*ball.cc.o' "$place/added/build.ninja")"
[[ "$ball" == *"-I$source/host/api"* ]] || { echo "an added folder gives no headers: $ball"; exit 1; }
[[ ! "$ball" =~ eigen|opencv|-ffp-contract|-fvisibility ]] || { echo "flags of the engine reach others: $ball"; exit 1; }
