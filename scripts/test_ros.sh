#!/usr/bin/env bash
# Installs ROS 1, builds the node beside what scripts/test.sh has built, and tests it in a ROS of its own.
#   scripts/test_ros.sh [CMake options]
set -euo pipefail
"$(dirname "$0")/setup.sh" --ros
source "$(dirname "$0")/environment.sh"
cmake --preset dev -D NVM_BUILD_ROS=ON "$@"
cmake --build --preset dev --target nvm_program odometry_node make_ros_bag ros_test
ctest --preset dev --label-regex '^ros$'
