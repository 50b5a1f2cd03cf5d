"""ir-sim (https://github.com/hanruihua/ir-sim) as a peer process that simulates the same robots in the same room.

It is used as its own examples use it: ten steps a second, no window, and after each step a look at the scan and at the
state.
"""

from __future__ import annotations

import importlib
import importlib.metadata
import importlib.util
import json
import math
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import Any

import numpy as np

from rosmini.core.errors import RosminiError
from rosmini.sim.geometry.raycast import raycast
from rosmini.sim.models import BURGER

from . import sim_room

HOME = Path(__file__).resolve().parents[1]
"""Where `python -m rosmini_bench...` finds this package."""
TIMEOUT_S = 300
RATE = 10
WARM_UP = 20
"""So many steps of a single robot are made before the clock starts, fewer of several."""


def find_irsim() -> Peer | None:
    """Return ir-sim, or None where it is not installed."""
    if not importlib.util.find_spec("irsim"):
        return None
    return Peer(f"ir-sim {importlib.metadata.version('ir-sim')}", __name__)


class Peer:
    """Another simulator that is installed, run in a process of its own by `python -m <module> <seconds> <count>`."""

    def __init__(self, name: str, module: str) -> None:
        self.name = name
        self._module = module

    def real_time_factor(self, seconds: float, count: int = 1) -> float:
        """Return simulated seconds a second of processor time, over `seconds`, with this many robots."""
        command = [sys.executable, "-m", self._module, str(seconds), str(count)]
        try:
            done = subprocess.run(
                command, capture_output=True, encoding="utf-8", timeout=TIMEOUT_S, check=False, cwd=HOME
            )
        except subprocess.TimeoutExpired as error:
            msg = f"{self.name} did not simulate {seconds} s with {count} robots in {TIMEOUT_S} s"
            raise RosminiError(msg) from error
        if done.returncode:
            msg = f"{self.name} failed:\n{done.stdout}{done.stderr}"
            raise RosminiError(msg)
        found = json.loads(done.stdout.splitlines()[-1])
        check(found, self.name)
        return float(found["factor"])


def check(found: dict[str, Any], name: str = "ir-sim") -> None:
    """Raise unless its robots drove, and the first one saw what ours sees from there."""
    poses, starts = found["poses"], sim_room.starts(len(found["poses"]))
    for (x, y, _), start, length in zip(poses, starts, found["lengths"], strict=True):
        if math.dist((x, y), start[:2]) > 2.2 * sim_room.RADIUS or not 0.9 < length / found["expected"] < 1.1:
            msg = f"a robot of {name} went {length:.2f} m, not {found['expected']:.2f} m, and to ({x:.2f}, {y:.2f})"
            raise RosminiError(msg)
    lidar, world, ranges = BURGER.laser, sim_room.room(), np.array(found["ranges"])
    x, y, theta = poses[0]
    begin, step = theta + found["angle_min"], found["angle_increment"]
    others = [(*pose[:2], found["radius"]) for pose in poses[1:]]
    discs = np.array([*world.discs, *others])
    exact = raycast(world.segments, discs, x, y, begin, step, len(ranges), lidar.range_max)
    clear = exact < lidar.range_max - 0.1
    wrong = np.abs(ranges - exact)[clear] > 6 * lidar.noise
    if len(ranges) != lidar.beams or wrong.sum() > 2 + len(others) // 10 or not clear.any():
        msg = f"the scan of {name} is not that of the room: {wrong.sum()} of {clear.sum()} ranges are wrong"
        raise RosminiError(msg)


def world_file(count: int = 1) -> dict[str, Any]:
    """The room and the robots as ir-sim describes them."""
    corner, lidar = sim_room.SIZE / 2, BURGER.laser
    outer = [[-corner, -corner], [corner, -corner], [corner, corner], [-corner, corner], [-corner, -corner]]
    wall = {"name": "rectangle", "length": sim_room.PARTITION.length, "width": sim_room.PARTITION.width}
    pillar = {"name": "circle", "radius": sim_room.PILLAR.radius}
    sensor = {
        "name": "lidar2d",
        "range_min": lidar.range_min,
        "range_max": lidar.range_max,
        "angle_range": 2 * math.pi,
        "number": lidar.beams,
        "noise": True,
        "std": lidar.noise,
    }
    robot = {
        "kinematics": {"name": "diff"},
        "shape": {"name": "circle", "radius": BURGER.body_radius},
        "goal": [corner, corner, 0],  # it is driven, not sent there
        "vel_min": [-BURGER.max_linear, -BURGER.max_angular],
        "vel_max": [BURGER.max_linear, BURGER.max_angular],
        "sensors": [sensor],
    }
    obstacles = [
        {"shape": {"name": "linestring", "vertices": outer}, "state": [0, 0, 0]},
        *({"shape": wall, "state": list(pose)} for pose in sim_room.PARTITIONS),
        *({"shape": pillar, "state": [x, y, 0]} for x, y in sim_room.PILLARS),
    ]
    return {
        "world": {
            "width": sim_room.SIZE,
            "height": sim_room.SIZE,
            "offset": [-corner, -corner],
            "step_time": 1 / RATE,
            "sample_time": 1 / RATE,
        },
        "robot": [{**robot, "state": list(start)} for start in sim_room.starts(count)],
        "obstacle": obstacles,
    }


def simulate(seconds: float, count: int) -> dict[str, Any]:
    """Simulate so long with ir-sim, in this process; how fast that was and what came out."""
    import time

    import yaml

    irsim = importlib.import_module("irsim")

    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "room.yaml"
        file.write_text(yaml.safe_dump(world_file(count)), encoding="utf-8")
        env = irsim.make(str(file), headless=True, log_level="ERROR", seed=1)
    steps = max(int(seconds * RATE), 2)
    actions = [np.array([[sim_room.SPEED], [sim_room.TURN_RATE]])] * count
    who = list(range(count))
    for _ in range(WARM_UP // count):
        env.step(actions, who)
    tracks, scan = [], {}
    begin = time.process_time()
    for _ in range(steps):
        env.step(actions, who)
        scan = env.get_lidar_scan(0)
        tracks.append([robot.state.ravel()[:3] for robot in env.robot_list])
    spent = time.process_time() - begin
    track = np.array(tracks)
    return {
        "factor": steps / RATE / spent,
        "poses": track[-1].tolist(),
        "lengths": np.hypot(*np.diff(track[:, :, :2], axis=0).T).sum(axis=-1).tolist(),
        "expected": (steps - 1) / RATE * sim_room.SPEED,
        "ranges": np.asarray(scan["ranges"], dtype=float).tolist(),
        "angle_min": float(scan["angle_min"]),
        "angle_increment": float(scan["angle_increment"]),
        "radius": BURGER.body_radius,
    }


if __name__ == "__main__":
    print(json.dumps(simulate(float(sys.argv[1]), int(sys.argv[2]))))
