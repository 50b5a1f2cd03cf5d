"""ir-sim (https://github.com/hanruihua/ir-sim) as a peer: a process of its own that simulates the same robot in the same room.

It is used as its own examples use it: ten steps a second, no window, and after each step a look at the scan and at the state.
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

from rosmini.errors import RosminiError
from rosmini.geometry.raycast import raycast
from rosmini.sim.models import BURGER

from . import sim_room

TIMEOUT_S = 300
RATE = 10
WARM_UP = 20
"""Steps before the clock starts."""


def find_irsim() -> IrSim | None:
    """Return ir-sim, or None where it is not installed."""
    return IrSim() if importlib.util.find_spec("irsim") else None


class IrSim:
    """An ir-sim that is installed."""

    def __init__(self) -> None:
        self.name = f"ir-sim {importlib.metadata.version('ir-sim')}"

    def real_time_factor(self, seconds: float) -> float:
        """Return how many seconds it simulates in a second of processor time, over `seconds` of them."""
        command = [sys.executable, "-m", __name__, str(seconds)]
        try:
            done = subprocess.run(command, capture_output=True, text=True, timeout=TIMEOUT_S, check=False)
        except subprocess.TimeoutExpired as error:
            msg = f"{self.name} did not simulate {seconds} s in {TIMEOUT_S} s"
            raise RosminiError(msg) from error
        if done.returncode:
            msg = f"{self.name} failed:\n{done.stdout}{done.stderr}"
            raise RosminiError(msg)
        found = json.loads(done.stdout.splitlines()[-1])
        check(found)
        return float(found["factor"])


def check(found: dict[str, Any]) -> None:
    """Raise unless its robot drove, and saw the room that ours sees from there."""
    x, y, theta = found["pose"]
    if math.dist((x, y), sim_room.START[:2]) > 1.5 or not 0.9 < found["length"] / found["expected"] < 1.1:
        msg = f"ir-sim's robot went {found['length']:.2f} m, not {found['expected']:.2f} m, and to ({x:.2f}, {y:.2f})"
        raise RosminiError(msg)
    lidar, world, ranges = BURGER.laser, sim_room.room(), np.array(found["ranges"])
    start, step = theta + found["angle_min"], found["angle_increment"]
    exact = raycast(world.segments, world.discs, x, y, start, step, len(ranges), lidar.range_max)
    clear = exact < lidar.range_max - 0.1
    wrong = np.abs(ranges - exact)[clear] > 6 * lidar.noise
    if len(ranges) != lidar.beams or wrong.sum() > 2 or not clear.any():
        msg = f"ir-sim's scan is not that of the room: {wrong.sum()} of {clear.sum()} ranges are wrong"
        raise RosminiError(msg)


def world_file() -> dict[str, Any]:
    """The room and the robot as ir-sim describes them."""
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
        "state": list(sim_room.START),
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
        "robot": [robot],
        "obstacle": obstacles,
    }


def simulate(seconds: float) -> dict[str, Any]:
    """Simulate so long with ir-sim, in this process; how fast that was and what came out."""
    import time

    import yaml

    irsim = importlib.import_module("irsim")

    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "room.yaml"
        file.write_text(yaml.safe_dump(world_file()), encoding="utf-8")
        env = irsim.make(str(file), headless=True, log_level="ERROR", seed=1)
    steps = max(int(seconds * RATE), 1)
    actions = [np.array(sim_room.command(i / RATE)).reshape(2, 1) for i in range(WARM_UP + steps)]
    for action in actions[:WARM_UP]:
        env.step(action)
    poses, scan = [], {}
    begin = time.process_time()
    for action in actions[WARM_UP:]:
        env.step(action)
        scan = env.get_lidar_scan()
        poses.append(env.get_robot_state().ravel()[:3])
    spent = time.process_time() - begin
    path = np.diff(np.array(poses)[:, :2], axis=0)
    return {
        "factor": steps / RATE / spent,
        "pose": poses[-1].tolist(),
        "length": float(np.hypot(*path.T).sum()),
        "expected": (steps - 1) / RATE * sim_room.SPEED,
        "ranges": np.asarray(scan["ranges"], dtype=float).tolist(),
        "angle_min": float(scan["angle_min"]),
        "angle_increment": float(scan["angle_increment"]),
    }


if __name__ == "__main__":
    print(json.dumps(simulate(float(sys.argv[1]))))
