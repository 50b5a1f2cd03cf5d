"""The pad in a page: what its scripts are given, and the page that needs no kernel."""

from __future__ import annotations

from dataclasses import replace
from functools import cache
from typing import TYPE_CHECKING, Any, Protocol

from rosmini.viz.embed import MESHCAT, asset_path, embed, unpacking
from rosmini.viz.svg import element, escape

from .key_maps import NAMES, key_map
from .teleop import table

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from rosmini.core.graph import Node

    from .chosen import Chosen
    from .driven_turtle import DrivenTurtle
    from .teleop import Teleop

STEP = 0.005
"""How long one step of the robot in a page is [s]: that of the engine's physics."""

TURTLE_STEP = 0.004
"""The same of a turtle: both its 16 ms and the 0.1 s between messages are so many of these [s]."""

SCRIPTS = (
    "rosmini-canvas.js",
    "rosmini-teleop.js",
    "rosmini-pad-style.js",
    "rosmini-pad-keys.js",
    "rosmini-pad.js",
)
SOLID = "rosmini-meshcat.js"
"""What shows a robot in three dimensions."""
HEIGHT = 420


def scripts_of(pad: Pad) -> tuple[str, ...]:
    """The scripts of a pad's page, in the order in which they are run."""
    if pad.turtle is not None:
        return (*SCRIPTS, "rosmini-turtle.js")
    return (*SCRIPTS, SOLID) if pad.solid else SCRIPTS


class Pad(Protocol):
    """A teleoperation pad, as its pages see it: :class:`~rosmini.viz.live.pad.TeleopPad`."""

    sight: Chosen | None
    turtle: DrivenTurtle | None
    teleop: Teleop
    sent: int
    hold: bool
    solid: bool
    chosen: str

    @property
    def node(self) -> Node:
        """What publishes."""

    @property
    def topic(self) -> str:
        """Where it publishes."""

    @property
    def gone(self) -> str | None:
        """Why there is nothing to drive any more."""

    @property
    def text(self) -> str:
        """What is wanted, what was sent, and how the robot is."""

    @property
    def alt(self) -> str:
        """The pad in a sentence or two."""

    @property
    def choices(self) -> Sequence[str]:
        """What can be driven."""

    @property
    def others(self) -> Sequence[str]:
        """Who else drives it."""

    def press(self, key: str) -> None:
        """Take a key."""

    def steer(self, linear: float, angular: float) -> None:
        """Take velocities."""

    def use(self, keys: str) -> None:
        """Have the keys of another program."""

    def choose(self, name: str) -> None:
        """Drive another one."""

    def stop(self) -> None:
        """Stop at once."""

    def reset(self) -> None:
        """Put the robot back."""

    def on_publish(self, callback: Callable[[Any], object]) -> None:
        """Call `callback(twist)` for each message."""


def pad_data(pad: Pad) -> dict[str, Any]:
    """All that a page needs of a pad, as JSON. Lengths are rounded to millimetres, angles to 0.0001 rad."""
    data: dict[str, Any] = {
        "title": title(pad),
        "topic": pad.topic,
        "maps": [table(pad.teleop.limits, key_map(name)) for name in _maps(pad)],
        "keys": pad.teleop.keys.name,
        "hold": pad.hold,
        "step": STEP,
        "scene": None,
        "pose": None,
        "scan_rate": 0.0,
    }
    if pad.turtle is not None and pad.gone is None:
        data |= {"turtle": pad.turtle.data(), "pose": list(pad.turtle.look()), "step": TURTLE_STEP}
    if pad.sight is not None and pad.gone is None:
        x, y, theta = pad.sight.look()
        pose = [round(x + 1e-8, 3) + 0.0, round(y + 1e-8, 3) + 0.0, round(theta + 1e-8, 4) + 0.0]
        data |= {"scene": pad.sight.scene(), "pose": pose, "scan_rate": pad.sight.model.laser.rate}
        if pad.solid:
            data["solid"] = _solid(pad.sight)
    return data


def _solid(sight: Chosen) -> dict[str, Any]:
    """The world and the robot in three dimensions, as the viewer's script takes them."""
    from rosmini.viz.meshcat.view import robot_3d

    view = robot_3d(
        replace(sight.world, obstacles=(*sight.fixed(), *sight.moving())), sight.model, sight.look()
    )
    return view.data


def _maps(pad: Pad) -> list[str]:
    """Whose keys it can have: keys that hold for a moment are for turtles."""
    return [
        name
        for name in NAMES
        if pad.turtle is not None or key_map(name).holds is None or name == pad.teleop.keys.name
    ]


def title(pad: Pad) -> str:
    """What the pad drives, in a few words."""
    if pad.turtle is not None:
        return pad.turtle.title
    if pad.sight is None:
        return f"Drive on {pad.topic}"
    model = pad.sight.model
    return f"Drive the {model.title or model.name} in the world {pad.sight.world.name}"


def static_html(pad: Pad, *, caption: str | None = None) -> str:
    """The HTML of a pad that drives a robot of its own, from where the pad's robot is; equal bytes for an equal state.

    What is not driven by two wheels (a car, or what goes sideways) would move otherwise there: of that it is a
    picture of how things stand.
    """
    if pad.sight is not None and not pad.sight.simple:
        return _still(pad)
    return embed(
        scripts_of(pad),
        "rosminiPad.mount",
        pad_data(pad),
        title=title(pad),
        alt=pad.alt,
        height=HEIGHT,
        fallback_html=_still(pad),
        caption=caption,
        assets=[MESHCAT] if pad.solid else [],
    )


@cache
def module(names: Sequence[str], driver: str) -> str:
    """Scripts as one module for anywidget, in which `driver` talks to the kernel."""
    texts = [asset_path(name).read_text(encoding="utf-8") for name in names]
    if SOLID in names:
        texts.insert(0, f"globalThis.rosminiAsset = (() => {{{unpacking([MESHCAT])} return asset; }})();")
    return "\n".join([*texts, f"export default {{ render: globalThis.{driver}.render }};\n"])


def _still(pad: Pad) -> str:
    """What is there without scripts and in print: the world, if there is one, and how things stand."""
    words = element("p", escape(pad.text).replace("\n", "<br>"))
    if (pad.sight is None and pad.turtle is None) or pad.gone is not None:
        return words
    from rosmini.core.graph.show import show

    picture = show("simulation", pad.sight) if pad.turtle is None else pad.turtle.sim.show()
    return f"{picture.html or ''}{words}"
