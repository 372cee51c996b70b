# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The nvm authors
"""Tables in the form of the paper's Tables II to VI, as Markdown and as one HTML page."""
import html
from statistics import mean

from cases import MAPS, PIPELINES, SENSORS

STAGES = {"map_update": "Map update", "optimize": "Optimise", "pose_estimation": "Pose estimation",
          "measurement": "Process measurement", "normals": "Normals", "total": "Total"}
SENSOR_NAMES = {"mid360": "Livox-like (Mid-360)", "vlp16": "Velodyne-like (VLP-16)", "avia": "Livox-like (Avia)"}
TABLE_NUMBERS = {"mid360": "Table II: ", "vlp16": "Table III: "}  # of the paper


def by_value(rows: list, key: str, order: list = ()) -> dict:
    """Value of `key` -> the rows that have it, in the given order and then as they come."""
    groups = {value: [] for value in order}
    for row in rows:
        groups.setdefault(row[key], []).append(row)
    return {value: group for value, group in groups.items() if group}


def over_seeds(rows: list, value, combine=mean) -> float:
    """Mean, or what `combine` makes, of value(row) over the rows that have one; None without any."""
    values = [value(row) for row in rows if "failure" not in row and value(row) is not None]
    return combine(values) if values else None


def text(value, digits: int = 2) -> str:
    return "–" if value is None else f"{value:.{digits}f}"


def table(title: str, head: list, body: list) -> dict:
    return {"title": title, "head": head, "body": body}


def map_table(rows: list, title: str, value, digits: int = 2, combine=mean) -> dict:
    """A row per scene, a column per map, the seeds combined."""
    maps = [name for name in MAPS if any(row["map"] == name for row in rows)]
    body = [[scene] + [
        text(over_seeds([r for r in group if r["map"] == name], value, combine), digits) for name in maps]
            for scene, group in by_value(rows, "scene").items()]
    return table(title, ["scene", *maps], body)


def thickness_table(rows: list) -> dict:
    """A row per true thickness and sensor of the scene with seven walls, a column per map: signed error."""
    maps = [name for name in MAPS if any(row["map"] == name for row in rows)]
    walls = {}
    for row in rows:
        for wall in row.get("walls", {}).values():
            if wall["error_mm"] is not None:
                walls.setdefault((row["sensor"], wall["true_mm"]), {}).setdefault(row["map"], []).append(wall["error_mm"])
    body = [[sensor, f"{true:.0f}"] + [text(mean(errors[name])) if name in errors else "–" for name in maps]
            for (sensor, true), errors in sorted(walls.items(), key=lambda item: (item[0][0], -item[0][1]))]
    return table("Table IV: error of each wall's thickness in `seven_walls`, fast_lio [mm]", ["sensor", "wall [mm]", *maps], body)


def timing_table(rows: list) -> dict:
    """CPU time per scan and stage, least recently used against radius."""
    body = []
    for sensor, of_sensor in by_value(rows, "sensor", SENSORS).items():
        for pipeline, group in by_value(of_sensor, "pipeline", PIPELINES).items():
            for name, chosen in by_value(group, "map", list(MAPS)).items():
                body.append([sensor, pipeline, name] + [
                    text(over_seeds(chosen, lambda row, s=stage: row["ms_per_scan"][s])) for stage in STAGES])
    return table("Table VI: CPU time per scan [ms], mean over scenes and seeds", ["sensor", "pipeline", "map", *STAGES.values()], body)


def pipeline_table(rows: list, sensor: str) -> dict:
    pipelines = [name for name in PIPELINES if any(row["pipeline"] == name for row in rows)]
    body = [[scene] + [text(over_seeds([r for r in group if r["pipeline"] == name], lambda r: r["ate_mm"])) for name in pipelines]
            for scene, group in by_value(rows, "scene").items()]
    return table(f"Pipelines on the `nvm` map: ATE RMSE, {SENSOR_NAMES[sensor]} [mm]", ["scene", *pipelines], body)


def plain_tables(rows: list) -> list:
    tables = []
    for sensor, group in by_value(rows, "sensor", SENSORS).items():
        for pipeline, chosen in by_value(group, "pipeline", PIPELINES).items():
            tables.append(map_table(
                chosen, f"{TABLE_NUMBERS.get(sensor, '')}ATE RMSE, {SENSOR_NAMES[sensor]}, {pipeline} [mm]", lambda row: row["ate_mm"]))
        tables.append(pipeline_table([row for row in group if row["map"] == "nvm"], sensor))
    fast = [row for row in rows if row["pipeline"] == "fast_lio"]
    tables.append(thickness_table([row for row in fast if row["scene"] == "seven_walls"]))
    for sensor, group in by_value(fast, "sensor", SENSORS).items():
        tables.append(map_table(group, f"Table V: mean error of wall thickness, {sensor}, fast_lio [mm]",
                                lambda row: row["thickness_mean_mm"]))
        tables.append(map_table(group, f"Worst error of wall thickness of any seed, {sensor}, fast_lio [mm]",
                                lambda row: row["thickness_worst_mm"], combine=max))
        tables.append(map_table(group, f"Side purity, {sensor}, fast_lio [%]",
                                lambda row: row["purity"] and 100.0 * row["purity"], 3))
    return [*tables, timing_table(rows)]


def setting_tables(rows: list, setting: str) -> list:
    tables = []
    for sensor, group in by_value([row for row in rows if row["pipeline"] == "fast_lio"], "sensor", SENSORS).items():
        tables.append(map_table(group, f"Setting `{setting}`: ATE RMSE, {sensor}, fast_lio [mm]", lambda row: row["ate_mm"]))
        tables.append(map_table(group, f"Setting `{setting}`: mean error of wall thickness, {sensor}, fast_lio [mm]",
                                lambda row: row["thickness_mean_mm"]))
    return tables


def all_tables(rows: list) -> list:
    tables = []
    for setting, group in by_value(rows, "setting", ["plain"]).items():
        tables += plain_tables(group) if setting == "plain" else setting_tables(group, setting)
    return [one for one in tables if one["body"]]


def failures(rows: list) -> list:
    return [f"{row['sequence']}, {row['pipeline']}, {row['map']}: {row['failure']}" for row in rows if "failure" in row]


def markdown(tables: list, rows: list) -> str:
    lines = []
    for one in tables:
        lines += ["", f"**{one['title']}**", "", "| " + " | ".join(one["head"]) + " |", "|" + "---|" * len(one["head"])]
        lines += ["| " + " | ".join(row) + " |" for row in one["body"]]
    if failures(rows):
        lines += ["", "Runs that gave no trajectory:", ""] + [f"- {line}" for line in failures(rows)]
    return "\n".join([*lines, "", ""])


def page(tables: list, rows: list) -> str:
    """One HTML file, nothing loaded from elsewhere."""
    style = ("body{font:15px sans-serif;margin:2em auto;max-width:70em}table{border-collapse:collapse;margin:1em 0}"
             "td,th{padding:.2em .8em;border-bottom:1px solid #ccc;text-align:right}td:first-child,th:first-child{text-align:left}")
    parts = [f"<!doctype html><meta charset='utf-8'><title>nvm: ablation</title><style>{style}</style><h1>Ablation</h1>"]
    for one in tables:
        cells = lambda tag, values: "".join(f"<{tag}>{html.escape(value)}</{tag}>" for value in values)
        parts.append(f"<h2>{html.escape(one['title'].replace('`', ''))}</h2><table><tr>{cells('th', one['head'])}</tr>")
        parts += [f"<tr>{cells('td', row)}</tr>" for row in one["body"]]
        parts.append("</table>")
    if failures(rows):
        parts.append("<h2>Runs that gave no trajectory</h2><ul>")
        parts += [f"<li>{html.escape(line)}</li>" for line in failures(rows)]
        parts.append("</ul>")
    return "\n".join(parts) + "\n"
