#!/usr/bin/env bash
# Makes the Debian packages: build/package/packages/*.deb (docs/library.md).
#   bash tools/package.sh
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
launcher=()
command -v ccache >/dev/null && launcher=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache)
cmake --preset release -B build/package -DCMAKE_INSTALL_PREFIX=/usr -DQUORUM_TESTS=OFF "${launcher[@]}"
cmake --build build/package --parallel "$(nproc)"
cd build/package
cpack -G DEB
