# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The nvm authors
"""A finished evaluation in rerun's viewer: true and estimated paths and the true walls from above, errors over time,
and a cross-section of each wall that was measured."""

from __future__ import annotations

import numpy as np

from .results import SIDE_COLORS, ResultError
from .viewer import open_stream


def show_evaluation(evaluation: dict, drawing: dict, recording=None) -> None:
    """Shows what `read_evaluation` gave, in the file `recording` or else in a viewer."""
    names = [run["name"] for run in evaluation["runs"]]
    try:
        walls = measured_walls(evaluation, drawing)
        stream = open_stream(recording, lambda rrb: views(rrb, walls))
        log_paths(stream, names, drawing)
        log_errors(stream, names, drawing)
        log_walls(stream, names, walls)
    except (KeyError, IndexError, TypeError) as error:
        raise ResultError("the evaluation was written by another version: evaluate again") from error


def views(rrb, walls):
    """What is beside what."""
    sections = [rrb.Spatial2DView(origin=f"walls/{i}", name=wall["name"]) for i, (wall, _) in enumerate(walls)]
    beside = [rrb.TimeSeriesView(origin="errors", name="position error [m]")]
    return rrb.Horizontal(
        rrb.Spatial3DView(origin="world"),
        rrb.Vertical(*beside, *([rrb.Tabs(*sections)] if sections else [])),
        column_shares=(3, 2),
    )


def measured_walls(evaluation: dict, drawing: dict) -> list[tuple[dict, list]]:
    """Each wall or region of which a map has points: what is known of it, and its points in the map of each run."""
    found = []
    maps = [(run["map"], drawn) for run, drawn in zip(evaluation["runs"], drawing["runs"])]
    for kind in ("walls", "regions"):
        known = next((of_run[kind] for of_run, _ in maps if of_run), [])
        for i, wall in enumerate(known):
            points = [drawn[kind][i] if of_run else [] for of_run, drawn in maps]
            if any(points):
                found.append((wall, points))
    return found


def on_the_floor(rows) -> np.ndarray:
    """Points (N, 3) of (N, 2) as seen from above."""
    return np.column_stack([rows, np.zeros(len(rows))])


def log_paths(stream, names: list[str], drawing: dict) -> None:
    import rerun as rr

    truth = drawing["truth"]
    if truth:
        grey = [150, 150, 150]
        stream.log("world/truth/path", rr.LineStrips3D([on_the_floor(truth["path"])], colors=grey), static=True)
        edges = [on_the_floor(edge) for edge in truth["walls"]]
        stream.log("world/truth/walls", rr.LineStrips3D(edges, colors=grey), static=True)
    for name, run in zip(names, drawing["runs"]):
        if run["path"]:
            stream.log(["world", "runs", name], rr.LineStrips3D([on_the_floor(run["path"])]), static=True)


def log_errors(stream, names: list[str], drawing: dict) -> None:
    import rerun as rr

    for name, run in zip(names, drawing["runs"]):
        for seconds, error in run["errors"] or ():
            stream.set_time("time", duration=seconds)
            stream.log(["errors", name], rr.Scalars(float(error)))


def log_walls(stream, names: list[str], walls) -> None:
    """Cross-sections [m]: along the wall, and across it from its middle."""
    import rerun as rr

    for i, (wall, points) in enumerate(walls):
        for name, rows in zip(names, points):
            if rows:
                along, across, side = np.array(rows, dtype=float).T
                colors = [int(SIDE_COLORS[int(face)][1:] + "ff", 16) for face in side]
                dots = rr.Points2D(np.column_stack([along, across]), colors=colors, radii=0.002)
                stream.log(["walls", str(i), name], dots, static=True)
        if wall["true_thickness_mm"]:
            log_faces(stream, i, 5e-4 * wall["true_thickness_mm"], points)


def log_faces(stream, wall: int, half: float, points) -> None:
    """The true faces, `half` [m] to either side of the middle, as long as the points."""
    import rerun as rr

    along = [row[0] for rows in points for row in rows]
    faces = [[(min(along), side * half), (max(along), side * half)] for side in (1, -1)]
    stream.log(["walls", str(wall), "true faces"], rr.LineStrips2D(faces, colors=[150, 150, 150]), static=True)
