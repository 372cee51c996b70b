#!/usr/bin/env bash
# Installs what is missing, builds everything and runs every test.
#   scripts/test.sh [PRESET [CMake options]]     dev unless named: CMakePresets.json lists the others
set -euo pipefail
"$(dirname "$0")/setup.sh"
source "$(dirname "$0")/environment.sh"
preset=${1:-dev}
cmake --preset "$preset" "${@:2}"
cmake --build --preset "$preset"
ctest --preset "$preset"
