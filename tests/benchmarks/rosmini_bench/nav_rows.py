"""Goals that were driven to, kept as data, and the book's page about them.

`rosmini bench nav --rows FILE` writes such a file; the one in assets/benchmarks makes `book/navigation_figures.md`:

    PYTHONPATH=tests/benchmarks uv run python -m rosmini_bench.nav_rows
"""

from __future__ import annotations

import json
from collections.abc import Iterable
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

from . import nav_quality
from .nav_goals import Errand
from .nav_trial import FIELD, Outcome, Setup

ROOT = Path(__file__).resolve().parents[3]
FILE = ROOT / "assets" / "benchmarks" / "navigation.json"
PAGE = ROOT / "book" / "navigation_figures.md"

Found = list[tuple[Setup, list[Outcome]]]


@dataclass(frozen=True)
class Kept:
    """What a file holds."""

    seed: int
    commit: str
    found: Found


def store(kept: Kept, file: Path) -> None:
    """Write goals to a file, lengths and times to the millimetre and millisecond."""
    setups = [
        {
            **{name: value for name, value in asdict(setup).items() if name != "seed"},
            "goals": [_plain(one) for one in outcomes],
        }
        for setup, outcomes in kept.found
    ]
    lines = [f' "seed": {kept.seed},', f' "commit": {json.dumps(kept.commit)},', ' "setups": [']
    for i, setup in enumerate(setups):
        goals = setup.pop("goals")
        head = json.dumps(setup)[:-1]
        rows = ",\n   ".join(json.dumps(goal) for goal in goals)
        lines.append(f'  {head}, "goals": [\n   {rows}\n  ]}}{"," if i + 1 < len(setups) else ""}')
    file.write_text("\n".join(["{", *lines, " ]", "}"]) + "\n", encoding="utf-8")


def _plain(one: Outcome) -> dict[str, Any]:
    def rounded(value: Any) -> Any:
        if isinstance(value, float):
            return round(value, 3)
        if isinstance(value, dict):
            return {name: rounded(each) for name, each in value.items()}
        return [rounded(each) for each in value] if isinstance(value, (list, tuple)) else value

    plain: dict[str, Any] = rounded(asdict(one))
    return plain


def load(file: Path) -> Kept:
    """Read what `store` wrote."""
    data = json.loads(file.read_text(encoding="utf-8"))
    found: Found = []
    for each in data["setups"]:
        goals = each.pop("goals")
        each["overrides"] = tuple((name, value) for name, value in each["overrides"])
        found.append((Setup(**each, seed=data["seed"]), [_outcome(goal) for goal in goals]))
    return Kept(data["seed"], data["commit"], found)


def _outcome(goal: dict[str, Any]) -> Outcome:
    errand = goal.pop("errand")
    start, end = tuple(errand.pop("start")), tuple(errand.pop("goal"))
    goal.update({name: tuple(goal[name]) for name in ("contacts", "bumps", "recoveries")})
    return Outcome(Errand(**errand, start=start, goal=end), **goal)


# -- the page ----------------------------------------------------------------------------------------------------------


def page(kept: Kept) -> str:
    """The page, as MyST."""
    worlds = [(setup, found) for setup, found in kept.found if setup.world != FIELD]
    fields = [(setup, found) for setup, found in kept.found if setup.world == FIELD]
    failed = [
        (setup, one)
        for setup, found in kept.found
        for one in found
        if not one.reached(nav_quality.XY, nav_quality.YAW) or one.contacts
    ]
    return (
        "\n".join(
            [
                *INTRODUCTION.format(seed=kept.seed, commit=kept.commit).splitlines(),
                "",
                *_table(worlds),
                "",
                "## Between cylinders that are not in the map",
                "",
                "Gaps are in widths of the burger, 0.21 m. The planner knows of a cylinder when the laser sees it.",
                "",
                *_table(fields),
                "",
                "## Each failure",
                "",
                "`C` are contacts: how often the robot drove into something.",
                "",
                "| setup | goal | from | to | result | driven | C |",
                "|---|---|---|---|---|---|---|",
                *(_failure(setup, one) for setup, one in failed),
                "",
                *CAUSES.splitlines(),
            ]
        )
        + "\n"
    )


def _table(found: Iterable[tuple[Setup, list[Outcome]]]) -> list[str]:
    head = "| setup | reached | 95 % | contacts | length | 95th | time | 95th |"
    lines = [head, "|---|---|---|---|---|---|---|---|"]
    for setup, outcomes in found:
        one = nav_quality.row(setup, outcomes)
        figures = [_number(each) for each in (one.stretch, one.stretch95, one.slowness, one.slowness95)]
        lines.append(
            f"| {one.what} | {one.reached} of {one.count} | {one.low:.0%} to {one.high:.0%} | {one.contacts} | "
            f"{' | '.join(figures)} |"
        )
    return lines


def _number(value: float) -> str:
    return "" if value != value else f"{value:.2f}"


def _failure(setup: Setup, one: Outcome) -> str:
    places = (f"{pose[0]:.1f}, {pose[1]:.1f}" for pose in (one.errand.start, one.errand.goal))
    reached = one.reached(nav_quality.XY, nav_quality.YAW)
    why = "reached" if reached else nav_quality.reason(one, nav_quality.XY, nav_quality.YAW)
    why = why.replace(" Even after executing recovery behaviors.", "").rstrip(".")
    driven = f"{one.driven:.1f} of {one.errand.shortest:.1f} m"
    return f"| {setup.words} | {one.errand.number} | {' | '.join(places)} | {why} | {driven} | {len(one.contacts)} |"


INTRODUCTION = """# Navigation in figures

How often does the navigation stack of this book get a robot to its goal? Here a burger, and a waffle, were sent to
goals drawn at random (seed {seed}, commit {commit}) with the parameter files of `turtlebot3_navigation`, one for
all worlds. Starts and goals are where a disc of 0.20 m has room, at least 3 m apart, with any heading. The laser
turns five times a second, its beams are taken while the robot moves, and have noise; `fake_localization` says
where the robot is. Reached means that `move_base` said SUCCEEDED, and that the true pose was within the
tolerances. The interval is Wilson's. Contacts are the goals on whose way the robot drove into something, as the
engine counts them.

Length is what was driven, over the shortest path that keeps 0.15 m from everything in the map; time is what it
took, over that path at full speed with its turns. Both are medians and 95th percentiles of the goals that were
reached. The table was generated from the rows in `assets/benchmarks/navigation.json`; `rosmini bench nav --seed 2
--rows FILE` drives to others.
"""

CAUSES = """## Where it fails, and why

The footprint of a burger has an inscribed radius of 5 cm with padding, since its origin is near its front. That is
all that a plan keeps. So plans lead where the whole footprint has no room: between the legs of a chair, through a
gap of two robot widths between cylinders. The local planner, which looks at all four edges, then finds no velocity
without a collision; the recoveries clear what the laser sees again a moment later, and the goal is aborted.
{doc}`../notebooks/39_move_base` shows how `explain()` says so. In the office a second cause is a door
that the robot saw closed and cannot see open, for its leaf hides the opening: the plan waits for a way that is
free. Doors keep away from a robot, and one that would press against it goes back: a robot that waits where the door
swings waits for good, since the plan waits for the door, and the door for the robot.
`carrot_planner` plans no way around a wall: it goes straight to the last free place before it.
"""


def main() -> None:
    """Write the page."""
    PAGE.write_text(page(load(FILE)), encoding="utf-8")


if __name__ == "__main__":
    main()
