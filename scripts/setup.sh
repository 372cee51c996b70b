#!/usr/bin/env bash
# Installs what nvm needs on Debian 12 (Ubuntu alike); takes no time when everything is there.
#   scripts/setup.sh [--developer] [--pcl] [--ros]
#     --developer  also what formats, lints, fuzzes, documents, measures coverage, runs tests for ARM and compiles for others
#     --pcl        also PCL, for the adapter and its comparison (large), and ROS, for the hosts' setting
#     --ros        also ROS 1, for the node and its tests
set -euo pipefail
source "$(dirname "$0")/environment.sh"

packages=(
  # to build
  g++ make cmake ninja-build pkg-config ccache git ca-certificates
  # the core
  libeigen3-dev libnanoflann-dev
  # the compiled components and the nvm program
  libassimp-dev libcli11-dev libembree-dev libfmt-dev libtbb-dev
  libyaml-cpp-dev nlohmann-json3-dev libbz2-dev liblz4-dev librosbag-storage-dev libsensor-msgs-dev
  zlib1g-dev # asked for by the CMake package of assimp, but not by its Debian package
  # tests and benchmarks
  libbenchmark-dev libgmock-dev libgtest-dev robin-map-dev
  # plots, converters, the comparison with evo
  python3 python3-venv
)
for option in "$@"; do
  case $option in
    --developer)
      packages+=(
        clang libclang-rt-dev libomp-dev clang-format clang-tidy doxygen gcovr dpkg-dev qemu-user
        g++-aarch64-linux-gnu g++-i686-linux-gnu g++-mingw-w64-x86-64-posix
      )
      ;;
    --pcl) packages+=(libpcl-dev libroscpp-dev libpcl-conversions-dev) ;;
    --ros)
      packages+=(
        libroscpp-dev libtopic-tools-dev libtf2-ros-dev libdiagnostic-msgs-dev libnav-msgs-dev libstd-srvs-dev
        rosout python3-rosbag python3-roslaunch python3-rostopic python3-rosservice python3-tf2-ros
        python3-diagnostic-msgs python3-nav-msgs python3-sensor-msgs python3-std-srvs
      )
      ;;
    *) sed -n '2,6s/^# //p' "$0" && exit 2 ;;
  esac
done

say() { echo "setup: $*"; }

install_debian_packages() {
  if ! command -v apt-get >/dev/null; then
    say "not a Debian: the equivalents of these are up to you: ${packages[*]}"
    return
  fi
  local missing=() package
  for package in "${packages[@]}"; do
    dpkg-query --show --showformat='${db:Status-Status}' "$package" 2>/dev/null |
      grep -qx installed || missing+=("$package")
  done
  ((${#missing[@]})) || return 0
  local as_root=()
  if ((EUID != 0)); then
    as_root=(sudo)
    command -v sudo >/dev/null || {
      say "run as root: apt-get install ${missing[*]}"
      exit 1
    }
  fi
  say "installing ${missing[*]}"
  "${as_root[@]}" apt-get update -q
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
    apt-get install -q -y --no-install-recommends "${missing[@]}"
}

has_python_packages() {
  python3 -c 'import evo, ezdxf, jinja2, matplotlib, numpy, rosbags' 2>/dev/null
}

install_python_packages() {
  has_python_packages && return
  say "installing $(tr '\n' ' ' <scripts/requirements.txt)into .venv"
  python3 -m venv .venv
  .venv/bin/pip install --quiet --requirement scripts/requirements.txt
}

install_debian_packages
install_python_packages
say "everything is there"
