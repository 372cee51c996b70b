# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The nvm authors
"""Recordings of Velodyne's sensors, read by velodyne-decoder."""

from __future__ import annotations

import collections
import itertools
import pathlib
from collections.abc import Iterator

import numpy as np

from .ros1_messages import Sweep
from .transforms import TransformTree

DATA_SIZE = 1206  # [bytes] of a packet of points
BLOCK = b"\xff\xee"  # begins each block of points but some of the HDL-64's
LOOKED_AT = 400  # packets
RECORD_SIZE = DATA_SIZE + 58  # [bytes] in a pcap
PCAPNG = b"\x0a\x0d\x0d\x0a"  # begins a file of that kind
HOUR = 3600.0  # [s]


def packets(path: pathlib.Path) -> Iterator[tuple[float, int, bytes]]:
    """Time of capture [s], port and data of each UDP packet."""
    import dpkt

    links = {
        dpkt.pcap.DLT_EN10MB: dpkt.ethernet.Ethernet,
        dpkt.pcap.DLT_LINUX_SLL: dpkt.sll.SLL,
        dpkt.pcap.DLT_RAW: dpkt.ip.IP,
    }
    with path.open("rb") as file:
        reader = dpkt.pcap.UniversalReader(file)
        link = links.get(reader.datalink(), dpkt.ethernet.Ethernet)
        for time, record in reader:
            try:
                packet = link(record)
            except dpkt.dpkt.UnpackError:
                continue
            while not isinstance(packet, (dpkt.udp.UDP, bytes)):
                packet = packet.data
            if isinstance(packet, dpkt.udp.UDP):
                yield float(time), packet.dport, bytes(packet.data)


def kinds_of_packets(path: pathlib.Path) -> collections.Counter:
    """How many of the first packets have which port and size."""
    first = itertools.islice(packets(path), LOOKED_AT)
    return collections.Counter((port, len(data)) for _, port, data in first)


def is_velodyne(path: pathlib.Path) -> bool:
    return any(is_data(data) for _, _, data in itertools.islice(packets(path), LOOKED_AT))


def is_data(data: bytes) -> bool:
    return len(data) == DATA_SIZE and data.startswith(BLOCK)


class VelodyneFile:
    """Points alone: the sensors have no IMU that is of use here."""

    format = "pcap of a Velodyne"

    def __init__(self, path: pathlib.Path):
        self._path = path

    def transforms(self) -> TransformTree:
        return TransformTree()

    def sweep_count(self) -> int:
        decoder, counts = self._decoder(), [0]
        for time, data in self._data():
            counts[-1] += 1
            if decoder.decode(time, data) is not None:
                counts.append(0)
            if len(counts) > 3:
                break
        return self._path.stat().st_size // (RECORD_SIZE * max(counts))

    def items(self) -> Iterator[Sweep]:
        decoder, clock = self._decoder(), DeviceClock()
        for time, data in self._data():
            yield from sweeps_of(decoder.decode(time, data), clock)
        yield from sweeps_of(decoder.finish(), clock)

    def _data(self) -> Iterator[tuple[float, bytes]]:
        return ((time, data) for time, _, data in packets(self._path) if is_data(data))

    def _decoder(self):
        from velodyne_decoder import Config, StreamDecoder
        from velodyne_decoder.hdl64e import detect_hdl64e

        with self._path.open("rb") as file:
            is_classic = file.read(4) != PCAPNG
        model, calibration = detect_hdl64e(str(self._path)) if is_classic else (None, None)
        return StreamDecoder(Config(model=model, calibration=calibration))


class DeviceClock:
    """Times of the sensor's clock, from when the host got the first. That clock shows the time within an hour, and
    velodyne-decoder takes the hour from the host, whose clock may be another: hours that come and go are taken out."""

    def __init__(self):
        self._offset = None

    def time(self, stamp) -> float:
        """[s]; stamp: a TimePair of velodyne-decoder."""
        offset = stamp.host - stamp.device
        if self._offset is None:
            self._offset = offset
        self._offset += HOUR * round((offset - self._offset) / HOUR)
        return self._offset + stamp.device


def sweeps_of(decoded, clock: DeviceClock) -> Iterator[Sweep]:
    """Of what the decoder gives: nothing, or a stamp and points."""
    if decoded is None or not len(decoded[1]):
        return
    stamp, points = decoded
    points = points[np.argsort(points[:, 4], kind="stable")]
    times = clock.time(stamp) + points[:, 4].astype(np.float64)
    yield Sweep("/velodyne/points", "velodyne", points[:, :3], times, intensity=points[:, 3], ring=points[:, 6])
