#!/usr/bin/env bash
# Makes the site in build/docs: the pages of docs/, the Python package from its docstrings, the C++ interface from its headers.
# A warning is an error, a link to nothing is a warning.
set -euo pipefail
"$(dirname "$0")/setup.sh" --developer
source "$(dirname "$0")/environment.sh"
tools=build/docs-tools
if ! cmp -s docs/requirements.txt $tools/requirements.txt; then
  python3 -m venv --clear $tools
  $tools/bin/pip install --quiet --requirement docs/requirements.txt
  cp docs/requirements.txt $tools
fi
# The wheel that scripts/test_python.sh has made will do.
ls build/python/nvm-*.whl >/dev/null 2>&1 || $tools/bin/pip wheel --quiet --no-deps --wheel-dir build/python .
$tools/bin/pip install --quiet --no-deps --upgrade --target $tools/package build/python/nvm-*.whl
NO_MKDOCS_2_WARNING=1 $tools/bin/mkdocs build --strict
doxygen docs/Doxyfile
echo "docs: $PWD/build/docs/index.html"
