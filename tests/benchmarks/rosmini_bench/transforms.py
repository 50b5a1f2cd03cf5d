"""What is measured of transforms: lookups in a tree of 1,000 frames, each of 10 s at 100 Hz, beside the real tf2."""

from __future__ import annotations

import subprocess
import time
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING

from rosmini.core.errors import RosminiError
from rosmini.core.tf import BufferCore
from rosmini.core.tf.rigid import from_rpy
from rosmini.core.tf.tree import LOOKUPS_LOADED
from rosmini.core.time import Time

from . import Measure
from .tf_node import FRAMES, SAMPLES, START_NS, STEP_NS, parent, questions

if TYPE_CHECKING:
    from .peer import Rospy

FIRST = 200
"""So many lookups are asked before the walk is compiled."""

NODE = Path(__file__).with_name("tf_node.py")


class Full:
    """A full tree, which is made when it is first asked: each frame stands 1 m ahead of its parent, at all times."""

    def __init__(self) -> None:
        self._buffer: BufferCore | None = None
        self._is_compiled = False

    def compiled_us(self, count: int) -> float:
        """Return the microseconds of a lookup by a buffer that walks in machine code, as one that is asked often does.

        That begins by itself, sooner in a process that has loaded numba for something else, as simulators do.
        """
        import numba  # noqa: F401 - loading it is what matters

        if not self._is_compiled:
            self._is_compiled = True
            self.lookup_us(LOOKUPS_LOADED)
        return self.lookup_us(count)

    def buffer(self) -> BufferCore:
        """Return the tree's buffer."""
        if self._buffer is None:
            self._buffer = BufferCore()
            tree = self._buffer.tree
            step = from_rpy((1.0, 0.0, 0.0), 0.0, 0.0, 0.0)
            names = [f"f{number}" for number in range(FRAMES)]
            for sample in range(SAMPLES):
                for number in range(1, FRAMES):
                    tree.set(names[parent(number)], names[number], step, START_NS + sample * STEP_NS, "bench")
        return self._buffer

    def lookup_us(self, count: int) -> float:
        """Return the microseconds [CPU] of a lookup between two samples: the same call as that of the real tf2."""
        buffer = self.buffer()
        asked = [(target, source, Time.from_nsec(when)) for target, source, when in questions(count)]
        begin = time.process_time()
        total = sum(buffer.lookup_transform_core(*one).transform.translation.x for one in asked)
        seconds = time.process_time() - begin
        check(total, count)
        return seconds / count * 1e6


def check(total: float, count: int) -> None:
    """Raise `RosminiError` if what was found is not what it has to be: depths differ by so many metres."""
    expected = sum(depth(source) - depth(target) for target, source, _ in questions(count))
    if abs(total - expected) > 1e-6 * max(1.0, abs(expected)):
        msg = f"the lookups add up to {total} m, not {expected} m: they were wrong, so there is no figure"
        raise RosminiError(msg)


def depth(frame: str) -> int:
    """Return how far below the root a frame is."""
    number, found = int(frame[1:]), 0
    while number:
        number, found = parent(number), found + 1
    return found


def real_lookup_us(python: str, count: int) -> float:
    """Return the microseconds that a lookup of the real tf2 takes, called from Python."""
    done = subprocess.run([python, str(NODE), str(count)], capture_output=True, check=True, encoding="utf-8")
    microseconds, total = map(float, done.stdout.split())
    check(total, count)
    return microseconds


def has_tf2(rospy: Rospy) -> bool:
    """Tell whether the real tf2 is installed beside the real rospy."""
    return subprocess.run([rospy.python, "-c", "import tf2_py"], capture_output=True, check=False).returncode == 0


def measures(rospy: Rospy | None, scale: float) -> Iterator[Measure]:
    """Yield everything that is measured."""
    count, full = max(int(50_000 * scale), 100), Full()
    python = rospy.python if rospy is not None and has_tf2(rospy) else None
    yield Measure(
        "one of the first tf lookups of a process, in plain Python, CPU",
        "us",
        lambda: full.lookup_us(FIRST),
        None,
        more_is_better=False,
    )
    yield Measure(
        "tf lookup at a time, 1,000 frames of 10 s at 100 Hz, CPU",
        "us",
        lambda: full.compiled_us(count),
        None if python is None else lambda: real_lookup_us(python, count),
        more_is_better=False,
    )
