"""What the benchmark runs with the real tf2: the same tree, the same questions.

Run by the system's Python; prints the microseconds [CPU] of a lookup.
"""

from __future__ import annotations

import random
import sys
import time
from typing import Any

FRAMES = 1000
SAMPLES = 1000
"""10 s at 100 Hz."""
STEP_NS = 10_000_000
START_NS = 1_000_000_000
CHILDREN = 4


def parent(number: int) -> int:
    """Return under which frame a frame is: a tree with four children each."""
    return (number - 1) // CHILDREN


def questions(count: int) -> list[tuple[str, str, int]]:
    """Return pairs of frames of a small set, as a robot asks for, at random times within the buffer."""
    rng = random.Random(7)
    pairs = [(f"f{rng.randrange(FRAMES)}", f"f{rng.randrange(FRAMES)}") for _ in range(50)]
    return [(*rng.choice(pairs), START_NS + rng.randrange(STEP_NS, (SAMPLES - 1) * STEP_NS)) for _ in range(count)]


def main(count: int) -> None:
    """Fill the real buffer, ask it, and print what a lookup took and where all that was found adds up."""
    import rospy  # type: ignore[import-not-found]
    import tf2_py  # type: ignore[import-not-found]
    from geometry_msgs.msg import TransformStamped  # type: ignore[import-not-found,unused-ignore]

    buffer = tf2_py.BufferCore(rospy.Duration(10))
    message: Any = TransformStamped()
    message.transform.translation.x = message.transform.rotation.w = 1.0
    for sample in range(SAMPLES):
        message.header.stamp = rospy.Time(*divmod(START_NS + sample * STEP_NS, 1_000_000_000))
        for number in range(1, FRAMES):
            message.header.frame_id, message.child_frame_id = f"f{parent(number)}", f"f{number}"
            buffer.set_transform(message, "bench")
    asked = [(target, source, rospy.Time(*divmod(when, 1_000_000_000))) for target, source, when in questions(count)]
    begin = time.process_time()
    total = sum(buffer.lookup_transform_core(*one).transform.translation.x for one in asked)
    print((time.process_time() - begin) / count * 1e6, total)


if __name__ == "__main__":
    main(int(sys.argv[1]))
