# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The nvm authors
"""Between the thread that receives messages and the one that works on them."""

import collections
import math
import threading

MAX_STEP_BACK = 1.0  # smaller ones are messages that overtook each other [s]
STALE_FOR = 10.0  # after a step back, messages from before it may still come [s]
MAX_READINGS = 60_000


class SensorQueue:
    """A queue of bounded size that gives a scan out together with the IMU readings up to its end.

    When it is full, the oldest scan is dropped. Time that goes back by more than a second begins a
    new epoch: everything that waits is forgotten.
    """

    def __init__(self, max_clouds: int, has_imu: bool, imu_timeout: float = 0.25):
        self._has_imu = has_imu
        self._imu_timeout = imu_timeout  # an IMU that lets a scan wait for longer is silent [s]
        self._max_clouds = max_clouds
        self._changed = threading.Condition()
        self._clouds = collections.deque()
        self._imu = collections.deque(maxlen=MAX_READINGS)
        self._newest = {"cloud": -math.inf, "imu": -math.inf}
        self._epoch_begin = -math.inf
        self._is_closed = False
        self.epoch = 0
        self.imu_is_silent = False
        self.counts = {"clouds": 0, "dropped": 0, "imu": 0, "bad imu": 0}

    @property
    def newest_imu(self) -> float:
        return self._newest["imu"]

    def add_cloud(self, stamp: float, cloud) -> None:
        with self._changed:
            if not self._begins("cloud", stamp):
                return
            self.counts["clouds"] += 1
            if len(self._clouds) >= self._max_clouds:
                self._clouds.popleft()
                self.counts["dropped"] += 1
            self._newest["cloud"] = stamp
            self._clouds.append((self.epoch, cloud))
            self._changed.notify_all()

    def add_imu(self, time: float, gyro, accel) -> None:
        with self._changed:
            if not self._begins("imu", time):
                return
            self.counts["imu"] += 1
            if time <= self._newest["imu"] or not all(map(math.isfinite, (*gyro, *accel))):
                self.counts["bad imu"] += 1
                return
            self._newest["imu"] = time
            self.imu_is_silent = False
            self._imu.append((time, gyro, accel))
            self._changed.notify_all()

    def close(self) -> None:
        with self._changed:
            self._is_closed = True
            self._changed.notify_all()

    def next_cloud(self):
        """(epoch, cloud) of the oldest; None when closed."""
        with self._changed:
            self._changed.wait_for(lambda: self._clouds or self._is_closed)
            return None if self._is_closed else self._clouds.popleft()

    def imu_until(self, epoch: int, time: float):
        """The readings up to `time` [s] that were not yet given out; None when meanwhile a new epoch
        has begun. Waits until the IMU is that far, but not for one that has fallen silent."""
        with self._changed:
            if self._has_imu and not self.imu_is_silent:
                self.imu_is_silent = not self._changed.wait_for(
                    lambda: self._newest["imu"] >= time or self.epoch != epoch or self._is_closed,
                    self._imu_timeout,
                )
            if self.epoch != epoch:
                return None
            readings = []
            while self._imu and self._imu[0][0] <= time:
                readings.append(self._imu.popleft())
            return readings

    def _begins(self, kind: str, time: float) -> bool:
        """False for a message from before a step back in time; begins a new epoch at one."""
        other = self._newest["imu" if kind == "cloud" else "cloud"]
        just_began = self.epoch > 0 and -math.inf < other < self._epoch_begin + STALE_FOR
        if just_began and time > other + MAX_STEP_BACK:
            return False
        if time < self._newest[kind] - MAX_STEP_BACK:
            self.epoch += 1
            self._epoch_begin = time
            self._newest = {"cloud": -math.inf, "imu": -math.inf}
            self._clouds.clear()
            self._imu.clear()
        return True
