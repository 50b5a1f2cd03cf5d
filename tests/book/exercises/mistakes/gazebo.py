"""Wrong answers to the exercises of the chapter Gazebo."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

from rosmini.sim.gazebo import ModelPlugin

if TYPE_CHECKING:
    from collections.abc import Callable

# ---- friction: friction ----


def _barrel(
    *,
    low: float = 0.5,
    along: Callable[[float, float, float], float] = lambda m, r, _h: m * r**2 / 2,
    across: Callable[[float, float, float], float] = lambda m, r, h: m * (3 * r**2 + h**2) / 12,
    shape: str = "<cylinder><radius>{r}</radius><length>{h}</length></cylinder>",
    solid: str = "collision",
    static: str = "",
    called: str = "",
) -> Callable[[], Any]:
    def text(name: str, radius: float, height: float, mass: float) -> str:
        a, b = across(mass, radius, height), along(mass, radius, height)
        return (
            f'<sdf version="1.6"><model name="{called or name}">{static}'
            f'<link name="link"><pose>0 0 {low * height} 0 0 0</pose>'
            f"<inertial><mass>{mass}</mass><inertia><ixx>{a}</ixx><iyy>{a}</iyy><izz>{b}</izz></inertia></inertial>"
            f'<{solid} name="solid"><geometry>{shape.format(r=radius, h=height)}</geometry></{solid}>'
            "</link></model></sdf>"
        )

    return lambda: text


def _friction(measure: Callable[[float, float, float], float]) -> Callable[[], Any]:
    """An answer that pushes once; `measure` is given the speed [m/s], the way [m] and gravity [m/s2]."""
    return lambda: lambda push, gravity: measure(3.0, push(3.0), gravity)


# ---- look_ahead: a laser that looks ahead ----

HALF = math.pi / 2
_CHANGES = {
    "<samples>360</samples>": "<samples>181</samples>",
    "<min_angle>0.0</min_angle>": f"<min_angle>{-HALF}</min_angle>",
    "<max_angle>6.28319</max_angle>": f"<max_angle>{HALF}</max_angle>",
    "<topicName>scan</topicName>": "<topicName>front_scan</topicName>",
}


def _changed(**other: str) -> Callable[[], Any]:
    """An answer that makes the changes, but one of them otherwise; `other` is by the name of the tag."""
    changes = {
        old: next((new for tag, new in other.items() if old.startswith(f"<{tag}>")), right)
        for old, right in _CHANGES.items()
    }

    def answer(text: str) -> str:
        for old, new in changes.items():
            text = text.replace(old, new)
        return text

    return lambda: answer


# ---- leash: a leash ----


def _leash(
    *,
    length: Callable[[Any], float] = lambda tag: float(tag.word("length")),
    home: Callable[[Any], Any] = lambda model: model.pose,
    rate: float = 50.0,
    back: Callable[[Any, Any], object] = lambda model, home: model.set_pose(home),
    far: Callable[[Any, Any], float] = lambda pose, home: math.dist(pose[:2], home[:2]),
) -> Callable[[], Any]:
    def make() -> Any:
        class Leash(ModelPlugin, filename="libleash.so"):
            def load(self, model: Any, sdf: Any) -> None:
                self.model, self.home = model, home(model)
                self.length = length(sdf)
                self.every(rate, self.look)

            def look(self, _: float) -> None:
                if far(self.model.pose, self.home) > self.length:
                    back(self.model, self.home)

        return Leash

    return make


class _Deaf(ModelPlugin):
    def load(self, model: Any, sdf: Any) -> None:
        self.model = model


MISTAKES = {
    "barrel": [
        _barrel(low=0.0),
        _barrel(low=1.0),
        _barrel(along=lambda m, r, _h: m * r**2),
        _barrel(across=lambda m, r, h: m * (3 * r**2 + h**2)),
        _barrel(shape="<cylinder><radius>{h}</radius><length>{r}</length></cylinder>"),
        _barrel(shape="<box><size>{r} {r} {h}</size></box>"),
        _barrel(shape="<cylinder><radius>{r}</radius><length>0.8</length></cylinder>"),
        _barrel(solid="visual"),
        _barrel(static="<static>true</static>"),
        _barrel(called="barrel"),
        lambda: lambda _name, _radius, _height, _mass: "<sdf version='1.6'/>",
        lambda: lambda name, _radius, _height, _mass: {"name": name},
    ],
    "friction": [
        _friction(lambda v, way, g: v * v / (g * way)),
        _friction(lambda v, way, _g: v * v / (2 * 9.8 * way)),
        _friction(lambda v, way, g: v / (2 * g * way)),
        _friction(lambda v, way, g: 2 * g * way / v**2),
        lambda: lambda _push, _gravity: 0.5,
        lambda: lambda push, _gravity: push(1.0),
        lambda: lambda push, _gravity: str(push(1.0)),
    ],
    "look_ahead": [
        lambda: lambda text: text,
        _changed(samples="<samples>180</samples>"),
        _changed(min_angle="<min_angle>-90</min_angle>", max_angle="<max_angle>90</max_angle>"),
        _changed(min_angle="<min_angle>0.0</min_angle>"),
        _changed(max_angle=f"<max_angle>{math.pi}</max_angle>"),
        _changed(topicName="<topicName>scan</topicName>"),
        lambda: lambda text: _changed()()(text).replace("<stddev>0.01</stddev>", "<stddev>0.0</stddev>"),
        lambda: (
            lambda text: _changed()()(text).replace("<update_rate>5</update_rate>", "<update_rate>10</update_rate>")
        ),
        lambda: lambda text: _changed()()(text).replace("</sensor>", ""),
        lambda: lambda _text: 181,
    ],
    "leash": [
        _leash(length=lambda _: 1.0),
        _leash(home=lambda _: (0.0,) * 6),
        _leash(rate=0.5),
        _leash(back=lambda model, _home: model.set_velocity((0.0, 0.0, 0.0))),
        _leash(back=lambda model, home: model.set_pose(home, (1.0, 0.0, 0.0))),
        _leash(far=lambda pose, home: pose[0] - home[0]),
        _leash(far=lambda _pose, _home: math.inf),
        lambda: _Deaf,
        lambda: object,
        lambda: lambda model, _sdf: model,
    ],
}
