# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The nvm authors
"""Packets of Ouster and Velodyne, in a room whose walls are known. The makers' packages are no dependencies:
scripts/test_python.sh runs this beside them."""

import struct
import warnings
from types import SimpleNamespace

import numpy as np
import pytest
from nvm.bags import BagError
from nvm.cli import main
from nvm.packets import PacketRecording
from nvm.serialization import ros1_typestore
from nvm.velodyne import DeviceClock

ROOM = np.array([4.0, 3.0, 1.5])  # [m], half of its size; the sensor is in the middle
EPOCH = 1.7e9
ELEVATIONS = np.deg2rad([-15, 1, -13, 3, -11, 5, -9, 7, -7, 9, -5, 11, -3, 13, -1, 15])  # of a VLP-16
PACKETS_PER_SWEEP = 75
PACKET_PERIOD = 1.327e-3  # [s]
LASERS_APART = 12e-3  # [m], which the sensor turns from the first laser of a sequence to the last
FIRING = 55.296e-6  # [s], from one sequence of 16 to the next


def ranges(directions, origins=0.0):
    """To the walls [m]."""
    with np.errstate(divide="ignore"):
        return ((ROOM - np.sign(directions) * origins) / np.abs(directions)).min(axis=-1)


def on_walls(points):
    """Distance of each point to the nearest wall [m]."""
    return np.abs(ROOM - np.abs(points)).min(axis=1)


def clouds_and_readings(path):
    recording = PacketRecording(path)
    store = ros1_typestore()
    clouds, readings = [], []
    for message in recording.messages([topic.name for topic in recording.topics()]):
        if message.type.endswith("Imu"):
            readings.append(store.deserialize_ros1(message.data, "sensor_msgs/msg/Imu"))
        else:
            clouds.append(store.deserialize_ros1(message.data, "sensor_msgs/msg/PointCloud2"))
    return clouds, readings


def records(cloud):
    kinds = {7: "<f4", 6: "<u4", 4: "<u2"}
    names, formats = zip(*((field.name, kinds[field.datatype]) for field in cloud.fields))
    offsets = [field.offset for field in cloud.fields]
    kind = np.dtype({"names": names, "formats": formats, "offsets": offsets, "itemsize": cloud.point_step})
    return np.frombuffer(cloud.data.tobytes(), kind)


def xyz(found):
    return np.stack([found[name] for name in "xyz"], axis=1)


def begin(message):
    return message.header.stamp.sec + 1e-9 * message.header.stamp.nanosec


def vlp16_packet(number, device_time):
    data = b""
    for block in range(12):
        degrees = (number * 12 + block) * 0.4 % 360
        azimuths = np.deg2rad(degrees + np.repeat([0.0, 0.2], 16))
        rings = np.tile(ELEVATIONS, 2)
        flat = np.cos(rings)
        directions = np.stack([flat * np.cos(azimuths), -flat * np.sin(azimuths), np.sin(rings)], axis=1)
        steps = np.round(ranges(directions) / 0.002).astype(int)
        data += b"\xff\xee" + struct.pack("<H", round(degrees * 100))
        data += b"".join(struct.pack("<HB", step, 10 + ring % 16) for ring, step in enumerate(steps))
    return data + struct.pack("<IBB", int(device_time * 1e6), 0x37, 0x22)


def write_udp(path, payloads, port=2368):
    """A pcap of (time of capture [s], bytes)."""
    dpkt = pytest.importorskip("dpkt")
    with path.open("wb") as file:
        writer = dpkt.pcap.Writer(file)
        for time, data in payloads:
            udp = dpkt.udp.UDP(sport=port, dport=port, data=data)
            udp.ulen = len(udp)
            ip = dpkt.ip.IP(src=bytes(4), dst=bytes(4), p=17, data=udp)
            ip.len = len(ip)
            writer.writepkt(bytes(dpkt.ethernet.Ethernet(data=ip)), ts=time)
    return path


def velodyne(path, sweeps, first_device_time=0.0):
    """Its host gets packets up to 2 ms late."""
    delays = np.random.default_rng(1).uniform(0, 2e-3, sweeps * PACKETS_PER_SWEEP)
    times = PACKET_PERIOD * np.arange(len(delays))
    packets = (vlp16_packet(i, (first_device_time + time) % 3600) for i, time in enumerate(times))
    return write_udp(path, zip(EPOCH + times + delays, packets))


def test_velodyne_packets_are_sweeps_with_the_times_of_the_sensor(tmp_path):
    pytest.importorskip("velodyne_decoder")
    path = velodyne(tmp_path / "room.pcap", 12, first_device_time=3599.5)  # its clock begins anew on the way
    clouds, readings = clouds_and_readings(path)
    assert not readings and 11 <= len(clouds) <= 13
    for cloud in clouds:
        found = records(cloud)
        assert on_walls(xyz(found)).max() < LASERS_APART
        assert (np.diff(found["t"].astype(int)) >= 0).all() and found["t"].max() < 0.102e9
        assert set(found["ring"]) <= set(range(16)) and found["intensity"].min() >= 10
    steps = np.diff([begin(cloud) for cloud in clouds[1:-1]])
    np.testing.assert_allclose(steps, PACKETS_PER_SWEEP * PACKET_PERIOD, atol=2 * FIRING)
    assert abs(begin(clouds[0]) - EPOCH) < 0.02


def test_hours_that_a_sensors_clock_leaps_are_taken_out():
    clock = DeviceClock()
    stamps = [(100.0, 1795.0), (100.1, 1795.1), (101.2, 1796.2 - 3600.0), (5000.0, 6695.0 - 7200.0)]
    times = [clock.time(SimpleNamespace(host=host + 2e-3 * i, device=device)) for i, (host, device) in enumerate(stamps)]
    np.testing.assert_allclose(times, [host for host, _ in stamps], atol=1e-9)


def test_what_is_wrong_with_packets_is_said(tmp_path, capfd):
    pytest.importorskip("velodyne_decoder")
    with pytest.raises(BagError, match="does not exist"):
        PacketRecording(tmp_path / "none.pcap")
    other = write_udp(tmp_path / "other.pcap", [(EPOCH + i, bytes(1080)) for i in range(5)], port=2369)
    with pytest.raises(BagError, match="5 of 1080 bytes to port 2369.*metadata"):
        PacketRecording(other)
    with pytest.raises(BagError, match="it holds none"):
        PacketRecording(write_udp(tmp_path / "empty.pcap", []))
    (tmp_path / "text.pcap").write_text("no pcap at all")
    assert main(["run", str(tmp_path / "text.pcap"), "--out", str(tmp_path / "out")]) == 1
    assert capfd.readouterr().err.splitlines()[-1].startswith(f"nvm: {tmp_path / 'text.pcap'}: cannot be read")


@pytest.mark.parametrize("keep", [30, 1000, 50_001])
def test_cut_off_packets_are_read_as_far_as_they_go(tmp_path, keep):
    pytest.importorskip("velodyne_decoder")
    path = velodyne(tmp_path / "room.pcap", 2)
    path.write_bytes(path.read_bytes()[:keep])
    if keep < 50_000:
        with pytest.raises(BagError):
            clouds_and_readings(path)
    else:
        clouds, _ = clouds_and_readings(path)
        assert len(clouds) == 1 and on_walls(xyz(records(clouds[0]))).max() < LASERS_APART


def test_a_velodyne_that_stands_still_is_tracked(tmp_path, capfd):
    pytest.importorskip("velodyne_decoder")
    path = velodyne(tmp_path / "room.pcap", 15)
    assert main(["run", str(path), "--out", str(tmp_path / "out")]) == 0
    poses = np.loadtxt(tmp_path / "out" / "trajectory.tum")
    assert len(poses) >= 13 and np.abs(poses[:, 1:4]).max() < 5e-3
    assert "IMU: none in the recording" in capfd.readouterr().err
    assert main(["info", str(path)]) == 0
    assert "pcap of a Velodyne" in capfd.readouterr().out


class OusterRoom:
    """An OS0-like sensor in the middle of the room, at rest."""

    def __init__(self, puts_imu_into_frames):
        core = pytest.importorskip("ouster.sdk.core")
        self.core = core
        info = core.SensorInfo.from_default(core.LidarMode._512x10)
        profile = core.UDPProfileIMU.ACCEL32_GYRO32_NMEA if puts_imu_into_frames else core.UDPProfileIMU.LEGACY
        for place in (info.format, info.config):
            place.udp_profile_lidar = core.UDPProfileLidar.RNG19_RFL8_SIG16_NIR16
            place.udp_profile_imu = profile
        info.config.lidar_mode, info.config.udp_port_lidar, info.config.udp_port_imu = core.LidarMode._512x10, 7502, 7503
        if puts_imu_into_frames:
            info.format.imu_measurements_per_packet = info.format.imu_packets_per_frame = 8
        self.info = info

    def frame(self, number):
        frame = self.core.LidarFrame(self.info)
        frame.frame_id = number
        frame.timestamp[:] = self.nanoseconds(number, frame.w)
        frame.packet_timestamp[:] = frame.timestamp[:: frame.w // len(frame.packet_timestamp)]
        frame.status[:], frame.measurement_id[:] = 1, np.arange(frame.w)
        frame.field("RANGE")[:] = self.millimetres(frame)
        frame.field("REFLECTIVITY")[:] = 77
        frame.field("RANGE")[0, :] = 0  # nothing came back
        frame.status[100:110] = 0  # a packet was lost
        if frame.has_field("IMU_ACC"):
            frame.field("IMU_ACC")[:], frame.field("IMU_GYRO")[:] = (0.1, 0.2, 9.8), (0.01, 0.02, 0.03)
            times = frame.field("IMU_TIMESTAMP")
            times[:] = self.nanoseconds(number, len(times))
            frame.field("IMU_PACKET_TIMESTAMP")[:] = times[::8]
            frame.field("IMU_STATUS")[:], frame.field("IMU_MEASUREMENT_ID")[:] = 1, np.arange(len(times))
        return frame

    def nanoseconds(self, number, count):
        return np.uint64((EPOCH + 0.1 * number) * 1e9) + (np.arange(count) * (1e8 / count)).astype(np.uint64)

    def millimetres(self, frame):
        lut, near = self.core.XYZLut(self.info, False), np.full((frame.h, frame.w), 1000, np.uint32)
        first, second = lut(near), lut(2 * near)
        directions = second - first  # a metre long each
        return np.round(ranges(directions, first - directions) * 1000)

    def legacy_reading(self, number, k):
        packet = self.core.ImuPacket(48)
        packet.format = self.core.PacketFormat(self.info)
        time = int((EPOCH + 0.1 * number + 0.01 * k) * 1e9)
        packet.buf[:] = np.frombuffer(struct.pack("<3Q6f", time, time, time, 0.0, 0.0, 1.0, 0.5, 0.0, 0.0), np.uint8)
        return packet

    def write_osf(self, path, sweeps):
        from ouster.sdk.osf import Writer

        writer = Writer(str(path), self.info)
        for number in range(sweeps):
            frame = self.frame(number)
            writer.save(0, frame, int(frame.timestamp[-1]))
        writer.close()
        return path

    def write_pcap(self, path, sweeps):
        from ouster.sdk.pcap import record

        kind, packets = self.core.PacketFormat(self.info), []
        for number in range(sweeps):
            packets += self.core.frame_to_packets(self.frame(number), kind, 0, 0)
            if self.info.format.udp_profile_imu == self.core.UDPProfileIMU.LEGACY:
                packets += [self.legacy_reading(number, k) for k in range(10)]
        for i, packet in enumerate(packets):
            packet.host_timestamp = int(1.8e18) + 1_000_000 * i
        record(packets, str(path))
        path.with_suffix(".json").write_text(self.info.to_json_string())
        return path


@pytest.fixture(autouse=True)
def the_makers_warn_of_their_own_names():
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        yield


@pytest.mark.parametrize("kind", ["osf", "pcap", "legacy pcap"])
def test_ouster_recordings_have_points_readings_and_the_extrinsic(tmp_path, kind):
    room = OusterRoom(puts_imu_into_frames=kind != "legacy pcap")
    path = tmp_path / f"room.{kind[-4:].strip()}"
    (room.write_osf if kind == "osf" else room.write_pcap)(path, 3)
    clouds, readings = clouds_and_readings(path)
    assert len(clouds) == 3
    for number, cloud in enumerate(clouds):
        found = records(cloud)
        assert len(found) == 63 * 502 and on_walls(xyz(found)).max() < 3e-3
        assert begin(cloud) == pytest.approx(EPOCH + 0.1 * number, abs=1e-6)
        assert (np.diff(found["t"].astype(int)) >= 0).all() and 0.099e9 < found["t"].max() < 0.1e9
        assert set(found["intensity"]) == {77} and set(found["ring"]) == set(range(1, 64))
    gyro = np.array([(m.angular_velocity.x, m.angular_velocity.y, m.angular_velocity.z) for m in readings])
    accel = np.array([(m.linear_acceleration.x, m.linear_acceleration.y, m.linear_acceleration.z) for m in readings])
    if kind == "legacy pcap":
        assert len(readings) == 30
        np.testing.assert_allclose(gyro[:, 0], np.deg2rad(0.5), rtol=1e-6)
        np.testing.assert_allclose(accel, [[0, 0, 9.80665]] * 30, rtol=1e-6)
    else:
        assert len(readings) == 3 * 64
        np.testing.assert_allclose(gyro, [[0.01, 0.02, 0.03]] * len(gyro), rtol=1e-6)
        np.testing.assert_allclose(accel, [[0.1, 0.2, 9.8]] * len(accel), rtol=1e-6)
    assert (np.diff([begin(m) for m in readings]) > 0).all()
    T, _ = PacketRecording(path).transforms().find("ouster_imu", "ouster_sensor")
    np.testing.assert_allclose(T[:3, 3], -1e-3 * np.array(room.info.imu_to_sensor_transform)[:3, 3], atol=1e-9)


def test_a_sweep_with_an_impossible_time_is_left_out_alone(tmp_path, monkeypatch, capfd):
    room = OusterRoom(puts_imu_into_frames=True)
    whole = room.frame

    def frame(number):
        made = whole(number)
        if number == 12:
            made.timestamp[0] = 1  # the rest lies 54 years later
        return made

    monkeypatch.setattr(room, "frame", frame)
    path = room.write_osf(tmp_path / "room.osf", 30)
    messages = list(PacketRecording(path).messages(["/ouster/points"]))
    assert [i for i, message in enumerate(messages) if not message.data] == [12]
    assert main(["run", str(path), "--out", str(tmp_path / "out")]) == 0
    assert len(np.loadtxt(tmp_path / "out" / "trajectory.tum")) >= 18
    assert "1 clouds are left out" in capfd.readouterr().err


def test_an_ouster_that_stands_still_is_tracked_with_its_imu(tmp_path, capfd):
    path = OusterRoom(puts_imu_into_frames=True).write_osf(tmp_path / "room.osf", 30)
    assert main(["run", str(path), "--out", str(tmp_path / "out")]) == 0
    said = capfd.readouterr().err
    assert "IMU: /ouster/imu" in said and "T_imu_lidar: from the metadata" in said
    poses = np.loadtxt(tmp_path / "out" / "trajectory.tum")
    assert len(poses) >= 18 and np.abs(poses[:, 1:4] - poses[0, 1:4]).max() < 0.01
