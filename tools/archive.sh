#!/usr/bin/env bash
# Makes an archive that runs from any folder of a Linux with glibc 2.35 or later and this processor, without installing
# anything: the program, its libraries, manual pages and completions.
#   bash tools/archive.sh    # build/release/quorum-VERSION-linux-MACHINE.tar.xz
# The C and C++ libraries and libexpat are the target's, as is all of Vulkan: its drivers are written for them.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
build=build/release
newest_glibc=2.35

bash tools/install_packages.sh
cmake --preset release
cmake --build --preset release --parallel "$(nproc)" --target quorum quorum_relocatable quorum_pages
version="$(sed -nE 's/^project\(.* VERSION ([0-9.]+) .*/\1/p' CMakeLists.txt)"
name="quorum-$version-linux-$(uname -m)"
folder="$build/archive/$name"
rm -rf "$build/archive"
mkdir -p "$folder"/{bin,lib,share}

cmake --install "$build" --component quorum --prefix "$folder" >/dev/null
strip -o "$folder/bin/quorum" "$build/relocatable/quorum"
of_target='^(linux-vdso|ld-linux|lib(c|m|dl|rt|pthread|util|resolv|stdc\+\+|gcc_s|expat))[-.]'
while read -r library path; do
  [[ "$path" == /* ]] || { echo "archive: $library is not here" >&2; exit 1; }
  [[ "$library" =~ $of_target ]] || cp -L "$path" "$folder/lib/$library"
done < <(ldd "$build/relocatable/quorum" | awk '$2 == "=>" { print $1, $3 }')
# Who copies a library copies its license. Debian lists some of /usr/lib as of /lib, so names alone are asked for.
mapfile -t names < <(cd "$folder/lib" && for library in *; do echo "*/$library"; done)
dpkg-query -S "${names[@]}" | cut -d: -f1 | sort -u | while read -r package; do
  install -Dm644 "/usr/share/doc/$package/copyright" "$folder/share/doc/libraries/$package"
done

# Nothing in it may want a newer C library than it says, or a library that is neither in it nor the target's.
failed=0
for file in "$folder/bin/quorum" "$folder"/lib/*; do
  needed="$(objdump -T "$file" | grep -oE 'GLIBC_2\.[0-9]+' | sed 's/GLIBC_//' | sort -V | tail -n 1 || true)"
  [[ "$(printf '%s\n' "${needed:-2.0}" $newest_glibc | sort -V | tail -n 1)" == "$newest_glibc" ]] ||
    { echo "archive: $(basename "$file") wants glibc $needed" >&2; failed=1; }
  while read -r library; do
    [[ "$library" =~ $of_target || -e "$folder/lib/$library" ]] ||
      { echo "archive: $(basename "$file") wants $library, which is not in it" >&2; failed=1; }
  done < <(objdump -p "$file" | awk '$1 == "NEEDED" { print $2 }')
done
[[ $failed -eq 0 ]] || exit 1

# The same bytes from the same files, whoever packs them and when.
tar -C "$build/archive" --owner=0 --group=0 --numeric-owner --sort=name --mtime=@0 -cf - "$name" |
  xz -6 -T2 >"$build/$name.tar.xz"
echo "$build/$name.tar.xz: $(find "$folder/lib" -type f | wc -l) libraries," \
  "$(($(stat -c %s "$build/$name.tar.xz") >> 20)) MiB, $(du -sm "$folder" | cut -f1) unpacked"
