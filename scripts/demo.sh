#!/usr/bin/env bash
# Walks a simulated LiDAR around a wall of 5 cm and draws what becomes of it: with an odometry in the shape of FAST_LIO, with the
# same on nvm's map, and with nvm's own.
set -euo pipefail
"$(dirname "$0")/setup.sh"
source "$(dirname "$0")/environment.sh"
cmake --preset release
cmake --build --preset release --target nvm_program nvm_fast_lio_shape

nvm=build/release/bin/nvm
demo=build/demo
rm -rf $demo
$nvm simulate wall5 --out $demo/sequence
build/release/tests/adapters/nvm_fast_lio_shape $demo/sequence $demo/fast_lio_shape $demo/the_same_on_nvm
$nvm run $demo/sequence --out $demo/nvm_run
$nvm evaluate $demo/fast_lio_shape $demo/the_same_on_nvm $demo/nvm_run --truth $demo/sequence --out $demo/report
PYTHONPATH=python/nvm python3 -m report $demo/report >/dev/null # of the Python package, which need not be built for it
echo
echo "The wall with and without nvm: $PWD/$demo/report/wall_free_standing.svg"
echo "Trajectories, errors, times:   $PWD/$demo/report/report.html"
