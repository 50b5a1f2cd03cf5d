"""Plugins under ROS names, proved with the interface of a planner."""

from __future__ import annotations

import sys
from importlib.metadata import EntryPoint

import pytest

from rosmini.core import plugins
from rosmini.core.plugins import Plugin, PluginError


class Planner(Plugin):
    """Stands for nav_core's."""

    def __init__(self, name, tolerance=0.0):
        self.name, self.tolerance = name, tolerance

    def plan(self, start, goal): ...


class Straight(Planner, plugin="carrot_planner/CarrotPlanner"):
    def plan(self, start, goal):
        return [start, goal]


class Grid(Planner):
    """A base of two planners, and none itself."""


class Dijkstra(Grid, plugin="navfn::NavfnROS"):
    pass


class AStar(Grid, plugin="global_planner/GlobalPlanner"):
    pass


class Layer(Plugin):
    """Another interface."""


class Inflation(Layer, plugin="costmap_2d::InflationLayer"):
    pass


@pytest.mark.parametrize("name", ["carrot_planner/CarrotPlanner", "carrot_planner::CarrotPlanner"])
def test_both_spellings_find_it(name):
    planner = Planner.create(name, "GlobalPlanner", tolerance=0.1)
    assert type(planner) is Straight
    assert (planner.name, planner.tolerance) == ("GlobalPlanner", 0.1)
    assert planner.plan((0, 0), (1, 1)) == [(0, 0), (1, 1)]
    assert Straight.plugin_name == "carrot_planner/CarrotPlanner"
    assert Planner.plugin_name == Grid.plugin_name == ""


def test_each_interface_has_its_own():
    assert Planner.names() == ["carrot_planner/CarrotPlanner", "global_planner/GlobalPlanner", "navfn/NavfnROS"]
    assert Grid.names() == ["global_planner/GlobalPlanner", "navfn/NavfnROS"]
    assert Layer.names() == ["costmap_2d/InflationLayer"]
    with pytest.raises(PluginError, match="there is no Layer 'navfn/NavfnROS'"):
        Layer.create("navfn/NavfnROS")
    with pytest.raises(PluginError, match="there is no Grid 'carrot_planner/CarrotPlanner'"):
        Grid.create("carrot_planner/CarrotPlanner")


def test_an_unknown_name_is_answered_with_the_nearest_and_all():
    with pytest.raises(
        PluginError,
        match=r"no Planner 'navfn::NavfnRos'; did you mean navfn/NavfnROS\? there are carrot_planner/.*, navfn/Navfn",
    ):
        Planner.create("navfn::NavfnRos")

    class Empty(Plugin):
        pass

    with pytest.raises(PluginError, match="there is none at all"):
        Empty.create("a/B")


def test_two_of_one_name():
    with pytest.raises(PluginError, match=r"two plugins are called navfn/NavfnROS: .*Dijkstra and .*Other"):

        class Other(Planner, plugin="navfn/NavfnROS"):
            pass

    assert Planner.named("navfn/NavfnROS") is Dijkstra


def test_a_cell_that_is_run_again_defines_its_class_again():
    def cell():
        class Mine(Planner, plugin="mine/Planner"):
            pass

        return Mine

    cell()
    second = cell()
    assert Planner.named("mine/Planner") is second
    del Planner._plugins["mine/Planner"]


@pytest.mark.parametrize("name", ["Planner", "/Planner", "pkg/", "pkg::"])
def test_a_name_is_package_and_class(name):
    with pytest.raises(PluginError, match="a name is package/Class"):

        class Wrong(Planner, plugin=name):
            pass


def test_other_distributions_bring_theirs(monkeypatch, tmp_path):
    (tmp_path / "their_planner.py").write_text(
        "from tests.test_plugins import Planner\nclass Theirs(Planner, plugin='their_pkg/TheirPlanner'):\n    pass\n",
        encoding="utf-8",
    )
    (tmp_path / "broken_planner.py").write_text("import no_such_module\n", encoding="utf-8")
    monkeypatch.syspath_prepend(tmp_path)
    monkeypatch.setitem(sys.modules, "tests.test_plugins", sys.modules[__name__])
    monkeypatch.setitem(sys.modules, "their_planner", None)  # so that it is gone afterwards
    monkeypatch.delitem(sys.modules, "their_planner")
    found = [
        EntryPoint("their_pkg/TheirPlanner", "their_planner:Theirs", plugins.GROUP),
        EntryPoint("broken/Planner", "broken_planner:X", plugins.GROUP),
    ]
    monkeypatch.setattr(plugins, "entry_points", lambda group: found if group == "rosmini.plugins" else [])
    assert type(Planner.create("their_pkg::TheirPlanner", "x")).__name__ == "Theirs"
    assert "their_pkg/TheirPlanner" in Planner.names()  # although another cannot be loaded
    with pytest.raises(PluginError, match=r"broken/Planner \(broken_planner:X\) cannot be loaded: .*no_such_module"):
        Planner.create("broken/Planner")
    del Planner._plugins["their_pkg/TheirPlanner"]


def test_one_entry_point_may_name_a_package_with_a_plugin_in_each_module(monkeypatch, tmp_path):
    package = tmp_path / "their_planners"
    package.mkdir()
    (package / "__init__.py").write_text("", encoding="utf-8")
    for name in ("First", "Second"):
        (package / f"{name.lower()}.py").write_text(
            f"from tests.test_plugins import Planner\nclass {name}(Planner, plugin='their_pkg/{name}'):\n    pass\n",
            encoding="utf-8",
        )
    monkeypatch.syspath_prepend(tmp_path)
    monkeypatch.setitem(sys.modules, "tests.test_plugins", sys.modules[__name__])
    for name in ("", ".first", ".second"):
        monkeypatch.setitem(sys.modules, f"their_planners{name}", None)  # so that it is gone afterwards
        monkeypatch.delitem(sys.modules, f"their_planners{name}")
    entry = EntryPoint("their_pkg/*", "their_planners", plugins.GROUP)
    monkeypatch.setattr(plugins, "entry_points", lambda group: [entry] if group == "rosmini.plugins" else [])
    assert Planner.named("their_pkg/Second").__name__ == "Second"
    assert {"their_pkg/First", "their_pkg/Second"} <= {*Planner.names()}
    for name in ("First", "Second"):
        del Planner._plugins[f"their_pkg/{name}"]
