"""Checks of the exercises in the chapter Teleoperation."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from rosmini.book.checks import Wrong, exercise, expect, expect_heard, expect_node
from rosmini.core.geometry.poses import Pose, arc
from rosmini.core.graph import Graph
from rosmini.msgs.geometry_msgs.msg import Twist, Vector3
from rosmini.msgs.sensor_msgs.msg import Joy
from rosmini.msgs.std_msgs.msg import Bool
from rosmini.viz.live.teleop import Limits, Teleop, key_map

Velocity = tuple[float, float]


def _twist(v: float = 0.0, w: float = 0.0) -> Any:
    return Twist(Vector3(x=v), Vector3(z=w))


def _said(velocities: list[Velocity]) -> str:
    return ", ".join(f"{v:.2f} m/s and {w:.2f} rad/s" for v, w in velocities) or "nothing"


def _same(got: list[Velocity], expected: list[Velocity]) -> bool:
    return np.shape(got) == np.shape(expected) and bool(np.allclose(got, expected, rtol=0.0, atol=1e-6))


# ---- keys_for: which keys ----


@exercise("keys_for", praise="These keys give the pad exactly this target.")
def keys_for(answer: Any) -> None:
    """The keys that set the target of a pad, starting from zero."""
    for v, w in ((0.02, -0.1), (0.07, 0.0), (0.14, 2.8), (-0.22, 0.3), (0.0, -2.3), (0.0, 0.0)):
        found = answer(v, w)
        asked = f"for {v:g} m/s and {w:g} rad/s"
        if not isinstance(found, str):
            raise Wrong(f"It returned a {type(found).__name__} {asked}, not a string.", 'such as "wwd"')
        strange = sorted({key for key in found if key not in "wxad"})
        expect(not strange, f"{asked[0].upper()}{asked[1:]} your keys contain {strange[:1]}.", "use only w, x, a and d")
        pad = Teleop(Limits(1.0, 10.0))
        for key in found:
            pad.press(key)
        expect(
            _same([pad.target], [(v, w)]),
            f"Your keys {asked} are {found!r}; they set the target {_said([pad.target])}.",
            "divide by the step and use round(...), and take the sign into account",
        )
        expect(
            all(key_map().moves[key][0] for key in found[: abs(round(v / 0.01))]),
            f"Your keys {asked} are {found!r}, but the keys for v must come first.",
            "write w or x first, then a or d",
        )
        least = abs(round(v / 0.01)) + abs(round(w / 0.1))
        expect(
            len(found) == least,
            f"You need {len(found)} keys {asked}; {least} are enough.",
            "leave out keys that cancel each other",
        )


# ---- joystick: a joystick ----


@exercise("joystick", praise="The robot stops when you release the button.")
def joystick(answer: Any) -> None:
    """A node that converts a gamepad's messages into commands while a button is held."""
    sent: list[Velocity] = []
    with Graph() as graph:
        answer(graph)
        expect_node(graph, "/joystick")
        _listen(graph, sent)
        joy = graph.node("gamepad_driver").publisher("joy", Joy, queue_size=10)
        graph.run(0.1)
        expect_heard(joy)
        for axes, held in (((0.5, 1.0), 1), ((-1.0, -0.5), 1), ((0.5, 1.0), 0), ((0.0, 0.25), 1)):
            message = Joy()
            message.axes, message.buttons = list(axes), [0, 0, 0, 0, held, 0]
            expected = (0.22 * axes[1], 2.84 * axes[0]) if held else (0.0, 0.0)
            got = _answers(graph, sent, joy, message)
            where = f"axes {list(axes)} and the button {'held' if held else 'not held'}"
            expect(
                _same(got, [expected]),
                f"For {where} it published {_said(got)}, not {_said([expected])}.",
                "axes[1] times 0.22 is linear.x, axes[0] times 2.84 is angular.z; zero if buttons[4] is not 1",
            )


def _listen(graph: Graph, sent: list[Velocity]) -> None:
    graph.node("wheels").subscriber("cmd_vel", Twist, lambda m: sent.append((m.linear.x, m.angular.z)))


def _answers(graph: Graph, sent: list[Velocity], publisher: Any, message: Any) -> list[Velocity]:
    """Return the messages on cmd_vel within a tenth of a second after this message."""
    sent.clear()
    publisher.publish(message)
    graph.run(0.1)
    return list(sent)


# ---- lock: a lock ----


@exercise("lock", praise="The stop key now stops the robot, whatever other nodes publish.")
def lock(answer: Any) -> None:
    """A node that passes on commands until it receives a stop."""
    sent: list[Velocity] = []
    with Graph() as graph:
        answer(graph)
        expect_node(graph, "/lock")
        _listen(graph, sent)
        hand = graph.node("hand")
        pad = hand.publisher("pad_vel", Twist, queue_size=10)
        stop = hand.publisher("stop", Bool, queue_size=10)
        graph.run(0.1)
        expect_heard(pad)
        expect_heard(stop)
        for publisher, given, expected, what in (
            (pad, (0.1, 0.5), [(0.1, 0.5)], "For a command before any stop"),
            (stop, True, [(0.0, 0.0)], "After True on /stop"),
            (pad, (0.2, 0.0), [], "For a command after the stop"),
            (pad, (-0.1, 0.2), [], "For a second command after the stop"),
            (stop, False, [], "After False on /stop"),
            (pad, (0.05, 0.0), [(0.05, 0.0)], "For a command after it was unlocked"),
        ):
            message = _twist(*given) if isinstance(given, tuple) else given
            got = _answers(graph, sent, publisher, message)
            expect(
                _same(got, expected),
                f"{what} it published {_said(got)}, not {_said(expected)}.",
                "store the last message on /stop, and check it for each command",
            )


# ---- where_now: where is it now ----


@exercise("where_now", praise="Drawn into the delayed picture, this pose shows the driver where the robot is now.")
def where_now(answer: Any) -> None:
    """The current pose, from a delayed pose and the commands since then."""
    cases: list[tuple[Pose, list[tuple[float, float, float]], str]] = [
        ((1.0, 2.0, 0.5), [], "no command"),
        ((1.0, 2.0, 0.5), [(0.2, 0.0, 1.5)], "one straight drive"),
        ((0.0, 0.0, 0.0), [(0.2, 0.5, 2.0)], "one arc"),
        ((0.0, 0.0, 1.0), [(0.0, -1.0, 0.7)], "a turn on the spot"),
        ((-1.0, 0.5, 2.0), [(0.2, 0.0, 0.5), (0.1, -0.8, 0.4), (-0.1, 0.3, 1.0)], "three commands"),
    ]
    for seen, commands, what in cases:
        expected = seen
        for v, w, seconds in commands:
            expected = arc(expected, v, w, seconds)
        found = answer(seen, list(commands))
        try:
            x, y, heading = (float(part) for part in found)
        except (TypeError, ValueError):
            raise Wrong(
                f"For {what} it returned {found!r}, not a pose.", "return three numbers: x, y, heading"
            ) from None
        off = math.hypot(x - expected[0], y - expected[1])
        turned = abs(math.remainder(heading - expected[2], 2 * math.pi))
        expect(
            off < 1e-6 and turned < 1e-6,
            f"For {what} the pose is ({x:.4f}, {y:.4f}, {heading:.4f}), "
            f"not ({', '.join(f'{part:.4f}' for part in expected)}).",
            "start with the delayed pose, apply the oldest command first, and handle w = 0 separately",
        )
