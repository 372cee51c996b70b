#!/usr/bin/env bash
# Builds the wheel as a user's pip does, installs it in an empty virtual environment and tests it there.
set -euo pipefail
source "$(dirname "$0")/environment.sh"
root=$PWD
folder=build/python
rm -rf "$folder" && mkdir -p "$folder"
python3 -m venv "$folder/venv"
python="$PWD/$folder/venv/bin/python"
# No library of the system is found, as on a machine that has only a compiler.
"$python" -m pip wheel --quiet --no-deps --wheel-dir "$folder" . \
  --config-settings=cmake.define.CMAKE_FIND_USE_CMAKE_SYSTEM_PATH=OFF
wheel=$(ls "$folder"/nvm-*.whl)
"$python" -m pip install --quiet auditwheel "${wheel}[test]"
"$python" -m auditwheel show "$wheel" | tee "$folder/auditwheel.txt"
"$python" -c 'import subprocess, sys, time
begin = time.perf_counter()
subprocess.run([sys.executable, "-c", "import nvm"], check=True)
print(f"import nvm: {time.perf_counter() - begin:.2f} s, the interpreter included")'
grep -q '"manylinux_' "$folder/auditwheel.txt" # a library that a bare machine lacks would leave it linux_x86_64
# C++ that was built before is what Python must agree with, and has the simulator.
for build in "$root/build/dev" "$root/build/release"; do
  if [[ -x $build/tests/io/print_sequence && -x $build/bin/nvm ]]; then
    export NVM_PRINT_SEQUENCE="$build/tests/io/print_sequence" NVM_TOOLS="$build/bin"
    break
  fi
done
cd python/tests # not the root, whose folder python/nvm must not stand in for the installed package
# No program is on the PATH, nor named: the commands have the one of the wheel.
env -u NVM_PROGRAM PATH="$(dirname "$python"):/usr/bin:/bin" "$python" -m pytest

# The packages for packets of sensors pin an old rosbags, so they have an environment of their own.
python3 -m venv "$root/$folder/packets"
python="$root/$folder/packets/bin/python"
"$python" -m pip install --quiet ouster-sdk velodyne-decoder pytest
"$python" -m pip install --quiet "$root/$wheel" 2>/dev/null # it says that ouster-sdk wants the old one
"$python" -m pytest -p no:asyncio test_packets.py
