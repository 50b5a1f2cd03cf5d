"""What a recording says of a run, on runs that can be worked out by hand."""

import math
from dataclasses import replace

import numpy as np
import pytest

from rosmini.sim.models import BURGER
from rosmini.sim.recording import Recording, RecordingError
from rosmini.sim.world import World

ROBOT = replace(BURGER, name="square", lidar=replace(BURGER.laser, beams=4))


def recording(truth, odom=None, *, step=0.1, commands=(), scans=()):
    """A run with the given poses, `step` seconds apart, and a scan every second one."""
    truth = np.array(truth, dtype=float)
    scans = np.array(scans, dtype=float).reshape(-1, 4)
    return Recording(
        World("void"),
        ROBOT,
        times=np.arange(len(truth)) * step,
        truth=truth,
        odom=truth if odom is None else np.array(odom, dtype=float),
        commands=np.array(commands, dtype=float).reshape(-1, 3),
        scan_times=np.arange(len(scans)) * 2 * step,
        scans=scans,
    )


def test_duration_and_distance_are_those_of_the_real_way():
    run = recording([(0, 0, 0), (3, 4, 0), (3, 4, 1), (3, 5, 1)], odom=np.zeros((4, 3)))
    assert run.duration == pytest.approx(0.3)
    assert run.distance == pytest.approx(6.0)
    for part in ("square", "void", "0.3 s", "4 poses", "0 scans", "0 commands"):
        assert part in repr(run)


def test_drift_is_relative_to_the_start_in_whichever_frame_odometry_began():
    truth = np.array([(1.0, 1.0, math.pi / 2), (1.0, 2.0, math.pi / 2), (1.0, 3.0, math.pi / 2)])
    odom = np.array([(5.0, 5.0, 0.0), (6.0, 5.0, 0.0), (7.0, 5.1, 0.2)])
    run = recording(truth, odom)
    np.testing.assert_allclose(
        run.odom_in_map(), [(1, 1, math.pi / 2), (1, 2, math.pi / 2), (0.9, 3, math.pi / 2 + 0.2)], atol=1e-12
    )
    np.testing.assert_allclose(run.drift().position, [0, 0, 0.1], atol=1e-12)
    np.testing.assert_allclose(run.drift().heading, [0, 0, 0.2], atol=1e-12)


def test_the_pose_at_a_time_lies_between_the_samples():
    run = recording([(0, 0, 3), (1, 2, 4)], step=1.0)
    assert run.pose_at(0.5) == (0.5, 1.0, 3.5)
    assert run.pose_at(9.0) == (1.0, 2.0, 4.0)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"times": np.empty(0)}, "at least one sample"),
        ({"odom": np.zeros((3, 3))}, r"odom of a recording must be an array \(2, 3\), not \(3, 3\)"),
        ({"scans": np.zeros((0, 360))}, r"scans of a recording must be an array \(0, 4\)"),
        ({"truth": np.array([(0, 0, 0), (0, math.nan, 0)])}, r"truth\[1, 1\] of a recording is nan"),
        ({"commands": np.array([(0, math.inf, 0)])}, r"commands\[0, 1\] of a recording is inf"),
        ({"times": np.array([1.0, 1.0])}, "times of a recording must increase"),
    ],
)
def test_arrays_that_do_not_fit_are_refused_by_name(change, message):
    with pytest.raises(RecordingError, match=message):
        replace(recording([(0, 0, 0), (1, 0, 0)]), **change)
