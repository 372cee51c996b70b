# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The nvm authors
"""Odometry in Python: nvm beside KISS-ICP and RKO-LIO, scan by scan on the same arrays.

usage: odometry.py SEQUENCE...

SEQUENCE is an nvm sequence with its truth (nvm simulate). One thread each; CPU time per scan of all calls
that feed the odometry, and RMSE of the IMU's positions after rigid alignment: for the end or the middle of
each scan as the time of its pose, whichever fits better. The others run with their own settings, and with
voxels of 0.5 m.
"""

import json
import pathlib
import sys
import time

import numpy as np

sys.path.append(str(pathlib.Path(__file__).parents[1] / "tests"))
from sequences import RECORD  # noqa: E402

import nvm  # noqa: E402


class Sequence:
    def __init__(self, folder):
        rows = np.genfromtxt(folder / "scans.csv", delimiter=",", names=True, dtype=None, encoding="utf-8")
        self.imu = np.loadtxt(folder / "imu.csv", delimiter=",", skiprows=1)
        self.truth = np.loadtxt(folder / "groundtruth.tum")
        pose = json.loads((folder / "meta.json").read_text())["T_imu_lidar"]
        self.T_imu_lidar = np.eye(4)
        self.T_imu_lidar[:3, 3] = pose["translation"]
        assert pose["quaternion_xyzw"] == [0.0, 0.0, 0.0, 1.0]
        self.scans = []  # begin, end [s], points [m], times [s]
        for _, begin, end, file in rows:
            records = np.fromfile(folder / file, RECORD)
            self.scans.append((begin, end, records["xyz"].astype(float), begin + records["dt"].astype(float)))

    def samples(self):
        """The IMU's readings up to the end of each scan."""
        ends = np.searchsorted(self.imu[:, 0], [scan[1] for scan in self.scans], side="right")
        return np.split(self.imu, ends)[:-1]

    def error(self, positions):
        """RMSE [mm]."""
        errors = []
        for share in (0.5, 1.0):
            times = np.array([begin + share * (end - begin) for begin, end, *_ in self.scans])
            true = np.stack([np.interp(times, self.truth[:, 0], self.truth[:, i]) for i in (1, 2, 3)], axis=1)
            a, b = positions - positions.mean(axis=0), true - true.mean(axis=0)
            u, _, vt = np.linalg.svd(a.T @ b)
            u[:, -1] *= np.linalg.det(u @ vt)
            errors.append(np.sqrt(np.mean(np.sum((a @ u @ vt - b) ** 2, axis=1))))
        return 1e3 * min(errors)


def with_nvm(sequence, has_imu):
    odometry = nvm.Odometry({"threads": 1}, T_imu_lidar=sequence.T_imu_lidar)
    for scan, imu in zip(sequence.scans, sequence.samples()):
        if has_imu:
            odometry.add_imu(imu[:, 0], imu[:, 1:4], imu[:, 4:7])
        frame = odometry.register(scan[2], scan[3])
        yield frame.T_map_body if has_imu else frame.T_map_lidar @ np.linalg.inv(sequence.T_imu_lidar)


def with_kiss_icp(sequence, voxel_size):
    from kiss_icp.config import KISSConfig
    from kiss_icp.kiss_icp import KissICP

    config = KISSConfig()
    config.mapping.voxel_size = voxel_size
    config.registration.max_num_threads = 1
    odometry = KissICP(config)
    for begin, end, points, times in sequence.scans:
        odometry.register_frame(points, (times - begin) / (end - begin))
        yield odometry.last_pose @ np.linalg.inv(sequence.T_imu_lidar)


def with_rko_lio(sequence, voxel_size):
    from rko_lio.config import LIOConfig
    from rko_lio.lio import LIO

    odometry = LIO(LIOConfig(voxel_size=voxel_size, max_num_threads=1))
    pose = np.eye(4)
    for (begin, end, points, times), imu in zip(sequence.scans, sequence.samples()):
        for row in imu:
            odometry.add_imu_measurement(row[4:7], row[1:4], round(1e9 * (row[0] + 1.0)), np.eye(4))
        stamps = np.round(1e9 * (times + 1.0)).astype(np.int64)
        odometry.register_scan(
            points, stamps, sequence.T_imu_lidar, round(1e9 * (begin + 1.0)), round(1e9 * (end + 1.0))
        )
        pose = odometry.pose()
        yield pose


CONTESTANTS = {
    "nvm": lambda s: with_nvm(s, True),
    "RKO-LIO, 1 m": lambda s: with_rko_lio(s, 1.0),
    "RKO-LIO, 0.5 m": lambda s: with_rko_lio(s, 0.5),
    "nvm, scans alone": lambda s: with_nvm(s, False),
    "KISS-ICP, 1 m": lambda s: with_kiss_icp(s, 1.0),
    "KISS-ICP, 0.5 m": lambda s: with_kiss_icp(s, 0.5),
}


def main(folders):
    for folder in folders:
        sequence = Sequence(pathlib.Path(folder))
        print(f"{folder}: {len(sequence.scans)} scans")
        for name, run in CONTESTANTS.items():
            begin = time.process_time()
            poses = np.stack(list(run(sequence)))
            seconds = time.process_time() - begin
            milliseconds = 1e3 * seconds / len(poses)
            print(f"{name:<20} {milliseconds:7.2f} ms per scan, {sequence.error(poses[:, :3, 3]):8.1f} mm", flush=True)


if __name__ == "__main__":
    main(sys.argv[1:])
