# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The nvm authors
"""The C++ program ``nvm``, and recordings for it that it does not read itself.

One program runs whatever was recorded: bags are read here and their messages go to it through a
pipe, in a process of their own, ahead of what it works on (docs/formats.md, "Pipe of messages").
"""

from __future__ import annotations

import contextlib
import fcntl
import json
import os
import pathlib
import signal
import struct
import subprocess
import sys
import tempfile
import threading

from . import _nvm
from .bags import BagError, Recording, is_ros1
from .choice import Choice, choose
from .packets import PacketRecording
from .recordings import is_recording, open_recording
from .topics import Topic

END = 0xFFFFFFFF  # in the place of a topic
LARGEST = 0xFFFFFFFF  # [bytes] of a message: far more than the program reads of one
PIPE_SIZE = 1 << 20  # [bytes]
AGAIN = 75  # the program's exit code when the messages are to come once more, with what it has learned
BUFFER_SIZE = 1 << 16  # [bytes], which joins messages of IMUs and leaves clouds where they are


def find_program() -> str:
    """The program of the package, or the one that $NVM_PROGRAM names.

    Raises
    ------
    RuntimeError
        When there is none.
    """
    program = os.environ.get("NVM_PROGRAM") or pathlib.Path(_nvm.__file__).parent / "bin" / "nvm"
    if not os.access(program, os.X_OK):
        raise RuntimeError(f"{program}: cannot be run: install nvm again, or let $NVM_PROGRAM name another")
    return str(program)


def run_program(arguments: list[str], keeps: tuple[int, ...] = ()) -> int:
    """Runs the program on `arguments` and returns its exit code. The first argument that names a bag
    is read for it. It inherits the file descriptors `keeps`."""
    program = find_program()
    bags = [i for i, argument in enumerate(arguments) if i > 0 and is_recording(argument)]
    if not bags or arguments[0] not in ("run", "map"):
        return run_alone([program, *arguments], keeps)
    before, bag, after = arguments[: bags[0]], arguments[bags[0]], arguments[bags[0] + 1 :]
    settings = input_settings(program, before + after)
    try:
        recording = open_recording(bag)
    except BagError as error:
        if not is_ros1(bag):
            raise
        print(f"nvm: note: {error}; the program reads what there is", file=sys.stderr)
        return run_alone([program, *arguments], keeps)
    with recording:
        choice = choose(recording, settings["lidar_topic"], settings["imu_topic"])
        for reason in (*recording.problems, *reasons_to_tell(choice, settings)):
            print(f"nvm: note: {reason}", file=sys.stderr)
        chosen = choice_arguments(choice, settings)
        return feed([program, *before], [*after, *chosen], keeps, recording, choice)


def run_alone(command: list[str], keeps: tuple[int, ...]) -> int:
    """Runs a command that needs nothing from here, and returns its exit code."""
    with started(command, keeps) as process:
        return exit_code(process.wait())


@contextlib.contextmanager
def started(command: list[str], keeps: tuple[int, ...] = (), **streams):
    """A program that ends a run well when it is interrupted, and is waited for, with `streams` as of Popen. It is in a session of its
    own, so that a signal reaches it once, whether it came to this process or to all of a terminal."""
    signals = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)
    with subprocess.Popen(command, pass_fds=keeps, start_new_session=True, **streams) as process:
        is_main = threading.current_thread() is threading.main_thread()
        forward = lambda number, _: process.send_signal(number)
        handlers = {number: signal.signal(number, forward) for number in signals} if is_main else {}
        try:
            yield process
        finally:
            for number, handler in handlers.items():
                signal.signal(number, handler)


def exit_code(code: int) -> int:
    """As a shell says it: 128 and the signal that ended a program."""
    return 128 - code if code < 0 else code


def input_settings(program: str, arguments: list[str]) -> dict:
    """What a command line says of the input, by the program's own word where it says anything."""
    if not any(argument.startswith(("--config", "--set")) for argument in arguments):
        return {"lidar_topic": "", "imu_topic": "", "T_imu_lidar": ""}
    from ruamel.yaml import YAML

    command, *others = arguments
    asked = subprocess.run(
        [program, command, "--print-config", *others], check=False, capture_output=True, text=True
    )
    if asked.returncode != 0:
        raise RuntimeError(asked.stderr.strip() or "the program does not print its settings")
    settings = YAML(typ="safe").load(asked.stdout)["input"]
    return {key: value or "" for key, value in settings.items()}


def reasons_to_tell(choice: Choice, settings: dict) -> list[str]:
    """Without that of an extrinsic which the user has set."""
    return [r for r in choice.reasons if not (settings["T_imu_lidar"] and r.startswith("T_imu_lidar:"))]


def choice_arguments(choice: Choice, settings: dict) -> list[str]:
    """The choice as settings of the program."""
    topics = {"lidar_topic": choice.lidar.name, "imu_topic": choice.imu and choice.imu.name}
    chosen = [f"input.{key}={json.dumps(name)}" for key, name in topics.items() if name]
    if choice.T_imu_lidar is not None and not settings["T_imu_lidar"]:
        chosen.append(f"input.T_imu_lidar={choice.extrinsic_numbers()}")
    return [word for setting in chosen for word in ("--set", setting)]


def feed(before: list[str], after: list[str], keeps, recording: Recording | PacketRecording, choice: Choice) -> int:
    """Runs a command with the messages of a recording in the place between its arguments; once more when
    that has learned too late what the first of them need."""
    _nvm.keep_freed_memory()  # the buffers of one cloud serve the next
    if before[1] != "run":
        return feed_once(before, after, keeps, recording, choice)
    with tempfile.TemporaryDirectory(prefix="nvm-again-") as folder:
        learned = pathlib.Path(folder) / "settings"
        code = feed_once(before, [*after, "--again", str(learned)], keeps, recording, choice)
        if code != AGAIN:
            return code
        settings = [word for setting in learned.read_text().splitlines() for word in ("--set", setting)]
    return feed_once(before, [*after, *settings], keeps, recording, choice)


def feed_once(before: list[str], after: list[str], keeps, recording, choice: Choice) -> int:
    read_end, write_end = os.pipe()
    with contextlib.suppress(OSError):  # a system may allow less
        fcntl.fcntl(write_end, getattr(fcntl, "F_SETPIPE_SZ", 1031), PIPE_SIZE)
    command = [*before, f"/dev/fd/{read_end}", *after]
    with started(command, (read_end, *keeps)) as process:
        os.close(read_end)
        problem = write_messages(write_end, recording, choice)
        code = process.wait()
    if problem:
        print(f"nvm: {problem}", file=sys.stderr)
        return exit_code(code) or 1
    return exit_code(code)


def is_same(topic: Topic, chosen: Topic) -> bool:
    return (topic.name, topic.is_cloud, topic.is_imu) == (chosen.name, chosen.is_cloud, chosen.is_imu)


def write_messages(descriptor: int, recording: Recording | PacketRecording, choice: Choice) -> str:
    """Writes the messages of the chosen topics to a pipe; returns what was wrong with the recording,
    nothing when the reader ended first."""
    # A topic may change its type midway.
    topics = [t for t in recording.topics() if is_same(t, choice.lidar) or (choice.imu and is_same(t, choice.imu))]
    head = {
        "format": "nvm messages",
        "version": 1,
        "source": str(recording.path),
        "recording": recording.format,
        "topics": [
            {"name": t.name, "type": t.type.replace("/msg/", "/"), "count": t.count} for t in topics
        ],
    }
    places = {(t["name"], t["type"]): i for i, t in enumerate(head["topics"])}
    try:
        with os.fdopen(descriptor, "wb", buffering=BUFFER_SIZE) as pipe:
            pipe.write(json.dumps(head).encode() + b"\n")
            for message in recording.messages(sorted({t.name for t in topics})):
                if (message.topic, message.type) in places:
                    place = places[message.topic, message.type]
                    data = message.data if len(message.data) <= LARGEST else message.data[:LARGEST]
                    pipe.write(struct.pack("<IdI", place, message.record_time, len(data)))
                    pipe.write(data)
            pipe.write(struct.pack("<I", END))
    except BrokenPipeError:
        pass
    except BagError as error:
        return str(error)
    except MemoryError:
        return f"{recording.path}: memory ran out while reading it"
    return ""
