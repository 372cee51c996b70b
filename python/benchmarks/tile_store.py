# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The nvm authors
"""How the time to build a tile store scales: measured with 1 and 2 workers, modelled beyond.

    python python/benchmarks/tile_store.py [--points 2e7] [--workers 1 2]

The model packs the measured times of the tasks, which one process takes, onto more workers.
"""

import argparse
import heapq
import tempfile
import time
from pathlib import Path

import numpy as np
from distributed import LocalCluster
from nvm.distributed import Session, build

SCAN = 20_000  # points


def session(scans: int, folder: Path) -> Session:
    """A sensor that goes along a street 20 m wide, a scan each metre, in files."""
    random = np.random.default_rng(1)
    paths, poses = [], np.tile(np.eye(4), (scans, 1, 1))
    poses[:, 0, 3] = np.arange(scans)
    for k in range(scans):
        points = random.uniform([-30, -10, -1.5], [30, 10, 6], (SCAN, 3))
        axis = random.integers(1, 3, SCAN)
        points[axis == 1, 1] = np.copysign(10, points[axis == 1, 1])
        points[axis == 2, 2] = -1.5
        paths.append(folder / f"{k}.npy")
        np.save(paths[-1], points.astype(np.float32))
    return Session(paths, poses)


class Timed:
    """Runs the tasks one after the other and keeps what each took."""

    def __init__(self):
        self.stages: list[list[float]] = []

    def submit(self, task, *arguments, **_):
        begin = time.perf_counter()
        result = task(*arguments)
        self.stages[-1].append(time.perf_counter() - begin)
        return result

    def gather(self, results):
        self.stages.append([])
        return results


def packed(times: list[float], workers: int) -> float:
    """How long `workers` take for tasks, each given to who is free first."""
    busy = [0.0] * workers
    for seconds in times:
        heapq.heappush(busy, heapq.heappop(busy) + seconds)
    return max(busy)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--points", type=float, default=2e7)
    parser.add_argument("--workers", type=int, nargs="*", default=[1, 2])
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        data = [session(max(1, int(arguments.points / SCAN)), folder)]
        timed = Timed()
        timed.stages.append([])
        build(data, folder / "model", client=timed)
        for workers in arguments.workers:
            with LocalCluster(
                n_workers=workers, threads_per_worker=1, dashboard_address=None
            ) as cluster, cluster.get_client() as client:
                begin = time.perf_counter()
                build(data, folder / f"store{workers}", client=client)
                print(f"{workers} workers, measured: {time.perf_counter() - begin:.1f} s")
        for workers in [1, 2, 4, 8, 16, 32]:
            seconds = sum(packed(stage, workers) for stage in timed.stages)
            print(f"{workers} workers, modelled: {seconds:.1f} s")


if __name__ == "__main__":
    main()
