"""A running simulation in its current state: the world, the true pose of the robot, and the last scan of its laser."""

from __future__ import annotations

from dataclasses import replace

from rosmini.sim.simulator import Simulator
from rosmini.sim.world import World
from rosmini.viz.beams import beams_of
from rosmini.viz.figures import WIDTH
from rosmini.viz.view import Picture
from rosmini.viz.world_pictures import HEIGHT, Other, Scene


def simulation_picture(
    simulator: Simulator, *, title: str | None = None, size: tuple[float, float] = (WIDTH, HEIGHT)
) -> Picture:
    """Draw a simulator's world in its current state, with its robots, and the first robot's last scan.

    Args:
        simulator: the instance that `rosrun("rosmini_sim", "simulator").instance()` returns.
        title: a caption under the picture, and the first words of its text form.
        size: the largest width and height [CSS px].

    Raises:
        RobotGone: the robot was removed, or the node shut down.

    """
    world: World = simulator.world
    fixed = [obstacle for obstacle in world.obstacles if obstacle.fixed]
    moving = [replace(obstacle, motion=None) for obstacle in simulator.engine.obstacles()]
    scene = Scene(replace(world, obstacles=(*fixed, *moving)), simulator.model)
    scene.robot, scene.name = simulator.truth(), simulator.name
    scene.others = [
        Other(name, robot.model, simulator.truth(name))
        for name, robot in simulator.robots.items()
        if name != simulator.name
    ]
    scan = simulator.last_scan()
    if scan is not None:
        each = simulator.scan_poses
        x, y, heading = each[0].tolist()
        scene.add_scan(beams_of(scan, scene.model.laser), (x, y, heading), each)
    return scene.picture(title, size)
