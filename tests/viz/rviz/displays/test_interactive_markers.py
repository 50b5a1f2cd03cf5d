"""Interactive markers: how they are seen, what a hand does to them, and what that publishes."""

import math

import numpy as np
import pytest

from rosmini.msgs import message_class
from rosmini.ros.interactive_markers import InteractiveMarkerServer, MenuHandler
from rosmini.viz.rviz import still
from rosmini.viz.rviz.primitives import DisplayError, Text
from rosmini.viz.rviz.tools import Tools

Control = message_class("visualization_msgs/InteractiveMarkerControl")
Feedback = message_class("visualization_msgs/InteractiveMarkerFeedback")
InteractiveMarker = message_class("visualization_msgs/InteractiveMarker")
Marker = message_class("visualization_msgs/Marker")
Quaternion = message_class("geometry_msgs/Quaternion")

ALONG_X, ALONG_Z = (0.0, 0.0, 0.0, 1.0), (0.0, 1.0, 0.0, 1.0)
HALF = math.sqrt(0.5)


def marker(mode, axis=ALONG_X, *, name="box", frame="map", at=(1.0, 2.0, 0.0)):
    made = InteractiveMarker(name=name, description=f"the {name}", scale=1.0)
    made.header.frame_id = frame
    made.pose.position.x, made.pose.position.y, made.pose.position.z = at
    made.controls = [Control(name="grip", interaction_mode=mode, orientation=Quaternion(*axis))]
    return made


class Shop:
    """A server, a display of its markers, and the feedback that comes."""

    def __init__(self, stage):
        self.graph, self.stage = stage.graph, stage
        self.server = InteractiveMarkerServer(stage.node, "basic")
        self.feedback = []
        self.scene = stage.scene()
        self.display = self.scene.add("InteractiveMarkers", {"Update Topic": "/basic/update"})
        self.graph.run(1.5)

    def show(self, *markers):
        for each in markers:
            self.server.insert(each, self.feedback.append)
        self.server.applyChanges()
        self.graph.run(1.5)  # a new marker listens to nobody for a second
        return self.look()

    def look(self):
        self.graph.run(0.01)
        return list(self.scene.update()[0].primitives)

    def pose(self, name="box"):
        """Where the server has it."""
        return self.server.get(name).pose

    def events(self):
        self.graph.run(0.01)
        return [each.event_type for each in self.feedback]


@pytest.fixture
def shop(stage):
    return Shop(stage)


def test_handles_and_the_description_are_seen(shop, statuses):
    arrows = shop.show(marker(Control.MOVE_AXIS))
    assert [type(each).__name__ for each in arrows] == ["Mesh", "Mesh", "Text"]
    assert {round(float(each.placed[:, 0].max()), 3) for each in arrows[:2]} == {1.9, 0.5}
    assert arrows[2].text == "the box"
    assert statuses(shop.display)["box"] == ("Ok", "Locked to frame map")
    assert statuses(shop.display)["/robot"] == ("Ok", "Initialization complete.")
    shop.display["Show Descriptions"] = False
    shop.display["Show Axes"] = True
    assert len(shop.look()) == 5


def test_without_interaction_only_what_is_always_visible_is_seen(shop):
    both = marker(Control.MOVE_AXIS)
    both.controls.append(Control(always_visible=True, markers=[Marker(type=Marker.CUBE)]))
    assert len(shop.show(both)) == 4
    shop.display.shows_controls = False
    assert len(shop.look()) == 2


MOVES = {
    "axis": (Control.MOVE_AXIS, ALONG_X, (3.0, 5.0, 0.0), (3.0, 2.0, 0.0), 0.0),
    "plane": (Control.MOVE_PLANE, ALONG_Z, (3.0, 5.0, 7.0), (3.0, 5.0, 0.0), 0.0),
    "space": (Control.MOVE_3D, ALONG_X, (3.0, 5.0, 7.0), (3.0, 5.0, 7.0), 0.0),
    "nothing": (Control.ROTATE_3D, ALONG_X, (3.0, 5.0, 7.0), (1.0, 2.0, 0.0), 0.0),
}


@pytest.mark.parametrize("name", MOVES)
def test_a_drag_moves_the_marker_as_its_control_says(shop, name):
    mode, axis, to, expected, yaw = MOVES[name]
    shop.show(marker(mode, axis))
    shop.display.drag("box", to)
    moved = Feedback.KEEP_ALIVE if name == "nothing" else Feedback.POSE_UPDATE
    assert shop.events() == [Feedback.MOUSE_DOWN, moved, Feedback.MOUSE_UP]
    at = shop.pose().position
    assert (at.x, at.y, at.z) == pytest.approx(expected)
    assert 2 * math.atan2(shop.pose().orientation.z, shop.pose().orientation.w) == pytest.approx(yaw)
    last = shop.feedback[-1]
    assert (last.control_name, last.client_id) == ("grip", f"{shop.scene.node.name}/InteractiveMarkers")
    assert (last.mouse_point_valid, last.mouse_point.y) == (True, to[1])


def test_a_ring_turns_and_a_toothed_one_tows(shop):
    shop.show(marker(Control.ROTATE_AXIS, ALONG_Z), marker(Control.MOVE_ROTATE, ALONG_Z, name="tow", at=(-5.0, 0, 0)))
    shop.display.drag("box", (1.0, 3.0, 0.0), start=(2.0, 2.0, 0.0))
    shop.display.drag("tow", (-5.0, 2.0, 0.0), start=(-4.0, 0.0, 0.0))
    shop.graph.run(0.1)
    turned = shop.pose().orientation
    assert (turned.z, turned.w) == pytest.approx((HALF, HALF))
    towed = shop.pose("tow")
    assert (towed.position.x, towed.position.y) == pytest.approx((-5.0, 1.0))
    assert (towed.orientation.z, towed.orientation.w) == pytest.approx((HALF, HALF))


def test_a_marker_of_another_frame_is_answered_in_it_and_a_stamped_one_in_the_fixed_frame(shop):
    shop.stage.place("map", "odom", (10.0, 0.0, 0.0), yaw=math.pi / 2)
    stamped = marker(Control.MOVE_3D, name="stamped", frame="odom")
    stamped.header.stamp = shop.graph.now()
    shop.show(marker(Control.MOVE_3D, frame="odom"), stamped)
    shop.display.drag("box", (9.0, 0.0, 0.0))
    shop.display.drag("stamped", (9.0, 0.0, 0.0))
    shop.graph.run(0.1)
    own, fixed = (next(each for each in shop.feedback if each.marker_name == name) for name in ("box", "stamped"))
    own, fixed = shop.feedback[1], shop.feedback[4]
    assert (own.header.frame_id, fixed.header.frame_id) == ("odom", "map")
    assert (own.pose.position.x, own.pose.position.y) == pytest.approx((0.0, 1.0), abs=1e-9)
    assert (fixed.pose.position.x, fixed.pose.orientation.w) == pytest.approx((9.0, HALF))


def test_the_tool_takes_hold_of_what_is_under_the_hand(shop):
    shop.show(marker(Control.MOVE_PLANE, ALONG_Z), marker(Control.MOVE_AXIS, name="other", at=(9.0, 9.0, 0.0)))
    tool = Tools(shop.scene)["Interact"]
    assert "Click an interactive marker" in tool.drag((1.0, 2.0), (3.0, 3.0))
    assert tool.drag((1.57, 2.0), (3.57, 3.0)) == "box: 3, 3, 0 in map"
    assert shop.events() == [Feedback.MOUSE_DOWN, Feedback.POSE_UPDATE, Feedback.MOUSE_UP]
    shop.server.applyChanges()
    text = next(each for each in shop.look() if isinstance(each, Text) and each.text == "the box")
    assert text.position[:2] == pytest.approx(np.array((3.0, 3.0)))


def test_controls_are_seen_with_the_tool_interact_and_only_those_that_are_held_during_a_drag(shop):
    markers = [marker(Control.MOVE_PLANE, ALONG_Z), marker(Control.MOVE_PLANE, ALONG_Z, name="other", at=(9.0, 9.0, 0))]
    assert len(shop.show(*markers)) == 4
    tools = Tools(shop.scene)
    tools.take("Measure")
    assert len(shop.look()) == 2
    tools.take("Interact")
    assert len(shop.look()) == 4
    tools.current.press(np.array([1.57, 2.0, 0.0]))
    assert len(shop.look()) == 3
    tools.current.release(np.array([1.57, 2.0, 0.0]))
    assert len(shop.look()) == 4


def test_buttons_and_menus(shop):
    button = marker(Control.BUTTON)
    button.controls[0].markers = [Marker(type=Marker.CUBE)]
    chosen = []
    menu = MenuHandler()
    mode = menu.insert("Mode")
    menu.insert("Fast", parent=mode, callback=lambda feedback: chosen.append(feedback.menu_entry_id))
    menu.insert("Shell", command_type=1, command="rm -r /")
    options = marker(Control.MENU, name="menu")
    shop.show(button, options)
    menu.apply(shop.server, "menu")
    menu.setCheckState(2, MenuHandler.CHECKED)
    menu.reApply(shop.server)
    shop.show()
    shop.display.click("box")
    assert shop.display.click("menu") == "Mode; Mode/Fast; Shell"
    assert shop.events() == [
        Feedback.MOUSE_DOWN, Feedback.BUTTON_CLICK, Feedback.MOUSE_UP, Feedback.MOUSE_DOWN, Feedback.MOUSE_UP,
    ]  # fmt: skip
    shop.display.choose("menu", "Mode/Fast")
    shop.graph.run(0.1)
    assert chosen == [2]
    with pytest.raises(DisplayError, match="rosmini runs no program named in a message"):
        shop.display.choose("menu", "Shell")
    with pytest.raises(DisplayError, match="no entry 'Slow'; it has Mode, Mode/Fast, Shell"):
        shop.display.choose("menu", "Slow")


def test_the_server_says_where_it_is_after_a_drag(shop):
    shop.server.insert(marker(Control.MOVE_3D), lambda feedback: home())

    def home():
        shop.server.setPose("box", marker(Control.MOVE_3D).pose)
        shop.server.applyChanges()

    shop.show()
    shop.display.drag("box", (7.0, 7.0, 0.0))
    assert shop.display.handle("box").pose[0, 3] == 7.0
    shop.look()
    assert shop.display.handle("box").pose[0, 3] == 1.0


WRONG = {
    "nan": (marker(Control.MOVE_AXIS, at=(math.nan, 0.0, 0.0)), "Error", "Marker contains invalid floats!"),
    "turned": (marker(Control.MOVE_AXIS, (math.nan, 0.0, 0.0, 0.0)), "Error", "Marker contains invalid floats!"),
    "frame": (marker(Control.MOVE_AXIS, frame="nowhere"), "Error", "For frame [nowhere]:"),
    "words": (marker(Control.MENU), "Warn", "Text is empty"),
}


@pytest.mark.parametrize("name", WRONG)
def test_what_is_wrong_is_said_and_the_others_are_seen(shop, statuses, name):
    bad, level, text = WRONG[name]
    assert shop.show(bad, marker(Control.MOVE_PLANE, name="good"))
    assert statuses(shop.display)["box"][0] == level
    assert text in statuses(shop.display)["box"][1]
    assert "Display" not in statuses(shop.display)
    assert text in still(shop.scene).text


def test_what_is_not_there_is_named(shop, stage, statuses):
    shop.show(marker(Control.MOVE_AXIS))
    with pytest.raises(DisplayError, match="no interactive marker 'bix' is shown; there are box"):
        shop.display.click("bix")
    with pytest.raises(DisplayError, match="has no control 'x'; it has 'grip'"):
        shop.display.drag("box", (0.0, 0.0, 0.0), control="x")
    scene, display = stage.display("InteractiveMarkers", more={"Update Topic": "/nobody/update"})
    scene.update()
    level, text = statuses(display)["Topic"]
    assert level == "Warn" and "/nobody/update" in text
    display["Update Topic"] = "/basic"
    assert statuses(display)["Topic"] == ("Error", "Invalid topic name: /basic")
