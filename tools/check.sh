#!/usr/bin/env bash
# Checks what neither the compiler nor a test sees: format, layers, kernels, documents, version, a build without Vulkan
# and clang-tidy.
#   bash tools/check.sh [format|layers|kernels|docs|version|vulkan_off|tidy]...    all of them, if none is named
# Prints what is wrong, as FILE:LINE where there is a line, and fails if anything is. clang-tidy reads the flags of the
# release build, which must be configured; options in documents are checked if that build's program is there.
set -uo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.." || exit 1
build=build/release

sources() { find engine host tools tests shaders docs/examples \( -name '*.cc' -o -name '*.h' \) "$@"; }

# The format of .clang-format. Other versions of clang-format lay out some lines in other ways.
check_format() { sources -print0 | xargs -0 -P "$(nproc)" -n 60 clang-format-14 --dry-run -Werror; }

# clang-tidy on a few folders at a time: one file that includes all of theirs takes a fifth of the time of file by file, for
# the time goes into headers of others. Each line is a file of its own, the longest first.
units=(
  engine/io
  "engine/depth engine/camera engine/image engine/mesh engine/core"
  "tools host/run"
  "engine/texture engine/report engine/synthetic engine/experiment engine/bench"
  "engine/pipeline engine/conformance"
  "engine/scene engine/volume engine/render engine/evaluate"
  host
  host/api
  tools/python
)
# unit NAME FILES: files whose names clash with those of files before them are left to a second unit.
unit() {
  local name="$1" unit="build/check/$1.cc" log="build/check/$1.log" of='/quorum[a-z_]*[.]dir/' other='python|_test' flags clashing
  shift
  [[ "$name" != tools_python* ]] || { of=/quorum_python.dir/ && other=none; }
  printf '#include "%s"\n' "$@" >"$unit"
  mapfile -t flags < <(grep -E "\"command\": .*$of" "$build/compile_commands.json" | grep -vE "quorum_($other)" |
    sed -E 's/\\\\\\"/"/g; s/-D[^ ]*__attribute__[^ ]*//' | grep -oE -- '-isystem [^ ]+|-[ID][^ ]+|-std=[^ ]+' |
    sed 's/^-isystem /-isystem/' | awk '!seen[$0]++')
  if clang-tidy-19 --quiet "$unit" -- "${flags[@]}" -ferror-limit=0 >"$log" 2>/dev/null; then return 0; fi
  mapfile -t clashing < <(sed -nE "s|^$PWD/([^:]*):.* error: .*\[clang-diagnostic-error\]\$|\1|p" "$log" | sort -u |
    grep -xFf <(printf '%s\n' "$@"))
  if [[ ${#clashing[@]} -eq 0 || ${#clashing[@]} -eq $# ]]; then
    sed "s|^$PWD/||" "$log"
    return 1
  fi
  local rest
  mapfile -t rest < <(printf '%s\n' "$@" | grep -vxFf <(printf '%s\n' "${clashing[@]}"))
  local failed=0
  unit "$name" "${rest[@]}" || failed=1
  unit "$name-2" "${clashing[@]}" || failed=1
  return "$failed"
}
# tidy_unit FOLDERS: the unit of all sources in them.
tidy_unit() {
  local files=() folders
  read -ra folders <<<"$1"
  for folder in "${folders[@]}"; do files+=("$folder"/*.cc); done
  unit "${folders[0]//\//_}" "${files[@]}"
}
check_tidy() {
  if [[ ! -f "$build/compile_commands.json" ]]; then
    echo "check: there is no $build/compile_commands.json: run cmake --preset release first"
    return 1
  fi
  mkdir -p build/check
  local forgotten
  forgotten="$(comm -13 <(printf '%s\n' "${units[@]}" | tr ' ' '\n' | sort) \
    <(find engine host tools -name '*.cc' -printf '%h\n' | sort -u))"
  [[ -z "$forgotten" ]] || { echo "check: clang-tidy does not see $forgotten: add it to a unit" && return 1; }
  export -f unit tidy_unit
  export build
  printf '%s\n' "${units[@]}" |
    { grep -q /quorum_python.dir/ "$build/compile_commands.json" && cat || grep -v tools/python; } |
    xargs -P "$(nproc)" -I{} bash -c 'tidy_unit "{}"'
}

# Includes point one way; the build checks that, too.
check_layers() {
  mkdir -p build/check
  [[ ! -f cmake/CheckIncludes.cmake ]] || cmake -DSTAMP=build/check/includes.stamp -P cmake/CheckIncludes.cmake
}

# Kernels: lines of at most 120 characters, no tabs, and a compiler that has nothing to say.
check_kernels() {
  local failed=0 said
  while IFS= read -r file; do
    awk -v file="$file" 'length > 120 { print file ":" FNR ": more than 120 characters"; bad = 1 }
                         /\t/ { print file ":" FNR ": a tab"; bad = 1 } END { exit bad }' "$file" || failed=1
  done < <(find shaders tests/host/kernels -name '*.comp' -o -name '*.glsl' -o -name '*.h')
  for kernel in shaders/*.comp; do
    said="$(glslangValidator --quiet -V --target-env vulkan1.1 -Ishaders -o /dev/null "$kernel")"
    [[ -z "$said" ]] || { echo "$said" && failed=1; }
  done
  return "$failed"
}

documents() { find README.md CONTRIBUTING.md CHANGELOG.md docs -maxdepth 1 -name '*.md'; }

# What documents name exists: files that they link to, paths, and options of the commands.
check_links() {
  local failed=0 target
  while IFS=: read -r file line target; do
    target="${target#*(}"
    [[ "$target" == http* || "$target" == \#* ]] && continue
    [[ -e "$(dirname "$file")/${target%%#*}" ]] && continue
    echo "$file:$line: links to $target, which is not there" && failed=1
  done < <(documents | xargs grep -noHE '[^[]\]\([^) ]+')
  while IFS=: read -r file line target; do
    target="${target//\`/}"
    [[ "$target" == *NAME* ]] && continue
    compgen -G "$target" >/dev/null && continue
    echo "$file:$line: names $target, which is not there" && failed=1
  done < <(documents | grep -v CHANGELOG | xargs grep -noHE '`(cmake|docs|engine|host|shaders|tests|tools)/[A-Za-z0-9_./*-]+`')
  return "$failed"
}
check_options() {
  [[ -x "$build/quorum" ]] || return 0
  local failed=0 help=build/check/help.txt option
  mkdir -p build/check
  "$build/quorum" --help | sed -nE 's/^  ([a-z]+)  .*/\1/p' |
    while IFS= read -r command; do "$build/quorum" "$command" --help; done | grep -oE -- '--[a-z][a-z0-9-]*' | sort -u >"$help"
  while IFS=: read -r file line option; do
    option="${option#\`}"
    grep -qxF -e "$option" "$help" && continue
    echo "$file:$line: names $option, which no command has" && failed=1
  done < <(documents | xargs grep -noHE '`--[a-z][a-z0-9-]*')
  return "$failed"
}
check_docs() {
  local failed=0
  check_links || failed=1
  check_options || failed=1
  return "$failed"
}

# The version of CMakeLists.txt is the newest of the changelog, which has a date or is not released yet.
check_version() {
  local version newest
  version="$(sed -nE 's/^project\(.* VERSION ([0-9.]+) .*/\1/p' CMakeLists.txt)"
  newest="$(sed -nE 's/^## \[([0-9].*)/[\1/p' CHANGELOG.md | head -n 1)"
  [[ "$newest" =~ ^"[$version] - "([0-9]{4}-[0-9]{2}-[0-9]{2}|unreleased)$ ]] && return 0
  echo "CMakeLists.txt: version $version; CHANGELOG.md: the newest is $newest"
  return 1
}

# QUORUM_VULKAN=OFF takes nothing of Vulkan. The tests run such a program (tests/tools/without_vulkan_test.cc).
check_vulkan_off() {
  local log=build/check/without_vulkan.log
  mkdir -p build/check
  if ! cmake -S . -B build/check/without_vulkan -G Ninja -DQUORUM_VULKAN=OFF -DCMAKE_DISABLE_FIND_PACKAGE_Vulkan=ON \
    >"$log" 2>&1; then
    cat "$log"
    return 1
  fi
  ! grep -niE 'libvulkan|spirv|glslang|quorum_host' build/check/without_vulkan/build.ninja
}

failed=0
[[ $# -gt 0 ]] || set -- format layers kernels docs version vulkan_off tidy
for check in "$@"; do
  began=$SECONDS
  if "check_$check"; then
    echo "check: $check is fine, $((SECONDS - began)) s"
  else
    echo "check: $check FAILED, $((SECONDS - began)) s"
    failed=1
  fi
done
exit "$failed"
