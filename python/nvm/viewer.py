# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The nvm authors
"""Runs in rerun's viewer, finished ones and those that go on: scan, map by side, trajectory, what a
scan does not tell, the status and the times of each scan."""

from __future__ import annotations

import json
import os
import pathlib
import sys
import threading
import time

import numpy as np

from .results import SIDE_COLORS, STAGES, Cloud, Results, read_cloud, thinned

PATH_STEP = 1.02
MAP_STEP = 1.1  # in points, from one map that is drawn to the next: all together hold ten times the last
ARROW = 1.0  # [m]
STATUS_LEVELS = ("skipped", "lost", "weak", "initializing", "degenerate", "tracking")


def views_of_a_run(rrb):
    """What is beside what, made with rerun.blueprint."""
    return rrb.Horizontal(
        rrb.Spatial3DView(origin="world"),
        rrb.Vertical(
            rrb.TimeSeriesView(origin="status"),
            rrb.TimeSeriesView(origin="times"),
            rrb.TextLogView(origin="log"),
        ),
        column_shares=(3, 1),
    )


def open_stream(recording=None, views=views_of_a_run):
    """A stream of rerun's: into the file `recording`, or else into a viewer that it starts."""
    try:
        import rerun as rr
        import rerun.blueprint as rrb
    except ImportError as error:
        raise RuntimeError("to look at runs takes rerun: pip install rerun-sdk") from error
    stream = rr.RecordingStream("nvm")
    if recording is None:
        stream.spawn(default_blueprint=views(rrb))
    else:
        stream.save(recording, default_blueprint=views(rrb))
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
        self._time = -float("inf")  # of the last [s]
        self._map_points = 0  # of the map drawn
        self._status = None

    def at(self, seconds: float) -> None:
        self._stream.set_time("time", timestamp=seconds)

    def pose(self, seconds: float, position, quaternion) -> None:
        """T_map_body at `seconds`."""
        rr = self._rr
        self.at(seconds)
        if seconds < self._time:  # the run has begun again
            self._positions, self._drawn = [], 0
        self._time = seconds
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

    def scan(self, points, T_map_lidar) -> None:
        """Points (N, 3) [m] in the LiDAR's frame, and where it is: x y z qx qy qz qw."""
        rr = self._rr
        turn = rr.Quaternion(xyzw=T_map_lidar[3:])
        self._stream.log("world/lidar", rr.Transform3D(translation=T_map_lidar[:3], quaternion=turn))
        self._stream.log("world/lidar/scan", rr.Points3D(points, colors=[200, 200, 200], radii=0.015))

    def unobserved(self, position, translations, rotations) -> None:
        """What a scan does not tell: directions in the map's frame, at `position`, and axes in the body's."""
        self._arrows("world/unobserved_translations", position, translations, [220, 30, 30])
        self._arrows("world/body/unobserved_rotations", (0.0, 0.0, 0.0), rotations, [200, 60, 200])

    def _arrows(self, entity, origin, directions, color) -> None:
        both_ways = [sign * ARROW * np.asarray(d) for d in directions for sign in (1.0, -1.0)]
        arrows = self._rr.Arrows3D(vectors=both_ways, origins=[origin] * len(both_ways), colors=color)
        self._stream.log(entity, arrows if both_ways else self._rr.Clear(recursive=False))

    def growing_map(self, positions, sides) -> None:
        """The map as it is now, where it has grown enough to be drawn again."""
        if len(sides) > self._map_points * MAP_STEP:
            self._map_points = len(sides)
            self.cloud(thinned(Cloud(positions, np.zeros_like(positions), sides)))

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


class StreamReader:
    """Takes the stream of a run (docs/formats.md) from a pipe."""

    def __init__(self, pipe):
        self._pipe = pipe

    def __iter__(self):
        """The head of each frame, its scan (N, 3), and the map's points (M, 3) and sides (M,)."""
        for line in self._pipe:
            head = json.loads(line)
            scan = self._rows(head["scan"])
            yield head, scan, self._rows(head["map"]), self._numbers(head["map"], "u1")

    def _rows(self, count):
        return self._numbers(3 * count, "<f4").reshape(-1, 3)

    def _numbers(self, count, kind):
        size = count * np.dtype(kind).itemsize
        data = self._pipe.read(size)
        if len(data) < size:
            raise EOFError("the stream of the run breaks off")
        return np.frombuffer(data, kind)


class RunFollower:
    """Shows what a run of the program writes to `sink` while it goes on, and its map in the end."""

    def __init__(self, folder, stream):
        self._folder = pathlib.Path(folder)
        self._begin = time.time()
        self._log = RunLog(stream)
        self._source, self.sink = os.pipe()
        self._thread = threading.Thread(target=self._follow)

    def __enter__(self):
        self._thread.start()
        return self

    def __exit__(self, *_):
        os.close(self.sink)
        self._thread.join()
        saved = self._folder / "map.nvm"
        if saved.is_file() and saved.stat().st_mtime >= self._begin - 1.0:  # the run has put it there
            self._log.cloud(thinned(read_cloud(saved)))

    def _follow(self):
        with os.fdopen(self._source, "rb") as pipe:
            try:
                for frame in StreamReader(pipe):
                    self._show(*frame)
            except Exception as error:  # the run goes on without its viewer
                print(f"nvm: warning: the run is no longer shown: {error}", file=sys.stderr)

    def _show(self, head, scan, positions, sides):
        counts = {"unobserved_directions": len(head["unobserved_translations"]) + len(head["unobserved_rotations"])}
        if head["T_map_body"]:
            pose = np.array(head["T_map_body"])
            self._log.pose(head["time"], pose[:3], pose[3:])
            self._log.scan(scan, np.array(head["T_map_lidar"]))
            self._log.unobserved(pose[:3], head["unobserved_translations"], head["unobserved_rotations"])
        self._log.frame({**head, **head["times"], **counts})
        self._log.growing_map(positions, sides)
