"""The three laser models: what they prefer, and what they make of beams that are none."""

from __future__ import annotations

import math

import numpy as np
import pytest

from rosmini.navigation.amcl.field import BeamMixture, LikelihoodField
from rosmini.navigation.amcl.laser import BeamSkip, LaserModel, Scan

KINDS = ("beam", "likelihood_field", "likelihood_field_prob")
BEARINGS = np.arange(60) * math.tau / 60


@pytest.fixture(scope="module")
def field():
    """A room of 4 x 3 m with a box in it, so that no two headings look alike."""
    occupied = np.zeros((60, 80), dtype=bool)
    occupied[[0, -1], :] = occupied[:, [0, -1]] = True
    occupied[30:42, 50:58] = True
    return LikelihoodField(occupied, 0.05, (0.0, 0.0))


def scan_from(field, pose, laser=(0.0, 0.0, 0.0), range_max=5.0):
    from rosmini.core.geometry.poses import compose

    ranges = field.ranges(np.array([compose(pose, laser)]), BEARINGS, range_max)[0]
    return Scan(ranges, BEARINGS, range_max, laser)


@pytest.mark.parametrize("kind", KINDS)
def test_the_truth_is_likeliest(field, kind):
    truth = (1.0, 1.2, 0.4)
    scan = scan_from(field, truth, laser=(0.1, 0.0, 0.2))
    offsets = [(0, 0, 0), (0.3, 0, 0), (0, -0.3, 0), (0, 0, 0.3), (0.9, 0.4, 1.0)]
    particles = np.array(truth) + np.array(offsets)
    found = LaserModel(kind, max_beams=60).log_likelihoods(field, particles, scan)
    assert np.argmax(found) == 0
    assert (found[0] > found[1:] + 0.05).all()


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("bad", [math.nan, math.inf, 5.0])
def test_beams_that_hit_nothing_do_not_count(field, kind, bad):
    """A scan of nothing but such beams says the same of all particles, or nothing of the map."""
    particles = np.array([(1.0, 1.0, 0.0), (2.0, 2.0, 1.0)])
    scan = Scan(np.full(60, bad), BEARINGS, 5.0)
    found = LaserModel(kind).log_likelihoods(field, particles, scan)
    assert np.isfinite(found).all()
    if kind != "beam":
        assert (found == 0.0).all()


@pytest.mark.parametrize("kind", KINDS)
def test_a_laser_that_is_upside_down_sees_its_beams_the_other_way_round(field, kind):
    truth = np.array([(1.0, 1.2, 0.4)])
    upright = scan_from(field, tuple(truth[0]))
    turned = Scan(upright.ranges, -BEARINGS, 5.0, upside_down=True)
    model = LaserModel(kind, max_beams=60)
    assert model.log_likelihoods(field, truth, turned) == pytest.approx(model.log_likelihoods(field, truth, upright))
    backwards = Scan(upright.ranges[::-1], BEARINGS[::-1], 5.0)
    assert model.log_likelihoods(field, truth, backwards) == pytest.approx(model.log_likelihoods(field, truth, upright))


def test_the_density_of_a_beam_is_that_of_the_formula(field):
    """One beam of 1 m where the map says more: hit, too short, random; and one that saw nothing."""
    mixture = BeamMixture(0.6, 0.2, 0.1, 0.1, 0.2, 0.5)
    particle = np.array([(1.0, 1.0, math.pi)])
    expected = field.ranges(particle, np.zeros(1), 5.0)[0, 0]
    assert expected == pytest.approx(0.95, abs=5e-5)

    def density(measured):
        scan = Scan(np.array([measured, measured]), np.zeros(2), 5.0)
        return math.expm1(LaserModel("beam", mixture, 2).log_likelihoods(field, particle, scan)[0]) / 2

    off = 0.7 - expected
    hit = 0.6 * math.exp(-(off**2) / (2 * 0.2**2))
    assert density(0.7) == pytest.approx((hit + 0.2 * 0.5 * math.exp(-0.5 * 0.7) + 0.1 / 5) ** 3, rel=1e-6)
    assert density(5.0) == pytest.approx((0.6 * math.exp(-((5 - expected) ** 2) / 0.08) + 0.1) ** 3, rel=1e-6)


def test_beams_that_most_particles_cannot_explain_are_skipped_once_converged(field):
    truth = np.array([(1.0, 1.2, 0.4), (1.02, 1.2, 0.4)])
    scan = scan_from(field, tuple(truth[0]))
    people = scan.ranges.copy()
    people[:12] = 0.3
    seen = Scan(people, BEARINGS, 5.0)
    model = LaserModel("likelihood_field_prob", max_beams=60, skip=BeamSkip(0.2, 0.5, 0.9))
    plain = LaserModel("likelihood_field_prob", max_beams=60)
    assert model.log_likelihoods(field, truth, seen) == pytest.approx(plain.log_likelihoods(field, truth, seen))
    skipped = model.log_likelihoods(field, truth, seen, converged=True)
    rest = Scan(np.delete(scan.ranges, range(12)), np.delete(BEARINGS, range(12)), 5.0)
    assert skipped == pytest.approx(plain.log_likelihoods(field, truth, rest), abs=1e-3)
    lost = np.array([(3.0, 2.6, 2.0), (3.0, 2.5, 2.0)])
    strict = LaserModel("likelihood_field_prob", max_beams=60, skip=BeamSkip(0.01, 0.5, 0.1))
    assert strict.log_likelihoods(field, lost, seen, converged=True) == pytest.approx(
        plain.log_likelihoods(field, lost, seen)
    ), "if nearly all beams would go, none does"
