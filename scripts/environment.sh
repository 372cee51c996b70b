# shellcheck shell=bash
# Sourced by the other scripts, after setup.sh where they call it: the repository's root as the working
# directory, the Python packages of .venv where setup.sh has made one, and ccache where it is installed.
cd "$(dirname "${BASH_SOURCE[0]}")/.." || exit
if [[ -x .venv/bin/python3 ]]; then
  export VIRTUAL_ENV="$PWD/.venv" PATH="$PWD/.venv/bin:$PATH"
fi
if command -v ccache >/dev/null; then
  export CMAKE_CXX_COMPILER_LAUNCHER=ccache CCACHE_BASEDIR="$PWD"
fi
