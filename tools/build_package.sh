#!/usr/bin/env bash
# Builds what is packed, in build/package: for the prefix /usr, without tests. Others call it.
#   bash tools/build_package.sh [TARGET]...
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
bash tools/install_packages.sh
cmake --preset release -B build/package -DCMAKE_INSTALL_PREFIX=/usr -DQUORUM_TESTS=OFF
cmake --build build/package --parallel "$(nproc)" --target "${@:-all}"
