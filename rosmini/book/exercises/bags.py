"""Checks of the exercises in the chapter Bags."""

from __future__ import annotations

import math
from io import BytesIO
from typing import TYPE_CHECKING, Any

from rosmini.book.checks import exercise, expect, expect_type
from rosmini.core.time import Time
from rosmini.msgs.geometry_msgs.msg import Twist, Vector3
from rosmini.msgs.nav_msgs.msg import Odometry
from rosmini.msgs.std_msgs.msg import String
from rosmini.ros.bag import Bag, FilterError
from rosmini.ros.bag.expressions import compile_expression

if TYPE_CHECKING:
    from collections.abc import Iterable


def _bag(messages: Iterable[tuple[str, Any, float]]) -> Bag:
    """Return a bag in memory, with messages recorded at the given times [s]."""
    file = BytesIO()
    with Bag(file, "w") as bag:
        for topic, message, time in messages:
            bag.write(topic, message, Time.from_nsec(round(time * 1e9)))
    return Bag(file)


def _odometry(x: float, y: float) -> Any:
    message = Odometry()
    message.pose.pose.position.x, message.pose.pose.position.y = x, y
    return message


# ---- message_counts: how many messages on which topic ----


@exercise("message_counts", praise="`rosbag info` prints the same numbers, one line for each topic.")
def message_counts(answer: Any) -> None:
    """A dictionary from topics to their message counts."""
    bag = _bag([("/chatter", String("x"), float(i)) for i in range(5)] + [("/news", String("x"), 2.5)])
    found = answer(bag)
    expect_type(found, dict, "It returned", "a dictionary")
    expect(
        set(found) == {"/chatter", "/news"}, f"The topics of the test bag are /chatter and /news, not {sorted(found)}."
    )
    expect(
        found == {"/chatter": 5, "/news": 1},
        f"The test bag has 5 messages on /chatter and 1 on /news; you counted {found['/chatter']} and "
        f"{found['/news']}.",
        "add one for each message from read_messages()",
    )


# ---- longest_silence: the longest silence ----


@exercise("longest_silence", praise="The timeline shows the gap; your function measures it.")
def longest_silence(answer: Any) -> None:
    """The longest time between two messages of one topic."""
    times = (10.0, 10.5, 14.25, 15.0)
    messages = [("/chatter", String("x"), time) for time in times]
    bag = _bag([*messages, *(("/news", String("x"), float(time)) for time in range(10, 17))])
    found = answer(bag, "/chatter")
    expect_type(found, int | float, "It returned", "a number of seconds")
    expect(
        math.isclose(found, 3.75, abs_tol=1e-6),
        f"In the test bag, /chatter is silent from 10.5 to 14.25 s, for 3.75 s; your result is {found:g} s.",
        "use the times of one topic only, and take the largest difference between consecutive ones",
    )
    other = answer(bag, "/news")
    expect(
        math.isclose(other, 1.0, abs_tol=1e-6),
        f"/news has a message every second; your result is {other:g} s.",
        "use the topic in the argument",
    )


# ---- fast_commands: a filter ----


@exercise("fast_commands", praise="`and` evaluates the right side only for the topic that has this field.")
def fast_commands(answer: Any) -> None:
    """An expression that keeps commands to drive forwards faster than 0.1 m/s."""
    expect(isinstance(answer, str), f"The expression must be a string, not a {type(answer).__name__}.")
    cases = [
        ("/cmd_vel", Twist(linear=Vector3(x=0.2)), True, "a command of 0.2 m/s"),
        ("/cmd_vel", Twist(linear=Vector3(x=0.05)), False, "a command of 0.05 m/s"),
        ("/cmd_vel", Twist(linear=Vector3(x=0.1)), False, "a command of exactly 0.1 m/s"),
        ("/cmd_vel", Twist(linear=Vector3(x=-0.2)), False, "a command to drive backwards"),
        ("/cmd_vel", Twist(Vector3(x=0.0), Vector3(z=1.0)), False, "a command to turn on the spot"),
        ("/odom", _odometry(1.0, 1.0), False, "a message on /odom"),
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
            "it has the form: topic == ... and m. ... > ...",
        )


# ---- distance_driven: how far did it drive ----


@exercise(
    "distance_driven", praise="The sum of small steps counts every turn; the distance between the ends would not."
)
def distance_driven(answer: Any) -> None:
    """The length of the path recorded on /odom [m]."""
    square = [(0, 0), (1, 0), (1, 2), (-0.5, 2), (-0.5, 0)]
    bag = _bag(
        [("/odom", _odometry(x, y), float(i)) for i, (x, y) in enumerate(square)] + [("/news", String("x"), 1.5)]
    )
    found = answer(bag)
    expect_type(found, int | float, "It returned", "a number of metres")
    expect(
        math.isclose(found, 6.5, abs_tol=1e-6),
        f"In the test bag the robot drives 1 + 2 + 1.5 + 2 = 6.5 m; your result is {found:.2f} m.",
        "add up the distances from each position to the next: math.dist((x0, y0), (x1, y1))",
    )
