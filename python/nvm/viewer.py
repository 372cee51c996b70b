# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The nvm authors
"""Runs in rerun's viewer, finished ones and those that go on: map by side, trajectory, the status
and the times of each scan."""

from __future__ import annotations

import contextlib
import csv
import pathlib
import threading
import time

import numpy as np

from .plots import SIDE_COLORS, STAGES, thinned
from .results import Cloud, Results, read_cloud

PATH_STEP = 1.02
STATUS_LEVELS = ("skipped", "lost", "weak", "initializing", "degenerate", "tracking")


def open_stream(recording=None):
    """A stream of rerun's: into the file `recording`, or else into a viewer that it starts."""
    try:
        import rerun as rr
        import rerun.blueprint as rrb
    except ImportError as error:
        raise RuntimeError("to look at runs takes rerun: pip install rerun-sdk") from error
    views = rrb.Horizontal(
        rrb.Spatial3DView(origin="world"),
        rrb.Vertical(
            rrb.TimeSeriesView(origin="status"),
            rrb.TimeSeriesView(origin="times"),
            rrb.TextLogView(origin="log"),
        ),
        column_shares=(3, 1),
    )
    stream = rr.RecordingStream("nvm")
    if recording is None:
        stream.spawn(default_blueprint=views)
    else:
        stream.save(recording, default_blueprint=views)
    stream.log("world", rr.ViewCoordinates.RIGHT_HAND_Z_UP, static=True)
    return stream


class RunLog:
    """What is known of a run, into a stream."""

    def __init__(self, stream):
        import rerun

        self._rr = rerun
        self._stream = stream
        self._positions = []
        self._drawn = 0  # of them
        self._status = None

    def at(self, seconds: float) -> None:
        self._stream.set_time("time", timestamp=seconds)

    def pose(self, seconds: float, position, quaternion) -> None:
        """T_map_body at `seconds`."""
        rr = self._rr
        self.at(seconds)
        self._positions.append(position)
        turn = rr.Quaternion(xyzw=quaternion)
        self._stream.log("world/body", rr.Transform3D(translation=position, quaternion=turn))
        self._stream.log("world/body/axes", rr.TransformAxes3D(0.5))
        if len(self._positions) > self._drawn * PATH_STEP:  # each holds all before it
            self._drawn = len(self._positions)
            self._stream.log("world/path", rr.LineStrips3D([self._positions], colors=[[0, 200, 0]]))

    def frame(self, row: dict) -> None:
        """A row of frames.csv."""
        rr = self._rr
        self.at(float(row["time"]))
        status = row["status"]
        level = STATUS_LEVELS.index(status) if status in STATUS_LEVELS else -1
        self._stream.log("status/of_scan", rr.Scalars(float(level)))
        if "unobserved_directions" in row:
            count = float(row["unobserved_directions"])
            self._stream.log("status/unobserved_directions", rr.Scalars(count))
        for stage in STAGES:
            if f"{stage}_ms" in row:
                self._stream.log(f"times/{stage}", rr.Scalars(float(row[f"{stage}_ms"])))
        if status != self._status:
            self._status = status
            self._stream.log("log", rr.TextLog(f"{status} {row['why']}".strip()))

    def cloud(self, cloud: Cloud) -> None:
        for side, (name, color) in enumerate(zip(("front", "back"), SIDE_COLORS)):
            rows = cloud.sides == side
            points = self._rr.Points3D(
                cloud.positions[rows],
                colors=[int(color[i : i + 2], 16) for i in (1, 3, 5)],
                radii=0.02,
            )
            self._stream.log(f"world/map/{name}", points, static=True)

    def results(self, results: Results) -> None:
        """Everything of a finished run."""
        if results.cloud is not None:
            self.cloud(thinned(results.cloud))
        if results.trajectory is not None:
            t = results.trajectory
            for pose in zip(t.times, t.positions, t.quaternions):
                self.pose(*pose)
        if results.frames:
            names = list(results.frames)
            for values in zip(*results.frames.values()):
                self.frame(dict(zip(names, values)))


class LineFollower:
    """Whole lines of a file that grows, as they come."""

    def __init__(self):
        self._offset = 0

    def lines(self, path: pathlib.Path) -> list[str]:
        try:
            with open(path, "rb") as file:
                file.seek(self._offset)
                data = file.read()
        except FileNotFoundError:  # not begun, or put in its place meanwhile
            return []
        whole = data[: data.rfind(b"\n") + 1]
        self._offset += len(whole)
        return whole.decode().splitlines()


class RunFollower:
    """Streams what a run of the program writes to its folder while it goes on."""

    PERIOD = 0.1  # [s]

    def __init__(self, folder, stream):
        self._folder = pathlib.Path(folder)
        self._before = set(self._unfinished())
        self._begin = time.time()
        self._log = RunLog(stream)
        self._poses, self._frames = LineFollower(), LineFollower()
        self._names = None
        self._done = threading.Event()
        self._thread = threading.Thread(target=self._follow)

    def __enter__(self):
        self._thread.start()
        return self

    def __exit__(self, *_):
        self._done.set()
        self._thread.join()
        if self._is_new("trajectory.tum"):
            self._step(self._folder)
        if self._is_new("map.nvm"):
            self._log.cloud(thinned(read_cloud(self._folder / "map.nvm")))

    def _is_new(self, name):
        """Whether the run has put this file in its place."""
        file = self._folder / name
        return file.is_file() and file.stat().st_mtime >= self._begin - 1.0

    def _unfinished(self):
        return self._folder.glob("nvm-results.part-*")

    def _follow(self):
        while not self._done.wait(self.PERIOD):
            for folder in set(self._unfinished()) - self._before:
                with contextlib.suppress(OSError):
                    self._step(folder)

    def _step(self, folder):
        for line in self._poses.lines(folder / "trajectory.tum"):
            numbers = np.array(line.split(), dtype=float)
            self._log.pose(numbers[0], numbers[1:4], numbers[4:])
        for line in self._frames.lines(folder / "frames.csv"):
            self._frame(line)

    def _frame(self, line):
        cells = next(csv.reader([line]))
        if self._names is None:
            self._names = cells
        else:
            self._log.frame(dict(zip(self._names, cells)))
