"""Displays for what is published."""

from rosmini.msgs.geometry_msgs.msg import PoseStamped
from rosmini.msgs.nav_msgs.msg import OccupancyGrid, Odometry, Path
from rosmini.msgs.sensor_msgs.msg import LaserScan
from rosmini.viz.rviz.suggestions import Suggestions, selected, suggested


def names(config):
    return [each["Name"] for each in config.mappings("Displays")]


def test_the_truth_of_a_simulator_is_shown_where_its_frame_is(stage):
    """Without a map there is no frame of that name either, and the display would be an error from the start."""
    for topic in ("/odom", "/base_pose_ground_truth", "/tb3_1/base_pose_ground_truth"):
        stage.publish(topic, Odometry(), "odom")
    assert set(names(suggested(stage.graph))) == {"Grid", "/odom", "TF"}
    stage.publish("/map", OccupancyGrid(), "map")
    assert {"/base_pose_ground_truth", "/tb3_1/base_pose_ground_truth"} < set(names(suggested(stage.graph)))


def test_displays_are_selected_by_class_name_or_topic(stage):
    for topic in ("/scan", "/front/scan"):
        stage.publish(topic, LaserScan(), "base_link")
    stage.publish("/map", OccupancyGrid(), "map")
    found = suggested(stage.graph)
    assert names(selected(found, ["/map"])) == ["Grid", "/map"]
    assert names(selected(found, ["LaserScan"])) == ["Grid", "/front/scan", "/scan"]


def scene_and_suggestions(stage):
    scene = stage.scene(suggested(stage.graph), None)
    return scene, Suggestions(stage.graph, scene)


def test_a_topic_that_appears_later_gets_one_display(stage):
    scene, suggestions = scene_and_suggestions(stage)
    stage.publish("/plan", Path())
    assert not suggestions.add_new()  # the Master is asked once a second
    stage.graph.run(1.0)
    assert suggestions.add_new()
    assert scene["/plan"].plugin_name == "rviz/Path"
    stage.graph.run(1.0)
    assert not suggestions.add_new()
    assert [each.name for each in scene].count("/plan") == 1


def test_a_display_that_the_user_removed_is_not_added_again(stage):
    stage.publish("/scan", LaserScan(), "odom")
    scene, suggestions = scene_and_suggestions(stage)
    stage.publish("/plan", Path())
    stage.graph.run(1.0)
    suggestions.add_new()
    for name in ("/scan", "/plan"):
        scene.remove(scene[name])
    stage.graph.run(1.0)
    assert not suggestions.add_new()
    assert {"/scan", "/plan"}.isdisjoint(each.name for each in scene)


def test_what_the_user_or_the_window_itself_added_is_not_suggested(stage):
    scene, suggestions = scene_and_suggestions(stage)
    scene.add("LaserScan", {"Topic": "scan"}, name="mine")
    scene.node.publisher("/move_base_simple/goal", PoseStamped)
    stage.publish("/scan", LaserScan(), "odom")
    stage.graph.run(1.0)
    assert not suggestions.add_new()


def test_a_map_that_appears_later_is_drawn_below_the_robot_and_gives_the_fixed_frame(stage):
    stage.publish("/odom", Odometry(), "odom")
    scene, suggestions = scene_and_suggestions(stage)
    assert scene.fixed_frame == "odom"
    stage.publish("/map", OccupancyGrid(), "map")
    stage.graph.run(1.0)
    assert suggestions.add_new()
    assert scene.fixed_frame == "map"
    order = [each.name for each in scene]
    assert order.index("/map") < order.index("/odom")


def test_a_fixed_frame_that_the_user_chose_stays(stage):
    scene, suggestions = scene_and_suggestions(stage)
    scene.fixed_frame = "base_link"
    stage.publish("/map", OccupancyGrid(), "map")
    stage.graph.run(1.0)
    assert suggestions.add_new()
    assert scene.fixed_frame == "base_link"
