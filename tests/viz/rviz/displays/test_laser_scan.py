"""LaserScan: which ranges are points, where, and in which colours."""

import numpy as np
import pytest

from rosmini.msgs.sensor_msgs.msg import LaserScan


def scan(ranges, intensities=()):
    return LaserScan(
        ranges=ranges, intensities=intensities, angle_min=0.0, angle_increment=np.pi / 2, range_min=0.2, range_max=3.5
    )


def points(stage, message, **properties):
    scene, display = stage.display("LaserScan", "/scan", more=properties)
    stage.publish("/scan", message, "map")
    found = scene.update()[0].primitives
    return (found[0] if found else None), display


def test_only_what_is_in_range_is_a_point(stage):
    found, _ = points(stage, scan([1.0, 0.1, 2.0, 4.0, float("nan"), float("inf")]))
    assert found.points == pytest.approx(np.array([(1, 0, 0), (-2, 0, 0)]), abs=1e-6)


def test_intensities_are_a_rainbow_from_red_to_magenta(stage):
    found, _ = points(stage, scan([1.0, 1.0], [0.0, 47.0]))
    assert found.colours[:, :3] == pytest.approx(np.array([(1, 0, 0), (1, 0, 1)]), abs=1e-9)


def test_flat_and_axis_colours(stage):
    found, _ = points(stage, scan([1.0]), **{"Color Transformer": "FlatColor", "Color": (0, 255, 0), "Alpha": 0.5})
    assert found.colours == pytest.approx(np.array([(0, 1, 0, 0.5)]))
    found, _ = points(
        stage,
        scan([1.0, 1.0, 1.0]),
        **{"Color Transformer": "AxisColor", "Axis": "X", "Autocompute Value Bounds": True},
    )
    assert len({tuple(each) for each in np.round(found.colours, 6)}) == 3


@pytest.mark.parametrize("ranges", [[], [float("nan")] * 3])
def test_a_scan_without_points_is_a_warning(stage, statuses, ranges):
    _, display = points(stage, scan(ranges))
    assert statuses(display)["Points"] == ("Warn", "Showing [0] points from [1] messages")


def test_impossible_angles_are_an_error_and_the_next_scan_is_shown(stage, statuses):
    broken = scan([1.0])
    broken.angle_min = float("nan")
    scene, display = stage.display("LaserScan", "/scan")
    stage.publish("/scan", broken, "map")
    scene.update()
    assert statuses(display)["Topic"][0] == "Error"
    stage.publish("/scan", scan([1.0]), "map")
    assert len(scene.update()[0].primitives[0].points) == 1
    assert statuses(display)["Topic"] == ("Ok", "2 messages received")


def test_a_transformer_that_the_message_cannot_serve_is_an_error(stage, statuses):
    _, display = points(stage, scan([1.0]), **{"Color Transformer": "RGB8"})
    level, text = statuses(display)["Topic"]
    assert level == "Error" and "RGB8" in text and "no channels" in text
