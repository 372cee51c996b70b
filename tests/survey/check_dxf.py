#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The nvm authors
"""Reads a floor plan of `nvm walls` with the ezdxf package, which knows the format.

usage: check_dxf.py NVM_PROGRAM

Exit status 77 (a skipped test) when ezdxf is not installed.
"""
import math
import pathlib
import random
import subprocess
import sys
import tempfile

try:
    import ezdxf
except ImportError as error:
    print(f"skipped: {error}")
    sys.exit(77)


def write_wall(path):
    """Both faces of a wall of 80 mm and 4 x 2.5 m along x, 5 cm apart, as an ASCII PLY."""
    rng = random.Random(1)
    rows = []
    for i in range(80):
        for j in range(50):
            for y, ny in ((0.0, -1), (0.08, 1)):
                rows.append(f"{0.05 * i:.3f} {y + rng.gauss(0, 0.001):.5f} {0.05 * j:.3f} 0 {ny} 0")
    names = "".join(f"property float {name}\n" for name in ("x", "y", "z", "nx", "ny", "nz"))
    path.write_text(
        f"ply\nformat ascii 1.0\nelement vertex {len(rows)}\n{names}end_header\n" + "\n".join(rows) + "\n"
    )


def main():
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        write_wall(folder / "map.ply")
        subprocess.run([sys.argv[1], "walls", folder / "map.ply", "--out", folder / "out"], check=True)
        drawing = ezdxf.readfile(folder / "out/plan.dxf")
        assert not drawing.audit().errors, drawing.audit().errors
        lines = list(drawing.modelspace().query('LINE[layer=="WALLS"]'))
        texts = list(drawing.modelspace().query('TEXT[layer=="THICKNESS"]'))
        assert len(lines) == 2, lines
        assert [text.dxf.text for text in texts] == ["80"], texts
        heights = sorted(line.dxf.start.y for line in lines)
        assert math.isclose(heights[1] - heights[0], 0.08, abs_tol=5e-4), heights
        for line in lines:
            assert abs(abs(line.dxf.end.x - line.dxf.start.x) - 3.95) < 0.05, line.dxf.all_existing_dxf_attribs()


main()
