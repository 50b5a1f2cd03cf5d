"""`rosmini test`: the tests of launch files, as rostest runs them, in simulated time."""

from __future__ import annotations

import argparse
import sys
import tempfile
from pathlib import Path

from rosmini.core.names import is_remapping

from .signals import end_as_ctrl_c

EPILOG = """\
Each <test> of the file is run with all its <node>s beside it, in one graph: a script with unittest, that calls
rostest.rosrun(PACKAGE, NAME, CLASS) or ends with an exit status. The exit status is 0 if all pass.

for example: rosmini test my_package talker.test rate:=10 --results results.xml
"""


def add_parser(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> argparse.ArgumentParser:
    """Add `test`."""
    parser = subparsers.add_parser(
        "test",
        help="run the tests of launch files",
        description=__doc__,
        epilog=EPILOG,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("--results", metavar="FILE", help="write the results as JUnit XML")
    parser.add_argument("--wall-time", action="store_true", help="in wall time instead of simulated time")
    parser.add_argument("words", nargs="+", metavar="[PACKAGE] FILE [NAME:=VALUE]")
    return parser


def main(args: argparse.Namespace) -> int:
    """Run the tests and print the results."""
    from rosmini.core.packages import PackageIndex
    from rosmini.ros.launch import find_file, read
    from rosmini.ros.launch.testing import run_tests

    packages = PackageIndex()
    files = find_file([word for word in args.words if not is_remapping(word)], packages)
    given = dict(word.split(":=", 1) for word in args.words if is_remapping(word))
    plan = read(*files, args=given, packages=packages)
    if not plan.tests:
        print(f"rosmini test: there is no <test> in {', '.join(files)}", file=sys.stderr)
        return 1
    end_as_ctrl_c()
    with tempfile.TemporaryDirectory() as folder:
        results = run_tests(plan, Path(folder), simulated=not args.wall_time, packages=packages)
    print(results)
    if args.results is not None:
        results.write(args.results)
    return 0 if results.passed else 1
