"""The panel of parameters: what a description becomes, and what changes in the server."""

import math

import pytest

from rosmini.core.dynamic_reconfigure import (
    Description,
    DynamicReconfigureException,
    ParameterGroup,
    ReconfigurableParameter,
    Server,
)
from rosmini.viz.rqt.parts import controls
from rosmini.viz.rqt.reconfigure import DynamicReconfigure
from rosmini.viz.view import ViewError

SPEEDS = repr({"enum": [{"name": name, "type": "int", "value": i} for i, name in enumerate(("Slow", "Fast"))]})


def parameter(name, kind, default, low, high, choices=""):
    return ReconfigurableParameter(name, kind, 0, f"meaning of {name}", default, low, high, choices)


ROOT = ParameterGroup(
    "Default",
    parameters=(
        parameter("gain", "double", 0.5, 0.0, 2.0),
        parameter("count", "int", 3, 0, 10),
        parameter("speed", "int", 0, 0, 1, SPEEDS),
        parameter("on", "bool", True, False, True),
        parameter("frame", "str", "map", "", ""),
        parameter("free", "double", 1.0, -math.inf, math.inf),
    ),
    groups=(ParameterGroup("limits", "collapse", id=1, parameters=(parameter("top", "double", 5.0, 0.0, 9.0),)),),
)


@pytest.fixture
def server(graph):
    return Server(graph.node("robot"), Description(ROOT), lambda config, _: config)


@pytest.fixture
def panel(graph, server):
    return DynamicReconfigure(graph, "/robot")


def kinds(panel):
    return {control.key: control.kind for control in controls(panel.parts())}


def test_each_type_has_its_control(panel):
    assert kinds(panel) == {
        "server": "choice",
        "value/gain": "number",
        "slider/gain": "slider",
        "value/count": "number",
        "slider/count": "slider",
        "value/speed": "choice",
        "value/on": "check",
        "value/frame": "text",
        "value/free": "number",
        "group/limits": "check",
        "value/top": "number",
        "slider/top": "slider",
    }


@pytest.mark.parametrize(
    ("key", "given", "name", "value"),
    [
        ("slider/gain", "1.25", "gain", 1.25),
        ("value/gain", 2, "gain", 2.0),
        ("value/count", "7", "count", 7),
        ("value/speed", "Fast", "speed", 1),
        ("value/on", False, "on", False),
        ("value/frame", "odom", "frame", "odom"),
        ("value/free", "-1e9", "free", -1e9),
        ("value/top", 1, "top", 1.0),
    ],
)
def test_what_is_operated_changes_in_the_server(panel, server, key, given, name, value):
    panel.set(key, given)
    assert server.config[name] == value
    assert panel.values[name] == value


def test_the_twin_does_the_same_and_the_text_shows_it(panel, server):
    panel.change("speed", "Fast")
    panel.change("gain", 1.5)
    assert (server.config["speed"], server.config["gain"]) == (1, 1.5)
    assert "gain       1.5      0 … 2   meaning of gain" in panel.text
    assert "speed      Fast             meaning of speed" in panel.text


def test_a_group_is_collapsed(panel):
    panel.set("group/limits", False)
    assert "value/top" not in kinds(panel)
    panel.switch("limits", True)
    assert "value/top" in kinds(panel)


@pytest.mark.parametrize(
    ("key", "given"), [("value/gain", "3"), ("value/count", 1.5), ("value/speed", "Warp"), ("value/on", 1)]
)
def test_what_is_out_of_range_is_refused(panel, server, key, given):
    before = dict(panel.values)
    with pytest.raises(ViewError):
        panel.set(key, given)
    assert panel.values == before


def test_what_is_not_there_is_refused(graph, server):
    panel = DynamicReconfigure(graph)
    assert panel.names() == ["/robot"]
    with pytest.raises(ViewError, match="no server is chosen"):
        panel.change("gain", 1)
    with pytest.raises(ViewError, match="did you mean /robot"):
        panel.choose("/robt")
    panel.choose("/robot")
    with pytest.raises(DynamicReconfigureException, match="gain"):
        panel.change("gian", 1)
