"""Panels as text."""

from rosmini.viz.rviz.window import TimePanel


def test_the_time_panel_counts_from_the_last_reset(stage):
    scene = stage.scene()
    panel = TimePanel(scene)
    stage.graph.run(2.5)
    now = stage.graph.now().to_sec()
    assert panel.words() == f"ROS Time: {now:.2f}\nROS Elapsed: 2.50"
    panel.reset()
    assert "ROS Elapsed: 0.00" in panel.words()


def test_a_reset_forgets_what_was_received(stage, statuses):
    from rosmini.msgs.sensor_msgs.msg import LaserScan

    scene, scan = stage.display("LaserScan", "/scan")
    node = stage.graph.node("laser_driver")
    publisher = node.publisher("/scan", LaserScan)
    stage.graph.run(0.1)
    message = LaserScan(range_max=9.0, ranges=[1.0], angle_increment=0.1)
    message.header.frame_id, message.header.stamp = "laser", stage.graph.now()
    stage.place("map", "laser")
    publisher.publish(message)
    stage.graph.run(0.1)
    assert scene.update()[0].primitives
    TimePanel(scene).reset()
    stage.graph.run(0.1)
    assert not scene.update()[0].primitives
    assert scan.message_count == 0 or "Topic" in statuses(scan)
