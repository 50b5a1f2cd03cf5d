"""Pages of the teleoperation pad: the data for their scripts, and the page that needs no kernel."""

from __future__ import annotations

from functools import cache
from typing import TYPE_CHECKING, Any

from rosmini.viz.embed import MESHCAT, asset_path, embed, unpacking
from rosmini.viz.svg import element, escape

from .key_maps import NAMES, key_map
from .teleop import table

if TYPE_CHECKING:
    from collections.abc import Sequence

    from .pad import TeleopPad

STEP = 0.005
"""Time step of the robot in a page [s], equal to that of the engine's physics."""

TURTLE_STEP = 0.004
"""Time step of a turtle in a page [s]: both its 16 ms and the 0.1 s between messages are multiples of it."""

SCRIPTS = ("rosmini-canvas.js", "rosmini-teleop.js", "rosmini-pad-style.js", "rosmini-pad-keys.js", "rosmini-pad.js")
SOLID = "rosmini-meshcat.js"
"""Script that shows a scene in three dimensions."""
HEIGHT = 420


def scripts_of(pad: TeleopPad) -> tuple[str, ...]:
    """Return the scripts of a pad's page, in the order in which they run."""
    if pad.turtle is not None:
        return (*SCRIPTS, "rosmini-turtle.js")
    return SCRIPTS


def pad_data(pad: TeleopPad) -> dict[str, Any]:
    """Return all data that a page needs of a pad, as JSON. Lengths are rounded to 1 mm, angles to 0.0001 rad."""
    data: dict[str, Any] = {
        "title": title(pad),
        "topic": pad.topic,
        "maps": [table(pad.teleop.limits, key_map(name)) for name in _maps(pad)],
        "keys": pad.teleop.keys.name,
        "hold": False,
        "step": STEP,
        "scene": None,
        "pose": None,
        "scan_rate": 0.0,
    }
    if pad.turtle is not None and pad.gone is None:
        data |= {"turtle": pad.turtle.data(), "pose": list(pad.turtle.sample_pose()), "step": TURTLE_STEP}
    if pad.shown_robot is not None and pad.gone is None:
        x, y, theta = pad.shown_robot.sample_pose()
        pose = [round(x + 1e-8, 3) + 0.0, round(y + 1e-8, 3) + 0.0, round(theta + 1e-8, 4) + 0.0]
        data |= {"scene": pad.shown_robot.scene(), "pose": pose, "scan_rate": pad.shown_robot.model.laser.rate}
    return data


def _maps(pad: TeleopPad) -> list[str]:
    """Return the key maps that fit the pad: maps whose keys hold for a moment are for turtles."""
    return [
        name for name in NAMES if pad.turtle is not None or key_map(name).holds is None or name == pad.teleop.keys.name
    ]


def title(pad: TeleopPad) -> str:
    """Return a short description of what the pad drives."""
    if pad.turtle is not None:
        return pad.turtle.title
    if pad.shown_robot is None:
        return f"Drive on {pad.topic}"
    model = pad.shown_robot.model
    return f"Drive the {model.title or model.name} in the world {pad.shown_robot.world.name}"


def static_html(pad: TeleopPad, *, caption: str | None = None) -> str:
    """Return the HTML of a pad that drives its own robot from the current pose; equal bytes for an equal state.

    A robot without two driven wheels, which moves sideways, would move differently in the page, so it
    gets a still picture.
    """
    if pad.shown_robot is not None and not pad.shown_robot.is_differential:
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
    )


@cache
def module(names: Sequence[str], driver: str) -> str:
    """Return the scripts as one module for anywidget, in which `driver` talks to the kernel."""
    texts = [asset_path(name).read_text(encoding="utf-8") for name in names]
    if SOLID in names:
        texts.insert(0, f"globalThis.rosminiAsset = (() => {{{unpacking([MESHCAT])} return asset; }})();")
    return "\n".join([*texts, f"export default {{ render: globalThis.{driver}.render }};\n"])


def _still(pad: TeleopPad) -> str:
    """Return the content for print and for browsers without scripts: the world, if there is one, and the state."""
    words = element("p", escape(pad.text).replace("\n", "<br>"))
    if (pad.shown_robot is None and pad.turtle is None) or pad.gone is not None:
        return words
    from rosmini.core.graph.show import show

    picture = show("simulation", pad.shown_robot) if pad.turtle is None else pad.turtle.sim.show()
    return f"{picture.html or ''}{words}"
