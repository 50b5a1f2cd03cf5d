"""A scene: its node, its frames, and displays that do not disturb one another."""

import pytest

from rosmini.viz import ViewError
from rosmini.viz.rviz import Display, Level
from rosmini.viz.rviz.primitives import DisplayError


def registered(stage):
    state = stage.graph.ask_as("/test").ask("getSystemState")
    return sorted({node for side in state[:2] for _, nodes in side for node in nodes if node.startswith("/rviz")})


def test_a_scene_subscribes_and_leaves_no_trace(stage):
    scene = stage.scene()
    scene.add("LaserScan", {"Topic": "/scan"})
    scene.add("Map", {"Topic": "/map"})
    published, subscribed, _ = stage.graph.ask_as("/test").ask("getSystemState")
    name = scene.node.name
    assert [topic for topic, nodes in published if name in nodes] == ["/rosout"]
    received = {topic for topic, nodes in subscribed if name in nodes}
    assert received == {"/scan", "/map", "/map_updates", "/tf", "/tf_static"}
    scene.close()
    assert registered(stage) == []


def test_a_display_that_is_off_or_removed_subscribes_to_nothing(stage):
    scene = stage.scene()
    scan = scene.add("LaserScan", {"Topic": "/scan"})

    def listeners():
        state = stage.graph.ask_as("/test").ask("getSystemState")
        return [nodes for topic, nodes in state[1] if topic == "/scan"]

    assert listeners() == [[scene.node.name]]
    scan.enabled = False
    assert listeners() == []
    scan.enabled = True
    assert listeners() == [[scene.node.name]]
    scene.remove(scan)
    assert listeners() == []
    with pytest.raises(ViewError, match="not in this scene"):
        scene.remove(scan)


def test_global_status_says_how_the_fixed_frame_is_doing(stage):
    scene = stage.scene(fixed_frame="mapp")
    assert [(each.level, each.name) for each in scene.global_status] == [(Level.WARN, "Fixed Frame")]
    stage.place("map", "odom")
    stage.graph.run(0.1)
    status = scene.global_status[0]
    assert status.level is Level.ERROR and "mapp; did you mean map?" in status.text
    scene.fixed_frame = "map"
    assert scene.global_status[0].text == "OK"


def test_names_are_suggested(stage):
    scene = stage.scene()
    with pytest.raises(ViewError, match="LaserScan"):
        scene.add("LaserScann")
    scan = scene.add("LaserScan", {"Topic": "/scan"}, name="front")
    with pytest.raises(DisplayError, match="Decay Time"):
        scan["Decay Tim"] = 1.0
    with pytest.raises(ViewError, match="did you mean front"):
        scene["frnt"]
    with pytest.raises(DisplayError, match="Flat Squares"):
        scan["Style"] = "Flat Square"


def test_a_display_that_fails_does_not_disturb_the_others(stage, statuses):
    class Broken(Display):
        def primitives(self, context):
            raise ZeroDivisionError("oh")

    scene = stage.scene()
    broken = scene.add(Broken("broken"))
    grid = scene.add("Grid")
    layers = {layer.display: layer.primitives for layer in scene.update()}
    assert layers[broken] == ()
    assert len(layers[grid]) == 1
    assert statuses(broken) == {"Display": ("Error", "ZeroDivisionError: oh")}


def test_displays_in_a_group_go_on_and_off_with_it(stage, data):
    scene = stage.scene(data / "navigation.rviz", None)
    group, costmap = scene["Global Map"], scene["Costmap"]
    assert costmap.is_running
    group.enabled = False
    assert not costmap.is_running
    assert costmap not in [layer.display for layer in scene.update()]
    group.enabled = True
    assert costmap.is_running


def test_when_time_jumps_back_displays_begin_again(stage):
    from rosmini.msgs.sensor_msgs.msg import LaserScan

    scene, scan = stage.display("LaserScan", "/scan")
    stage.publish("/scan", LaserScan(ranges=[1.0], range_max=2.0, angle_increment=0.1), "map")
    scene.update()
    assert scan.message_count == 1
    scene._last_ns += 10**12
    scene.update()
    stage.graph.run(0.1)
    assert scan.message_count == 1  # the latched one, again
