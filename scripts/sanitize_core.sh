#!/usr/bin/env bash
# Builds and tests the header-only core under one of the sanitizer presets.
#   scripts/sanitize_core.sh asan|tsan
set -euo pipefail
source "$(dirname "$0")/environment.sh"
preset=$1
cmake --preset "$preset" -D NVM_BUILD_APPS=OFF -D NVM_BUILD_ADAPTERS=OFF
cmake --build --preset "$preset"
ctest --preset "$preset"
