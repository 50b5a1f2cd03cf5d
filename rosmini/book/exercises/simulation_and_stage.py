"""Checks of the exercises in the chapter Simulation and Stage: each runs a script or a world file of the reader."""

from __future__ import annotations

import math
from typing import Any

from rosmini.book.checks import Script, Wrong, exercise, expect, expect_type
from rosmini.book.trials import StageTrial, Trial
from rosmini.msgs.std_msgs.msg import Float32

YARD = """
define wall model( color "gray30" )
wall( pose [0 2 0 0] size [6 0.2 0.5] )
wall( pose [0 -2 0 0] size [6 0.2 0.5] )
wall( pose [-3 0 0 90] size [4.2 0.2 0.5] )
wall( pose [3 0 0 90] size [4.2 0.2 0.5] )
define courier position
(
  size [0.3 0.3 0.2]
  drive "diff"
  ranger( pose [0 0 -0.05 0] sensor( range [0 5] fov 180 samples 181 ) )
)
"""
"""A yard whose walls are at x = -2.9 m and 2.9 m, and y = -1.9 m and 1.9 m, and a kind of robot that sees others."""

STOP = """
import rospy
from geometry_msgs.msg import Twist
from sensor_msgs.msg import LaserScan

def on_scan(scan):
    command = Twist()
    ahead = round(-scan.angle_min / scan.angle_increment)
    if scan.ranges[ahead] > 0.5:
        command.linear.x = 0.2
    cmd_vel.publish(command)

rospy.init_node("driver")
cmd_vel = rospy.Publisher("cmd_vel", Twist, queue_size=1)
rospy.Subscriber("scan", LaserScan, on_scan, queue_size=1)
rospy.spin()
"""
"""A driver that stops half a metre in front of whatever it sees."""


# ---- stop_in_both: one program for two lasers ----


@exercise("stop_in_both", praise="The same program stops two robots whose lasers count their beams differently.")
def stop_in_both(answer: Script) -> Any:
    """The robot stops in front of a wall, in the TurtleBot3's simulator and in Stage."""
    with Trial("room", "_x:=1.2") as trial:
        _stops(trial, answer, "The TurtleBot3", 3.3, 0.11)
    with StageTrial(f"{YARD}courier( pose [0.5 1.2 0 0] )", "base_scan:=scan") as stage:
        _stops(stage, answer, "Stage's robot", 2.9, 0.16)
        return stage.view()


def _stops(trial: Trial, answer: Script, who: str, wall: float, touch: float) -> None:
    """Run the script. Raises `Wrong` unless the robot, which looks along x, stops at most 0.5 m before the wall."""
    trial.start(answer)
    begin = trial.simulation.truth()[0]
    trial.run(20.0)
    before = trial.simulation.truth()[0]
    trial.run(1.0)
    trial.expect_no_errors()
    x = trial.simulation.truth()[0]
    expect(x > begin + 0.1, f"{who} did not drive.", "publish a command for every scan")
    expect(wall - x > touch, f"{who} ran into the wall.", "compute which beam looks ahead from scan.angle_min")
    expect(x - before < 0.01, f"{who} is still driving after 20 s.", "publish a command of zero to stop it")
    expect(
        wall - x < 0.51,
        f"{who} stopped {wall - x:.2f} m from the wall; it should stop less than half a metre from it.",
        "the beam at angle 0 looks ahead; its number is -angle_min / angle_increment",
    )


# ---- pair_world: robots that see each other ----


@exercise("pair_world", praise="Each courier sees the other one, so both stop.")
def pair_world(answer: Any) -> Any:
    """A Stage world with two robots, face to face, whose lasers see the other robot."""
    expect_type(answer, str, "pair_world is", "a string")
    with StageTrial(answer, "robot_0/base_scan:=robot_0/scan", "robot_1/base_scan:=robot_1/scan") as trial:
        robots = trial.stage.file.robots
        expect(
            len(robots) == 2, f"It contains {len(robots)} robots, not two.", "add two lines that begin with courier("
        )
        for robot in robots:
            expect(len(robot.lasers) == 1, f"{robot.name} has no laser.", "a ranger with a sensor, as in yard.world")
        (x, y, heading), (other_x, other_y, other_heading) = (robot.pose for robot in robots)
        apart = math.hypot(other_x - x, other_y - y)
        expect(
            abs(apart - 3) < 0.02, f"They start {apart:.2f} m apart, not 3 m.", "compare the first two numbers of pose"
        )
        bearing = math.atan2(other_y - y, other_x - x)
        for robot, angle in ((robots[0], heading - bearing), (robots[1], other_heading - bearing - math.pi)):
            off = abs(math.remainder(angle, 2 * math.pi))
            expect(
                off < 0.02, f"{robot.name} does not face the other robot.", "the last number of a pose is in degrees"
            )
        for i in (0, 1):
            trial.start(Script("stop.py", STOP), f"__ns:=robot_{i}")
        trial.run(20.0)
        (x, y, _), (other_x, other_y, _) = (trial.stage.truth(f"robot_{i}") for i in (0, 1))
        left = math.hypot(other_x - x, other_y - y)
        expect(
            left > 0.5,
            "They drove into each other: no laser saw the other robot.",
            "a laser without a pose is on top of its robot; a negative z puts it into the body",
        )
        expect(left < 0.9, f"They stopped {left:.2f} m apart: something is between them.", "leave the shed out")
        return trial.view()


# ---- sideways: a robot that drives in any direction ----

PLACES = (((-2.0, -1.0, 90.0), (-0.5, 0.8)), ((1.5, 1.0, 200.0), (-1.0, -0.7)))
"""Starts (x, y, heading [deg]) and goals."""


@exercise("sideways", praise="Whatever its heading, the robot went straight to its goal and did not turn.")
def sideways(answer: Script) -> Any:
    """An omnidirectional robot goes to a place without turning."""
    return [_slides(answer, start, goal) for start, goal in PLACES][-1]


def _slides(answer: Script, start: tuple[float, float, float], goal: tuple[float, float]) -> Any:
    x, y, degrees = start
    slider = f'courier( drive "omni" pose [{x} {y} 0 {degrees}] )'
    with StageTrial(YARD + slider, "base_scan:=scan") as trial:
        trial.start(answer, f"_x:={goal[0]}", f"_y:={goal[1]}")
        trial.run(20.0)
        before = trial.stage.truth()
        trial.run(1.0)
        trial.expect_no_errors()
        x, y, heading = trial.stage.truth()
        at = f"With a heading of {degrees:.0f} degrees at the start,"
        expect(math.dist((x, y), start[:2]) > 0.1, f"{at} it did not move.", "publish a command for every odom")
        turned = math.degrees(heading - math.radians(degrees))
        expect(abs(turned) < 3, f"{at} it turned by {turned:.0f} degrees.", "leave angular.z at 0")
        off = math.dist((x, y), goal)
        expect(off < 0.05, f"{at} it is {off:.2f} m from its goal after 20 s.", "turn (dx, dy) into the robot's axes")
        expect(math.dist(before[:2], (x, y)) < 0.02, f"{at} it does not stop.", "let the speed follow the distance")
        return trial.view()


# ---- odometry_error: how wrong is it? ----

ERRORS = (0.08, -0.05)


@exercise("odometry_error", praise="It measured both errors with its laser: now you can correct the odometry.")
def odometry_error(answer: Script) -> Any:
    """The node measures with the laser by how much the odometry overestimates the distance."""
    return [_measures(answer, error) for error in ERRORS][-1]


def _measures(answer: Script, error: float) -> Any:
    got: list[float] = []
    driver = f'courier( pose [0.2 0.5 0 0] localization "odom" odom_error [{error} 0 0 0] )'
    with StageTrial(YARD + driver, "base_scan:=scan") as trial:
        trial.graph.node("listener").subscriber("odom_error", Float32, lambda m: got.append(m.data))
        trial.start(answer)
        trial.run(20.0)
        trial.expect_no_errors()
        x, _, _ = trial.stage.truth()
        expect(
            x > 0.7, f"The robot drove {x - 0.2:.2f} m; it should drive at least half a metre.", "repeat the command"
        )
        expect(x < 2.7, "The robot ran into the wall.", "drive for 5 s at 0.2 m/s")
        expect(got, "It published nothing on /odom_error.", "publish once, at the end")
        if not math.isfinite(got[-1]) or abs(got[-1] - error) > 0.01:
            raise Wrong(
                f"It published {got[-1]:.3f}; the odometry of this robot overestimates by {error:g}.",
                "divide the distance by odometry by the distance by the laser, and subtract 1",
            )
        return trial.view()
