#!/usr/bin/env bash
# Builds the benchmarks for this machine and runs them; arguments go to benchmarks/run.py.
set -euo pipefail
source "$(dirname "$0")/environment.sh"
scripts/setup.sh
cmake --workflow --preset bench
python3 benchmarks/run.py "$@"
