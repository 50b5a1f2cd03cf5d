"""TF and Grid: frames, their names and arrows, and a grid in a frame."""

import numpy as np
import pytest

from rosmini.viz.rviz.primitives import Lines, Mesh, Text


def test_frames_have_axes_names_and_arrows_to_their_parents(stage):
    scene = stage.scene()
    scene.add("TF")
    stage.place("map", "odom", (1.0, 0.0, 0.0))
    stage.place("odom", "base", (1.0, 0.0, 0.0), yaw=np.pi / 2)
    stage.graph.run(0.1)
    found = scene.update()[0].primitives
    names = {each.text: each.position for each in found if isinstance(each, Text)}
    assert sorted(names) == ["base", "map", "odom"]
    assert names["base"] == pytest.approx((2, 0, 0))
    assert sum(isinstance(each, Mesh) for each in found) == 9
    (arrows,) = [each for each in found if isinstance(each, Lines)]
    assert arrows.points[[0, 3]] == pytest.approx(np.array([(2, 0, 0), (1, 0, 0)]))


def test_frames_that_do_not_connect_or_are_silent_are_warnings(stage, statuses):
    scene = stage.scene()
    display = scene.add("TF", {"Show Axes": False, "Show Arrows": False})
    stage.place("map", "odom")
    stage.place("moon", "crater")
    stage.graph.run(0.1)
    found = scene.update()[0].primitives
    assert sorted(each.text for each in found) == ["map", "odom"]
    assert statuses(display)["crater"][1].startswith("No transform from [crater] to frame [map]")
    stage.graph.run(20.0)
    assert sorted(each.text for each in scene.update()[0].primitives) == ["map"]


def test_single_frames_are_switched_off(stage):
    scene = stage.scene()
    display = scene.add("TF", {"Show Axes": False, "Show Arrows": False})
    stage.place("map", "odom")
    stage.graph.run(0.1)
    display["Frames"] = {"All Enabled": True, "odom": {"Value": False}}
    assert [each.text for each in scene.update()[0].primitives] == ["map"]


def test_a_grid_lies_in_its_frame(stage, statuses):
    scene = stage.scene()
    grid = scene.add("Grid", {"Plane Cell Count": 2, "Reference Frame": "odom", "Plane": "XZ"})
    assert scene.update()[0].primitives == ()
    assert statuses(grid)["Transform"][0] == "Error"
    stage.place("map", "odom", (5.0, 0.0, 0.0))
    stage.graph.run(0.1)
    (lines,) = scene.update()[0].primitives
    assert len(lines.segments()) == 6
    assert lines.points.min(axis=0) == pytest.approx((4, 0, -1))
    grid["Normal Cell Count"] = 2
    (lattice,) = scene.update()[0].primitives
    assert len(lattice.segments()) == 3 * 6 + 9
