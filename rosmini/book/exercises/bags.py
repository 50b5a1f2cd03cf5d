"""Checks of the exercises in the chapter Bags."""

from __future__ import annotations

import math
import re
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING, Any

from rosmini.book.checks import Script, exercise, expect, expect_type
from rosmini.book.trials import Trial
from rosmini.core.time import Time
from rosmini.msgs.geometry_msgs.msg import Twist, Vector3
from rosmini.msgs.nav_msgs.msg import Odometry
from rosmini.msgs.std_msgs.msg import String
from rosmini.ros.bag import Bag, FilterError
from rosmini.ros.bag.tools import compile_expression

if TYPE_CHECKING:
    from collections.abc import Iterable


def _write(path: Path, messages: Iterable[tuple[str, Any, float]]) -> None:
    """Write a bag with messages recorded at the given times [s]."""
    with Bag(path, "w") as bag:
        for topic, message, time in messages:
            bag.write(topic, message, Time.from_nsec(round(time * 1e9)))


# ---- longest_silence: the longest silence ----

NUMBER = re.compile(r"-?\d+(?:\.\d+)?(?:e-?\d+)?")


@exercise("longest_silence", praise="The timeline shows the gap; your script measures it.")
def longest_silence(answer: Script) -> None:
    """A script that prints the longest time between two messages of one topic."""
    messages = [("/chatter", String("x"), time) for time in (10.0, 10.5, 14.25, 15.0)]
    news = [("/news", String("x"), float(time)) for time in range(9, 19)]
    with TemporaryDirectory() as folder:
        path = Path(folder) / "test.bag"
        _write(path, sorted(messages + news, key=lambda message: message[2]))
        found = _printed(answer, str(path), "/chatter")
        expect(
            math.isclose(found, 3.75, abs_tol=0.01),
            f"In the test bag, /chatter is silent from 10.5 to 14.25 s, for 3.75 s; your script prints {found:g}.",
            "use the times of one topic only, and take the largest difference between consecutive ones",
        )
        other = _printed(answer, str(path), "/news")
        expect(
            math.isclose(other, 1.0, abs_tol=0.01),
            f"/news has a message every second; your script prints {other:g}.",
            "use the topic in sys.argv[2]",
        )


def _printed(answer: Script, *args: str) -> float:
    """Return the last number that a script prints."""
    with Trial(is_shown=False) as trial:
        trial.start(answer, *args)
        trial.run(1.0)
        numbers = NUMBER.findall(trial.output)
    expect(numbers, "The script prints no number.", "print the longest time in seconds")
    return float(numbers[-1])


# ---- fast_commands: a filter ----


@exercise("fast_commands", praise="`and` evaluates the right side only for the topic that has this field.")
def fast_commands(answer: Any) -> None:
    """An expression that keeps commands to drive forwards faster than 0.1 m/s."""
    expect_type(answer, str, "The expression is", "a string")
    cases = [
        ("/cmd_vel", Twist(linear=Vector3(x=0.2)), True, "a command of 0.2 m/s"),
        ("/cmd_vel", Twist(linear=Vector3(x=0.05)), False, "a command of 0.05 m/s"),
        ("/cmd_vel", Twist(linear=Vector3(x=0.1)), False, "a command of exactly 0.1 m/s"),
        ("/cmd_vel", Twist(linear=Vector3(x=-0.2)), False, "a command to drive backwards"),
        ("/cmd_vel", Twist(Vector3(x=0.0), Vector3(z=1.0)), False, "a command to turn on the spot"),
        ("/odom", Odometry(), False, "a message on /odom"),
    ]
    try:
        chosen = compile_expression(answer)
        results = [bool(chosen(topic, message, Time(1))) for topic, message, _, _ in cases]
    except FilterError as error:
        expect(False, str(error))
        return
    for found, (_, _, wanted, what) in zip(results, cases, strict=True):
        expect(
            found == wanted,
            f"It {'keeps' if found else 'drops'} {what}.",
            "compare m.linear.x with > 0.1" if found else "the topic is '/cmd_vel', with a slash",
        )


# ---- way_back: the recorded commands, backwards ----

DRIVES = (
    (((0.2, 0.0), 0.3, 8), ((0.1, 0.5), 0.1, 30), ((0.15, -0.4), 0.2, 12)),
    (((0.0, 0.6), 0.2, 8), ((0.2, 0.0), 0.1, 25)),
)
"""Drives of parts: the speed and the turn, the interval between commands [s], and the number of commands."""


@exercise("way_back", praise="Twice the robot was driven away, and twice it came back, in reverse.")
def way_back(answer: Script) -> Any:
    """A node that drives the robot back along a recorded drive."""
    return [_comes_back(answer, drive) for drive in DRIVES][-1]


def _comes_back(answer: Script, drive: Iterable[tuple[tuple[float, float], float, int]]) -> Any:
    with TemporaryDirectory() as folder, Trial("arena", "_x:=-1.0", "_y:=0.5") as trial:
        wheels = trial.graph.node("person").publisher("cmd_vel", Twist, queue_size=1)
        trial.run(1.0)
        start = trial.robot.truth()
        messages = []
        for (speed, turn), interval, count in drive:
            for _ in range(count):
                command = Twist(Vector3(x=speed), Vector3(z=turn))
                messages.append(("/cmd_vel", command, trial.graph.now().to_sec()))
                wheels.publish(command)
                trial.run(interval)
        messages.append(("/cmd_vel", Twist(), trial.graph.now().to_sec()))
        wheels.publish(Twist())
        _write(Path(folder) / "test.bag", messages)
        trial.run(1.0)
        away = trial.robot.truth()
        trial.start(answer, str(Path(folder) / "test.bag"))
        trial.run(messages[-1][2] - messages[0][2] + 2.0)
        trial.expect_no_errors()
        back = trial.robot.truth()
        far, left = math.dist(start[:2], away[:2]), math.dist(start[:2], back[:2])
        expect(math.dist(away[:2], back[:2]) > 0.05, "The robot did not move.", "publish each command on cmd_vel")
        turned = abs(math.remainder(back[2] - start[2], math.tau))
        expect(
            left < 0.15 and turned < 0.45,
            f"It was driven {far:.2f} m away, and your node left it {left:.2f} m from where it started, turned by "
            f"{math.degrees(turned):.0f} degrees.",
            "the last command comes first, with both speeds negative, and lasts as long as it did in the bag",
        )
        trial.run(0.5)
        expect(math.dist(back[:2], trial.robot.truth()[:2]) < 0.01, "The robot does not stop.", "publish Twist() last")
        return trial.view()
