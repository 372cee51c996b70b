#!/usr/bin/env bash
# Walks a simulated LiDAR past a wall of 5 cm, maps it with nvm and with a k-d tree of bare points, and draws both.
set -euo pipefail
source "$(dirname "$0")/environment.sh"
scripts/setup.sh
cmake --preset release
cmake --build --preset release --target nvm_program

nvm=build/release/bin/nvm
demo=build/demo
rm -rf $demo
$nvm simulate wall5 --out $demo/sequence
$nvm run $demo/sequence --out $demo/with_nvm
$nvm run $demo/sequence --out $demo/without_nvm --set map.type=kdtree
$nvm evaluate $demo/with_nvm $demo/without_nvm --truth $demo/sequence --out $demo/report
echo
echo "The wall with and without nvm: $PWD/$demo/report/wall_free_standing.svg"
echo "Trajectories, errors, times:   $PWD/$demo/report/report.html"
