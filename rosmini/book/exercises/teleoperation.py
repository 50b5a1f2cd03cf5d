"""Checks of the exercises in the chapter Teleoperation: each runs a script with a separate robot."""

from __future__ import annotations

from typing import Any

import numpy as np

from rosmini.book.checks import Script, exercise, expect
from rosmini.book.trials import Trial
from rosmini.msgs.geometry_msgs.msg import Twist
from rosmini.msgs.sensor_msgs.msg import Joy
from rosmini.msgs.std_msgs.msg import Bool

Velocity = tuple[float, float]
"""Speed ahead [m/s] and rate of turn to the left [rad/s]."""


def _said(velocities: list[Velocity]) -> str:
    return ", ".join(f"{v:.2f} m/s and {w:.2f} rad/s" for v, w in velocities) or "nothing"


def _same(got: list[Velocity], expected: list[Velocity]) -> bool:
    return np.shape(got) == np.shape(expected) and bool(np.allclose(got, expected, rtol=0.0, atol=1e-6))


def _twist(v: float = 0.0, w: float = 0.0) -> Any:
    command = Twist()
    command.linear.x, command.angular.z = v, w
    return command


def _listen(trial: Trial) -> list[Velocity]:
    """Return a list that gets all commands to the robot."""
    sent: list[Velocity] = []
    trial.graph.node("listener").subscriber("cmd_vel", Twist, lambda m: sent.append((m.linear.x, m.angular.z)))
    return sent


def _answers(trial: Trial, sent: list[Velocity], publisher: Any, message: Any) -> list[Velocity]:
    """Return the commands within a tenth of a second after this message."""
    sent.clear()
    publisher.publish(message)
    trial.run(0.1)
    trial.expect_no_errors()
    return list(sent)


# ---- joystick: a dead man's switch ----

STICKS = (((0.2, 1.0), 1), ((-0.4, -0.5), 1), ((0.5, 1.0), 0), ((0.0, 0.25), 1), ((0.3, 0.3), 0))
"""Axes, and whether the button is held."""


@exercise("joystick", praise="The robot stops when you release the button.")
def joystick(answer: Script) -> Any:
    """The node converts a gamepad's messages into commands while a button is held."""
    with Trial("room") as trial:
        sent = _listen(trial)
        joy = trial.graph.node("gamepad").publisher("joy", Joy, queue_size=10)
        trial.start(answer)
        trial.run(1.0)
        expect(joy.num_connections(), "No node subscribes to /joy.", "keep the stub's last lines")
        for axes, held in STICKS:
            expected = (0.22 * axes[1], 2.84 * axes[0]) if held else (0.0, 0.0)
            for _ in range(10):
                message = Joy()
                message.axes, message.buttons = list(axes), [0, 0, 0, 0, held, 0]
                got = _answers(trial, sent, joy, message)
                expect(
                    _same(got, [expected]),
                    f"For axes {list(axes)} and the button {'held' if held else 'not held'} it published "
                    f"{_said(got)}; it should publish {_said([expected])}.",
                    "axes[1] times 0.22 is linear.x, axes[0] times 2.84 is angular.z; zero if buttons[4] is not 1",
                )
        return trial.view()


# ---- lock: a stop that lasts ----


@exercise("lock", praise="The stop now stops the robot, whatever other nodes publish.", gaps=2)
def lock(answer: Script) -> Any:
    """The node passes commands on until it receives a stop."""
    with Trial("room") as trial:
        sent = _listen(trial)
        hand = trial.graph.node("hand")
        wish = hand.publisher("wish", Twist, queue_size=10)
        stop = hand.publisher("stop", Bool, queue_size=10)
        trial.start(answer)
        trial.run(1.0)
        for publisher, topic in ((wish, "/wish"), (stop, "/stop")):
            expect(publisher.num_connections(), f"No node subscribes to {topic}.", "keep the stub's last lines")
        for publisher, given, expected, what in (
            *((wish, (0.2, 0.3), [(0.2, 0.3)], "For a command before any stop"),) * 20,
            (stop, True, [(0.0, 0.0)], "After True on /stop"),
            *((wish, (0.2, 0.0), [], "For a command after the stop"),) * 10,
            (stop, False, [], "After False on /stop"),
            *((wish, (0.1, -0.3), [(0.1, -0.3)], "For a command after it was unlocked"),) * 10,
        ):
            got = _answers(trial, sent, publisher, _twist(*given) if isinstance(given, tuple) else given)
            expect(
                _same(got, expected),
                f"{what} it published {_said(got)}; it should publish {_said(expected)}.",
                "store the last message on /stop, and check it for each command",
            )
        return trial.view()


# ---- guard_back: a guard with eyes in the back ----

DRIVES = (("_x:=2.2", "_yaw:=0", 0.2, "ahead"), ("_x:=2.2", "_yaw:=3.14159", -0.2, "backwards"))
"""Start and heading of a robot in the room, whose wall is at x = 3.3 m, and the speed towards the wall [m/s]."""


@exercise("guard_back", praise="It protects the robot in both directions, and never traps it.", gaps=2)
def guard_back(answer: Script) -> Any:
    """The guard stops the robot before it drives into something, ahead and backwards, and lets it leave."""
    return [_guards(answer, *drive) for drive in DRIVES][-1]


def _guards(answer: Script, start: str, heading: str, speed: float, way: str) -> Any:
    with Trial("room", start, heading) as trial:
        sent = _listen(trial)
        wish = trial.graph.node("driver").publisher("wish", Twist, queue_size=10)
        trial.start(answer)
        trial.run(1.0)
        expect(wish.num_connections(), "No node subscribes to /wish.", "keep the stub's last lines")

        def drive(v: float, w: float, seconds: float) -> float:
            before = trial.robot.truth()
            for _ in range(round(10 * seconds)):
                got = _answers(trial, sent, wish, _twist(v, w))
                expect(len(got) == 1, f"For one command it published {len(got)}.", "publish one command for each wish")
            after = trial.robot.truth()
            return abs(after[2] - before[2]) if w else after[0] - before[0]

        x = trial.robot.truth()[0]
        far = drive(speed, 0.0, 1.0)
        expect(far > 0.1, f"It does not let the robot drive {way}, although nothing is near.", "compare with 0.3 m")
        drive(speed, 0.0, 9.0)
        x = trial.robot.truth()[0]
        touch = 3.3 - (0.05 if speed > 0 else 0.13)
        expect(x < touch - 0.02, f"The robot ran into the wall {way}.", "beams 150 to 210 look backwards")
        expect(x > 2.75, f"It stopped the robot {3.3 - x:.2f} m before the wall {way}; that is too early.", "use 0.3 m")
        expect(drive(0.0, 1.0, 0.5) > 0.2, "At the wall it does not let the robot turn.", "leave angular.z as it is")
        drive(0.0, -1.0, 0.5)
        expect(
            drive(-speed, 0.0, 1.5) < -0.1,
            "It does not let the robot drive away from the wall.",
            "change only one sign",
        )
        return trial.view()
