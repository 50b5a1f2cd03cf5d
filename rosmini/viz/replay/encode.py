"""Encode a recorded run in some ten kilobytes of text, the same on every machine, for the player in a page.

Numbers become integers (millimetres, tenths of a milliradian, milliseconds), see `packing`. A run of a minute with
five scans of 360 beams a second takes about 170 kB; in longer runs, scans are rounded to 2 cm, with 2 Hz for two
minutes.

The player draws each beam of a scan from the robot's pose at the time of its measurement.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rosmini.sim.recording import Recording
from rosmini.viz.replay.canvas_data import robot_data, scene_data, shapes_of
from rosmini.viz.replay.layers import RANGE
from rosmini.viz.replay.packing import ANGLE, LENGTH, NANOSECOND, TIME, pack, whole
from rosmini.viz.world_pictures import colour_of

RATE = 30.0
"""Maximum number of poses per second."""
MAX_POSES = 1800
"""Maximum number of poses, so runs of more than a minute have fewer per second."""
MAX_SCANS = 300
"""Number of scans above which a run is thinned: it then keeps at most `THINNED_SCANS`, each
rounded to `RANGE`."""
THINNED_SCANS = 240
"""Maximum number of scans after thinning: 2 Hz for two minutes."""


def replay_data(recording: Recording) -> dict[str, Any]:
    """Return the data that `rosmini/viz/static/rosmini-replay-data.js` decodes: the scene, and the run in packed form.

    | key | numbers |
    |---|---|
    | `start`, `duration` | [ms] |
    | `truth`, `odom` | all x [mm], then all y [mm], then all headings [0.1 mrad], at even times from start to end |
    | `commands` | times [ms], then linear [mm/s], then angular velocities [0.1 mrad/s], whenever these change |
    | `scan_times` | [ms] |
    | `scans` | ranges, scan by scan; 0 where a beam hit nothing, -1 where the object hit was too near |
    | `scan_unit` | unit of the ranges [m]; by default a millimetre |
    | `time_increment` | [ns] from one beam of a scan to the next, if a laser sweeps |
    | `things` | of each object that moved: its name, its shapes in its own frame, and its `track`, like `truth` |
    | `others` | of each other robot: its name, colour and robot data, and its `track`; `name` is that of the first |

    All but `start`, `duration`, `scan_unit` and `time_increment` are packed. Both tracks are in the frame `map`:
    odometry starts at the robot's true pose. Poses are resampled at even times; the player interpolates linearly
    between them.
    """
    start, duration = float(recording.times[0]), recording.duration
    samples = 1 + min(int(np.ceil(duration * RATE)), MAX_POSES)
    even = start + np.linspace(0.0, duration, samples)
    long = len(recording.scans) > MAX_SCANS
    every, unit = (-(-len(recording.scans) // THINNED_SCANS), RANGE) if long else (1, LENGTH)
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
            np.concatenate([whole(commands[:, 0], TIME), whole(commands[:, 1], LENGTH), whole(commands[:, 2], ANGLE)])
        ),
        "scan_times": pack(whole(recording.scan_times[::every], TIME)),
        "scans": pack(whole(np.where(np.isfinite(scans), scans, np.where(scans < 0, -unit, 0.0)), unit).ravel()),
    }
    if long:
        data["scan_unit"] = unit
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


def _track(times: NDArray[np.float64], poses: NDArray[np.float64], at: NDArray[np.float64]) -> NDArray[np.int64]:
    """Resample poses (n, 3) and return all x, all y, all headings."""
    return np.concatenate(
        [
            whole(np.interp(at, times, column), quantum)
            for column, quantum in zip(poses.T, (LENGTH, LENGTH, ANGLE), strict=True)
        ]
    )


def _changes(commands: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the commands (m, 3) that request another velocity than the previous one."""
    if not len(commands):
        return commands
    differs = np.ones(len(commands), dtype=bool)
    differs[1:] = (commands[1:, 1:] != commands[:-1, 1:]).any(axis=1)
    return commands[differs]
