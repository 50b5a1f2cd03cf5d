"""Checks of the exercises in the chapter Services: each runs a script with a separate robot."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from rosmini.book.checks import Script, exercise, expect
from rosmini.book.trials import Trial
from rosmini.core.errors import ROSException, ServiceException
from rosmini.msgs.geometry_msgs.msg import Twist
from rosmini.msgs.std_srvs.srv import Empty, Trigger

if TYPE_CHECKING:
    from collections.abc import Callable


def call(trial: Trial, name: str, kind: Any) -> Any:
    """Call a service of the answer; return its response. Raises `Wrong` if there is none, or if it fails."""
    nodes = trial.graph.nodes
    asker = nodes["/asker"] if "/asker" in nodes else trial.graph.node("asker")
    try:
        asker.wait_for_service(name, timeout=1.0)
    except ROSException:
        expect(False, f"No node offers /{name}.", f'rospy.Service("{name}", {kind.__name__}, ...) offers it')
    before = trial.graph.now().to_sec()
    try:
        response = asker.service_client(name, kind)()
    except ServiceException as error:
        trial.expect_no_errors()
        expect(False, f"The call to /{name} failed: {error}", "the handler must return a response")
    expect(
        trial.graph.now().to_sec() - before < 0.1,
        f"/{name} does not answer at once.",
        "let the callback of the topic store the value, and the handler only read it",
    )
    return response


def drive(trial: Trial, speed: float, seconds: float) -> None:
    """Let the trial's robot drive ahead, then stop."""
    nodes = trial.graph.nodes
    driver = nodes["/driver"] if "/driver" in nodes else trial.graph.node("driver")
    cmd_vel = driver.publisher("cmd_vel", Twist, queue_size=1)
    cmd_vel.wait_for_subscribers()
    for _ in range(round(seconds * 10)):
        command = Twist()
        command.linear.x = speed
        cmd_vel.publish(command)
        trial.run(0.1)
    cmd_vel.publish(Twist())
    trial.run(0.5)


# ---- trip: two services and a topic ----


@exercise("trip", praise="It counted backward metres, too.", gaps=2)
def trip(answer: Script) -> Any:
    """The service answers with the distance driven since the last call of clear."""
    with Trial("arena", "_x:=-1.5") as trial:
        trial.start(answer)
        trial.run(1.0)
        for speed, seconds, low, high in ((0.2, 6.0, 1.1, 1.35), (-0.2, 3.0, 1.65, 2.0)):
            drive(trial, speed, seconds)
            response = call(trial, "trip", Trigger)
            trial.expect_no_errors()
            expect(response.success, "In the response of /trip, success is False.", "TriggerResponse(True, message)")
            try:
                metres = float(response.message)
            except ValueError:
                metres = -1.0
            expect(
                response.message == f"{metres:.2f}",
                f"/trip answers {response.message!r}, not a number with two decimal places.",
                'f"{metres:.2f}" writes it',
            )
            expect(
                low < metres < high,
                f"After about {(low + high) / 2:.1f} m, /trip answers {response.message}.",
                "the message is the sum of the distances, in metres",
            )
        call(trial, "clear", Empty)
        trial.run(0.5)
        after = call(trial, "trip", Trigger).message
        expect(after in {"0.00", "0.01"}, f"After /clear, /trip answers {after}.", "on_clear needs: global metres")
        return trial.view()


# ---- ask_first: a careful client ----


def _fail(_request: Any) -> tuple[bool, str]:
    raise RuntimeError("the door is jammed")


DOORS: tuple[tuple[str, Callable[[Any], tuple[bool, str]] | None, float, bool], ...] = (
    ("If there is no service", None, 0.0, False),
    ("If the door refuses", lambda _request: (False, "closed"), 0.0, False),
    ("If the call fails", _fail, 0.0, False),
    ("If the door opens", lambda _request: (True, "open"), 0.0, True),
    ("If the service starts after three seconds", lambda _request: (True, "open"), 3.0, True),
)


@exercise("ask_first", praise="It drove only if the door had said so.")
def ask_first(answer: Script) -> Any:
    """The script drives only after a successful call."""
    view = None
    for case, handler, delay, drives in DOORS:
        with Trial("arena", "_x:=-1.5") as trial:
            if delay:
                trial.start(answer)
                trial.run(delay)
            if handler is not None:
                door = trial.graph.node("door")
                door.logger.set_level("rosout", "FATAL")  # a door that fails is part of the trial
                door.service("open_door", Trigger, handler)
            if not delay:
                trial.start(answer)
            start = trial.robot.truth()[0]
            trial.run(14.0)
            moved = trial.robot.truth()[0] - start
            if drives:
                expect(moved > 0.5, f"{case}, the robot drove {moved:.2f} m.", "is_open must then return True")
                expect(moved < 1.3, f"{case}, the robot drove {moved:.2f} m, not 1 m.", "keep the loop of the stub")
            else:
                expect(moved < 0.05, f"{case}, the robot drove {moved:.2f} m.", "is_open must then return False")
            view = trial.view()
    return view


# ---- is_free: a service that answers from a topic ----


@exercise("is_free", praise="The callback writes, the handler reads, and no node waits.", gaps=2)
def is_free(answer: Script) -> Any:
    """The service answers from the latest scan."""
    with Trial("room", "_x:=1.2") as trial:
        trial.start(answer)
        first = call(trial, "is_free", Trigger)
        expect(
            (first.success, first.message) == (False, "no scan yet"),
            f"Before the first scan it answers {first.success}, {first.message!r}.",
            'test ahead first: if it is None, the answer is False and "no scan yet"',
        )
        for speed, seconds, free in ((0.0, 1.0, True), (0.2, 7.5, False)):
            drive(trial, speed, seconds)
            trial.expect_no_errors()
            ahead = 3.3 + 0.03 - trial.robot.truth()[0]
            found = call(trial, "is_free", Trigger)
            expect(
                found.success is free,
                f"The wall is {ahead:.1f} m ahead, and success is {found.success}.",
                "success is True if the distance is at least 1.0",
            )
            try:
                metres = float(found.message)
            except ValueError:
                metres = -1.0
            expect(
                abs(metres - ahead) < 0.1 and found.message == f"{metres:.2f}",
                f"The wall is {ahead:.2f} m ahead, and the message is {found.message!r}.",
                'f"{ahead:.2f}" is the message',
            )
        return trial.view()
