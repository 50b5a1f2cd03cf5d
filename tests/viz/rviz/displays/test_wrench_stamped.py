"""WrenchStamped: arrows for a force and a torque."""

import math

import numpy as np
import pytest

from rosmini.msgs import message_class
from rosmini.viz.rviz.primitives import Lines, Mesh

Wrench = message_class("geometry_msgs/WrenchStamped")


def wrench(force=(0.0, 0.0, 0.0), torque=(0.0, 0.0, 0.0)):
    made = Wrench()
    made.wrench.force.x, made.wrench.force.y, made.wrench.force.z = force
    made.wrench.torque.x, made.wrench.torque.y, made.wrench.torque.z = torque
    return made


@pytest.fixture
def drawn(stage, statuses):
    scene, display = stage.display("WrenchStamped", "/wrench", more={"Arrow Width": 0.1})

    def draw(message):
        stage.publish("/wrench", message, "map")
        return scene.update()[0].primitives, statuses(display)

    draw.display = display
    return draw


def test_a_force_is_an_arrow_as_long_as_it_is_strong(drawn):
    ((arrow,), _) = drawn(wrench((0.0, 1.5, 0.0)))
    assert np.ptp(arrow.placed[:, 1]) == pytest.approx(3.0)
    assert arrow.colours[:3] == pytest.approx(np.array((0.8, 0.2, 0.2)))


def test_a_torque_has_a_circle_around_it(drawn):
    arrow, circle, head = drawn(wrench(torque=(0.0, 0.0, 1.0)))[0]
    assert isinstance(arrow, Mesh)
    assert np.ptp(arrow.placed[:, 2]) == pytest.approx(2.0)
    assert isinstance(circle, Lines)
    assert np.linalg.norm(circle.points[:, :2], axis=1) == pytest.approx(np.full(29, 0.5))
    assert circle.points[:, 2] == pytest.approx(np.ones(29))
    assert head.placed.mean(axis=0) == pytest.approx(circle.points[-1], abs=0.02)


def test_small_and_wrong_ones(drawn):
    assert not drawn(wrench((0.01, 0.0, 0.0)))[0]
    drawn.display["Hide Small Values"] = False
    assert len(drawn(wrench((0.01, 0.0, 0.0)))[0]) == 1
    found, said = drawn(wrench((math.nan, 0.0, 0.0)))
    assert not found
    assert said["Topic"] == ("Error", "Message contained invalid floating point values (nans or infs)")
