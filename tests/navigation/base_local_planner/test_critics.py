"""Critics of velocities, and how the numbers of all are put together."""

from __future__ import annotations

import numpy as np

from rosmini.navigation.base_local_planner.scored_sampling import Oscillation, combined_scores, twirling


def test_who_has_turned_left_and_right_may_not_turn_left_again():
    left, right = np.array([0.0, 0, 1]), np.array([0.0, 0, -1])
    critic = Oscillation()
    critic.update((0, 0, 0), left, 0.1)
    assert critic.score(np.array([left, right])).tolist() == [0, 0]
    critic.update((0, 0, 0), right, 0.1)
    assert critic.score(np.array([left, right])).tolist() == [-5, 0]
    critic.update((0, 0, -0.1), right, 0.1)
    assert critic.score(np.array([left])).tolist() == [-5]
    critic.update((0, 0, -0.3), right, 0.1)
    assert critic.score(np.array([left])).tolist() == [0]


def test_turns_do_not_count_while_it_drives_on():
    critic = Oscillation()
    for turn in (1.0, -1.0, 1.0):
        critic.update((0, 0, 0), np.array([0.3, 0, turn]), 0.1)
    assert critic.score(np.array([[0.3, 0, -1.0]])).tolist() == [0]
    critic.update((0, 0, 0), np.array([-0.1, 0, 0]), 0.1)
    assert critic.score(np.array([[0.3, 0, 0.0], [-0.1, 0, 0]])).tolist() == [-5, 0]


def test_the_first_critic_that_rejects_decides_and_one_without_weight_is_not_asked():
    raw = np.array([[0.0, 1, 2], [-5, -1, 2], [0, -3, -2], [0, 0, -2]])
    totals, rejected_by = combined_scores(raw, np.array([1.0, 2.0, 0.0]))
    assert totals.tolist() == [2, -5, -3, 0]
    assert rejected_by.tolist() == [-1, 0, 1, -1]


def test_twirling_costs_the_turning_speed():
    commands = np.array([[0.5, 0, -0.3], [-0.1, 0, 0], [0.05, 0, 0.1]])
    assert np.allclose(twirling(commands), [0.3, 0, 0.1])
