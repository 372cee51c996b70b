# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The nvm authors
"""Tables of the grid (scene x sensor x grade of IMU): each cell, a summary per sensor, and the worst cells."""
from statistics import median

from cases import GRID_SENSORS
from report import SENSOR_NAMES, by_value, over_seeds, table, text

WORST = 10  # cells that are listed


def is_lost(row: dict) -> bool:
    """No trajectory, or no pose of a tenth of the scans."""
    return "failure" in row or row["poses"] < 0.9 * row["scans"]


def by_ate(row: dict) -> float:
    """Runs that were lost are worst of all."""
    return float("inf") if is_lost(row) else row["ate_mm"]


def cell(rows: list) -> str:
    """ATE, and z in brackets; the worst seed. A star where nvm run itself called the run unusable."""
    if not rows:
        return "–"
    if any(is_lost(row) for row in rows):
        return "lost"
    worst = max(rows, key=by_ate)
    return f"{text(worst['ate_mm'])} ({text(worst['z_rmse_mm'])})" + ("*" if worst["verdict"] else "")


def grade_table(rows: list, sensor: str) -> dict:
    """A row per scene and setting, a column per grade."""
    grades = sorted({row["imu_grade"] for row in rows})
    body = []
    for scene, of_scene in by_value(rows, "scene").items():
        for setting, group in by_value(of_scene, "setting", ["plain"]).items():
            body.append([scene, setting] + [cell([row for row in group if row["imu_grade"] == grade]) for grade in grades])
    title = f"Grid: ATE RMSE (of which z), {SENSOR_NAMES[sensor]}, by the IMU's grade [mm]"
    return table(title, ["scene", "setting", *(f"x {grade:g}" for grade in grades)], body)


def summary_table(rows: list) -> dict:
    """A row per sensor."""
    head = ["sensor", "cells", "lost", "ATE: median", "worst", "z: median", "worst", "thickness: median of means", "worst",
            "walls missing"]
    body = []
    for sensor, group in by_value(rows, "sensor", GRID_SENSORS).items():
        figures = [(key, combine) for key in ("ate_mm", "z_rmse_mm") for combine in (median, max)]
        figures += [("thickness_mean_mm", median), ("thickness_worst_mm", max)]
        found = [row for row in group if not is_lost(row)]
        body.append([sensor, str(len(group)), str(len(group) - len(found))]
                    + [text(over_seeds(found, lambda row, k=key: row[k], combine)) for key, combine in figures]
                    + [f"{sum(row['walls_missing'] for row in found)} of {sum(row['walls_seen'] for row in found)}"])
    return table("Grid: summary per sensor [mm]", head, body)


def worst_table(rows: list) -> dict:
    body = []
    for row in sorted(rows, key=by_ate, reverse=True)[:WORST]:
        place = [row["scene"], row["sensor"], f"x {row['imu_grade']:g}", row["setting"], str(row["seed"])]
        if is_lost(row):
            body.append(place + ["lost", "–", "–", "–"])
        else:
            body.append(place + [text(row["ate_mm"]) + ("*" if row["verdict"] else ""), text(row["z_rmse_mm"]), text(row["thickness_worst_mm"]),
                                 f"{row['walls_missing']} of {row['walls_seen']}"])
    head = ["scene", "sensor", "IMU", "setting", "seed", "ATE", "z", "worst wall", "walls missing"]
    return table(f"Grid: the worst {len(body)} of {len(rows)} cells [mm]", head, body)


def all_tables(rows: list) -> list:
    if not rows:
        return []
    return [summary_table(rows), worst_table(rows),
            *(grade_table(group, sensor) for sensor, group in by_value(rows, "sensor", GRID_SENSORS).items())]
