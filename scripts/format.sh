#!/usr/bin/env bash
# Formats every C++ file; with --check, only says which ones are not formatted, and fails.
set -euo pipefail
source "$(dirname "$0")/environment.sh"
options=(-i)
[[ ${1:-} == --check ]] && options=(--dry-run --Werror)
find adapters benchmarks examples include python ros src tests \( -name '*.hpp' -o -name '*.cpp' \) -print0 |
  xargs -0 clang-format "${options[@]}"
