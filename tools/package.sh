#!/usr/bin/env bash
# Makes the Debian packages: build/package/packages/*.deb (docs/library.md).
#   bash tools/package.sh
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
bash tools/build_package.sh
rm -rf build/package/packages
cd build/package
cpack -G DEB
