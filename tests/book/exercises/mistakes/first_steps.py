"""Wrong answers to the exercise of the first steps, which its check has to refuse: right ones with one fault."""

from __future__ import annotations

from .nodes_and_master import wrong
from .published import solution

STOP = solution("first_steps", "first_stop")

MISTAKES = {
    "first_stop": [
        wrong("stop.py", STOP, "< 0.5", "> 0.5"),
        wrong("stop.py", STOP, "< 0.5", "< 0.0"),
        wrong("stop.py", STOP, "< 0.5", "< 2.0"),
        wrong("stop.py", STOP, "ranges[0]", "ranges[90]"),
        wrong("stop.py", STOP, "scan.ranges[0]", "scan.range"),
        wrong("stop.py", STOP, "x = 0.0", "x = 0.1"),
        wrong("stop.py", STOP, "linear.x = 0.0", "linear = 0"),
    ]
}
