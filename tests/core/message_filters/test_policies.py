"""Which messages belong together: invariants, and small cases by hand."""

from __future__ import annotations

import itertools

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rosmini.core.message_filters import ApproximateTime, ExactTime, MessageFilterError

STORIES = st.integers(1, 4).flatmap(
    lambda count: st.tuples(
        st.just(count),
        st.lists(st.tuples(st.integers(0, count - 1), st.integers(0, 60)), max_size=60),
        st.integers(1, 6),
    )
)


def told(policy, story):
    """The sets for messages (input, stamp), which are numbered in the order of their arrival."""
    return [
        found
        for number, (index, stamp) in enumerate(story)
        for found in policy.add(index, stamp, (index, stamp, number))
    ]


def in_order(story, gap):
    """The same messages with stamps that increase by at least `gap` in each input.

    Inputs stay interleaved at random.
    """
    last = {}
    ordered = []
    for index, stamp in story:
        last[index] = last.get(index, 0) + gap + stamp % 7
        ordered.append((index, last[index]))
    return ordered


@given(STORIES, st.integers(1, 30))
def test_no_set_is_possible_any_more_that_was_complete_when_its_last_message_came(given_story, slop):
    """What is left in the queues with the message that came last is no set, by trial of all combinations."""
    count, story, queue_size = given_story
    policy = ApproximateTime(count, queue_size, slop)
    for number, (index, stamp) in enumerate(story):
        if policy.add(index, stamp, number) or stamp not in policy.queues[index]:
            continue
        others = [[stamp] if other == index else list(queue) for other, queue in enumerate(policy.queues)]
        assert not any(max(combination) - min(combination) < slop for combination in itertools.product(*others))


def test_the_nearest_partner_is_taken():
    policy = ApproximateTime(2, 10, 50)
    sets = told(policy, [(0, 0), (0, 30), (0, 40), (1, 33)])
    assert [[message[1] for message in one] for one in sets] == [[30, 33]]


def test_a_slop_is_not_reached():
    assert told(ApproximateTime(2, 10, 50), [(0, 0), (1, 50)]) == []
    assert len(told(ApproximateTime(2, 10, 50), [(0, 0), (1, 49)])) == 1


def test_the_oldest_stamps_are_dropped_first():
    policy = ExactTime(2, 2)
    assert told(policy, [(0, 3), (0, 1), (0, 2), (1, 1)]) == []
    assert len(told(policy, [(1, 3)])) == 1


def test_many_inputs_that_do_not_fit_together_are_given_up_quickly():
    """8 inputs of 60 candidates each: all combinations would be 60^7."""
    policy = ApproximateTime(8, 100, 1000)
    story = [(index, (index % 2) * 1100 + offset) for index in range(7) for offset in range(60)]
    assert told(policy, [*story, (7, 580)]) == []


@pytest.mark.parametrize(
    ("make", "problem"),
    [
        (lambda: ExactTime(0, 1), "nothing to synchronise"),
        (lambda: ExactTime(2, 0), r"queue_size is 0"),
        (lambda: ExactTime(2, 1.5), r"queue_size is 1\.5"),
        (lambda: ApproximateTime(2, 1, 0), "slop is 0"),
    ],
)
def test_sizes_with_which_nothing_would_ever_come_out_are_errors(make, problem):
    with pytest.raises(MessageFilterError, match=problem):
        make()
