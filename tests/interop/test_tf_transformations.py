"""Every function of our ``tf.transformations`` against the real one's answers."""

from __future__ import annotations

import json
import runpy
from pathlib import Path

import numpy as np
import pytest

from rosmini.core.tf import transformations

from ..processes import run
from .conftest import SYSTEM_PYTHON, need_ros

PEER = Path(__file__).with_name("transformations_peer.py")
answers = runpy.run_path(str(PEER))["answers"]

RARE = ("projection", "reflection", "scale", "shear")
ABSENT = {
    "Arcball", "arcball_constrain_to_axis", "arcball_map_to_sphere", "arcball_nearest_axis", "clip_matrix",
    "orthogonalization_matrix", "superimposition_matrix", *(f"{name}_matrix" for name in RARE),
    *(f"{name}_from_matrix" for name in RARE),
}  # fmt: skip
"""Functions of the real module that ours does not have: a mouse's trackball, and rare matrices."""


@pytest.fixture(scope="module")
def real() -> dict[str, object]:
    need_ros(modules="tf.transformations")
    return json.loads(run([SYSTEM_PYTHON, PEER], check=True).stdout)


def numbers(value: object) -> np.ndarray:
    parts = value if isinstance(value, list) else [value]
    return np.concatenate([np.ravel(np.asarray(part, dtype=float)) for part in parts]) if parts else np.zeros(0)


def test_all_answers_are_the_real_ones(real: dict[str, object]) -> None:
    ours = answers(transformations)
    assert ours.keys() == real.keys()
    assert len(ours) > 1000
    wrong = [
        (key, real[key], mine)
        for key, mine in ours.items()
        if (isinstance(mine, str) and mine != real[key])
        or (not isinstance(mine, str) and not np.allclose(numbers(mine), numbers(real[key]), atol=1e-8))
    ]
    assert wrong == []


def test_no_other_name_is_missing(real: dict[str, object]) -> None:
    listing = (
        "import inspect, tf.transformations as t; "
        "print(*[n for n, f in vars(t).items() if n[0] != '_' and (inspect.isfunction(f) or inspect.isclass(f))])"
    )
    done = run([SYSTEM_PYTHON, "-c", listing], check=True)
    assert set(done.stdout.split()) - set(transformations.__all__) == ABSENT
