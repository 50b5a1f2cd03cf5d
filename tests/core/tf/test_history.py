"""The samples of frames: what is kept, in whatever order it comes."""

import random

import pytest

from rosmini.core.tf.history import History, Samples
from rosmini.core.tf.kernel import sample

from ...conftest import nightly


def content(samples, history):
    """What is in the arrays for one frame."""
    begin, end = samples.spans[3 * history.number : 3 * history.number + 2]
    return [
        (samples.stamps[place], samples.source_of(samples.origins[place]).authority, sample(samples.values, place)[0])
        for place in range(begin, end)
    ]


@pytest.mark.parametrize("seed", [0, *nightly(*range(1, 10))])
def test_the_newest_are_kept_in_order(seed):
    """Three frames side by side against a plain model, with frames that are forgotten in between."""
    rng, samples = random.Random(seed), Samples()
    cache = rng.choice([5, 50, 500])
    histories, model = {}, {}
    for step in range(1500):
        name = rng.choice("abc")
        if name not in histories:
            histories[name] = History(name, samples, cache, "p", "", static=False)
            model[name] = {}
        kept = model[name]
        stamp = step + rng.choice([0, 0, 0, 1, -1, -3, -cache])
        authority = rng.choice(["x", "y"])
        outcome = histories[name].add("p", (step, 0, 0, 0, 0, 0, 1), stamp, authority)
        if stamp in kept:
            assert outcome == "repeated"
        elif kept and stamp < max(kept) - cache:
            assert outcome == "old"
        else:
            assert outcome == "kept"
            kept[stamp] = (stamp, authority, step)
            for old in [one for one in kept if one < max(kept) - cache]:
                del kept[old]
        assert content(samples, histories[name]) == sorted(kept.values())
        assert len(histories[name]) == len(kept)
        assert (histories[name].oldest_ns, histories[name].newest_ns) == (min(kept), max(kept))
        if rng.random() < 0.005:
            histories.pop(name).forget()
    for name, history in histories.items():
        assert content(samples, history) == sorted(model[name].values())


def test_what_is_forgotten_makes_room():
    """Frames that come and go, as when a bag is played in a loop, take no more memory than once."""
    samples = Samples()
    sizes = set()
    for _ in range(20):
        histories = [History(str(number), samples, 10**9, "p", "", static=False) for number in range(10)]
        for stamp in range(100):
            for history in histories:
                history.add("p", (0, 0, 0, 0, 0, 0, 1), stamp, "")
        for history in histories:
            history.forget()
        sizes.add(tuple(len(column) for column in samples.columns))
    assert len(sizes) == 1
