#!/usr/bin/env bash
# Builds the benchmarks for this machine and runs them; arguments go to benchmarks/run.py.
set -euo pipefail
"$(dirname "$0")/setup.sh"
source "$(dirname "$0")/environment.sh"

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

# KISS-ICP's map: its source package fetches the C++ when it is built, so it comes from a checkout or its repository, as do
# the headers that it needs.
clone() { # repository, tag: into $rivals
  [[ -d $rivals/$(basename "$1") ]] ||
    GIT_TERMINAL_PROMPT=0 git clone --quiet --depth 1 --branch "$2" "https://github.com/$1" "$rivals/$(basename "$1")" 2>/dev/null
}
kiss_icp=${NVM_KISS_ICP_SOURCE:-$rivals/kiss-icp}
sophus=${NVM_SOPHUS_INCLUDE:-$rivals/Sophus}
[[ -d $kiss_icp && -d $sophus ]] || { clone PRBonn/kiss-icp v1.2.3 && clone strasdat/Sophus 1.24.6; } || {
  echo "bench: KISS-ICP cannot be cloned (NVM_KISS_ICP_SOURCE and NVM_SOPHUS_INCLUDE name checkouts); its rows are left out"
  kiss_icp=""
}

cmake --preset bench -D NVM_SMALL_GICP_INCLUDE="$(realpath $rivals/small_gicp-1.0.1/include 2>/dev/null || true)" \
  -D NVM_KISS_ICP_SOURCE="${kiss_icp:+$(realpath "$kiss_icp")}" -D NVM_SOPHUS_INCLUDE="${kiss_icp:+$(realpath "$sophus")}"
cmake --build --preset bench --target nvm_map_benchmark nvm_normals_benchmark nvm_query_probe nvm_flags_probe_plain nvm_flags_probe_native
python3 benchmarks/run.py "$@"
