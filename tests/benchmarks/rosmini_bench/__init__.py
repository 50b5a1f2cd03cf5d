"""`rosmini bench`: measure rosmini, and in the same run real ROS and another simulator where installed.

Each figure is the median of several rounds in which rosmini and its peer take turns, so that a machine that slows down
slows both. Nothing is judged: a figure depends on the machine, the ratio much less.
"""

from __future__ import annotations

import json
import platform
import statistics
from contextlib import ExitStack
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from rosmini.core.errors import RosminiError
from rosmini.tools.collector import seldom

if TYPE_CHECKING:
    import argparse
    from collections.abc import Callable, Iterable, Iterator


@dataclass(frozen=True)
class Figure:
    """One row of the table: medians of ``ours`` and of the ``peer`` (None where there is none)."""

    name: str
    unit: str
    ours: float
    peer: float | None
    peer_name: str
    rounds: int
    more_is_better: bool = True

    @property
    def ratio(self) -> float | None:
        """How many times better than the peer, or None without one."""
        if self.peer is None or not self.ours or not self.peer:
            return None
        return self.ours / self.peer if self.more_is_better else self.peer / self.ours


@dataclass(frozen=True)
class Measure:
    """Something to measure: two functions that run it once and return the figure."""

    name: str
    unit: str
    ours: Callable[[], float]
    peer: Callable[[], float] | None = None
    peer_name: str = "rospy"
    more_is_better: bool = True
    once: bool = False
    """Measured only once: the result depends on the argument, and little or not at all on the machine's load."""

    def run(self, rounds: int) -> Figure:
        """Measure ``rounds`` times, taking turns."""
        ours: list[float] = []
        peer: list[float] = []
        rounds = 1 if self.once else rounds
        for _ in range(rounds):
            ours.append(self.ours())
            if self.peer is not None:
                peer.append(self.peer())
        return Figure(
            self.name,
            self.unit,
            statistics.median(ours),
            statistics.median(peer) if peer else None,
            self.peer_name,
            rounds,
            self.more_is_better,
        )


def table(figures: Iterable[Figure]) -> str:
    """Return the figures as an aligned text table."""
    rows = [("what", "rosmini", "peer", "", "times better")]
    for figure in figures:
        ratio = figure.ratio
        rows.append(
            (
                f"{figure.name} [{figure.unit}]",
                f"{figure.ours:,.3g}" if figure.ours < 100 else f"{figure.ours:,.0f}",
                "-" if figure.peer is None else f"{figure.peer:,.3g}" if figure.peer < 100 else f"{figure.peer:,.0f}",
                "" if figure.peer is None else figure.peer_name,
                "-" if ratio is None else f"{ratio:.1f}",
            )
        )
    widths = [max(len(row[column]) for row in rows) for column in range(5)]
    return "\n".join(
        f"{row[0]:<{widths[0]}}  {row[1]:>{widths[1]}}  {row[2]:>{widths[2]}} {row[3]:<{widths[3]}}  "
        f"{row[4]:>{widths[4]}}".rstrip()
        for row in rows
    )


SUBJECTS = ("graph", "wire", "tools", "sim", "rviz", "turtles", "nav")


def add_parser(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> object:
    """Add the subcommand's parser."""
    parser = subparsers.add_parser(
        "bench", help="measure rosmini, and real ROS where it is installed", description=__doc__
    )
    parser.add_argument(
        "subject",
        nargs="?",
        choices=SUBJECTS,
        help="graph, wire between processes, tools, simulator, RViz, turtles or navigation (default: all)",
    )
    parser.add_argument(
        "--rounds", type=int, default=3, metavar="N", help="rounds of which the median is shown (default: 3)"
    )
    parser.add_argument(
        "--scale", type=float, default=1.0, metavar="F", help="do F times the usual work in a round (default: 1)"
    )
    parser.add_argument("--json", type=Path, metavar="FILE", help="write the figures to FILE, too")
    parser.add_argument("--seed", type=int, default=1, metavar="N", help="of the goals of nav (default: 1)")
    parser.add_argument("--quick", action="store_true", help="few goals of nav: under five minutes")
    parser.add_argument("--rows", type=Path, metavar="FILE", help="append each of nav's goals to FILE, too")
    parser.add_argument("--no-peer", action="store_true", help="measure nothing else beside it")
    return parser


def main(args: argparse.Namespace) -> int:
    """Measure and print."""
    if args.rounds < 1 or not args.scale > 0:
        msg = "--rounds takes a whole number from 1 and --scale a positive one"
        raise RosminiError(msg)
    figures = []
    with seldom(), ExitStack() as peers:
        for measure in _measures(args, peers):
            figures.append(measure.run(args.rounds))
            print(".", end="", flush=True)
    print()
    print(table(figures))
    if args.json is not None:
        machine = {"machine": platform.machine(), "system": platform.system(), "python": platform.python_version()}
        rows = [{**asdict(figure), "ratio": figure.ratio} for figure in figures]
        args.json.write_text(json.dumps({"machine": machine, "figures": rows}, indent=2) + "\n", encoding="utf-8")
        print(f"written to {args.json}")
    if args.subject == "nav":
        from . import nav_explore, nav_located, nav_quality, nav_study

        nav_located.show(quick=args.quick)
        if args.quick:
            explored = nav_explore.run(worlds=("maze",), seeds=(args.seed,))
        else:
            explored = nav_explore.run(seeds=range(args.seed, args.seed + 20))
        found = nav_quality.run(args.seed, quick=args.quick)
        if args.rows is not None:
            commit = nav_quality.commit()
            lines = [nav_study.Line(commit, one) for one in explored]
            lines += [nav_study.Line(commit, one, setup) for setup, outcomes in found for one in outcomes]
            for line in lines:
                nav_study.append(line, args.rows)
            print(f"written to {args.rows}")
    return 0


def _measures(args: argparse.Namespace, peers: ExitStack) -> Iterator[Measure]:
    """What is to be measured; the peers that have to be stopped go to `peers`."""
    rospy = None
    if args.subject not in ("sim", "rviz", "nav"):
        from .peer import find_rospy

        rospy = None if args.no_peer else find_rospy()
        if rospy is not None:
            peers.callback(rospy.close)
        elif not args.no_peer:
            print("real ROS is not installed here: no peer")
    if args.subject in (None, "wire"):
        from . import wire

        yield from wire.measures(rospy, args.scale, peers)
    if args.subject in (None, "graph"):
        from . import graph

        yield from graph.measures(rospy, args.scale)
        from . import actions

        yield from actions.measures(rospy, args.scale)
        from . import transforms

        yield from transforms.measures(rospy, args.scale)
        from . import bags

        folder = bags.Folder()
        peers.callback(folder.close)
        rosbag = None if args.no_peer else bags.find_rosbag(folder.path)
        yield from bags.measures(folder.path, rosbag, args.scale)
    if args.subject in (None, "tools"):
        from . import launch_files

        yield from launch_files.measures(rospy, args.scale)
        from . import tools

        yield from tools.measures(rospy, args.scale)
    if args.subject in (None, "rviz"):
        from . import displays

        yield from displays.measures(args.scale)
    if args.subject in (None, "turtles"):
        from . import turtles

        yield from turtles.measures(args.scale)
    if args.subject in (None, "nav"):
        from . import nav

        yield from nav.measures(min(args.scale, 0.1) if args.quick else args.scale, args.seed)
    if args.subject in (None, "sim"):
        from . import sim
        from .sim_peer import find_irsim

        irsim = None if args.no_peer else find_irsim()
        if irsim is None and not args.no_peer:
            print("ir-sim is not installed here: no peer (pip install ir-sim)")
        yield from sim.measures(irsim, args.scale)
