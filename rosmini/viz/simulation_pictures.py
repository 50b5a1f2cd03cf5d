"""A running simulation in its current state: the world, the true pose of the robot, and the last scan of its laser."""

from __future__ import annotations

from dataclasses import replace

from numpy.typing import ArrayLike

from rosmini.sim.recording import Recording
from rosmini.sim.simulator import Simulator
from rosmini.sim.world import World
from rosmini.viz.figures import WIDTH
from rosmini.viz.view import Picture
from rosmini.viz.world_pictures import HEIGHT, Other, world_picture


def simulation_picture(
    simulator: Simulator,
    *,
    scan: bool = True,
    trail: Recording | ArrayLike | None = None,
    title: str | None = None,
    size: tuple[float, float] = (WIDTH, HEIGHT),
) -> Picture:
    """Draw a simulator's world in its current state, with its robots, and the first robot's last scan.

    Args:
        simulator: the instance that `rosrun("rosmini_sim", "simulator").instance()` returns.
        scan: True to draw the last scan; there is none before the first revolution of the laser.
        trail: past poses of the robot: a `Recording`, whose odometry is also drawn, or poses (n, 2) or (n, 3).
        title: a caption under the picture, and the first words of its text form.
        size: the largest width and height [CSS px].

    Raises:
        ViewError: the trail is invalid.
        RobotGone: the robot was removed, or the node shut down.

    """
    world: World = simulator.world
    fixed = [obstacle for obstacle in world.obstacles if obstacle.fixed]
    moving = [replace(obstacle, motion=None) for obstacle in simulator.engine.obstacles()]
    way, odom = (trail.truth, trail.odom_in_map()) if isinstance(trail, Recording) else (trail, None)
    runs = trail.others if isinstance(trail, Recording) else ()
    ways = {run.name: run.truth for run in runs}
    return world_picture(
        replace(world, obstacles=(*fixed, *moving)),
        robot=simulator.truth(),
        model=simulator.model,
        scan=simulator.last_scan() if scan else None,
        scan_from=simulator.scan_poses,
        trail=way,
        odom=odom,
        others=[
            Other(name, robot.model, simulator.truth(name), ways.get(name))
            for name, robot in simulator.robots.items()
            if name != simulator.name
        ],
        name=simulator.name,
        title=title,
        size=size,
    )
