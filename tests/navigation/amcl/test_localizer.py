"""When an update happens, with one laser and with two, and that it finds the robot."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from rosmini.core.geometry.poses import compose
from rosmini.navigation.amcl.laser import Scan
from rosmini.navigation.amcl.localizer import FreeSpace, Localizer
from rosmini.navigation.amcl.parameters import AmclParameters

from .test_node import hall

BEARINGS = np.arange(90) * math.tau / 90
SMALL = np.diag([0.01, 0.01, 0.01])


def localizer(**changes):
    parameters = AmclParameters(
        min_particles=100, max_particles=1000, resample_interval=1, laser_max_beams=60, **changes
    )
    found = Localizer(parameters, np.random.default_rng(4))
    found.set_map(hall())
    return found


def seen(found, pose):
    return Scan(found.field.ranges(np.array([pose]), BEARINGS, 3.5)[0], BEARINGS, 3.5)


def test_an_update_takes_a_motion_and_a_resampling_some_updates():
    found = localizer()
    found.configure(replace(found.parameters, resample_interval=2))
    found.initialize((1.0, 1.0, 0.0), SMALL)

    def at(x):
        return found.update("base_scan", seen(found, (1.0 + x, 1.0, 0.0)), (x, 0.0, 0.0))

    assert at(0.0) is True, "the first scan gives an estimate"
    assert at(0.1) is None, "it has hardly moved"
    assert at(0.3) is True
    assert at(0.6) is False, "weighed, and not yet resampled"
    assert at(0.9) is True
    assert at(0.9) is None
    found.force = True
    assert at(0.9) is False, "forced, though it stands"
    assert at(0.9) is None, "once"


def test_each_of_two_lasers_has_its_turn():
    found = localizer()
    found.initialize((1.0, 1.0, 0.0), SMALL)
    scan = seen(found, (1.0, 1.0, 0.0))
    assert found.update("front", scan, (0.0, 0.0, 0.0))
    assert found.update("back", scan, (0.0, 0.0, 0.0)) is None, "nobody knew of it when the robot moved"
    assert found.update("back", scan, (0.3, 0.0, 0.0)) is not None
    assert found.update("front", scan, (0.3, 0.0, 0.0)) is not None
    assert found.update("front", scan, (0.3, 0.0, 0.0)) is None


@pytest.mark.parametrize("kind", ["beam", "likelihood_field", "likelihood_field_prob"])
def test_it_follows_a_robot(kind):
    found = localizer(laser_model_type=kind, do_beamskip=True, odom_model_type="diff-corrected", update_min_d=0.1)
    pose, odometry = (1.0, 1.0, 0.0), (0.0, 0.0, 0.0)
    found.initialize((1.1, 0.9, 0.1), np.diag([0.04, 0.04, 0.02]))
    for _ in range(15):
        found.update("scan", seen(found, pose), odometry)
        pose, odometry = compose(pose, (0.2, 0.0, 0.1)), compose(odometry, (0.21, 0.0, 0.09))
    last = compose(pose, (0.0, 0.0, 0.0))
    found.update("scan", seen(found, last), odometry)
    estimate = found.estimate()
    assert math.dist(estimate.pose[:2], last[:2]) < 0.1
    assert abs(math.remainder(estimate.pose[2] - last[2], math.tau)) < 0.08
    assert sum(cluster.weight for cluster in estimate.clusters) == pytest.approx(1.0)
    assert found.numbers()["particles"] == len(found.filter.particles)


def test_a_robot_that_is_anywhere_is_found():
    found = localizer()
    found.configure(replace(found.parameters, max_particles=10_000))
    found.initialize_globally()
    assert len(found.filter.particles) == 10_000
    pose, odometry = (1.0, 1.2, 0.0), (0.0, 0.0, 0.0)
    for step in range(25):
        found.update("scan", seen(found, pose), odometry)
        motion = (0.25, 0.0, 0.35 if step > 10 else 0.0)
        pose, odometry = compose(pose, motion), compose(odometry, motion)
    found.update("scan", seen(found, pose), odometry)
    assert math.dist(found.estimate().pose[:2], pose[:2]) < 0.15


def test_candidates_find_a_robot_that_was_carried_away():
    """Random particles that the scan has chosen are near the robot at once; uniform ones rarely are."""

    def off(candidates):
        found = localizer(
            recovery_alpha_slow=0.001, recovery_alpha_fast=0.1, recovery_candidates=candidates,
            laser_model_type="likelihood_field_prob",
        )  # fmt: skip
        found.initialize((5.0, 3.0, 2.0), SMALL)
        pose, odometry = (1.0, 1.2, 0.0), (0.0, 0.0, 0.0)
        found.update("scan", seen(found, (5.0, 3.0, 2.0)), odometry)
        for _ in range(12):
            motion = (0.25, 0.0, 0.1)
            pose, odometry = compose(pose, motion), compose(odometry, motion)
            found.update("scan", seen(found, pose), odometry)
        return math.dist(found.estimate().pose[:2], pose[:2])

    assert off(20) < 0.2 < 1.0 < off(1)


def test_poses_are_drawn_evenly_from_free_cells():
    free = np.zeros((4, 5), dtype=bool)
    free[1, 2] = free[3, 4] = True
    space = FreeSpace(free, 0.5, (10.0, -10.0))
    poses = space.draw(10_000, np.random.default_rng(2))
    places, counts = np.unique(poses[:, :2], axis=0, return_counts=True)
    assert places.tolist() == [[11.25, -9.25], [12.25, -8.25]]
    assert counts == pytest.approx([5000, 5000], rel=0.06)
    assert np.std(poses[:, 2]) == pytest.approx(math.tau / math.sqrt(12), rel=0.03)
    assert (11.1, -9.4) in space
    assert (10.1, -9.4) not in space
    assert (9.9, -9.4) not in space
    assert (12.6, -8.25) not in space
    assert (11.25, 40.0) not in space


@pytest.mark.parametrize("kind", ["beam", "likelihood_field", "likelihood_field_prob"])
def test_the_last_bit_changes_nothing(kind):
    """Machines differ in the last bit of sines and exponentials: the same particles are drawn for all that."""

    def run(noise):
        found = localizer(
            laser_model_type=kind, recovery_alpha_slow=0.001, recovery_alpha_fast=0.1, recovery_candidates=3
        )
        found.initialize((1.1, 0.9, 0.1), np.diag([0.04, 0.04, 0.02]))
        pose, odometry = (1.0, 1.0, 0.0), (0.0, 0.0, 0.0)
        random, counts = np.random.default_rng(1), []
        for _ in range(6):
            scan = seen(found, pose)
            scan = Scan(scan.ranges * (1 + noise * random.uniform(-1, 1, 90)), BEARINGS, 3.5)
            off = noise * random.uniform(-1, 1, found.filter.particles.shape)
            found.filter.particles = found.filter.particles * (1 + off)
            found.filter.weights = found.filter.weights * (1 + off[:, 0])
            found.update("scan", scan, odometry)
            counts.append(len(found.filter.particles))
            pose, odometry = compose(pose, (0.25, 0.0, 0.1)), compose(odometry, (0.26, 0.0, 0.09))
        return counts, found.filter.particles

    (one, particles), (other, again) = run(0.0), run(4e-16)
    assert one == other
    assert particles == pytest.approx(again, abs=1e-9)
