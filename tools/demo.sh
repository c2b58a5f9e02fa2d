#!/usr/bin/env bash
# Builds Quorum and shows what it does: a synthetic temple (or a scene of your own) to depth maps, mesh and pictures.
#   bash tools/demo.sh [SCENE]
# SCENE: a Middlebury folder. Everything ends up in demo/.
set -euo pipefail

scene=""
if [[ $# -gt 0 ]]; then
  [[ -d "$1" ]] || { echo "demo: $1: no such folder" >&2; exit 2; }
  scene="$(cd "$1" && pwd)"
fi
cd "$(dirname "${BASH_SOURCE[0]}")/.."

bash tools/install_packages.sh
cmake --preset release  # without ccache, which can't keep what is compiled with precompiled headers
cmake --build --preset release --parallel "$(nproc)" --target quorum
quorum=build/release/quorum

mkdir -p demo
truth=""
if [[ -z "$scene" ]]; then
  scene=demo/scene
  truth=demo/scene/gt.ply
  rm -rf demo/scene
  echo "Rendering a temple from 24 cameras"
  "$quorum" synthesize demo/scene --views 24 --width 640
fi

rm -rf demo/result
"$quorum" reconstruct "$scene" -o demo/result

# Two pictures from cameras a quarter of the way around from each other.
mapfile -t views < <(cd demo/result/depth && ls ./*.depth.pfm | sed -e 's/^\.\///' -e 's/\.depth\.pfm$//')
first="${views[0]}"
second="${views[$((${#views[@]} / 4))]}"
pictures=()
for view in "$first" "$second"; do
  for shading in shaded color; do
    picture="demo/$view.$shading.png"
    "$quorum" render demo/result/mesh.ply --scene "$scene" --view "$view" --shading "$shading" -o "$picture"
    pictures+=("$picture")
  done
done

"$quorum" report demo/result --scene "$scene" >/dev/null

echo
if [[ -n "$truth" ]]; then
  echo "Against the exact surface $truth:"
  "$quorum" evaluate demo/result/mesh.ply "$truth"
  echo
fi
echo "mesh        $PWD/demo/result/mesh.ply"
echo "depth maps  $PWD/demo/result/depth/"
echo "report      $PWD/demo/result/report.html"
for picture in "${pictures[@]}"; do echo "picture     $PWD/$picture"; done
