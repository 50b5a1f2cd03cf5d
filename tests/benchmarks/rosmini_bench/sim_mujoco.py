"""MuJoCo (https://mujoco.org) as a peer: a process of its own that simulates the same robots in the same room.

Each robot is a cylinder on two sliding joints and a hinge, whose speeds are set at each of the hundred steps a second
as a planar move would; its rays are cast by `mj_multiRay` five times a second. No messages are made.
"""

from __future__ import annotations

import importlib
import importlib.metadata
import importlib.util
import json
import math
import sys
import time
from typing import Any

import numpy as np

from rosmini.sim.models import BURGER

from . import sim_room
from .sim_peer import Peer

RATE = 100
"""Steps a second."""


def find_mujoco() -> Peer | None:
    """Return MuJoCo, or None where it is not installed."""
    if not importlib.util.find_spec("mujoco"):
        return None
    return Peer(f"MuJoCo {importlib.metadata.version('mujoco')}", __name__)


def model_text(count: int) -> str:
    """The room and the robots in MuJoCo's XML (MJCF)."""
    corner, wall = sim_room.SIZE / 2, sim_room.PARTITION
    sides = [
        (corner, 0, 0.01, corner),
        (-corner, 0, 0.01, corner),
        (0, corner, corner, 0.01),
        (0, -corner, corner, 0.01),
    ]
    outside = [
        (x + math.copysign(0.01, x) * (x != 0), y + math.copysign(0.01, y) * (y != 0), a, b) for x, y, a, b in sides
    ]
    solid = [f'<geom type="box" pos="{x} {y} 0.25" size="{a} {b} 0.25"/>' for x, y, a, b in outside]
    solid += [
        f'<geom type="box" pos="{x} {y} 0.25" euler="0 0 {heading}" size="{wall.length / 2} {wall.width / 2} 0.25"/>'
        for x, y, heading in sim_room.PARTITIONS
    ]
    solid += [
        f'<geom type="cylinder" pos="{x} {y} 0.25" size="{sim_room.PILLAR.radius} 0.25"/>' for x, y in sim_room.PILLARS
    ]
    robots = [
        f'<body pos="{x} {y} 0.1"><joint type="slide" axis="1 0 0"/><joint type="slide" axis="0 1 0"/>'
        f'<joint type="hinge" axis="0 0 1"/><geom type="cylinder" size="{BURGER.body_radius} 0.09" '
        f'mass="{BURGER.mass}"/></body>'
        for x, y, _ in sim_room.starts(count)
    ]
    return (
        f'<mujoco><compiler angle="radian"/><option timestep="{1 / RATE}" gravity="0 0 0"/>'
        f"<worldbody>{''.join(solid + robots)}</worldbody></mujoco>"
    )


def simulate(seconds: float, count: int) -> dict[str, Any]:
    """Simulate so long with MuJoCo, in this process; how fast that was and what came out."""
    mujoco = importlib.import_module("mujoco")
    model = mujoco.MjModel.from_xml_string(model_text(count))
    data = mujoco.MjData(model)
    starts = np.array(sim_room.starts(count))
    lidar = BURGER.laser
    beams = 2 * math.pi / lidar.beams * np.arange(lidar.beams)
    geom, rng = np.zeros(lidar.beams, np.int32), np.random.default_rng(1)
    scans = np.zeros((count, lidar.beams))
    bodies = [int(body) for body in model.jnt_bodyid[::3]]

    def step() -> None:
        heading = starts[:, 2] + data.qpos[2::3]
        data.qvel[0::3], data.qvel[1::3] = sim_room.SPEED * np.cos(heading), sim_room.SPEED * np.sin(heading)
        data.qvel[2::3] = sim_room.TURN_RATE
        mujoco.mj_step(model, data)

    def scan() -> None:
        mujoco.mj_kinematics(model, data)
        for i, body in enumerate(bodies):
            angles = beams + (starts[i, 2] + data.qpos[3 * i + 2])
            rays = np.column_stack([np.cos(angles), np.sin(angles), np.zeros(lidar.beams)]).ravel()
            place = data.xpos[body].copy()
            mujoco.mj_multiRay(
                model, data, place, rays, None, True, body, geom, scans[i], None, lidar.beams, lidar.range_max
            )
            found = scans[i]
            found[found < 0] = np.inf
            found += lidar.noise * rng.standard_normal(lidar.beams)

    steps, every = max(int(seconds * RATE), RATE), round(RATE / lidar.rate)
    for _ in range(10):
        step()
    scan()
    track = []
    begin = time.process_time()
    for number in range(1, steps + 1):
        step()
        if number % every == 0:
            scan()
            track.append(starts + data.qpos.reshape(-1, 3))
    spent = time.process_time() - begin
    tracks = np.array(track)
    return {
        "factor": steps / RATE / spent,
        "poses": tracks[-1].tolist(),
        "lengths": np.hypot(*np.diff(tracks[:, :, :2], axis=0).T).sum(axis=-1).tolist(),
        "expected": (len(tracks) - 1) / lidar.rate * sim_room.SPEED,
        "ranges": scans[0].tolist(),
        "angle_min": 0.0,
        "angle_increment": 2 * math.pi / lidar.beams,
        "radius": BURGER.body_radius,
    }


if __name__ == "__main__":
    print(json.dumps(simulate(float(sys.argv[1]), int(sys.argv[2]))))
