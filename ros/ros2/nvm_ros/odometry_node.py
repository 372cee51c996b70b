# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The nvm authors
"""Scans and IMU readings in; odometry, TF and the two-sided map out.

One thread receives messages, another works on them."""

import pathlib
import threading
import time

import numpy as np
import nvm
import rclpy
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from nav_msgs.msg import Odometry, Path
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile
from sensor_msgs.msg import Imu, PointCloud2
from std_srvs.srv import Trigger

from . import messages
from .clouds import cloud_message, raw_cloud
from .finding_watch import FindingWatch
from .frames import TransformBroadcaster, Transforms
from .options import split
from .sensor_queue import SensorQueue
from .topics import choose, message_class, profile_for

STANDARD_GRAVITY = 9.80665
HAVE_POSE = ("tracking", "degenerate", "weak")  # one that can be trusted
MAX_PATH = 5000  # poses
LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
RECEIVING = 10  # scans that may wait before they are received, where none would be counted
LEARNING = 10  # scans that tell how all are dated, before the first is worked on


def columns_of(points: np.ndarray, normals: np.ndarray) -> dict:
    """Of a cloud with x y z and normal_x normal_y normal_z."""
    columns = {name: points[:, i].astype("f4") for i, name in enumerate("xyz")}
    return columns | {f"normal_{name}": normals[:, i].astype("f4") for i, name in enumerate("xyz")}


class OdometryNode(Node):
    def __init__(self, **arguments):
        super().__init__(
            "nvm_odometry",
            allow_undeclared_parameters=True,
            automatically_declare_parameters_from_overrides=True,
            **arguments,
        )
        parameters = {n: p.value for n, p in self.get_parameters_by_prefix("").items()}
        self.options, self._config = split(parameters)
        self._input = self._config.pop("input", {})
        nvm.ScanStream(self._input), nvm.Odometry(self._config)  # tell a bad option here
        self._lock = threading.Lock()
        self._reset()
        self._transforms = Transforms(self)
        self._tf = TransformBroadcaster(self) if TransformBroadcaster and self.options.publish_tf else None
        self._odometry_out = self.create_publisher(Odometry, "nvm/odometry", 100)
        self._path_out = self.create_publisher(Path, "nvm/path", LATCHED)
        self._map_out = self.create_publisher(PointCloud2, "nvm/map", LATCHED)
        self._frame_out = self.create_publisher(PointCloud2, "nvm/frame", 5)
        self._status_out = self.create_publisher(DiagnosticArray, "nvm/status", 10)
        self.create_service(Trigger, "nvm/save", self._save)
        self.create_service(Trigger, "nvm/reset", self._on_reset)
        self._queue = None
        self._worker = None
        self._counts = {"scans": 0, "scans with a pose": 0, "scans that could not be read": 0, "resets": 0}
        self._latencies = []
        self._bad = ""
        self._deadline = None
        self._epoch = 0
        self._detection = self.create_timer(0.2, self._detect)
        self.create_timer(1.0, self._report)

    def _detect(self) -> None:
        wants_imu = self.options.imu_topic != "none" and self._config.get("pipeline") != "lidar_only"
        own = (self._map_out.topic_name, self._frame_out.topic_name)
        topics = choose(self.get_topic_names_and_types(), self.options, wants_imu, own)
        if not topics.lidar:
            return
        self._deadline = self._deadline or time.monotonic() + self.options.detection_time
        if wants_imu and not topics.imu and time.monotonic() < self._deadline:
            return
        try:
            kind = message_class(topics.lidar_type)
        except ValueError as error:
            self.get_logger().error(f"{topics.lidar}: {error}", throttle_duration_sec=5.0)
            return
        self._detection.cancel()
        if wants_imu and not topics.imu:
            waited = f"no IMU topic within {self.options.detection_time} s: odometry from scans alone"
            topics.notes.append(f"{waited}; set imu_topic to wait for one")
        for note in topics.notes:
            self.get_logger().warning(note)
        self._begin(topics, kind)

    def _begin(self, topics, kind) -> None:
        lidar, imu = self._lidar_topic, self._imu_topic = topics.lidar, topics.imu
        self.get_logger().info(f"LiDAR: {lidar}, IMU: {imu or 'none'}")
        self._lidar_type = topics.lidar_type
        self._queue = SensorQueue(self.options.queue_size, bool(imu), self.options.imu_timeout)
        self._scans = nvm.ScanStream(self._input)
        profile = profile_for(self, lidar, self.options.queue_size + RECEIVING)
        self.create_subscription(kind, lidar, self._on_cloud, profile, raw=True)
        if imu:
            self.create_subscription(Imu, imu, self._on_imu, profile_for(self, imu, 2000))
        self._worker = threading.Thread(target=self._work, daemon=True)
        self._worker.start()

    def _on_cloud(self, cdr: bytes) -> None:
        cloud = raw_cloud(cdr, self._lidar_type, time.monotonic())
        self._queue.add_cloud(cloud.stamp, cloud)

    def _on_imu(self, imu) -> None:
        self._imu_frame = imu.header.frame_id
        stamp = imu.header.stamp.sec + 1e-9 * imu.header.stamp.nanosec
        w, a = imu.angular_velocity, imu.linear_acceleration
        self._queue.add_imu(stamp, (w.x, w.y, w.z), (a.x, a.y, a.z))

    def _work(self) -> None:
        waiting, has_learnt = [], False
        while (taken := self._queue.next_cloud()) is not None:
            waiting.append(taken)
            if not has_learnt:
                if len(waiting) < LEARNING:
                    continue
                has_learnt = self._learn([cloud for _, cloud in waiting])
            for epoch, cloud in waiting:
                self._take(epoch, cloud)
            waiting.clear()

    def _learn(self, clouds) -> bool:
        """Judges by the first clouds how all are dated; False when none of them can be read."""
        messages = []
        for cloud in clouds:
            try:
                messages.append(cloud.ros1())
            except ValueError:
                continue  # _take() tells it
        return self._scans.learn(messages, self._lidar_type) > 0

    def _take(self, epoch: int, cloud) -> None:
        if epoch != self._epoch:
            self._epoch = epoch
            with self._lock:
                self._begin_anew("time has gone back")
        try:
            self._process(epoch, cloud)
        except (ValueError, RuntimeError) as error:
            self._counts["scans that could not be read"] += 1
            self._bad = str(error)
            self.get_logger().error(f"a scan is left out: {error}", throttle_duration_sec=5.0)

    def _process(self, epoch: int, cloud) -> None:
        scan = self._scans.convert(cloud.ros1(), cloud.kind)
        with self._lock:
            needed = self._odometry.imu_needed_until(scan.end) if self._odometry else scan.end
        readings = self._queue.imu_until(epoch, needed)
        if readings is None:
            return
        if self._odometry is None and not self._start(cloud.frame):
            return
        with self._lock:
            if self._odometry is None:
                return  # reset meanwhile
            self._add(readings)
            frame = self._odometry.register(scan)
            self._counts["scans"] += 1
            self._publish(frame)
            findings = [*self._odometry.findings(), *self._scans.findings()]
            for finding in self._findings.new_ones(scan.end, findings):
                self.get_logger().warning(finding)
            self._latencies.append(time.monotonic() - cloud.arrival)

    def _start(self, lidar_frame: str) -> bool:
        if self._imu_topic and self._imu_frame is None:
            return False
        imu = self._imu_frame.lstrip("/") if self._imu_topic else None
        frames = self._transforms.find_frames(lidar_frame, imu, self.options)
        for note in frames.notes:
            self.get_logger().warning(note)
        with self._lock:
            self._frames = frames
            self._odometry = nvm.Odometry(self._config, T_imu_lidar=frames.T_body_lidar)
        return True

    def _add(self, readings) -> None:
        """Gives readings to the odometry once enough have told the unit of acceleration."""
        self._undecided += readings
        if self._scale is None and len(self._undecided) >= 20:
            unit = self._input.get("accel_unit", "auto")
            length = np.median([np.linalg.norm(a) for _, _, a in self._undecided])
            is_g = unit == "g" or (unit == "auto" and length < 3.0)
            self._scale = STANDARD_GRAVITY if is_g else 1.0
        if self._scale is not None:
            if self._undecided:
                times, gyro, accel = (np.array(column) for column in zip(*self._undecided))
                self._odometry.add_imu(times, gyro, self._scale * accel)
            self._undecided = []

    def _reset(self) -> None:
        self._odometry = self._frames = self._scale = self._last = None
        self._imu_frame = getattr(self, "_imu_frame", None)
        self._undecided, self._poses, self._findings = [], [], FindingWatch()
        self._next_map = self._next_path = 0.0

    def _begin_anew(self, reason: str) -> None:
        self.get_logger().warning(f"{reason}: odometry and map begin anew")
        self._counts["resets"] += 1
        self._reset()

    def _publish(self, frame) -> None:
        self._last = frame
        if frame.status not in HAVE_POSE:
            return
        self._counts["scans with a pose"] += 1
        odometry = messages.odometry_message(frame, self._frames, self.options.odom_frame)
        self._odometry_out.publish(odometry)
        if self._tf:
            self._tf.sendTransform(messages.transform_message(odometry))
        self._poses.append(messages.pose_message(odometry))
        if len(self._poses) > 2 * MAX_PATH:
            del self._poses[::2]
        stamp = odometry.header.stamp
        if self._frame_out.get_subscription_count():
            self._publish_frame(stamp)
        now = time.monotonic()
        if now >= self._next_path and self._path_out.get_subscription_count():
            step = -(-len(self._poses) // MAX_PATH)
            self._path_out.publish(Path(header=odometry.header, poses=self._poses[::-step][::-1]))
            self._next_path = now + 1.0
        if self.options.map_period > 0 and now >= self._next_map and self._map_out.get_subscription_count():
            self._publish_map(stamp)
            took = time.monotonic() - now
            self._next_map = now + max(self.options.map_period, 20 * took)

    def _publish_frame(self, stamp) -> None:
        """The scan, deskewed, in the base's frame."""
        points, normals = self._odometry.scan
        T_base_lidar = np.linalg.inv(self._frames.T_body_base) @ self._frames.T_body_lidar
        turn = T_base_lidar[:3, :3]
        columns = columns_of(points @ turn.T + T_base_lidar[:3, 3], normals @ turn.T)
        columns["intensity"] = self._odometry.scan_intensity
        self._frame_out.publish(cloud_message(stamp, self._frames.base, columns))

    def _publish_map(self, stamp) -> None:
        voxels = self._odometry.map
        columns = columns_of(voxels.points, voxels.normals)
        if voxels.options["intensity"]:
            columns["intensity"] = voxels.column("intensity")
        columns["side"] = voxels.sides
        self._map_out.publish(cloud_message(stamp, self.options.odom_frame, columns))

    def _report(self) -> None:
        if self._queue is None:
            return
        counts = dict(self._queue.counts)
        dropped = counts["dropped"] - getattr(self, "_reported_drops", 0)
        self._reported_drops = counts["dropped"]
        latencies, self._latencies = self._latencies, []
        status = self._last.status if self._last else "none"
        notes = [*(self._frames.notes if self._frames else []), *self._findings.said.values()]
        level = messages.LEVELS.get(status, DiagnosticStatus.WARN)
        text = self._last.message if self._last else self._why_nothing(counts)
        if self._queue.imu_is_silent:
            level, text = DiagnosticStatus.ERROR, f"no message on {self._imu_topic} any longer"
        elif level == DiagnosticStatus.OK and dropped:
            level, text = DiagnosticStatus.WARN, f"cannot keep up: {dropped} scans dropped"
            self.get_logger().warning(text, throttle_duration_sec=5.0)
        elif level == DiagnosticStatus.OK and self._bad:
            level, text, self._bad = DiagnosticStatus.WARN, f"a scan is left out: {self._bad}", ""
        elif level == DiagnosticStatus.OK and notes:
            level, text = DiagnosticStatus.WARN, notes[0]
        values = {"status": status, **self._counts, "scans dropped": counts["dropped"]}
        values |= {"IMU readings": counts["imu"], "IMU readings left out": counts["bad imu"]}
        values["latency, mean [ms]"] = f"{1e3 * np.mean(latencies):.1f}" if latencies else ""
        values["latency, max [ms]"] = f"{1e3 * max(latencies):.1f}" if latencies else ""
        values |= {f"note {i}": note for i, note in enumerate(notes, 1)}
        stamp = self.get_clock().now().to_msg()
        self._status_out.publish(messages.status_message(stamp, status, text, level, values))

    def _why_nothing(self, counts: dict) -> str:
        if counts["clouds"] == 0:
            return f"no message on {self._lidar_topic} yet"
        return self._bad or f"no message on {self._imu_topic} yet"

    def _save(self, _, response):
        folder = pathlib.Path(self.options.save_folder or "~/.ros/nvm").expanduser()
        with self._lock:
            voxels = self._odometry.map if self._poses else None
            poses = list(self._poses)
        try:
            if voxels is None:
                raise RuntimeError("there is no pose yet")
            folder.mkdir(parents=True, exist_ok=True)
            voxels.save(folder / "map.nvm")
            (folder / "trajectory.tum").write_text("".join(map(messages.tum_line, poses)))
            response.success, response.message = True, f"{folder}: {len(poses)} poses"
        except (OSError, RuntimeError) as error:
            response.success, response.message = False, str(error)
        return response

    def _on_reset(self, _, response):
        with self._lock:
            self._begin_anew("reset was asked for")
        response.success = True
        return response

    def destroy_node(self) -> None:
        if self._queue:
            self._queue.close()
            self._worker.join(timeout=5.0)
        super().destroy_node()


def main() -> None:
    rclpy.init()
    try:
        node = OdometryNode()
    except ValueError as error:
        raise SystemExit(f"nvm_odometry: {error}") from None
    try:
        rclpy.spin(node)
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        node.destroy_node()
        rclpy.try_shutdown()


if __name__ == "__main__":
    main()
