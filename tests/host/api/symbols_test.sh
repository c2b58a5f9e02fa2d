#!/usr/bin/env bash
# The library exports its namespace and nothing else, under one version.
#   bash tests/host/api/symbols_test.sh libquorum.so VERSION
set -euo pipefail
names="$(nm --dynamic --defined-only --demangle "$1")"
others="$(grep -vE ' A QUORUM_[0-9.]+(@@.*)?$| T quorum::v0::' <<<"$names" || true)"
[[ -z "$others" ]] || { echo "exported, too:" && head -20 <<<"$others" && exit 1; }
count="$(grep -c 'quorum::v0::' <<<"$names")"
echo "$count names are exported"
[[ $count -ge 25 && $count -le 100 ]] || { echo "expected 25 to 100"; exit 1; }
readelf --dynamic "$1" | grep -qF "Library soname: [libquorum.so.$2]" && exit
echo "soname is not libquorum.so.$2"
exit 1
