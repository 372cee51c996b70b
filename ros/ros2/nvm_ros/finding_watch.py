# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The nvm authors
"""Chooses what to say of findings."""

import re

LASTING = 5.0  # [s]


def kind_of(finding: str) -> str:
    """The words before the first details, without numbers."""
    return re.sub(r"[-.\d]", "", re.split("[:;(]", finding)[0])


class FindingWatch:
    """Has each kind of finding said once, whatever its numbers: while a run goes on they change from
    scan to scan, and what the first scans seem to say may not last."""

    def __init__(self):
        self._since = {}
        self.said = {}

    def new_ones(self, time: float, findings: list[str]) -> list[str]:
        """Those of `findings`, as they are at `time` [s], that have lasted and have not been said."""
        kinds = {kind_of(finding): finding for finding in findings}
        self._since = {kind: self._since.get(kind, time) for kind in kinds}
        lasting = {k: f for k, f in kinds.items() if k not in self.said and time - self._since[k] >= LASTING}
        self.said |= lasting
        return list(lasting.values())
