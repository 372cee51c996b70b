# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The nvm authors
"""What ``nvm info`` says of a recording."""

from __future__ import annotations

from .bags import BagError, Recording
from .choice import choose
from .topics import Topic

UNITS = {"s": 1.0, "ms": 1e-3, "us": 1e-6, "ns": 1e-9}
G_LIMIT = 3.0  # between 1 g and 9.8 m/s^2 on a logarithmic scale


def described(recording: Recording) -> str:
    """Topics, what ``nvm run`` would choose and why, and the frames."""
    topics = recording.topics()
    lines = [
        f"{recording.path}: {recording.format}, {recording.duration:.1f} s"
        + (f" from {recording.begin:.3f} s" if topics else ""),
        *table([("topic", "type", "messages", "Hz", "frame"), *map(row, topics)]),
        "",
    ]
    lines += [f"{topic.name}: {details(topic)}" for topic in topics if topic.is_cloud or topic.is_imu]
    frames = recording.transforms().frames
    lines += [f"{topic.name}: left out, {topic.encoding} is no encoding of ROS" for topic in topics if not topic.is_ros]
    lines += recording.problems
    lines.append(f"{recording.transforms_from}: {', '.join(frames) if frames else 'nothing'}")
    lines.append("")
    try:
        lines += choose(recording).reasons
    except BagError as error:
        lines.append(str(error))
    return "\n".join(lines)


def row(topic: Topic) -> tuple[str, ...]:
    rate = f"{topic.rate:.1f}" if topic.rate else ""
    return (topic.name, topic.type, str(topic.count), rate, topic.frame)


def table(rows) -> list[str]:
    widths = [max(len(row[i]) for row in rows) for i in range(len(rows[0]))]
    return ["  ".join(cell.ljust(w) for cell, w in zip(row, widths)).rstrip() for row in rows]


def details(topic: Topic) -> str:
    """Fields and units."""
    if not topic.fields and topic.acceleration is None:
        return "no messages"
    if topic.is_imu:
        unit = "g" if topic.acceleration < G_LIMIT else "m/s^2"
        return f"accelerations of {topic.acceleration:.2f}: {unit}"
    times = "no times of points"
    if topic.time_field:
        times = f"times in {topic.time_field}"
        if topic.time_range:
            low, high = topic.time_range
            times += f" from {low:.9g} to {high:.9g}" + likely(topic, high - low)
    return f"{topic.points:.0f} points, {' '.join(topic.fields)}; {times}"


def likely(topic: Topic, span: float) -> str:
    """The unit in which `span` comes nearest to the time between clouds."""
    if span <= 0 or topic.rate <= 0:
        return ""
    unit = min(UNITS, key=lambda name: max(a := span * UNITS[name] * topic.rate, 1 / a))
    return f": {unit}"
