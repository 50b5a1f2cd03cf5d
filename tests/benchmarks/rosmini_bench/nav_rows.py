"""Goals that were driven to and worlds that were explored, kept as data, and the book's page about them.

`rosmini bench nav --rows FILE` and `python -m rosmini_bench.nav_explore --rows FILE` write into such a file; the one in
assets/benchmarks makes `book/navigation_figures.md`:

    PYTHONPATH=tests/benchmarks uv run python -m rosmini_bench.nav_rows
"""

from __future__ import annotations

import json
import statistics
from collections.abc import Iterable, Iterator
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

from . import nav_quality
from .nav_explore import GOOD, Explored
from .nav_goals import Errand, wilson
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
    explored: tuple[Explored, ...] = ()


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
    lines += [" ],", ' "explored": [']
    lines.append(",\n".join(f"  {json.dumps(_rounded(asdict(one)))}" for one in kept.explored))
    file.write_text("\n".join(["{", *lines, " ]", "}"]) + "\n", encoding="utf-8")


def _plain(one: Outcome) -> dict[str, Any]:
    plain: dict[str, Any] = _rounded(asdict(one))
    return plain


def _rounded(value: Any) -> Any:
    if isinstance(value, float):
        return round(value, 3)
    if isinstance(value, dict):
        return {name: _rounded(each) for name, each in value.items()}
    return [_rounded(each) for each in value] if isinstance(value, (list, tuple)) else value


def load(file: Path) -> Kept:
    """Read what `store` wrote."""
    data = json.loads(file.read_text(encoding="utf-8"))
    found: Found = []
    for each in data["setups"]:
        goals = each.pop("goals")
        each["overrides"] = tuple((name, value) for name, value in each["overrides"])
        found.append((Setup(**each, seed=data["seed"]), [_outcome(goal) for goal in goals]))
    explored = tuple(Explored(**each) for each in data["explored"])
    return Kept(data["seed"], data["commit"], found, explored)


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
                *EXPLORING.splitlines(),
                "",
                *_exploring(kept.explored),
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


def _exploring(explored: Iterable[Explored]) -> Iterator[str]:
    """One line for each world and method: medians, and of how many runs."""
    rows: dict[tuple[str, str], list[Explored]] = {}
    for one in explored:
        rows.setdefault((one.world, one.method), []).append(one)
    yield "| world | method | ended by itself | 95 % | seen all | seen | least | time | way | goals | contacts |"
    yield "|---|---|---|---|---|---|---|---|---|---|---|"
    for (world, method), runs in sorted(rows.items()):
        ended = sum(one.ended for one in runs)
        low, high = wilson(ended, len(runs))
        seen, seconds, driven, goals = (
            statistics.median(getattr(one, name) for one in runs)
            for name in ("share", "seconds", "driven", "goals")
        )
        yield (
            f"| {world} | {method} | {ended} of {len(runs)} | {low:.0%} to {high:.0%} | "
            f"{sum(one.share >= GOOD for one in runs)} of {len(runs)} | {seen:.0%} | "
            f"{min(one.share for one in runs):.0%} | {seconds:.0f} s | {driven:.0f} m | {goals:.0f} | "
            f"{sum(one.contacts for one in runs)} |"
        )


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
goals drawn at random (seed {seed}, commit {commit}) with the parameter files of `turtlebot3_navigation`, the same
for all worlds. Starts and goals are where a disc of 0.20 m has room, at least 3 m apart, with any heading. The laser
turns five times a second, its beams are taken while the robot moves, and have noise; `fake_localization` says
where the robot is. Reached means that `move_base` said SUCCEEDED, and that the true pose was within the
tolerances. The interval is Wilson's. Contacts are the goals on whose way the robot drove into something, as the
engine counts them.

Length is what was driven, over the shortest path that keeps 0.15 m from everything in the map; time is what it
took, over that path at full speed with its turns. Both are medians and 95th percentiles of the goals that were
reached. Rows called *careful* were driven with `careful:=true`, which loads `param/careful.yaml` over these files.
They are few so far. In the office they are goals 0 to 6, 8 and 16, of which 1, 3 and 16 had failed without it; 0 and 6
had not. The table was generated from the rows in `assets/benchmarks/navigation.json`; `rosmini bench nav --seed 2
--rows FILE` drives to others, carefully.
"""

EXPLORING = f"""## Exploring

Both explorers with gmapping (10 particles) and `careful:=true`; explore_lite gives a frontier up that gets no nearer
for 120 s, since in the house one is near as the crow flies and far on wheels. *Seen* is the share of the cells that
a disc of 0.20 m gets to and that the map knows in the end: the median, the least, and how many runs saw {GOOD:.0%} of
them. `PYTHONPATH=tests/benchmarks python -m rosmini_bench.nav_explore house --seeds 5` drives more of them.
Before, with the files in the shape of ROBOTIS's and 30 s, 2 of 14 runs saw as much, the others 8 % to 67 %.
"""

CAUSES = """## Where it fails, and why

Failing drives were looked at one by one: costmaps, plan, and what each critic rejected. `explain()` tells it
({doc}`../notebooks/39_move_base`). The causes, and what `careful.yaml` does about them:

- **The footprint.** A burger's has an inscribed radius of 5 cm with padding, since its origin is near its front, and
  that is all that a plan keeps. So plans lead where the sides have no room: between the legs of a chair, through a
  gap of two robot widths. The local planner, which looks at all four edges, refuses. *Careful* plans for a disc.
- **No way back.** A robot with its nose 3 cm before something, or before a walker who waits for it, can neither drive
  on nor turn: at 0.05 m/s ahead or turning at 0.3 rad/s it is in the obstacle within the 1.7 s that are looked ahead,
  and slower or backwards our files do not allow (ROBOTIS's allow backwards). No recovery changes that. *Careful*
  allows -0.1 m/s. Lower least speeds were tried, too: with them robots crept on one spot until they counted as
  oscillating, in the office and between cylinders where they arrive with 0.05 m/s and 0.3 rad/s.
- **Ghosts.** A beam that meets nothing clears nothing unless `inf_is_valid` is set. Where the way behind them is longer
  than the 3.5 m of the laser, walkers leave a trail of obstacles. *Careful* sets it.
- **Doors.** One that was seen to open hides the free way behind its leaf, where the costmap keeps its former positions.
  Only a reset while the door stands open helps, so *careful* has two more. Doors keep away from a robot, and one that
  would press against it goes back: a robot that waits where the door swings waits for good, since the plan waits for
  the door, and the door for the robot.
- **The crow.** explore_lite measures progress towards a frontier in a straight line, and gives frontiers up while the
  robot drives to them around walls.

`carrot_planner` plans no way around a wall: it goes straight to the last free place before it.
"""


def main() -> None:
    """Write the page."""
    PAGE.write_text(page(load(FILE)), encoding="utf-8")


if __name__ == "__main__":
    main()
