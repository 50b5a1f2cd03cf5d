"""``help()`` of everything that shows itself lists the options of its renderer, and what they are unless given."""

from __future__ import annotations

import inspect
from importlib import import_module
from importlib.metadata import entry_points

import pytest

from rosmini.viz.live.pad import TeleopPad

DRIVEN = {"show3d": "simulation_3d", "pad": "teleop_pad"}
SHOWN = {
    "rosmini.ros.bag:Bag": {"show": "bag"},
    "rosmini.core.graph.observers.console:Console": {"show": "log_console"},
    "rosmini.core.graph:Graph": {"show": "computation_graph"},
    "rosmini.sim.urdf.model:Robot": {"show3d": "robot_3d"},
    "rosmini.sim.simulator:Simulator": {"show": "simulation", **DRIVEN},
    "rosmini.sim.recording:Recording": {"show": "recording", "replay": "replay", "replay3d": "replay_3d"},
    "rosmini.sim.stage.node:Stageros": {"show": "simulation", **DRIVEN},
    "rosmini.sim.gazebo.client:GazeboClient": {"show": "gazebo", "show3d": "gazebo_3d"},
    "rosmini.sim.gazebo.server:GazeboServer": {**DRIVEN, "show": "gazebo", "show3d": "gazebo_3d"},
    "rosmini.sim.gazebo.snapshot:Snapshot": {"show": "gazebo", "show3d": "gazebo_3d"},
    "rosmini.core.tf:Buffer": {"show": "tf_tree"},
}
WIDGETS = {"teleop_pad": TeleopPad}


@pytest.mark.parametrize(
    ("home", "method", "kind"),
    [(home, method, kind) for home, kinds in SHOWN.items() for method, kind in kinds.items()],
)
def test_help_lists_the_options(home, method, kind):
    module, _, name = home.partition(":")
    function = getattr(getattr(import_module(module), name), method)
    renderer = WIDGETS.get(kind) or entry_points(group="rosmini.renderers")[kind].load()
    taken = {*inspect.signature(function).parameters, *(["robot"] if kind == "teleop_pad" else [])}
    wanted = [
        f"{one.name}={one.default!r}: "
        for one in inspect.signature(renderer).parameters.values()
        if one.kind is inspect.Parameter.KEYWORD_ONLY and one.name not in taken
    ]
    assert wanted
    listed = [line.strip() for line in (inspect.getdoc(function) or "").splitlines() if line.startswith("    ")]
    assert [line[: len(start)] for line, start in zip(listed, wanted, strict=True)] == wanted
