#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The nvm authors
"""Makes small bags with the rosbags package and reads them with nvm.

usage: convert_bag_test.py CONVERT_BAG_SCRIPT PRINT_SEQUENCE [--with-rosbag]

ROS 2 bags (db3 and mcap) go through the converter, ROS 1 bags through it and, with --with-rosbag,
also straight into nvm; each must give the points, times and IMU samples that went in. Exits with 77
(skipped) when rosbags is missing.
"""

import contextlib
import io
import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

try:
    import numpy as np
    from rosbags.rosbag1 import Writer as Writer1
    from rosbags.rosbag2 import StoragePlugin
    from rosbags.rosbag2 import Writer as Writer2
    from rosbags.typesys import Stores, get_types_from_msg, get_typestore
except ImportError as error:
    print(f"skipped: {error}; install it with: pip install rosbags")
    sys.exit(77)

SCRIPT, PRINT_SEQUENCE = sys.argv[1:3]
WITH_ROSBAG = "--with-rosbag" in sys.argv
sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(SCRIPT).parent))
import convert_bag  # noqa: E402  (the script under test)

START = 1_700_000_000
POINT_COUNT = 12


def point(scan, index):
    """x, y, z, intensity, dt [s], ring of a point: any numbers that float32 holds exactly."""
    return (index + 0.5, -scan, 2.0 * index, 10.0 * index, index / 128, index % 4)


class Messages:
    """Builds the messages of one ROS version and knows how they are serialised."""

    def __init__(self, is_ros2):
        self.is_ros2 = is_ros2
        self.store = get_typestore(Stores.ROS2_HUMBLE if is_ros2 else Stores.ROS1_NOETIC)
        for package in convert_bag.LIVOX_PACKAGES:
            for text, name in (
                (convert_bag.CUSTOM_POINT, "CustomPoint"),
                (convert_bag.CUSTOM_MSG, "CustomMsg"),
            ):
                self.store.register(get_types_from_msg(text, f"{package}/msg/{name}"))

    def make(self, kind, /, **members):
        return self.store.types[kind](**members)

    def serialise(self, message):
        kind = message.__msgtype__
        if self.is_ros2:
            return self.store.serialize_cdr(message, kind)
        return self.store.serialize_ros1(message, kind)

    def header(self, nanoseconds):
        seconds, rest = divmod(nanoseconds, 10**9)
        stamp = self.make("builtin_interfaces/msg/Time", sec=seconds, nanosec=rest)
        extra = {} if self.is_ros2 else {"seq": 0}
        return self.make("std_msgs/msg/Header", stamp=stamp, frame_id="sensor", **extra)

    def cloud(self, scan, nanoseconds, field="t", ticks=1e9):
        """A cloud of two rows with padding; its order is that of the rings, not of time."""
        fields = [("x", 0, 7, "f4"), ("y", 4, 7, "f4"), ("z", 8, 7, "f4"), ("intensity", 16, 7, "f4")]
        fields += [(field, 24, 8, "f8"), ("ring", 20, 4, "u2")]
        dtype = np.dtype(
            {
                "names": [f[0] for f in fields],
                "formats": [f[3] for f in fields],
                "offsets": [f[1] for f in fields],
                "itemsize": 32,
            }
        )
        points = np.zeros(POINT_COUNT, dtype)
        for row, index in enumerate(sorted(range(POINT_COUNT), key=lambda i: i % 4)):
            x, y, z, intensity, dt, ring = point(scan, index)
            points[row] = (x, y, z, intensity, dt * ticks, ring)
        half = POINT_COUNT // 2
        padding = b"\xff" * 7
        data = points[:half].tobytes() + padding + points[half:].tobytes() + padding
        return self.make(
            "sensor_msgs/msg/PointCloud2",
            header=self.header(nanoseconds),
            height=2,
            width=half,
            fields=[
                self.make("sensor_msgs/msg/PointField", name=n, offset=o, datatype=d, count=1)
                for n, o, d, _ in fields
            ],
            is_bigendian=False,
            point_step=32,
            row_step=32 * half + 7,
            data=np.frombuffer(data, np.uint8),
            is_dense=True,
        )

    def livox(self, scan, nanoseconds, package):
        points = []
        for index in range(POINT_COUNT):
            x, y, z, intensity, dt, ring = point(scan, index)
            points.append(
                self.make(
                    f"{package}/msg/CustomPoint",
                    offset_time=round(dt * 1e9),
                    x=x,
                    y=y,
                    z=z,
                    reflectivity=int(intensity),
                    tag=0,
                    line=ring,
                )
            )
        return self.make(
            f"{package}/msg/CustomMsg",
            header=self.header(nanoseconds),
            timebase=nanoseconds,
            point_num=len(points),
            lidar_id=1,
            rsvd=np.zeros(3, np.uint8),
            points=points,
        )

    def imu(self, nanoseconds, gravity):
        def vector(x, y, z):
            return self.make("geometry_msgs/msg/Vector3", x=x, y=y, z=z)

        return self.make(
            "sensor_msgs/msg/Imu",
            header=self.header(nanoseconds),
            orientation=self.make("geometry_msgs/msg/Quaternion", x=0.0, y=0.0, z=0.0, w=1.0),
            orientation_covariance=np.zeros(9),
            angular_velocity=vector(0.125, -0.25, 0.5),
            angular_velocity_covariance=np.zeros(9),
            linear_acceleration=vector(0.0, 0.0, gravity),
            linear_acceleration_covariance=np.zeros(9),
        )


def write_bag(writer, messages, make_cloud, gravity):
    """Three scans from START s on at 10 Hz, with IMU samples at 100 Hz."""
    with writer:
        connections = {}
        for step in range(31):
            nanoseconds = START * 10**9 + step * 10**7
            batch = [("/imu/data", messages.imu(nanoseconds, gravity))]
            if step % 10 == 0 and step > 0:
                scan = step // 10 - 1
                batch.append(("/points", make_cloud(scan, START * 10**9 + scan * 10**8)))
            for topic, message in batch:
                kind = message.__msgtype__
                if topic not in connections:
                    connections[topic] = writer.add_connection(
                        topic, kind, typestore=messages.store
                    )
                writer.write(connections[topic], nanoseconds, messages.serialise(message))


class ConvertBag(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.path = pathlib.Path(self.folder.name)

    def tearDown(self):
        self.folder.cleanup()

    def convert(self, bag, *options):
        """Nothing, or the script's error."""
        with contextlib.redirect_stdout(io.StringIO()):
            return convert_bag.main([str(bag), str(self.path / "sequence"), *options])

    def read(self, path):
        result = subprocess.run([PRINT_SEQUENCE, str(path)], capture_output=True, text=True)
        self.assertEqual(result.returncode, 0, result.stderr)
        return json.loads(result.stdout)

    def check(self, sequence, gravity=9.75):
        self.assertEqual(len(sequence["scans"]), 3)
        for index, scan in enumerate(sequence["scans"]):
            self.assertAlmostEqual(scan["t_begin"], START + 0.1 * index, places=6)
            self.assertAlmostEqual(scan["t_end"] - scan["t_begin"], 11 / 128, places=6)
            expected = [point(index, i) for i in range(POINT_COUNT)]
            np.testing.assert_allclose(scan["points"], expected, rtol=0, atol=1e-6)
        times = [START + 0.01 * i for i in range(len(sequence["imu"]))]
        self.assertGreaterEqual(len(times), 28)
        np.testing.assert_allclose([s[0] for s in sequence["imu"]], times, rtol=0, atol=1e-6)
        for sample in sequence["imu"]:
            expected = [0.125, -0.25, 0.5, 0, 0, gravity]
            np.testing.assert_allclose(sample[1:], expected, rtol=0, atol=1e-6)

    def check_ros2(self, make_cloud_of, storage):
        messages = Messages(is_ros2=True)
        writer = Writer2(self.path / "bag", version=9, storage_plugin=storage)
        write_bag(writer, messages, make_cloud_of(messages), 9.75)
        self.assertIsNone(self.convert(self.path / "bag"))
        self.check(self.read(self.path / "sequence"))

    def test_ros2_clouds_in_mcap(self):
        self.check_ros2(lambda messages: messages.cloud, StoragePlugin.MCAP)

    def test_ros2_clouds_in_db3_with_absolute_times(self):
        def make_cloud_of(messages):
            def make(scan, nanoseconds):
                cloud = messages.cloud(scan, 0, "timestamp", ticks=1.0)
                data = cloud.data.copy()
                for row in range(POINT_COUNT):
                    at = row * 32 + (7 if row >= POINT_COUNT // 2 else 0) + 24
                    time = data[at : at + 8].view(np.float64) + nanoseconds / 1e9
                    data[at : at + 8] = time.view(np.uint8)
                cloud.data = data
                return cloud

            return make

        self.check_ros2(make_cloud_of, StoragePlugin.SQLITE3)

    def test_ros2_livox(self):
        def make_cloud_of(messages):
            return lambda scan, time: messages.livox(scan, time, "livox_ros_driver2")

        self.check_ros2(make_cloud_of, StoragePlugin.MCAP)

    def test_ros1_clouds_and_livox(self):
        messages = Messages(is_ros2=False)
        makers = [messages.cloud]
        for package in convert_bag.LIVOX_PACKAGES[:2]:
            makers.append(lambda scan, time, p=package: messages.livox(scan, time, p))
        for index, make_cloud in enumerate(makers):
            with self.subTest(index):
                bag = self.path / f"{index}.bag"
                write_bag(Writer1(bag), messages, make_cloud, 9.75)
                self.assertIsNone(self.convert(bag))
                self.check(self.read(self.path / "sequence"))
                (self.path / "sequence").rename(self.path / f"sequence{index}")
                if WITH_ROSBAG:
                    self.check(self.read(bag))

    def test_accelerations_in_g_and_extrinsic(self):
        messages = Messages(is_ros2=True)
        writer = Writer2(self.path / "bag", version=9, storage_plugin=StoragePlugin.SQLITE3)
        write_bag(writer, messages, messages.cloud, 1.0)
        pose = ["0.1", "-0.2", "0.3", "0", "0", "1", "0"]
        self.assertIsNone(self.convert(self.path / "bag", "--T-imu-lidar", *pose))
        self.check(self.read(self.path / "sequence"), gravity=9.80665)
        meta = json.loads((self.path / "sequence/meta.json").read_text())
        self.assertEqual(meta["T_imu_lidar"]["translation"], [0.1, -0.2, 0.3])
        self.assertEqual(meta["T_imu_lidar"]["quaternion_xyzw"], [0, 0, 1, 0])
        self.assertEqual(meta["counts"], {"scans": 3, "points": 36, "imu_samples": 31})

    def test_errors_are_one_line_and_leave_nothing(self):
        messages = Messages(is_ros2=True)
        writer = Writer2(self.path / "bag", version=9, storage_plugin=StoragePlugin.SQLITE3)
        write_bag(writer, messages, lambda scan, time: messages.cloud(scan, 0), 9.75)
        for bag, options in (
            ("bag", ()),  # all scans at time 0
            ("bag", ("--lidar-topic", "/none")),
            ("none", ()),
            ("bag/metadata.yaml", ("--imu-topic", "/none")),
        ):
            self.assertRegex(self.convert(self.path / bag, *options), r"^error: [^\n]+$")
            self.assertEqual([p.name for p in self.path.iterdir()], ["bag"])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
