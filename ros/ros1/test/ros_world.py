# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The nvm authors
"""A ROS of its own for a test: a master on a free port, and everything that is started in it.

usage of a test: TEST.py NVM_PROGRAM MAKE_ROS_BAG ROS_PACKAGES
"""

import math
import os
import pathlib
import signal
import socket
import subprocess
import sys
import tempfile
import time

NVM, MAKE_BAG, PACKAGES = sys.argv[1:4]
DURATION = 5.0  # of the simulated recording [s]


def free_port():
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


class RosWorld:
    """With-statement: starts a master, sets this process's environment; ends everything."""

    def __enter__(self):
        self._temporary = tempfile.TemporaryDirectory(prefix="nvm_ros_")
        self.folder = pathlib.Path(self._temporary.name)
        self._running = []
        port = free_port()
        os.environ.update(
            ROS_MASTER_URI=f"http://127.0.0.1:{port}",
            ROS_IP="127.0.0.1",
            ROS_HOME=str(self.folder / "home"),
            ROS_LOG_DIR=str(self.folder / "log"),
            ROS_PACKAGE_PATH=f"{PACKAGES}:/usr/share",
            PYTHONUNBUFFERED="1",
        )
        self.start("master", "rosmaster", "--core", "-p", str(port))
        wait_until(lambda: port_answers(port), "the master answers")
        return self

    def __exit__(self, kind, error, trace):
        for process in reversed(self._running):
            end(process)
        if kind is not None:
            for log in sorted(self.folder.glob("*.out")):
                print(f"--- {log.name}\n{log.read_text(errors='replace')[-4000:]}")
        self._temporary.cleanup()

    def start(self, name, *command):
        """A process whose output goes to NAME.out."""
        with open(self.folder / f"{name}.out", "a") as output:
            process = subprocess.Popen(
                command, stdout=output, stderr=subprocess.STDOUT, start_new_session=True
            )
        self._running.append(process)
        return process

    def start_node(self, *parameters, name="node"):
        """The odometry node with parameters such as "queue_size:=1000", and none of a node before.
        It waits for what a busy machine is late with."""
        import rosgraph

        master = rosgraph.Master("/ros_world")
        if master.hasParam("/nvm_odometry"):
            master.deleteParam("/nvm_odometry")
        words = [f"_{parameter}" for parameter in ("imu_timeout:=20", "tf_timeout:=1", *parameters)]
        return self.start(name, f"{PACKAGES}/nvm_ros/odometry_node", *words)

    def play(self, bag, *options):
        # A queue that a busy machine does not fill: what the player drops nobody can count.
        command = ("rosbag", "play", "--quiet", "--queue=100000", "--wait-for-subscribers")
        command += (*options, str(bag))
        return self.start("play", *command)

    def output(self, name):
        return (self.folder / f"{name}.out").read_text(errors="replace")

    def record(self, cloud_type="cloud", sensor="mid360", duration=DURATION):
        """A bag of a simulated walk past a thin wall, and what `nvm run` makes of it."""
        sequence = self.folder / f"{sensor}_{duration}"
        bag = self.folder / f"{sensor}_{duration}_{cloud_type}.bag"
        if not sequence.exists():
            run(NVM, "simulate", "wall5", "--sensor", sensor, "--duration", duration, "--out", sequence)
        if not bag.exists():
            run(MAKE_BAG, sequence, cloud_type, bag)
        return bag

    def reference(self, bag, *options):
        """Poses of `nvm run` on `bag`: rows t x y z qx qy qz qw."""
        out = self.folder / f"run_{bag.stem}"
        run(NVM, "run", bag, "--out", out, *options)
        lines = (out / "trajectory.tum").read_text().splitlines()
        return [[float(word) for word in line.split()] for line in lines]


def run(*command):
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True)
    assert done.returncode == 0, f"{command}: {done.stdout}{done.stderr}"


def end(process, how=signal.SIGINT):
    """Ends a process and its children."""
    for number in (how, signal.SIGKILL):
        if process.poll() is None:
            os.killpg(process.pid, number)
        try:
            return process.wait(timeout=10)
        except subprocess.TimeoutExpired:
            continue
    return process.wait()


def port_answers(port):
    with socket.socket() as probe:
        return probe.connect_ex(("127.0.0.1", port)) == 0


def wait_until(condition, what, timeout=240.0):
    deadline = time.monotonic() + timeout
    while not condition():
        assert time.monotonic() < deadline, f"waited {timeout} s in vain until {what}"
        time.sleep(0.05)


def row(odometry):
    """A nav_msgs/Odometry as a row of a TUM file."""
    p, q = odometry.pose.pose.position, odometry.pose.pose.orientation
    return [odometry.header.stamp.to_sec(), p.x, p.y, p.z, q.x, q.y, q.z, q.w]


def expect_same(rows, reference):
    """Asserts that two trajectories are the same, to what TUM files and ROS's stamps hold."""
    assert len(rows) == len(reference), f"{len(rows)} poses, nvm run has {len(reference)}"
    for ours, theirs in zip(rows, reference):
        assert abs(ours[0] - theirs[0]) < 1e-6, f"{ours[0]} is not {theirs[0]}"
        assert math.dist(ours[1:4], theirs[1:4]) < 3e-9, f"{ours} is not {theirs}"
        sign = 1.0 if sum(a * b for a, b in zip(ours[4:], theirs[4:])) > 0 else -1.0
        turned = math.dist(ours[4:], [sign * value for value in theirs[4:]])
        assert turned < 1e-11, f"{ours} is not {theirs}"
