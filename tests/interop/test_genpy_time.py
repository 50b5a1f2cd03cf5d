"""Every operation on times and durations: the same result, text and kind of error as the real genpy's."""

import itertools
import json

from rosmini.core import time as ours

from ..processes import run
from .conftest import SYSTEM_PYTHON, need_ros

# Run in this process on our classes and in a system Python on genpy's.
TABLE = """
import copy, itertools, operator, pickle
VALUES = [
    "Time(0)", "Time(1)", "Time(1, 500000000)", "Time(1.25)", "Time(1, 2500000000)", "Time(5, -1)",
    "Time.from_sec(1.1)", "TVal(2, 3)",
    "Duration(0)", "Duration(-0.5)", "Duration(3, 700000000)", "Duration(-2, -1)", "Duration.from_sec(-1.1)",
    "Duration(True)",
    "0", "2", "-3", "0.3", "1.5", "'x'", "None", "[1]", "True",
]
BINARY = ["add", "sub", "mul", "truediv", "floordiv", "mod", "lt", "le", "gt", "ge", "eq", "ne"]
UNARY = ["repr(v)", "str(v)", "bool(v)", "hash(v)", "v.to_sec()", "v.to_nsec()", "v.is_zero()", "-v", "abs(v)",
         "[v.secs, v.nsecs]",
         "v.to_time()", "copy.deepcopy(v)", "pickle.loads(pickle.dumps(v))", "v.set(1, 3000000000) or v.canon() or v",
         "v.set(1, 3000000000) or v", "v._slot_types", "sorted(v.__slots__)", "v.__cmp__(Time(1))",
         "v.__cmp__(Duration(1))"]
MAKE = ["Time(-1)", "Time(0, -1)", "Time(1.5, 2)", "Duration(1.5, 2)", "Time('x')", "Time(None)", "Time.from_sec(-1)",
        "Duration(1, 'x')",
        "Time(1) - Duration(2)", "Time(3) - Time(5)", "Duration(2**40)", "Time(1, 1.5)", "Duration.from_sec('x')",
        "Time(float('inf'))",
        "sum([Duration(1), Duration(2)], Duration(0))", "max(Time(1), Time(2))", "sorted([Duration(2), Duration(-1)])"]
def answer(code, names):
    try:
        return repr(eval(code, names))
    except Exception as error:
        return type(error).__name__
def table(module):
    names = {"Time": module.Time, "Duration": module.Duration, "TVal": module.TVal}
    names.update({"copy": copy, "pickle": pickle, "operator": operator})
    codes = list(MAKE)
    codes += ["(lambda v: %s)(%s)" % (u, v) for v in VALUES[:14] for u in UNARY]
    pairs = [pair for pair in itertools.product(VALUES, VALUES) if "(" in "".join(pair)]
    codes += ["operator.%s(%s, %s)" % (op, a, b) for op in BINARY for a, b in pairs]
    codes += ["divmod(%s, %s)" % (a, b) for a, b in itertools.product(VALUES[7:14], VALUES[7:18])]
    return [[code, answer(code, names)] for code in codes]
"""


def test_the_whole_table_is_genpys() -> None:
    script = TABLE + "\nimport json, genpy.rostime\nprint(json.dumps(table(genpy.rostime)))"
    need_ros(modules="genpy")
    done = run([SYSTEM_PYTHON, "-c", script], check=True)
    names: dict = {}
    exec(TABLE, names)
    theirs, mine = json.loads(done.stdout), names["table"](ours)
    assert len(theirs) > 3000
    assert [(a[0], "genpy", a[1], "ours", b[1]) for a, b in itertools.zip_longest(theirs, mine) if a != b] == []
