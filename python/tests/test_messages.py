# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The nvm authors
"""What the C++ reader makes of messages that come from Python: points, times and units to the bit.

$NVM_PRINT_SEQUENCE is print_sequence of the C++ tests.
"""

import json
import os
import subprocess

import numpy as np
import pytest

pytest.importorskip("rosbags")
from recordings import CLOUD, FORMATS, IMU, LIVOX, LIVOX_POINT, write

from nvm.bags import Recording
from nvm.choice import choose
from nvm.program import write_messages

PRINT_SEQUENCE = os.environ.get("NVM_PRINT_SEQUENCE")
pytestmark = pytest.mark.skipif(not PRINT_SEQUENCE, reason="needs $NVM_PRINT_SEQUENCE")

START = 1_700_000_000.0  # [s]
COUNT = 12


def expected_points(scan):
    """x, y, z, intensity, dt [s], ring: numbers that float32 holds exactly."""
    i = np.arange(COUNT)
    return np.stack([i + 0.5, 0 * i - scan, 2.0 * i, 10.0 * i, i / 128, i % 4], axis=1)


def cloud(m, scan, time, field="t", ticks=1e9, origin=0.0):
    """A cloud in the order of its rings, with padding between the fields."""
    kind = np.dtype(
        {
            "names": ["x", "y", "z", "intensity", field, "ring"],
            "formats": ["f4", "f4", "f4", "f4", "f8", "u2"],
            "offsets": [0, 4, 8, 16, 24, 20],
            "itemsize": 32,
        }
    )
    values = np.zeros(COUNT, kind)
    for column, name in enumerate(kind.names):
        values[name] = expected_points(scan)[:, column]
    values[field] = values[field] * ticks + origin
    message = m.cloud(time, values[np.argsort(values["ring"], kind="stable")], "sensor")
    return message


def in_two_rows(m, scan, time):
    """The same with padding behind each row."""
    message = cloud(m, scan, time)
    half = len(message.data) // 2
    padding = np.full(7, 255, np.uint8)
    message.data = np.concatenate([message.data[:half], padding, message.data[half:], padding])
    message.height, message.width, message.row_step = 2, COUNT // 2, half + 7
    return message


def livox(m, scan, time):
    values = np.zeros(COUNT, LIVOX_POINT)
    points = expected_points(scan)
    for column, name in enumerate(["x", "y", "z", "reflectivity", "offset_time", "line"]):
        values[name] = np.round(points[:, column] * 1e9) if name == "offset_time" else points[:, column]
    return m.livox(time, values)


def of(make_cloud, kind=CLOUD, gravity=9.75):
    """A maker of three scans from START on, with IMU samples at 100 Hz."""

    def make(m):
        for step in range(31):
            time = START + 0.01 * step
            yield "/imu", IMU, time, m.imu(time, (0.125, -0.25, 0.5), (0, 0, gravity))
            if step % 10 == 0 and step > 0:
                scan = step // 10 - 1
                yield "/points", kind, time, make_cloud(m, scan, START + 0.1 * scan)

    return make


def read(path):
    """The sequence that the C++ reader makes of a recording."""
    read_end, write_end = os.pipe()
    command = [PRINT_SEQUENCE, f"/dev/fd/{read_end}"]
    with subprocess.Popen(command, pass_fds=[read_end], stdout=subprocess.PIPE) as process:
        os.close(read_end)
        with Recording(path) as recording:
            assert write_messages(write_end, recording, choose(recording)) == ""
        return json.loads(process.stdout.read())


def check(sequence, gravity=9.75):
    assert len(sequence["scans"]) == 3
    for index, scan in enumerate(sequence["scans"]):
        assert scan["t_begin"] == pytest.approx(START + 0.1 * index, abs=1e-6)
        assert scan["t_end"] - scan["t_begin"] == pytest.approx(11 / 128, abs=1e-6)
        assert np.allclose(scan["points"], expected_points(index), rtol=0, atol=1e-6)
    samples = np.array(sequence["imu"])
    assert len(samples) >= 28
    assert np.allclose(samples[:, 0], START + 0.01 * np.arange(len(samples)), rtol=0, atol=1e-6)
    assert np.allclose(samples[:, 1:], [0.125, -0.25, 0.5, 0, 0, gravity], rtol=0, atol=1e-6)


@pytest.mark.parametrize("form", FORMATS)
@pytest.mark.parametrize("make_cloud", [cloud, in_two_rows], ids=["packed", "two rows"])
def test_clouds(tmp_path, form, make_cloud):
    sequence = read(write(tmp_path / "bag", form, of(make_cloud)))
    check(sequence)
    assert sequence["format"] == {"bag": "ROS 1 bag", "ros1.mcap": "MCAP"}.get(form, "ROS 2 bag")


@pytest.mark.parametrize("form", FORMATS)
def test_livox(tmp_path, form):
    check(read(write(tmp_path / "bag", form, of(livox, LIVOX))))


def test_absolute_times_in_seconds(tmp_path):
    def absolute(m, scan, time):
        return cloud(m, scan, time, "timestamp", 1.0, time)

    check(read(write(tmp_path / "bag", "db3", of(absolute))))


def test_accelerations_in_g(tmp_path):
    sequence = read(write(tmp_path / "bag", "mcap", of(cloud, gravity=1.0)))
    check(sequence, 9.80665)


def test_a_recording_that_ends_early_is_an_error(tmp_path):
    read_end, write_end = os.pipe()
    os.write(write_end, b'{"format": "nvm messages", "version": 1, "source": "x.mcap", "topics": [')
    os.write(write_end, b'{"name": "/p", "type": "sensor_msgs/PointCloud2", "count": 9}]}\n\0\0\0\0ab')
    os.close(write_end)
    done = subprocess.run(
        [PRINT_SEQUENCE, f"/dev/fd/{read_end}"], pass_fds=[read_end], capture_output=True, text=True
    )
    os.close(read_end)
    assert done.returncode == 1 and "x.mcap: ended before its last message" in done.stderr


@pytest.mark.parametrize("head", [b"", b"\n", b"{}\n", b"[1]\n", b'{"format": "nvm messages"}\n', b"\xff\xfe\n"])
def test_another_pipe_is_refused(head):
    read_end, write_end = os.pipe()
    os.write(write_end, head)
    os.close(write_end)
    done = subprocess.run(
        [PRINT_SEQUENCE, f"/dev/fd/{read_end}"], pass_fds=[read_end], capture_output=True, text=True
    )
    os.close(read_end)
    assert done.returncode == 1 and "not of nvm messages" in done.stderr


@pytest.mark.parametrize("make_cloud, kind", [(in_two_rows, CLOUD), (livox, LIVOX)], ids=["cloud", "livox"])
def test_the_reader_of_bags_gives_the_same(tmp_path, make_cloud, kind):
    bag = write(tmp_path / "bag", "bag", of(make_cloud, kind))
    done = subprocess.run([PRINT_SEQUENCE, bag], capture_output=True, text=True)
    if "built without ROS 1 bags" in done.stderr:
        pytest.skip(done.stderr)
    assert json.loads(done.stdout) == read(bag)
