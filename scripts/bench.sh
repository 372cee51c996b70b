#!/usr/bin/env bash
# Builds the benchmarks for this machine and runs them; arguments go to benchmarks/run.py.
set -euo pipefail
source "$(dirname "$0")/environment.sh"
scripts/setup.sh

# small_gicp's headers, from its source package, to be measured beside nvm; without them its rows are left out.
rivals=build/rivals
if [[ ! -d $rivals/small_gicp-1.0.1 ]]; then
  mkdir -p $rivals
  if python3 -m pip download --quiet --no-deps --no-binary :all: --dest $rivals small_gicp==1.0.1; then
    tar --extract --gzip --file $rivals/small_gicp-1.0.1.tar.gz --directory $rivals
  else
    echo "bench: small_gicp cannot be had from PyPI; its rows are left out"
  fi
fi

cmake --preset bench -D NVM_SMALL_GICP_INCLUDE="$(realpath $rivals/small_gicp-1.0.1/include 2>/dev/null || true)"
cmake --build --preset bench --target nvm_map_benchmark nvm_normals_benchmark nvm_query_probe
python3 benchmarks/run.py "$@"
