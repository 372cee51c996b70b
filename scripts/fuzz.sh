#!/usr/bin/env bash
# Builds the targets of tests/fuzz and lets libFuzzer run them one after the other.
#   scripts/fuzz.sh [SECONDS [TARGET...]]     60 s of every target unless named
# What it finds interesting is kept in build/fuzz/corpus, findings are files build/fuzz/findings/TARGET-*.
set -euo pipefail
"$(dirname "$0")/setup.sh" --developer
source "$(dirname "$0")/environment.sh"
seconds=${1:-60}
targets=("${@:2}")
((${#targets[@]})) || mapfile -t targets < <(basename -s _target.cpp tests/fuzz/*_target.cpp)
cmake --preset fuzz
cmake --build --preset fuzz

mkdir -p build/fuzz/findings
found=()
for target in "${targets[@]}"; do
  mkdir -p "build/fuzz/corpus/$target"
  log=build/fuzz/$target.log
  if build/fuzz/tests/fuzz/fuzz_"$target" -max_total_time="$seconds" -timeout=20 -rss_limit_mb=2048 -max_len=4096 -len_control=0 \
    -print_final_stats=1 -artifact_prefix="build/fuzz/findings/$target-" \
    "build/fuzz/corpus/$target" "tests/fuzz/corpus/$target" &>"$log"; then
    verdict="no finding"
  else
    verdict="A FINDING, see $log"
    found+=("$target")
  fi
  echo "$target: $(sed -n 's/.*number_of_executed_units: *//p' "$log") executions, $verdict"
done
((${#found[@]} == 0))
