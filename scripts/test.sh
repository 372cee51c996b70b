#!/usr/bin/env bash
# Installs what is missing, builds everything and runs every test.
set -euo pipefail
source "$(dirname "$0")/environment.sh"
scripts/setup.sh
cmake --workflow --preset dev
