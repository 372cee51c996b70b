# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The nvm authors
"""Pictures of a run, by matplotlib: from above, in cross-section, its times and its errors."""

from __future__ import annotations

import pathlib

import matplotlib
import numpy as np
from matplotlib.figure import Figure

from .results import SIDE_COLORS, STAGES, Cloud, ResultError, Results, Trajectory, thinned

SLICE = 0.05  # half a slice's thickness [m]


def draw_sides(axes, cloud: Cloud, columns, size=0.5) -> None:
    """Scatters two coordinates, each side of its voxel in its own colour."""
    for side, color in enumerate(SIDE_COLORS):
        rows = cloud.sides == side
        axes.scatter(*cloud.positions[rows][:, columns].T, s=size, c=color, lw=0, rasterized=True)
    axes.set_aspect("equal")
    axes.set_xlabel("xyz"[columns[0]] + " [m]")
    axes.set_ylabel("xyz"[columns[1]] + " [m]")


def plot_top(results: Results) -> Figure:
    """The map from above, floors and ceilings left out, with the trajectory."""
    figure = Figure(figsize=(10, 10), layout="constrained")
    axes = figure.subplots()
    if results.cloud is not None:
        upright = np.abs(results.cloud.normals[:, 2]) < 0.5
        draw_sides(axes, thinned(results.cloud, upright), [0, 1])
    if results.trajectory is not None:
        axes.plot(*results.trajectory.positions[:, :2].T, c="k", lw=1, label="trajectory")
        axes.legend()
    axes.set_aspect("equal")
    axes.set_title("From above, walls by side")
    return figure


def slice_centers(results: Results) -> np.ndarray:
    """Where the sections go: through the middle of the trajectory, else of the map."""
    places = results.trajectory.positions if results.trajectory is not None else results.cloud.positions
    return np.median(places, axis=0)


def plot_sections(results: Results) -> Figure:
    """Three slices of 10 cm through the map, in which the two faces of a wall can be told."""
    figure = Figure(figsize=(15, 6), layout="constrained")
    center = slice_centers(results)
    for axes, axis in zip(figure.subplots(1, 3), (2, 1, 0)):
        near = np.abs(results.cloud.positions[:, axis] - center[axis]) < SLICE
        columns = [c for c in range(3) if c != axis]
        draw_sides(axes, thinned(results.cloud, near), columns, size=1.5)
        axes.set_title(f"{'xyz'[axis]} = {center[axis]:.2f} ± {SLICE} m")
    return figure


def plot_times(frames: dict) -> Figure:
    """CPU time of each stage over the scans, and what became of each scan."""
    figure = Figure(figsize=(12, 6), layout="constrained")
    above, below = figure.subplots(2, 1, sharex=True, height_ratios=(4, 1))
    begin = frames["time"] - frames["time"][0]
    stages = [name for name in STAGES if f"{name}_ms" in frames]
    above.stackplot(begin, *[frames[f"{name}_ms"] for name in stages], labels=stages)
    above.set_ylabel("CPU time [ms]")
    above.legend(loc="upper right")
    known = list(dict.fromkeys(frames["status"]))
    colors = matplotlib.colormaps["tab10"]
    for place, status in enumerate(known):
        rows = [i for i, value in enumerate(frames["status"]) if value == status]
        label = f"{status}: {len(rows)}"
        below.scatter(begin[rows], [place] * len(rows), s=6, color=colors(place % 10), label=label)
    below.set_yticks(range(len(known)), known)
    below.legend(loc="upper right", fontsize="small")
    below.set_xlabel("time [s]")
    return figure


def aligned(estimate: np.ndarray, truth: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """The rigid transform R (3, 3), t (3,) that brings `estimate` (N, 3) closest to `truth`
    (S. Umeyama, 1991, without scale)."""
    mean_estimate, mean_truth = estimate.mean(axis=0), truth.mean(axis=0)
    u, _, vt = np.linalg.svd((truth - mean_truth).T @ (estimate - mean_estimate))
    flip = np.diag([1.0, 1.0, np.linalg.det(u) * np.linalg.det(vt)])
    rotation = u @ flip @ vt
    return rotation, mean_truth - rotation @ mean_estimate


def position_errors(estimate: Trajectory, truth: Trajectory) -> tuple[np.ndarray, np.ndarray]:
    """Times (M,) and errors (M, 3) [m] after a rigid alignment, where the truth, interpolated
    between poses at most 0.25 s apart, has a pose."""
    times = estimate.times
    after = np.searchsorted(truth.times, times).clip(1, max(1, len(truth.times) - 1))
    inside = (times >= truth.times[0]) & (times <= truth.times[-1])
    if len(truth.times) > 1:
        inside &= truth.times[after] - truth.times[after - 1] <= 0.25
    if inside.sum() < 3:
        raise ResultError("the truth has a pose at fewer than 3 of the run's times: another clock?")
    there = np.stack([np.interp(times[inside], truth.times, c) for c in truth.positions.T], axis=1)
    rotation, translation = aligned(estimate.positions[inside], there)
    return times[inside], estimate.positions[inside] @ rotation.T + translation - there


def plot_errors(estimate: Trajectory, truth: Trajectory) -> Figure:
    """The errors of the positions over time."""
    times, errors = position_errors(estimate, truth)
    figure = Figure(figsize=(12, 5), layout="constrained")
    axes = figure.subplots()
    for axis, column in zip("xyz", errors.T):
        axes.plot(times - times[0], 1000 * column, lw=0.8, label=axis)
    distances = np.linalg.norm(errors, axis=1)
    axes.plot(times - times[0], 1000 * distances, c="k", lw=1.2, label="distance")
    rmse = 1000 * np.sqrt(np.mean(distances**2))
    axes.set_title(f"Position errors, rigidly aligned: RMSE {rmse:.2f} mm, max {1000 * distances.max():.2f} mm")
    axes.set_xlabel("time [s]")
    axes.set_ylabel("error [mm]")
    axes.legend()
    return figure


def write_plots(results: Results, folder, truth: Trajectory | None = None) -> list[pathlib.Path]:
    """Writes the pictures that `results` have data for to `folder`, and returns their paths."""
    figures = {"top.png": plot_top(results)}
    if results.cloud is not None and len(results.cloud.sides):
        figures["sections.png"] = plot_sections(results)
    if results.frames:
        figures["times.png"] = plot_times(results.frames)
    if truth is not None and results.trajectory is not None:
        figures["errors.png"] = plot_errors(results.trajectory, truth)
    folder = pathlib.Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    for name, figure in figures.items():
        figure.savefig(folder / name, dpi=120)
    return [folder / name for name in figures]
