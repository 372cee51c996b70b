# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The nvm authors
"""The report of ``nvm evaluate``: its figures as tables and pictures, in one page that needs nothing else.

Uses matplotlib and Jinja, and nothing of nvm: ``python -m report FOLDER`` beside it draws without the package.
"""

from __future__ import annotations

import json
import pathlib

from .charts import error_chart, trajectory_chart, wall_pictures
from .page import page


def write_report(folder) -> list[pathlib.Path]:
    """Draws what ``nvm evaluate`` has left in a folder.

    Parameters
    ----------
    folder : path
        Holds evaluation.json and drawing.json.

    Returns
    -------
    list of pathlib.Path
        report.html, and a wall_NAME.svg of each wall drawn.

    Raises
    ------
    RuntimeError
        When a file is not what ``nvm evaluate`` of this version writes.
    """
    folder = pathlib.Path(folder)
    evaluation, drawing = (read(folder / name) for name in ("evaluation.json", "drawing.json"))
    try:
        pictures = wall_pictures(evaluation, drawing)
        charts = [trajectory_chart(evaluation, drawing), error_chart(evaluation, drawing)] if drawing["truth"] else []
        html = page(evaluation, charts, pictures)
    except (KeyError, IndexError, TypeError) as error:
        raise RuntimeError(f"{folder}: was written by another version: evaluate again") from error
    files = {f"wall_{file_name(name)}.svg": picture for name, picture in pictures}
    files["report.html"] = html
    for name, text in files.items():
        (folder / name).write_text(text, encoding="utf-8")
    return [folder / name for name in reversed(files)]


def read(path: pathlib.Path):
    try:
        return json.loads(path.read_text(encoding="utf-8"))
    except FileNotFoundError as error:
        raise RuntimeError(f"{path}: is missing: give the folder of nvm evaluate") from error
    except ValueError as error:
        raise RuntimeError(f"{path}: is not JSON: evaluate again") from error


def file_name(name: str) -> str:
    """`name` with everything but letters, digits, '-' and '.' turned into '_'."""
    return "".join(c if c.isascii() and (c.isalnum() or c in "-.") else "_" for c in name)
