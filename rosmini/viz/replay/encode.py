"""A recorded run as a few ten kilobytes of text, the same on every machine, for the player in a page.

Numbers become whole ones (millimetres, tenths of a milliradian, milliseconds), then differences from one to the next,
then bytes, mostly one for each number, then base64. A run of a minute with five scans of 360 beams a second takes about
170 kB. It could be compressed further, but another zlib writes other bytes, and nbval compares HTML to the byte.

The player draws each beam of a scan from where the robot was when it was measured.
"""

from __future__ import annotations

import base64
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rosmini.sim.recording import Recording
from rosmini.viz.replay.canvas_data import robot_data, scene_data, shapes_of
from rosmini.viz.rounding import snap
from rosmini.viz.world_pictures import colour_of

LENGTH = 1e-3
"""[m], also [m/s]"""
ANGLE = 1e-4
"""[rad], also [rad/s]"""
TIME = 1e-3
"""[s]"""
NANOSECOND = 1e-9
"""[s]"""
RATE = 30.0
"""Poses a second, at most."""
MOST_POSES = 3600
MOST_SCANS = 300
"""A run with more of them keeps every second, third, ... so that no player is much larger than that of a minute."""
LARGEST = 2**50
"""Beyond it a difference is no exact number in JavaScript."""


def replay_data(recording: Recording) -> dict[str, Any]:
    """What `rosmini/viz/static/rosmini-replay.js` plays: the scene, and the run in packed numbers.

    | key | numbers |
    |---|---|
    | `start`, `duration` | [ms] |
    | `truth`, `odom` | as many x [mm], then y [mm], then headings [0.1 mrad], at even times from start to end |
    | `commands` | times [ms], then linear [mm/s], then angular velocities [0.1 mrad/s], whenever these change |
    | `scan_times` | [ms] |
    | `scans` | ranges [mm], scan by scan; 0 where a beam hit nothing, -1 where it hit what was too near |
    | `time_increment` | [ns] from one beam of a scan to the next, if a laser sweeps |
    | `things` | of each thing that moved its name, its shapes in its own frame, and its `track`, as `truth` |
    | `others` | of each other robot its name, colour and numbers, and its `track`; `name` is the first one's |

    All but `start`, `duration` and `time_increment` are packed. Both tracks are in the frame `map`: odometry starts at
    the robot's true pose. Poses are resampled at even times; between them the player goes in straight lines.
    """
    start, duration = float(recording.times[0]), recording.duration
    samples = 1 + min(int(np.ceil(duration * RATE)), MOST_POSES)
    even = start + np.linspace(0.0, duration, samples)
    every = -(-len(recording.scans) // MOST_SCANS) or 1
    commands = _changes(recording.commands)
    scans = recording.scans[::every]
    moved = {thing.obstacle.name for thing in recording.things}
    world = recording.world
    if moved:
        world = replace(world, obstacles=tuple(o for o in world.obstacles if o.name not in moved))
    data: dict[str, Any] = {
        "scene": scene_data(world, recording.model),
        "start": whole(start, TIME).item(),
        "duration": whole(duration, TIME).item(),
        "truth": pack(_track(recording.times, recording.truth, even)),
        "odom": pack(_track(recording.times, recording.odom_in_map(), even)),
        "commands": pack(
            np.concatenate(
                [
                    whole(commands[:, 0], TIME),
                    whole(commands[:, 1], LENGTH),
                    whole(commands[:, 2], ANGLE),
                ]
            )
        ),
        "scan_times": pack(whole(recording.scan_times[::every], TIME)),
        "scans": pack(
            whole(np.where(np.isfinite(scans), scans, np.where(scans < 0, -LENGTH, 0.0)), LENGTH).ravel()
        ),
    }
    if recording.time_increment:
        data["time_increment"] = whole(recording.time_increment, NANOSECOND).item()
    if moved:
        data["scene"]["bounds"] = scene_data(recording.world)["bounds"]
        data["things"] = [
            {
                "name": thing.obstacle.name,
                "shapes": shapes_of(thing.obstacle, (0.0, 0.0, 0.0)),
                "track": pack(_track(thing.times, thing.poses, even)),
            }
            for thing in recording.things
        ]
    if recording.others:
        data["name"] = recording.name
        data["others"] = [
            {
                "name": run.name,
                "colour": colour_of(i),
                "robot": robot_data(run.model),
                "track": pack(_track(run.times, run.truth, even)),
            }
            for i, run in enumerate(recording.others)
        ]
    return data


def whole(values: Any, quantum: float) -> NDArray[np.int64]:
    """Values as whole multiples of `quantum`; off by less than 0.54 of it, and never by the last bit of a value."""
    bounded = np.clip(np.asarray(values, dtype=float), -LARGEST * quantum, LARGEST * quantum)
    return snap(bounded / quantum, 1.0).astype(np.int64)


def pack(values: NDArray[np.int64]) -> str:
    """Whole numbers (n,) as text.

    What is written are the differences, each folded to a natural number (0, -1, 1, -2 become 0, 1, 2, 3), in bytes of
    seven bits, the lowest first, the eighth bit set in all but a number's last; as base64. The fold and the bytes are
    those of Protocol Buffers' sint64 (protobuf.dev/programming-guides/encoding).
    """
    steps = np.diff(values, prepend=0)
    folded = np.where(steps < 0, -2 * steps - 1, 2 * steps)
    groups = folded[:, None] >> np.arange(0, 63, 7)
    length = np.maximum(1, (groups > 0).sum(axis=1))[:, None]
    place = np.arange(groups.shape[1])
    coded = (groups & 127) | np.where(place < length - 1, 128, 0)
    return base64.b64encode(coded[place < length].astype(np.uint8).tobytes()).decode()


def _track(
    times: NDArray[np.float64], poses: NDArray[np.float64], at: NDArray[np.float64]
) -> NDArray[np.int64]:
    """Poses (n, 3), resampled: all x, all y, all headings."""
    return np.concatenate(
        [
            whole(np.interp(at, times, column), quantum)
            for column, quantum in zip(poses.T, (LENGTH, LENGTH, ANGLE), strict=True)
        ]
    )


def _changes(commands: NDArray[np.float64]) -> NDArray[np.float64]:
    """The commands (m, 3) that ask for another velocity than the one before."""
    if not len(commands):
        return commands
    differs = np.ones(len(commands), dtype=bool)
    differs[1:] = (commands[1:, 1:] != commands[:-1, 1:]).any(axis=1)
    return commands[differs]
