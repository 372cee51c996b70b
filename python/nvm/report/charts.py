# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The nvm authors
"""The pictures of an evaluation, as texts of SVG, by matplotlib."""

from __future__ import annotations

import io
import math

import matplotlib
import numpy as np
from matplotlib.figure import Figure

COLORS = ("#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#7f3c8d", "#8c564b")
SIDE_COLORS = ("#1f77b4", "#e4572e")
UNKNOWN_SIDE = "#888888"
MAX_WALLS = 12  # that are drawn
SURROUNDINGS = 60.0  # of a wall, that are drawn [mm]
DOT_DPI = 220  # of the dots, which are an image within the picture
STYLE = {
    "svg.fonttype": "none",  # text stays text
    "font.family": "sans-serif",
    "font.size": 8.5,
    "axes.titlesize": 10,
    "axes.titleweight": "bold",
    "axes.titlelocation": "left",
    "axes.grid": True,
    "axes.axisbelow": True,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "grid.color": "#e4e4e4",
    "grid.linewidth": 0.7,
}


def color_of(run: int) -> str:
    """In all charts and tables."""
    return COLORS[run % len(COLORS)]


def svg_of(draw, name: str, *arguments) -> str:
    """The ``<svg>`` element of the figure that draw(*arguments) makes; the same bytes each time. `name`
    keeps apart the parts of pictures that are in one page."""
    with matplotlib.rc_context({**STYLE, "svg.hashsalt": name}):
        file = io.StringIO()
        draw(*arguments).savefig(file, format="svg", dpi=DOT_DPI, metadata={"Date": None, "Creator": None})
    text = file.getvalue()
    return text[text.index("<svg") :]


def trajectory_chart(evaluation: dict, drawing: dict) -> str:
    """True and aligned estimated trajectories, and the true walls, from above."""
    return svg_of(draw_trajectories, "trajectories", drawing)


def draw_trajectories(drawing: dict) -> Figure:
    figure, axes = chart("Trajectories and walls from above", "x [m]", "y [m]", (6.6, 5.0))
    for wall in drawing["truth"]["walls"]:
        axes.plot(*np.array(wall).T, c="#222222", lw=1.0)
    axes.plot(*columns(drawing["truth"]["path"], 2), c="#222222", lw=0.8)
    for i, run in enumerate(drawing["runs"]):
        axes.plot(*columns(run["path"], 2), c=color_of(i), lw=1.1, gid=f"path-run-{i}")
    axes.set_aspect("equal", adjustable="datalim")
    return figure


def error_chart(evaluation: dict, drawing: dict) -> str:
    """The position error of each run over time."""
    return svg_of(draw_errors, "errors", drawing)


def draw_errors(drawing: dict) -> Figure:
    figure, axes = chart("Position error over time", "time from the start [s]", "error [mm]", (6.6, 5.0))
    for i, run in enumerate(drawing["runs"]):
        times, errors = columns(run["errors"], 2)
        axes.plot(times, 1e3 * errors, c=color_of(i), lw=1.1, gid=f"error-run-{i}")
    axes.set_ylim(bottom=0.0)
    return figure


def wall_pictures(evaluation: dict, drawing: dict) -> list[tuple[str, str]]:
    """Names and cross-sections of the regions, and of the walls that were seen: of all, or of the
    MAX_WALLS whose worst error over all runs is largest (a wall that a map lacks being worst). One run
    is beside the other; points are coloured by the side that their normals tell, lines are the true faces."""
    pictures = []
    for kind in ("walls", "regions"):
        for i in drawn(evaluation, kind):
            walls = [(run["map"] or {kind: []})[kind] for run in evaluation["runs"]]
            name = next(of_run[i]["name"] for of_run in walls if of_run)
            sections = [
                (run, run["map"][kind][i], section[kind][i])
                for run, section in zip(evaluation["runs"], drawing["runs"])
                if run["map"]
            ]
            pictures.append((name, svg_of(draw_sections, name, sections)))
    return pictures


def drawn(evaluation: dict, kind: str) -> list[int]:
    """Which walls are drawn, ascending."""
    lists = [run["map"][kind] for run in evaluation["runs"] if run["map"]]
    seen = [i for i in range(len(lists[0]) if lists else 0) if lists[0][i]["seen"]]

    def worst(i):
        errors = [walls[i]["error_mm"] for walls in lists]
        return math.inf if None in errors else max(map(abs, errors))

    return seen if kind == "regions" else sorted(sorted(seen, key=worst, reverse=True)[:MAX_WALLS])


def draw_sections(sections: list[tuple[dict, dict, list]]) -> Figure:
    figure = Figure(figsize=(4.4 * len(sections), 2.7), layout="constrained")
    all_axes = figure.subplots(1, len(sections), sharex=True, sharey=True, squeeze=False)[0]
    thickness = next((w["true_thickness_mm"] or w["thickness_mm"] or 0.0 for _, w, _ in sections), 0.0)
    for axes, (run, wall, points) in zip(all_axes, sections):
        along, across, side = columns(points, 3)
        by_normal = run["map"]["sides"] == "by normal"
        colors = np.where(side == 0, *SIDE_COLORS) if by_normal else UNKNOWN_SIDE
        axes.scatter(along, 1e3 * across, s=3.0, c=colors, lw=0, rasterized=True)
        for face in (0.5, -0.5) if wall["true_thickness_mm"] else ():
            axes.axhline(face * wall["true_thickness_mm"], c="#222222", lw=0.9)
        axes.set_title(section_title(run, wall))
        axes.set_xlabel("along the wall [m]")
    all_axes[0].set_ylabel("across [mm]")
    all_axes[0].set_ylim(-thickness / 2 - SURROUNDINGS, thickness / 2 + SURROUNDINGS)
    return figure


def section_title(run: dict, wall: dict) -> str:
    if wall["thickness_mm"] is None:
        return f"{run['name']}: not found"
    error = "" if wall["error_mm"] is None else f" ({wall['error_mm']:+.2f})"
    return f"{run['name']}: {wall['thickness_mm']:.2f} mm{error}"


def chart(title: str, x: str, y: str, size) -> tuple[Figure, matplotlib.axes.Axes]:
    figure = Figure(figsize=size, layout="constrained")
    axes = figure.subplots()
    axes.set(title=title, xlabel=x, ylabel=y)
    return figure, axes


def columns(rows, count: int) -> np.ndarray:
    """The `count` columns of `rows`, which may be none."""
    return np.array(rows or np.zeros((0, count)), dtype=float).T
