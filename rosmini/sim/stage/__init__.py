"""Stage: its world files, and the node `stage_ros/stageros` on rosmini's engine.

>>> from rosmini.sim.stage import load
>>> stage = load("package://stage_ros/world/willow-erratic.world")
>>> [robot.drive for robot in stage.robots]
['diff']

Stage is the simulator of the Player project, by Richard Vaughan: many robots, plain models, a flat world
(https://github.com/rtv/Stage).
"""

from .errors import StageError
from .robots import StageRobot
from .world_file import StageWorld, load

__all__ = ["StageError", "StageRobot", "StageWorld", "load"]
