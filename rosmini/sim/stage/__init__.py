"""Stage: its world files, and the node `stage_ros/stageros` on rosmini's engine.

>>> from rosmini.sim.stage.world_file import load
>>> stage = load("package://stage_ros/world/willow-erratic.world")
>>> [robot.drive for robot in stage.robots]
['diff']

Stage is the simulator of the Player project, by Richard Vaughan: many robots, plain models, a flat world
(https://github.com/rtv/Stage).
"""
