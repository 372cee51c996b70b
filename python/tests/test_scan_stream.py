# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The nvm authors
"""nvm.ScanStream: raw messages as scans, dated as `nvm run` dates them."""

import numpy as np
import pytest
from support import box_room

import nvm

pytest.importorskip("rosbags")
from recordings import CLOUD, LIVOX, LIVOX_POINT, Messages, typestore

from nvm.serialization import ros1_of

BEGIN = 1_700_000_000.0  # [s]
PERIOD = 0.1
UNITS = {"s": 1.0, "ms": 1e3, "us": 1e6, "ns": 1e9}


def sweeps(unit, frame="lidar", count=10, origin=0.0):
    """Raw ROS 2 clouds of a sensor in a room, with times from their stamps on, and those times [s]."""
    m = Messages(typestore(False))
    rng = np.random.default_rng(1)
    for i in range(count):
        points = box_room(rng, 500, noise=0.003)
        times = np.linspace(0.0, 0.9 * PERIOD, len(points))
        records = np.zeros(len(points), [("x", "f4"), ("y", "f4"), ("z", "f4"), ("t", "f8")])
        records["x"], records["y"], records["z"] = points.T
        records["t"] = times * UNITS[unit] + origin * UNITS[unit]
        message = m.cloud(BEGIN + i * PERIOD, records, frame)
        raw = m.store.serialize_cdr(message, CLOUD)
        yield ros1_of(raw, CLOUD), points, BEGIN + i * PERIOD + times


@pytest.mark.parametrize("unit", UNITS)
def test_finds_the_unit_of_times(unit):
    clouds = list(sweeps(unit))
    stream = nvm.ScanStream()
    assert stream.learn([message for message, *_ in clouds]) == len(clouds)
    for message, points, times in clouds:
        scan = stream.convert(message, CLOUD)
        assert len(scan) == len(points) and scan.points.dtype == np.float32
        np.testing.assert_array_equal(scan.points, points.astype("f4"))
        np.testing.assert_allclose(scan.times, times, rtol=0, atol=1e-6)
        assert scan.begin == pytest.approx(times[0]) and scan.end == pytest.approx(times[-1], abs=0.01)
    assert any("point times" in note for note in stream.notes()) and stream.findings() == []


def test_a_unit_can_be_set_and_others_are_refused():
    stream = nvm.ScanStream({"point_time_unit": "us"})
    message, _, times = next(sweeps("us"))
    np.testing.assert_allclose(stream.convert(message).times, times, rtol=0, atol=1e-6)
    with pytest.raises(ValueError, match="point_time_unit"):
        nvm.ScanStream({"point_time_unit": "fortnights"})
    with pytest.raises(ValueError, match="point_time_units"):
        nvm.ScanStream({"point_time_units": "us"})


def test_keeps_to_one_of_two_lidars_and_says_so():
    stream = nvm.ScanStream()
    for (front, *_), (rear, *_) in zip(sweeps("s"), sweeps("s", "rear")):
        stream.convert(front)
        with pytest.raises(RuntimeError, match="of frame 'rear', not 'lidar'.*two LiDARs"):
            stream.convert(rear)


def test_livox_messages_are_read_as_their_bags_are():
    m = Messages(typestore(False))
    records = np.zeros(100, LIVOX_POINT)
    records["x"], records["offset_time"] = np.arange(1, 101), np.arange(100) * 1_000_000
    raw = m.store.serialize_cdr(m.livox(BEGIN, records), LIVOX)
    scan = nvm.ScanStream().convert(ros1_of(raw, LIVOX), LIVOX)
    np.testing.assert_array_equal(scan.points[:, 0], records["x"])
    np.testing.assert_allclose(scan.times, BEGIN + 1e-3 * np.arange(100), rtol=0, atol=1e-6)


@pytest.mark.parametrize("size", [0, 3, 40, 400, -2])
def test_truncated_messages_are_errors(size):
    message = bytes(next(sweeps("s"))[0])[:size]
    stream = nvm.ScanStream()
    with pytest.raises(RuntimeError):
        stream.convert(message)
    assert stream.learn([message]) == 0


def test_other_types_and_objects_are_refused():
    stream = nvm.ScanStream()
    with pytest.raises(ValueError, match="sensor_msgs/Imu"):
        stream.convert(b"", "sensor_msgs/msg/Imu")
    for odd in (None, 3, "text", [1.0]):
        with pytest.raises((TypeError, ValueError)):
            stream.convert(odd)
        with pytest.raises((TypeError, ValueError)):
            stream.learn([odd])


def test_scans_are_registered_as_arrays_are():
    stream, by_scan, by_arrays = nvm.ScanStream(), nvm.Odometry(), nvm.Odometry()
    for message, *_ in sweeps("s"):
        scan = stream.convert(message)
        one = by_scan.register(scan)
        other = by_arrays.register(scan.points, scan.times - scan.begin, scan.begin, scan.end)
        assert one.status == other.status
        np.testing.assert_allclose(one.T_map_body, other.T_map_body, atol=1e-6)
    assert one.status in ("tracking", "weak")  # of 500 points
