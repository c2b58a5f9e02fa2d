#!/usr/bin/env bash
# The Debian packages in a bare Debian 12: installed, used, purged. On request, as root; it takes a network, debootstrap and
# two minutes.
#   bash tools/package.sh && bash tests/tools/packages_in_root.sh build/package/packages ROOT
# ROOT is made by debootstrap if it is not there.
set -euo pipefail
packages="$1" root="$2"
[[ -d "$root" ]] || debootstrap --variant=minbase bookworm "$root"
if [[ -z "${QUORUM_IN_ROOT:-}" ]]; then  # mounts of its own, which end with it
  QUORUM_IN_ROOT=1 exec unshare -m --propagation private bash "$0" "$packages" "$root"
fi
cp /etc/resolv.conf "$root/etc/resolv.conf"
rm -rf "$root/debs"
mkdir "$root/debs"
cp "$packages"/*.deb "$root/debs"
mount -t proc proc "$root/proc"
mount --bind /dev "$root/dev"
cat >"$root/debs/inside.sh" <<'INSIDE'
set -euo pipefail
export DEBIAN_FRONTEND=noninteractive LC_ALL=C
files() { find / -xdev \( -path /proc -o -path /dev -o -path /debs -o -path /tmp -o -path /var/lib/apt -o -path /var/cache \
  -o -path /var/log -o -path /var/lib/dpkg \) -prune -o -print | sort; }
installed() { dpkg-query -W -f '${Package}\n' | sort; }
size() { du -sxm --exclude=/var/cache --exclude=/var/lib/apt --exclude=/proc --exclude=/dev --exclude=/debs / | cut -f 1; }
work="$(mktemp -d)"
quietly() { "$@" >"$work/log" 2>&1 || { tail -n 20 "$work/log" && exit 1; }; }
install() { quietly apt-get install -q -y --no-install-recommends "$@"; }
tell() { echo "$1: $(comm -13 "$work/packages" <(installed) | wc -l) packages and $(($(size) - before)) MiB more"; }

quietly apt-get update -q
installed >"$work/packages"
files >"$work/files"
before="$(size)"
install /debs/quorum_*.deb
tell "quorum alone"
quorum synthesize "$work/scene" --views 4 --width 128
quorum reconstruct "$work/scene" -o "$work/out" --device cpu --min-component 0 --min-confidence 0 --report --quiet
[[ -s "$work/out/mesh.ply" && -s "$work/out/report.html" ]]
install /debs/*.deb
tell "all packages"
python3 /usr/share/doc/quorum-doc/docs/examples/turntable.py
mapfile -t names < <(for package in /debs/*.deb; do dpkg-deb -f "$package" Package; done)
quietly apt-get purge -q -y "${names[@]}"
quietly apt-get autoremove --purge -q -y
left="$(comm -13 "$work/files" <(files))"
[[ -z "$left" ]] || { echo "left by purge: $left" && exit 1; }
echo "nothing is left"
INSIDE
chroot "$root" bash /debs/inside.sh
