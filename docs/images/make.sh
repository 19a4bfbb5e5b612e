#!/usr/bin/env bash
# Makes the pictures of this folder anew, with the program as it is: docs/images/make.sh [PROGRAM]
set -euo pipefail
cd "$(dirname "$0")/../.."
program=${1:-target/release/smoothpatch}
work=$(mktemp -d)
trap 'rm -r "$work"' EXIT

run() { "$program" "$@" --quiet; }
picture() { run render "$work/$1" -o "docs/images/$2" "${@:3}"; }

for scene in double-torus chair deccube; do
    run fit "fixtures/scenes/$scene.ron" -o "$work/$scene.vtu"
done
picture double-torus.vtu double-torus-zebra.png --size 480x360 --view=-65,40 --stripes 8
picture chair.vtu chair-zebra.png --size 360x360 --view=-35,22 --stripes 8
picture deccube.vtu deccube-zebra.png --size 360x360 --view=-50,24 --stripes 7
picture double-torus.vtu double-torus-curvature.png --size 480x330 --view=-65,40 --shade curvature
picture double-torus.vtu double-torus-deviation.png --size 480x330 --view=-65,40 --shade deviation \
    --scene fixtures/scenes/double-torus.ron

# before and after the patches are joined
run fit --shape sphere --faces 32 --method published -o "$work/g1.vtu" --before-join "$work/g0.vtu"
picture g0.vtu g0-g1.png --compare "$work/g1.vtu" --size 900x430 --view=-50,30 --edges

run nagata fixtures/meshes/spot_triangulated.obj --normals estimate --crease-angle 180 \
    --continuity g1 --cells flat --divisions 4 -o "$work/spot.vtu"
picture spot.vtu spot-nagata.png --size 360x420 --up y --view=-35,15 --stripes 7
run apatch truncated-icosahedron --scheme c2-quintic -o "$work/ball.vtu"
picture ball.vtu ball-apatch.png --size 400x400 --stripes 7 --edges
