#!/usr/bin/env bash
# Compiles the examples, which use all of the core, as strangers would: other compilers, standards, flags, targets and versions of
# Eigen, as far as Debian and PyPI bring them. Warnings of nvm's headers are errors, and nothing is run: the tests do that here
# and under emulators. A set-up whose compiler or library is not there is left out, and said.
set -uo pipefail
source "$(dirname "$0")/environment.sh"
unset CMAKE_CXX_COMPILER_LAUNCHER
work=build/matrix
mkdir -p $work/logs $work/nanoflann
ln -sf /usr/include/nanoflann.hpp $work/nanoflann/ # cross compilers do not look into /usr/include
debian=/usr/include/eigen3
# All examples as one source file: most of the time goes into the headers. What is no main() any more has to return something.
for example in examples/*.cpp; do
  printf '#define main example_%s\n#include "../../%s"\n#undef main\n' "$(basename "$example" .cpp)" "$example"
done >$work/examples.cpp

# eigen NAME PACKAGE==VERSION FOLDER: headers out of a wheel, into $work/NAME.
eigen() {
  [[ -f $work/$1/Eigen/Dense ]] && return
  python3 -m pip download --quiet --no-deps --only-binary :all: --python-version 3.11 --platform manylinux2014_x86_64 \
    --dest $work/wheels "$2" 2>/dev/null || return
  python3 -m zipfile -e "$(ls $work/wheels/"${2%%=*}"*.whl $work/wheels/"$(tr - _ <<<"${2%%=*}")"*.whl 2>/dev/null | head -1)" $work/unpacked
  mv "$work/unpacked/$3" "$work/$1"
}
eigen eigen-3.4.1 cmeel-eigen==3.4.1 cmeel.prefix/include/eigen3
eigen eigen-5.0.1 eigency==5.0.1.1 eigency/eigen

# NAME | compiler | folder of Eigen | flags
matrix="
g++, C++17 | g++ | $debian | -std=c++17
g++, C++20 | g++ | $debian | -std=c++20
g++, C++23 | g++ | $debian | -std=c++23
g++, -Os -fno-rtti | g++ | $debian | -std=c++17 -Os -fno-rtti
g++, -ffast-math | g++ | $debian | -std=c++17 -O2 -ffast-math
g++, AVX2 | g++ | $debian | -std=c++17 -march=x86-64-v3
g++, AVX-512 | g++ | $debian | -std=c++17 -march=x86-64-v4
g++, no vectors | g++ | $debian | -std=c++17 -U__SSE2__
g++, Eigen 3.4.1 | g++ | $work/eigen-3.4.1 | -std=c++17
g++, Eigen 5.0.1 | g++ | $work/eigen-5.0.1 | -std=c++17
clang, C++17 | clang++ | $debian | -std=c++17
clang, C++20 | clang++ | $debian | -std=c++20
clang, AVX2 | clang++ | $debian | -std=c++17 -march=x86-64-v3
clang, Eigen 5.0.1 | clang++ | $work/eigen-5.0.1 | -std=c++17
aarch64 | aarch64-linux-gnu-g++ | $debian | -std=c++17
i686, SSE2 | i686-linux-gnu-g++ | $debian | -std=c++17 -msse2
i686, AVX2 | i686-linux-gnu-g++ | $debian | -std=c++17 -mavx2
Windows, MinGW | x86_64-w64-mingw32-g++-posix | $debian | -std=c++17 -D_USE_MATH_DEFINES
"

# try NAME COMPILER EIGEN FLAGS...: one line of the table.
try() {
  local name=$1 compiler=$2 eigen=$3 log verdict=passed
  log=$work/logs/$(tr -c 'A-Za-z0-9\n' _ <<<"$name").log
  if ! command -v "$compiler" >/dev/null; then
    verdict="left out: no $compiler"
  elif [[ ! -d $eigen ]]; then
    verdict="left out: $(basename "$eigen") cannot be had"
  else
    "$compiler" "${@:4}" -fsyntax-only -Wall -Wextra -Wconversion -Wsign-conversion -Werror -Wno-return-type -Iinclude -isystem "$eigen" \
      -isystem $work/nanoflann $work/examples.cpp >"$log" 2>&1 || verdict=FAILED
  fi
  printf '%-22s %s\n' "$name" "$verdict"
  [[ $verdict != FAILED ]] || sed -n '1,20p' "$log"
}
export -f try
export work

while IFS='|' read -r name compiler eigen flags; do
  read -r name <<<"$name"
  [[ -z $name ]] || printf 'try %q %s %s %s\0' "$name" "$compiler" "$eigen" "$flags"
done <<<"$matrix" | xargs --null --max-procs "$(nproc)" --replace bash -c '{}' | tee $work/verdicts
! grep -q 'FAILED$' $work/verdicts
