"""Wrong answers to the exercises of the chapter GMapping: right ones with a fault put in."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from rosmini.book.checks import Script

from .published import solution

if TYPE_CHECKING:
    from collections.abc import Callable

SURVEYOR = solution("gmapping", "map_is_done")

MAPPER = """
<launch>
  <node pkg="rosmini_sim" type="simulator" name="cart"
        args="_world:=room"/>
  <include
   file="$(find turtlebot3_bringup)/launch/turtlebot3_remote.launch">
    <arg name="model" value="burger"/>
  </include>
  <node pkg="gmapping" type="slam_gmapping" name="gmapping">
    <rosparam>
      base_frame: base_footprint
      linearUpdate: 0.3
      angularUpdate: 0.3
      maxUrange: 3.0
      particles: 5
    </rosparam>
  </node>
</launch>
"""


def _but(old: str, new: str) -> Callable[[], Script]:
    assert old in SURVEYOR, old
    return lambda: Script("surveyor.py", SURVEYOR.replace(old, new))


def _data(hits: Any, visits: Any, occ_thresh: float) -> Any:
    cells = np.where(hits / np.maximum(visits, 1) > occ_thresh, 100, 0)
    cells[visits == 0] = -1
    return cells


MISTAKES: dict[str, list[Callable[[], Any]]] = {
    "data_of": [
        lambda: _data,
        lambda: lambda h, v, t: _data(h, v, t)[::-1].ravel().tolist(),
        lambda: lambda h, v, t: _data(h, v, t).T.ravel().tolist(),
        lambda: lambda h, v, t: np.where(_data(h, v, t) < 0, 0, _data(h, v, t)).ravel().tolist(),
        lambda: lambda h, v, t: _data(h, v, 0.25).ravel().tolist(),
        lambda: lambda h, v, t: _data(h, v, t - 1e-9).ravel().tolist(),
    ],
    "mapper": [
        lambda: MAPPER.replace("base_footprint", "base_foot"),
        lambda: MAPPER.replace("maxUrange: 3.0", "maxUrange: 0.3"),
        lambda: MAPPER.replace("</launch>", ""),
        lambda: None,
    ],
    "map_is_done": [
        _but('if state["dull"] < 3:\n        if min', "if True:\n        if min"),
        _but('state["dull"] + 1 if news < 40 else 0', "3 if news < 40 else 0"),
        _but('state["dull"] + 1 if news < 40 else 0', 'state["dull"] + (news < 400)'),
        _but("command.linear.x = 0.2", "command.linear.x = 0.0"),
    ],
}
