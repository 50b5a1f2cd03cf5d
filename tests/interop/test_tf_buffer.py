"""The same transforms told to the real ``tf2_py.BufferCore`` and to our tree, the same questions asked of both."""

from __future__ import annotations

import json
import random
from pathlib import Path

import numpy as np
import pytest

from rosmini.core.tf import BufferCore, FrameTree, TransformException
from rosmini.core.tf.messages import to_stamped
from rosmini.core.tf.rigid import from_rpy, matrix

from ..conftest import nightly
from ..processes import run
from .conftest import SYSTEM_PYTHON, need_ros

PEER = Path(__file__).with_name("tf_buffer_peer.py")
MS = 1_000_000
S = 1000 * MS


@pytest.fixture(scope="module", autouse=True)
def _real() -> None:
    need_ros(modules="tf2_py, rospy")


def world(seed: int, *, wander: bool) -> dict[str, list]:
    """Two trees of random frames that move at random times, some static, some late, some twice.

    And questions of all kinds.
    """
    rng = random.Random(seed)

    def pose() -> list[float]:
        return list(from_rpy([rng.uniform(-5, 5) for _ in range(3)], *(rng.uniform(-3, 3) for _ in range(3))))

    frames = [f"f{number}" for number in range(14)]
    told = []
    for number in range(1, 14):
        if number == 9:
            continue  # the root of the second tree
        first = 0 if number < 9 else 9
        parent = frames[rng.randrange(first, number)]
        if rng.random() < 0.25:
            told.append((parent, frames[number], pose(), 0, True))
            continue
        if rng.random() < 0.05:
            told.append((parent, frames[number], pose(), 0, False))
            continue
        for _ in range(rng.randrange(1, 30)):
            if wander and rng.random() < 0.1:
                parent = frames[rng.randrange(first, number)]
            told.append((parent, frames[number], pose(), rng.randrange(1000, 16000, 50) * MS, False))
    told.sort(key=lambda item: item[3] + rng.randrange(0, 300) * MS)
    asked = []
    for _ in range(400):
        target, source = rng.choice([*frames, "nobody"]), rng.choice([*frames, "/f1", "f2"])
        when, then = (
            rng.choice([0, rng.randrange(500, 17000) * MS, rng.randrange(1000, 16000, 50) * MS]) for _ in "12"
        )
        asked.append((target, when, source, then, rng.choice(["", "", rng.choice(frames)])))
    latest = [(target, source) for target in [*frames, "nobody"] for source in [*frames, "/f1", "nobody"]]
    return {"cache": 6, "told": told, "asked": asked, "latest": latest}


def real_answers(task: dict[str, list]) -> dict[str, object]:
    done = run([SYSTEM_PYTHON, PEER], stdin=json.dumps(task), check=True)
    return json.loads(done.stdout)


def our_answers(task: dict[str, list]) -> tuple[list, BufferCore]:
    core = BufferCore(task["cache"])
    core.tree = FrameTree(task["cache"] * S)
    for parent, child, numbers, stamp, static in task["told"]:
        message = to_stamped(parent, child, tuple(numbers), stamp)
        (core.set_transform_static if static else core.set_transform)(message, "peer")
    answers = []
    for target, target_ns, source, source_ns, fixed in task["asked"]:
        try:
            if fixed:
                found = core.tree.lookup_full(target, target_ns, source, source_ns, fixed)
            else:
                found = core.tree.lookup(target, source, target_ns)
            answers.append([list(found.transform), found.stamp_ns])
        except TransformException as error:
            answers.append([type(error).__name__, 0])
    return answers, core


def better(real: str, ours: str) -> bool:
    """tf2 calls frames in two trees an extrapolation where an edge on the way is not known either.

    Ours names the graver cause.
    """
    return real == "ExtrapolationException" and ours == "ConnectivityException"


@pytest.mark.parametrize("wander", [False, True], ids=["steady", "wandering"])
@pytest.mark.parametrize("seed", [0, *nightly(*range(1, 8))])
def test_the_same_answers(seed: int, wander: bool) -> None:
    task = world(seed, wander=wander)
    real = real_answers(task)
    ours, core = our_answers(task)
    numbers = 0
    for question, (theirs, their_stamp), (mine, my_stamp) in zip(task["asked"], real["answers"], ours, strict=True):
        if isinstance(theirs, str) or isinstance(mine, str):
            assert theirs == mine or better(theirs, mine), question
        else:
            numbers += 1
            assert np.allclose(matrix(tuple(mine)), matrix(tuple(theirs)), atol=1e-9), question
            assert my_stamp == their_stamp, question
    assert numbers > 40
    for (target, source), theirs in zip(task["latest"], real["latest"], strict=True):
        try:
            mine: object = core.get_latest_common_time(target, source).to_nsec()
        except TransformException as error:
            mine = type(error).__name__
        assert mine == theirs or (theirs == "TransformException" and mine == "ConnectivityException"), (target, source)
