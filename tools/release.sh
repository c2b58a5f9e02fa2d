#!/usr/bin/env bash
# Makes a release of what is committed: Debian packages, the archive, the sources, their checksums, and the tag.
#   bash tools/release.sh [--draft]    # everything in build/release-VERSION; --draft: of any state, without the tag
# Before it: set the version in CMakeLists.txt, give the changelog's newest part that version and today's date, run
# tools/test.sh, commit.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

fail() { echo "release: $*" >&2; exit 1; }
draft=0
[[ "${1:-}" != --draft ]] || draft=1
version="$(sed -nE 's/^project\(.* VERSION ([0-9.]+) .*/\1/p' CMakeLists.txt)"
out="build/release-$version"

bash tools/check.sh version
if ((!draft)); then
  [[ -z "$(git status --porcelain)" ]] || fail "there are changes that are not committed"
  ! git rev-parse -q --verify "refs/tags/v$version" >/dev/null || fail "v$version is tagged already; raise the version"
  grep -qE "^## \[$version\] - [0-9]{4}-" CHANGELOG.md || fail "the changelog gives $version no date"
fi

rm -rf build/package/packages
bash tools/package.sh
bash tools/archive.sh
rm -rf "$out"
mkdir -p "$out"
cp build/package/packages/*.deb build/release/quorum-"$version"-linux-*.tar.xz "$out"
git archive --format=tar --prefix="quorum-$version/" HEAD | xz -6 >"$out/quorum-$version.tar.xz"
# The changelog's part of this version.
awk -v head="## [$version]" 'index($0, "## [") == 1 { here = index($0, head) == 1; next } here' CHANGELOG.md >"$out/NOTES.md"
(cd "$out" && sha256sum -- * >SHA256SUMS)
((draft)) || git tag -a "v$version" -m "Quorum $version"
cat "$out/SHA256SUMS"
