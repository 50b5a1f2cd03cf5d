"""Checks of the exercises in the chapter Odometry: each runs a script with a separate robot."""

from __future__ import annotations

from typing import Any

from rosmini.book.checks import Script, exercise, expect
from rosmini.book.trials import Trial
from rosmini.msgs import message_class

from .nodes_and_master import driver

TWIST = "geometry_msgs/Twist"


def listen(trial: Trial, topic: str, kind: str) -> list[Any]:
    """Return a list to which each message of a topic will be appended."""
    heard: list[Any] = []
    trial.graph.node(f"listener_to_{topic}").subscriber(topic, message_class(kind), heard.append)
    return heard


class Driver:
    """Drives the robot of a trial."""

    def __init__(self, trial: Trial) -> None:
        self.trial = trial
        self._cmd_vel = trial.graph.node("check").publisher("cmd_vel", message_class(TWIST), queue_size=1)
        self._cmd_vel.wait_for_subscribers()

    def drive(self, speed: float, turn: float, seconds: float) -> None:
        """Send a command ten times a second [m/s, rad/s], then stop for a second."""
        for v, w, duration in ((speed, turn, seconds), (0.0, 0.0, 1.0)):
            command = message_class(TWIST)()
            command.linear.x, command.angular.z = v, w
            for _ in range(round(10 * duration)):
                self._cmd_vel.publish(command)
                self.trial.run(0.1)


# ---- mileage: how far the robot has been driven ----


@exercise("mileage", praise="Ahead, back and turns: your node counts every metre once.")
def mileage(answer: Script) -> Any:
    """The node adds up the distance that the middle of the robot has driven."""
    with Trial("empty", "_board:=true") as trial:
        robot = Driver(trial)
        robot.drive(0.2, 0.0, 3.0)
        heard = listen(trial, "mileage", "std_msgs/Float64")
        trial.start(answer)
        trial.run(0.5)
        robot.drive(0.2, 0.3, 6.0)
        trial.expect_no_errors()
        expect(heard, "Nothing was published on mileage.", "publish in the callback, for each message")
        ahead = heard[-1].data
        expect(
            abs(ahead - 1.2) < 0.03,
            f"The robot drove 1.2 m after the start of your node, and mileage is {ahead:.2f} m.",
            "count from the first message that your node receives, not from 0 ticks",
        )
        robot.drive(-0.2, 0.0, 4.0)
        back = heard[-1].data - ahead
        expect(
            abs(back - 0.8) < 0.03,
            f"The robot drove 0.8 m backwards, and mileage changed by {back:.2f} m.",
            "add the absolute value",
        )
        robot.drive(0.0, 1.5, 5.0)
        turned = heard[-1].data - ahead - back
        expect(
            abs(turned) < 0.02,
            f"The robot turned on the spot, and mileage grew by {turned:.2f} m.",
            "take the mean of both wheels first, then the absolute value",
        )
        return trial.view()


# ---- calibrate: measure the wheel separation ----

NARROW, WIDE = "truck", "carol"
"""Names of simulators whose robots have a wheel separation of 156.3 mm and 162.4 mm."""


@exercise("calibrate", praise="With this number, the robot's odometry turns as the robot does.")
def calibrate(answer: Script) -> Any:
    """The node measures the wheel separation of two robots."""
    calibrates(answer, NARROW)
    return calibrates(answer, WIDE)


def calibrates(answer: Script, name: str) -> Any:
    """Run the script with the robot of this simulator; return the drive."""
    with Trial("arena", f"__name:={name}") as trial:
        right = trial.robot.engine.robot(trial.robot.name).wheels.separation
        heard = listen(trial, "separation", "std_msgs/Float64")
        trial.start(answer)
        trial.run(90.0)
        trial.expect_no_errors()
        expect(heard, "Nothing was published on separation within 90 s.", "publish once, after the spin")
        found = heard[-1].data
        expect(
            abs(found - right) < 5e-4,
            f"A robot has a wheel separation of {1000 * right:.1f} mm, and your node says {1000 * found:.1f} mm.",
            "the distance that the right wheel rolled more than the left one, divided by the true angle",
        )
        before = trial.robot.truth()[2]
        trial.run(1.0)
        expect(
            abs(trial.robot.truth()[2] - before) < 0.01, "The robot is still turning.", "publish Twist() after the spin"
        )
        return trial.view()


# ---- stuck: wheels that spin against an obstacle ----


@exercise("stuck", praise="It reports the robot that is stuck at the wall, and no others.")
def stuck(answer: Script) -> Any:
    """The node notices that the robot drives by odometry, and does not move by its laser."""
    with Trial("arena") as trial:
        heard = listen(trial, "stuck", "std_msgs/Bool")
        trial.start(answer)
        trial.start(driver(speed=0.2, turn=0.5))
        trial.run(15.0)
        trial.expect_no_errors()
        expect(heard, "Nothing was published on stuck.", "publish at each scan")
        expect(
            not any(message.data for message in heard),
            "The robot drove a free circle, and your node said that it was stuck.",
            "when the range changes, also store the position, and measure the distance from there",
        )
    with Trial("arena", "_x:=0.5") as trial:
        heard = listen(trial, "stuck", "std_msgs/Bool")
        trial.start(answer)
        trial.start(driver(speed=0.2))
        trial.run(6.0)
        expect(
            not any(message.data for message in heard),
            "The robot drove towards a wall, and your node said that it was stuck.",
            "compare the new range with the stored one, by its absolute difference",
        )
        trial.run(6.0)
        trial.expect_no_errors()
        x, _, _ = trial.robot.truth()
        expect(
            heard and heard[-1].data,
            f"The robot pushed against the wall at x = {x:.2f} m for some seconds, and your node did not notice.",
            "store a new position only if the range has changed; for -inf, use scan.range_min",
        )
        return trial.view()
