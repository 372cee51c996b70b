# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The nvm authors
"""The page of an evaluation: its tables, around the pictures."""

from __future__ import annotations

import pathlib

import jinja2

from .charts import color_of

NOTHING = "–"


def page(evaluation: dict, charts: list[str], pictures: list[tuple[str, str]]) -> str:
    """The HTML text; `charts` and `pictures` hold ``<svg>`` elements."""
    folder = pathlib.Path(__file__).parent
    environment = jinja2.Environment(
        loader=jinja2.FileSystemLoader(folder), autoescape=True, undefined=jinja2.StrictUndefined, trim_blocks=True
    )
    runs = evaluation["runs"]
    return environment.get_template("report.html.jinja").render(
        runs=[{"name": run["name"], "color": color_of(i)} for i, run in enumerate(runs)],
        rows=summary_rows(runs),
        charts=charts,
        walls=[
            (title, rows) for title, kind in (("Walls", "walls"), ("Regions", "regions")) if (rows := wall_rows(runs, kind))
        ],
        pictures=pictures,
    )


def summary_rows(runs: list[dict]) -> list[tuple[str, list[str]]]:
    """A label and a cell for each run; what no run has is left out."""
    rows = [*trajectory_rows(), *map_rows(), *timing_rows(runs)]
    filled = [(label, [cell(run) for run in runs]) for label, cell in rows]
    return [(label, cells) for label, cells in filled if set(cells) != {NOTHING}]


def trajectory_rows():
    def error(kind):
        return lambda run: number(run, ("trajectory", "ate_m", kind), 1e3, 2)

    def relative(step):
        def cell(run):
            millimetres = number(run, ("trajectory", step, "translation_m", "rmse"), 1e3, 2)
            degrees = number(run, ("trajectory", step, "rotation_deg", "rmse"), 1.0, 3)
            return NOTHING if NOTHING in (millimetres, degrees) else f"{millimetres} mm, {degrees}°"

        return cell

    def poses(run):
        trajectory = run["trajectory"]
        return f"{trajectory['poses']} ({trajectory['unmatched_poses']})" if trajectory else NOTHING

    return [
        *((f"ATE {'RMSE' if kind == 'rmse' else kind} [mm]", error(kind)) for kind in ("rmse", "mean", "median", "max")),
        *((f"RPE RMSE per {unit}", relative(f"rpe_per_{unit}")) for unit in ("frame", "second", "metre")),
        ("poses compared (without truth)", poses),
    ]


def map_rows():
    def walls_found(run):
        summary = member(run, ("map", "wall_summary"))
        return f"{summary['measured']} ({summary['seen']})" if summary and summary["seen"] else NOTHING

    def figure(*path, scale=1.0, digits=2):
        return lambda run: number(run, ("map", *path), scale, digits)

    return [
        ("walls found (of those seen from both sides)", walls_found),
        ("thickness error, mean absolute [mm]", figure("wall_summary", "absolute_error_mm", "mean")),
        ("thickness error, worst [mm]", figure("wall_summary", "absolute_error_mm", "max")),
        ("side purity [%]", figure("wall_summary", "side_purity", scale=100.0, digits=3)),
        ("crispness: plane thickness [mm]", figure("crispness", "plane_thickness_mm")),
        ("crispness: mean map entropy", figure("crispness", "mean_map_entropy")),
        ("map points", figure("points", digits=0)),
        ("sides of points told", lambda run: member(run, ("map", "sides")) or NOTHING),
    ]


def timing_rows(runs: list[dict]):
    def times(stage):
        def cell(run):
            time = run["cpu"].get(stage)
            return f"{time['mean']:.2f} ({time['max']:.2f})" if time else NOTHING

        return cell

    stages = dict.fromkeys(stage for run in runs for stage in run["cpu"])
    return [
        (f"CPU per scan, mean (max) [ms]: {stage.removesuffix('_ms').replace('_', ' ')}", times(stage)) for stage in stages
    ]


def wall_rows(runs: list[dict], kind: str) -> list[tuple[str, list[str]]]:
    """A row for each wall."""
    lists = [run["map"][kind] if run["map"] else None for run in runs]
    known = next((walls for walls in lists if walls), [])
    rows = []
    for i, wall in enumerate(known):
        true = wall["true_thickness_mm"]
        label = f"{wall['name']}: {NOTHING if true is None else format(true, '.1f')}"
        rows.append((label, [wall_cell(walls[i]) if walls else NOTHING for walls in lists]))
    return rows


def wall_cell(wall: dict) -> str:
    if not wall["seen"]:
        return "not seen from both sides"
    if wall["thickness_mm"] is None:
        return "not found"
    if wall["error_mm"] is None:
        return f"{wall['thickness_mm']:.2f}"
    return f"{wall['thickness_mm']:.2f} ({wall['error_mm']:+.2f} mm, {wall['error_percent']:+.1f} %)"


def member(tree, path):
    """What lies at the end of `path`; None where it breaks off."""
    for name in path:
        if tree is None:
            return None
        tree = tree[name]
    return tree


def number(run: dict, path, scale: float, digits: int) -> str:
    value = member(run, path)
    return NOTHING if value is None else f"{scale * value:.{digits}f}"
