"""A study of navigation that may be cut off at any time: each goal, exploration and crossing is a line of a file.

    PYTHONPATH=tests/benchmarks python -m rosmini_bench.nav_study FILE house=0-59 office,amcl=0-29 cylinders:2=0-9 \
        explore_lite:maze=1-3 explore_lite:office,walkers=1-5 \
        crossing:4=1-5 house,waffle=0-9 house,trajectory,robotis=0-9 office,walkers=0-9

Who asks again for what is in the file gets no second drive. `nav_rows` makes the book's page of such a file.
"""

from __future__ import annotations

import argparse
import json
from collections.abc import Iterator
from dataclasses import asdict, dataclass, fields
from functools import cache
from pathlib import Path
from typing import Any

from rosmini.core.errors import RosminiError

from . import nav_crossing, nav_explore, nav_quality, nav_trial
from .nav_crossing import Crossing
from .nav_explore import Explored
from .nav_goals import Errand
from .nav_trial import FIELD, Outcome, Setup

CYLINDERS, CROSSING = "cylinders", "crossing"
WORDS: dict[str, dict[str, Any]] = {
    "amcl": {"localization": "amcl"},
    "burger": {"model": "burger"},
    "waffle": {"model": "waffle"},
    "trajectory": {"overrides": nav_quality.TRAJECTORY},
    "global_planner": {"overrides": nav_quality.PLANNERS[0]},
    "robotis": {"careful": False},
    "still": {"sweep": False},
    "walkers": {"without": "door"},
    "doors": {"without": "walker"},
    "narrow": {"narrow": True},
}
"""What may stand behind a world, and what it changes."""


@dataclass(frozen=True)
class Line:
    """What came of one drive, and of which commit."""

    commit: str
    result: Outcome | Explored | Crossing
    setup: Setup | None = None
    """Of a goal."""


def append(line: Line, file: Path) -> None:
    """Write one more line to a file, lengths and times to the millimetre and millisecond."""
    kind = type(line.result).__name__.lower()
    data = {"commit": line.commit, kind: _rounded(asdict(line.result))}
    if line.setup is not None:
        usual = asdict(Setup(line.setup.world))
        setup = {name: value for name, value in asdict(line.setup).items() if value != usual[name]}
        data["setup"] = {"world": line.setup.world, **setup}
    with file.open("a", encoding="utf-8") as out:
        out.write(json.dumps(data) + "\n")


def _rounded(value: Any) -> Any:
    if isinstance(value, float):
        return round(value, 3)
    if isinstance(value, dict):
        return {name: _rounded(each) for name, each in value.items()}
    return [_rounded(each) for each in value] if isinstance(value, (list, tuple)) else value


def load(file: Path) -> list[Line]:
    """Read what `append` wrote."""
    return [_line(json.loads(text)) for text in file.read_text(encoding="utf-8").splitlines()]


def _line(data: dict[str, Any]) -> Line:
    if "outcome" in data:
        setup = data["setup"]
        overrides = tuple((name, value) for name, value in setup.pop("overrides", ()))
        return Line(data["commit"], _outcome(data["outcome"]), Setup(**setup, overrides=overrides))
    kind = Explored if "explored" in data else Crossing
    return Line(data["commit"], _tupled(kind, data[kind.__name__.lower()]))


def _outcome(goal: dict[str, Any]) -> Outcome:
    errand = _tupled(Errand, goal.pop("errand"))
    outcome: Outcome = _tupled(Outcome, {**goal, "errand": errand})
    return outcome


def _tupled(kind: type[Any], data: dict[str, Any]) -> Any:
    assert set(data) <= {each.name for each in fields(kind)}
    return kind(**{name: tuple(value) if isinstance(value, list) else value for name, value in data.items()})


# -- driving -----------------------------------------------------------------------------------------------------------


def drive(item: str, seed: int, done: set[tuple[Any, int]], commit: str) -> Iterator[Line]:
    """Drive one item of the command line, except for what is done."""
    name, _, numbers = item.partition("=")
    first, _, last = numbers.partition("-")
    wanted = range(int(first), int(last or first) + 1)
    what, *more = name.split(",")
    kind, _, rest = what.partition(":")
    if kind in nav_explore.FILES:
        without = "".join(_word(each).get("without", "") for each in more)
        for number in wanted:
            if ((kind, rest, without), number) not in done:
                yield Line(commit, nav_explore.explore(rest, kind, number, without=without))
    elif kind == CROSSING:
        for number in wanted:
            if (what, number) not in done:
                yield Line(commit, nav_crossing.run(int(rest), number))
    else:
        setup = _setup(kind, rest, more, seed)
        for number in wanted:
            if (setup, number) not in done:
                yield Line(commit, nav_trial.run(setup, _errands(setup, wanted.stop)[number]), setup)


@cache
def _errands(setup: Setup, count: int) -> list[Errand]:
    return list(nav_trial.drawn(setup, count))


def _setup(kind: str, rest: str, more: list[str], seed: int) -> Setup:
    setup: dict[str, Any] = {"world": FIELD if kind == CYLINDERS else kind, "seed": seed}
    if kind == CYLINDERS:
        setup["gap"] = float(rest)
    elif rest or kind not in nav_quality.WORLDS:
        raise RosminiError(f"{kind}: name one of {', '.join((*nav_quality.WORLDS, CYLINDERS, *nav_explore.FILES))}")
    for each in more:
        setup.update(_word(each))
    return Setup(**setup)


def _word(each: str) -> dict[str, Any]:
    if each not in WORDS:
        raise RosminiError(f"{each}: name one of {', '.join(WORDS)}")
    return WORDS[each]


def key(line: Line) -> tuple[Any, int]:
    """What a line is of, and which of them."""
    one = line.result
    if isinstance(one, Outcome):
        return line.setup, one.errand.number
    if isinstance(one, Explored):
        return (one.method, one.world, one.without), one.seed
    return f"{CROSSING}:{one.robots}", one.seed


def main() -> None:
    """Drive, and write."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("file", type=Path)
    parser.add_argument("items", nargs="+", metavar="WHAT=FIRST-LAST")
    parser.add_argument("--seed", type=int, default=7, help="of the goals")
    chosen = parser.parse_args()
    done = {key(line) for line in load(chosen.file)} if chosen.file.exists() else set()
    commit = nav_quality.commit()
    for item in chosen.items:
        for line in drive(item, chosen.seed, done, commit):
            append(line, chosen.file)
            print(item, told(line), flush=True)


def told(line: Line) -> str:
    """A line in short."""
    one = line.result
    if isinstance(one, Explored):
        return one.line()
    if isinstance(one, Crossing):
        return f"{one.reached} of {one.robots} reached, {one.failures} {one.charged} {one.seconds:.0f} s"
    return (
        f"{one.errand.number} {one.status} {one.text} {one.seconds:.0f} s {one.driven:.1f} of "
        f"{one.errand.shortest:.1f} m, {one.off:.2f} m off, {one.contacts} {one.bumps} {one.recoveries}"
    )


if __name__ == "__main__":
    main()
