"""Markers: what each kind looks like, when they come and go, and what is said of wrong ones."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rosmini.core.time import Duration
from rosmini.msgs import message_class
from rosmini.viz.rviz import still
from rosmini.viz.rviz.displays.marker import Marker as MarkerDisplay
from rosmini.viz.rviz.primitives import Lines, Mesh, Points, Text

Color = message_class("std_msgs/ColorRGBA")
Marker = message_class("visualization_msgs/Marker")
MarkerArray = message_class("visualization_msgs/MarkerArray")
Point = message_class("geometry_msgs/Point")

TOPIC = "/shapes"
SOMEWHERE = [Point(0.0, 0.0, 0.0), Point(1.0, 0.0, 0.0), Point(1.0, 2.0, 0.0)]


def marker(kind, number=0, *, scale=(0.5, 0.25, 0.125), at=(1.0, 2.0, 0.0), **fields):
    made = Marker(type=kind, id=number, ns="a", color=Color(0.25, 0.5, 0.75, 1.0), **fields)
    made.pose.position = Point(*at)
    made.pose.orientation.w = 1.0
    made.scale.x, made.scale.y, made.scale.z = scale
    return made


@pytest.fixture
def shown(stage, statuses):
    """Publish markers, and return what is drawn and what is said."""
    scene, display = stage.display("Marker", more={"Marker Topic": TOPIC})

    def show(*markers):
        for each in markers:
            stage.publish(TOPIC, each, each.header.frame_id or "map")
        return scene.update()[0].primitives, statuses(display)

    show.scene, show.display = scene, display
    return show


@pytest.mark.parametrize(
    ("kind", "size"),
    [(Marker.CUBE, (0.5, 0.25, 0.125)), (Marker.SPHERE, (0.5, 0.25, 0.125)), (Marker.CYLINDER, (0.5, 0.25, 0.125))],
)
def test_solids_have_the_scale_as_their_size(shown, kind, size):
    ((mesh,), said) = shown(marker(kind))
    low, high = mesh.placed.min(axis=0), mesh.placed.max(axis=0)
    assert high - low == pytest.approx(np.array(size), rel=0.02)
    assert (low + high) / 2 == pytest.approx(np.array((1.0, 2.0, 0.0)), abs=1e-9)
    assert mesh.colours == pytest.approx(np.array((0.25, 0.5, 0.75, 1.0)))
    assert said["Markers"] == ("Ok", "Showing [1] of [1] markers in [1] namespaces")


def test_an_arrow_is_as_long_as_its_scale_or_goes_from_point_to_point(shown):
    (first, second), _ = shown(
        marker(Marker.ARROW, scale=(2.0, 0.1, 0.1)),
        marker(Marker.ARROW, 1, scale=(0.1, 0.2, 0.3), points=[Point(0.0, 0.0, 1.0), Point(0.0, -3.0, 1.0)]),
    )
    assert np.ptp(first.placed[:, 0]) == pytest.approx(2.0)
    assert np.ptp(first.placed[:, 1]) == pytest.approx(0.2, rel=0.02)
    assert second.placed[:, 1].min() == pytest.approx(-1.0)
    assert second.placed[:, 1].max() == pytest.approx(2.0)
    assert np.ptp(second.placed[:, 0]) == pytest.approx(0.2, rel=0.05)
    assert second.placed[:, 2].mean() == pytest.approx(1.0, abs=0.01)


def test_lists_lines_points_and_words(shown):
    colors = [Color(1.0, 0.0, 0.0, 1.0), Color(0.0, 1.0, 0.0, 1.0), Color(0.0, 0.0, 1.0, 0.5)]
    drawn, _ = shown(
        marker(Marker.LINE_STRIP, 0, points=SOMEWHERE, colors=colors),
        marker(Marker.LINE_LIST, 1, points=SOMEWHERE[:2]),
        marker(Marker.POINTS, 2, points=SOMEWHERE),
        marker(Marker.SPHERE_LIST, 3, points=SOMEWHERE, scale=(0.5, 0.5, 0.5)),
        marker(Marker.CUBE_LIST, 4, points=SOMEWHERE[:1]),
        marker(Marker.TRIANGLE_LIST, 5, points=SOMEWHERE, colors=colors, scale=(1.0, 1.0, 1.0)),
        marker(Marker.TEXT_VIEW_FACING, 6, text=" goal ", scale=(0.0, 0.0, 0.5)),
    )
    strip, pairs, points, balls, box, triangle, text = drawn
    assert isinstance(strip, Lines)
    assert (strip.strip, strip.width, pairs.strip) == (True, 0.5, False)
    assert strip.points == pytest.approx(np.array([(1, 2, 0), (2, 2, 0), (2, 4, 0)]))
    assert strip.colours[2] == pytest.approx(np.array((0, 0, 1, 0.5)))
    assert isinstance(points, Points)
    assert (points.style, points.size, balls.style) == ("Flat Squares", 0.5, "Spheres")
    assert isinstance(box, Mesh)
    assert isinstance(triangle, Mesh)
    assert triangle.placed == pytest.approx(strip.points)
    assert triangle.colours == pytest.approx(np.array([(1 / 3, 1 / 3, 1 / 3, 2.5 / 3)]))
    assert isinstance(text, Text)
    assert (text.text, text.height) == ("goal", 0.5)


def test_a_mesh_of_a_package_has_its_own_colours_or_that_of_the_marker(shown):
    resource = "package://turtlebot3_description/meshes/bases/burger_base.dae"
    plain, _ = shown(marker(Marker.MESH_RESOURCE, mesh_resource=resource, scale=(1.0, 1.0, 1.0)))
    assert {tuple(mesh.colours) for mesh in plain} == {(0.25, 0.5, 0.75, 1.0)}
    own = marker(Marker.MESH_RESOURCE, mesh_resource=resource, mesh_use_embedded_materials=True)
    own.color = Color()
    coloured, said = shown(own)
    assert len({tuple(mesh.colours) for mesh in coloured}) > 1
    assert "a/0" not in said


def test_missing_meshes_are_named(shown):
    drawn, said = shown(
        marker(Marker.MESH_RESOURCE, mesh_resource="package://turtlebot3_description/meshes/bases/burger_base.stl"),
        marker(Marker.MESH_RESOURCE, 1, mesh_resource="http://example.org/a.stl"),
        marker(Marker.CUBE, 2),
    )
    assert len(drawn) == 1
    assert said["a/0"][0] == "Error"
    assert "did you mean burger_base.dae?" in said["a/0"][1]
    assert "begin with package:// or file://" in said["a/1"][1]


WRONG = {
    "nan": (marker(Marker.CUBE, at=(math.nan, 0.0, 0.0)), "Error", "Position contains invalid floating point values"),
    "infinite": (marker(Marker.CUBE, scale=(1.0, math.inf, 1.0)), "Error", "Scale contains invalid floating point"),
    "zero": (marker(Marker.CUBE, scale=(1.0, 0.0, 1.0)), "Warn", "Scale contains 0.0 in x, y or z"),
    "negative": (marker(Marker.CUBE, scale=(1.0, -2.0, 1.0)), "Warn", "Scale contains a negative number"),
    "no points": (marker(Marker.POINTS), "Error", "Points should not be empty for specified marker type"),
    "one point": (marker(Marker.LINE_STRIP, points=SOMEWHERE[:1]), "Error", "At least two points are required"),
    "odd": (marker(Marker.LINE_LIST, points=SOMEWHERE), "Error", "should be a multiple of 2 for LINE_LIST"),
    "no triangle": (marker(Marker.TRIANGLE_LIST, points=SOMEWHERE[:2]), "Error", "should be a multiple of 3"),
    "colours": (marker(Marker.POINTS, points=SOMEWHERE, colors=[Color()]), "Error", "Number of colors doesn't match"),
    "arrow": (marker(Marker.ARROW, points=SOMEWHERE), "Error", "an ARROW marker should be either 0 or 2"),
    "words": (marker(Marker.TEXT_VIEW_FACING, text=" "), "Error", "Text is empty or only consists of whitespace"),
    "mesh": (marker(Marker.MESH_RESOURCE), "Error", "Empty mesh_resource path"),
    "kind": (marker(77), "Error", "Unknown marker type: 77"),
    "action": (marker(Marker.CUBE, action=9), "Error", "Unknown marker action: 9"),
    "clear": (marker(Marker.POINTS, points=SOMEWHERE), "Ok", "Marker is fully transparent (color.a is 0.0)"),
    "far": (marker(Marker.CUBE_LIST, points=[Point(1e9, 0.0, 0.0)]), "Error", "larger than"),
}
WRONG["clear"][0].color.a = 0.0


@pytest.mark.parametrize("name", WRONG)
def test_what_is_wrong_is_said_and_the_scene_stands(shown, name):
    bad, level, text = WRONG[name]
    drawn, said = shown(bad, marker(Marker.CUBE, 5))
    assert said["a/0"][0] == level
    assert text in said["a/0"][1]
    assert len(drawn) == (1 if level == "Error" else 2)
    assert "Display" not in said
    assert text in still(shown.scene).text


def test_same_name_replaces_delete_takes_away_and_deleteall_all(shown):
    drawn, _ = shown(marker(Marker.CUBE), marker(Marker.SPHERE), marker(Marker.CUBE, 1), marker(Marker.CUBE, 2))
    assert len(drawn) == 3
    drawn, _ = shown(marker(Marker.CUBE, 1, action=Marker.DELETE))
    assert len(drawn) == 2
    drawn, said = shown(marker(Marker.CUBE, action=Marker.DELETEALL))
    assert drawn == ()
    assert said["Markers"][1] == "Showing [0] of [0] markers in [0] namespaces"


def test_a_lifetime_ends(stage, shown):
    assert len(shown(marker(Marker.CUBE, lifetime=Duration(1, 0)), marker(Marker.CUBE, 1))[0]) == 2
    stage.graph.run(0.9)
    assert len(shown()[0]) == 2
    stage.graph.run(0.2)
    assert len(shown()[0]) == 1


def test_only_a_locked_marker_goes_with_its_frame(stage, shown):
    stage.place("map", "odom", (1.0, 0.0, 0.0))
    locked, left = marker(Marker.CUBE, frame_locked=True), marker(Marker.CUBE, 1)
    for each in (locked, left):
        each.header.frame_id = "odom"
    shown(locked, left)
    stage.place("map", "odom", (1.0, 0.0, 0.0))
    stage.graph.run(0.1)
    stage.place("map", "odom", (4.0, 0.0, 0.0))
    stage.graph.run(0.1)
    middles = [mesh.placed.mean(axis=0)[0] for mesh in shown()[0]]
    assert middles == pytest.approx([5.0, 2.0])


def test_a_marker_waits_for_its_frame_and_says_so(stage, shown):
    lost = marker(Marker.CUBE)
    lost.header.frame_id = "nowhere"
    stage.place("map", "odom")
    stage.publish(TOPIC, lost)  # as of any time
    drawn, said = shown(marker(Marker.CUBE, 1))
    assert len(drawn) == 1
    assert said["a/0"] == ("Error", "For frame [nowhere]: Frame [nowhere] does not exist")
    stage.place("map", "nowhere")
    stage.graph.run(0.1)
    drawn, said = shown()
    assert (len(drawn), "a/0" in said) == (2, False)


def test_namespaces_are_listed_and_switched(shown):
    other = marker(Marker.CUBE)
    other.ns = "b"
    assert len(shown(marker(Marker.CUBE), other)[0]) == 2
    assert shown.display["Namespaces"] == {"a": True, "b": True}
    shown.display["Namespaces"] = {"a": False}
    drawn, said = shown()
    assert (len(drawn), said["Markers"][1]) == (1, "Showing [1] of [2] markers in [2] namespaces")
    assert shown.display.tree()["Namespaces"] == {"a": False}
    assert MarkerDisplay()["Namespaces"] == {}


def test_arrays_come_by_either_display(stage, statuses, shown):
    array = MarkerArray(markers=[marker(Marker.CUBE), marker(Marker.SPHERE, 1)])
    scene, display = stage.display("MarkerArray", more={"Marker Topic": f"{TOPIC}_array"})
    for each in array.markers:
        each.header.frame_id = "map"
    stage.publish(f"{TOPIC}_array", array)
    assert len(scene.update()[0].primitives) == 2
    assert statuses(display)["Topic"] == ("Ok", "1 message received")
    assert len(shown()[0]) == 2


def test_many_points_and_many_bad_markers_stay_bounded(stage, shown):
    many = [Point(0.001 * i, math.sin(0.01 * i), 0.0) for i in range(30_000)]
    drawn, _ = shown(marker(Marker.LINE_STRIP, points=many), marker(Marker.POINTS, 1, points=many))
    assert [len(each.points) for each in drawn] == [30_000] * 2
    assert len(still(shown.scene, fit=True).svg) < 150_000
    array = MarkerArray(markers=[marker(77, number) for number in range(2000)])
    for each in array.markers:
        each.header.frame_id = "map"
    stage.publish(f"{TOPIC}_array", array)
    _, said = shown()
    assert len(said) < 50
    assert said["Others"][0] == "Warn"


numbers = st.one_of(st.floats(width=32), st.sampled_from([0.0, 1.0, -1.0, 0.5]))


@given(
    st.integers(-1, 12),
    st.lists(numbers, min_size=3, max_size=3),
    st.lists(st.tuples(numbers, numbers, numbers), max_size=7),
    st.lists(st.tuples(numbers, numbers, numbers, numbers), max_size=7),
    st.lists(numbers, min_size=4, max_size=4),
)
def test_whatever_comes_the_scene_stands(shown, kind, scale, points, colors, turned):
    made = marker(kind, scale=scale, text="x", points=[Point(*each) for each in points])
    made.colors = [Color(*each) for each in colors]
    q = made.pose.orientation
    q.x, q.y, q.z, q.w = turned
    _, said = shown(made, marker(Marker.CUBE, 1))
    assert "Display" not in said
    assert shown.display.markers.keys() >= {("a", 1)}
    assert still(shown.scene).text
