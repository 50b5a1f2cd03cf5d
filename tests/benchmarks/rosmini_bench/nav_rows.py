"""The book's page about how well the stack navigates: charts and tables of the drives that `nav_study` wrote.

PYTHONPATH=tests/benchmarks uv run python -m rosmini_bench.nav_rows
"""

from __future__ import annotations

import itertools
import statistics
from collections.abc import Iterable, Iterator
from pathlib import Path

from . import nav_charts, nav_crossing, nav_explore, nav_quality
from .nav_charts import Mark, label
from .nav_crossing import Crossing
from .nav_explore import GOOD, Explored
from .nav_goals import wilson
from .nav_study import Line, load
from .nav_trial import FIELD, Outcome, Setup

ROOT = Path(__file__).resolve().parents[3]
FILE = ROOT / "assets" / "benchmarks" / "navigation.jsonl"
PAGE = ROOT / "book" / "about" / "navigation_figures.md"
LEAST = 10
"""A row of fewer goals says little, and is left out."""

Rows = dict[Setup, list[Outcome]]


def rows(lines: Iterable[Line]) -> Rows:
    """The goals of each setup by their numbers; of two drives to the same goal the later one."""
    found: dict[Setup, dict[int, Outcome]] = {}
    for line in lines:
        if isinstance(line.result, Outcome) and line.setup is not None:
            found.setdefault(line.setup, {})[line.result.errand.number] = line.result
    return {
        setup: [each[number] for number in sorted(each)]
        for setup, each in sorted(found.items(), key=lambda one: _order(one[0]))
        if len(each) >= LEAST
    }


def _order(setup: Setup) -> tuple[bool, str, bool, str, float, str, int]:
    """Careful ones first, of burgers before waffles, the planners' defaults before others."""
    overrides, place = bool(setup.overrides), setup.world + setup.without + "narrow" * setup.narrow
    return not setup.careful, setup.model, overrides, place, setup.gap or 0.0, setup.localization, setup.seed


def _usual(setup: Setup) -> bool:
    """Whether it is a burger with the careful file in a world as it is."""
    return setup == Setup(setup.world, localization=setup.localization, seed=setup.seed) and setup.world != FIELD


# -- charts and tables -------------------------------------------------------------------------------------------------


def charts(lines: list[Line]) -> dict[str, str]:
    """The charts of the page as SVG, by name."""
    goals = rows(lines)
    usual = _marks({setup: found for setup, found in goals.items() if _usual(setup)})
    gaps = [
        _mark(f"{setup.gap:g} widths", setup, found)
        for setup, found in goals.items()
        if setup.world == FIELD and setup.careful
    ]
    seen = [
        Mark(f"{place}, {method}", f"{statistics.median(shares):.0%}", statistics.median(shares), runs=tuple(shares))
        for (place, method), runs in _explored(lines).items()
        for shares in [[one.share for one in runs]]
    ]
    tenths, fifths = (0.9, 0.92, 0.94, 0.96, 0.98, 1.0), (0.0, 0.2, 0.4, 0.6, 0.8, 1.0)
    return {
        "navigation_goals": nav_charts.chart(
            usual, tenths, "Goals reached", f"Goals reached with the careful files. {nav_charts.spoken(usual)}"
        ),
        "navigation_gaps": nav_charts.chart(
            gaps, fifths, "Goals reached between cylinders", f"Goals reached by gap. {nav_charts.spoken(gaps)}"
        ),
        "exploring": nav_charts.chart(
            seen, fifths[2:], "What explorers have seen", f"Median of the share seen. {nav_charts.spoken(seen)}"
        ),
    }


def _marks(goals: Rows) -> list[Mark]:
    names = {"fake_localization": "true pose", "amcl": "amcl"}
    return [
        _mark(f"{setup.world}, {names[setup.localization]}, seed {setup.seed}", setup, found)
        for setup, found in goals.items()
    ]


def _mark(name: str, setup: Setup, found: list[Outcome]) -> Mark:
    one = nav_quality.row(setup, found)
    return Mark(name, f"{one.reached} of {one.count}", one.reached / one.count, (one.low, one.high))


def _explored(lines: list[Line]) -> dict[tuple[str, str], list[Explored]]:
    found: dict[tuple[str, str], list[Explored]] = {}
    for line in lines:
        if isinstance(line.result, Explored):
            found.setdefault((line.result.place, line.result.method), []).append(line.result)
    return dict(sorted(found.items()))


def page(lines: list[Line]) -> str:
    """The page, as MyST."""
    goals = rows(lines)
    explored = _explored(lines)
    crossed = [line.result for line in lines if isinstance(line.result, Crossing)]
    usual = {setup: found for setup, found in goals.items() if _usual(setup)}
    field = {setup: found for setup, found in goals.items() if setup.world == FIELD}
    others = {setup: found for setup, found in goals.items() if setup not in usual and setup not in field}
    made = [
        INTRODUCTION, *_table(usual), "", *_together(usual), "", OTHERS, *_table(others), "",
        CYLINDERS, *_table(field), "", exploring(explored), *nav_explore.table(itertools.chain(*explored.values())), "",
        CROSSING, *nav_crossing.table(crossed), "", FAILURES, *_failures(goals), "", "</details>", "", CAUSES,
    ]  # fmt: skip
    return "\n".join(made)


def _table(goals: Rows) -> Iterator[str]:
    yield "| setup | reached | 95% interval | contacts | length | time | off |"
    yield "|---|---|---|---|---|---|---|"
    for setup, outcomes in goals.items():
        one = nav_quality.row(setup, outcomes)
        figures = [_both(one.stretch, one.stretch95), _both(one.slowness, one.slowness95)]
        off = "" if one.off != one.off else f"{one.off * 100:.0f} cm"
        yield (
            f'| <a id="{label(setup.words)}"></a>{setup.words} | {one.reached} of {one.count} | '
            f"{one.low:.0%} to {one.high:.0%} | {one.contacts} | {' | '.join(figures)} | {off} |"
        )


def _both(median: float, high: float) -> str:
    return "" if median != median else f"{median:.2f} ({high:.2f})"


def _together(goals: Rows) -> Iterator[str]:
    """A sentence for each localisation and seed that was driven in all worlds: the goals of all of them."""
    sums: dict[tuple[str, int], list[nav_quality.Row]] = {}
    for setup, outcomes in goals.items():
        sums.setdefault((setup.localization, setup.seed), []).append(nav_quality.row(setup, outcomes))
    for (localization, seed), found in sums.items():
        if len(found) == len(nav_quality.WORLDS):
            reached, count = sum(one.reached for one in found), sum(one.count for one in found)
            low, high = wilson(reached, count)
            contacts = sum(one.contacts for one in found)
            yield (
                f"- In the three worlds together, with {localization} and seed {seed}, {reached} of {count} goals were "
                f"reached ({reached / count:.1%}; 95% interval {low:.1%} to {high:.1%}); "
                f"{f'contacts occurred in {contacts} drives' if contacts else 'no drive had a contact'}."
            )


def exploring(runs: dict[tuple[str, str], list[Explored]]) -> str:
    """The text above the table of the explorers, with the sums that it tells."""
    inside = [one for (place, _), each in runs.items() if place in ("house", "maze") for one in each]
    office = sorted(one.share for (place, _), each in runs.items() if place == "office" for one in each)
    return EXPLORING.format(
        good=f"{GOOD:.0%}",
        full=f"{sum(one.share >= GOOD for one in inside)} of {len(inside)}",
        ended=f"{sum(one.ended for one in inside)} of {len(inside)}",
        most=f"{max(office, default=0):.0%}",
        least=f"{min(office, default=0):.0%}",
        quarter=f"{office[len(office) // 4] if office else 0:.0%}",
    )


def _failures(goals: Rows) -> Iterator[str]:
    yield "| setup | goal | from | to | result | driven | contacts |"
    yield "|---|---|---|---|---|---|---|"
    for setup, outcomes in goals.items():
        for one in outcomes if setup.careful else ():
            if not one.reached(*nav_quality.tolerances(setup)) or one.contacts:
                yield _failure(setup, one)


def _failure(setup: Setup, one: Outcome) -> str:
    places = (f"{pose[0]:.1f}, {pose[1]:.1f}" for pose in (one.errand.start, one.errand.goal))
    tolerances = nav_quality.tolerances(setup)
    why = "reached" if one.reached(*tolerances) else nav_quality.reason(one, *tolerances)
    why = why.replace(" Even after executing recovery behaviors.", "").rstrip(".")
    driven = f"{one.driven:.1f} of {one.errand.shortest:.1f} m"
    return f"| {setup.words} | {one.errand.number} | {' | '.join(places)} | {why} | {driven} | {len(one.contacts)} |"


# -- text --------------------------------------------------------------------------------------------------------------

INTRODUCTION = f"""# Navigation in figures

How often does this book's Navigation Stack bring a robot to its goal? These charts and tables summarise {{}} drives in
the simulator's worlds. Each drive is stored in `assets/benchmarks/navigation.jsonl`, with its seed and the commit that
produced it. A chapter that quotes a number from this page links to its row. A later commit may round the last digit of
a computation differently. A drive with the same seed then eventually takes a different course, so to check a figure,
repeat many drives, not one.

## Goals in the house, the maze and the office

```{{drawing}} navigation_goals
<a id="chart-goals"></a>Figure 1: Goals that a Burger with the careful parameter files reached. The point is the
proportion, the bar its 95% interval
```

A Burger was sent to goals drawn at random, at least 3 m away, with any heading. Around each start and
each goal there is room for a disc with a radius of 0.20 m. The parameter files are the same in all worlds: those of
`turtlebot3_navigation`, with `careful:=true`, which loads `param/careful.yaml` after them. The laser turns five times a
second, measures while the robot moves, and is noisy. The robot's pose comes from the simulator
(`fake_localization`) or from `amcl`.

How to read the table:

- **Reached**: `move_base` reported `SUCCEEDED`, and the true pose was within the goal tolerance. With `amcl`, whose
  estimate has an error, a true pose up to 0.25 m and 0.3 rad from the goal counts as reached.
- **95% interval**: the Wilson interval for the proportion. If the intervals of two rows overlap, chance may explain the
  difference.
- **Contacts**: the number of drives in which the robot hit something.
- **Length**: the distance driven, divided by the length of the shortest path that keeps 0.15 m from everything on the
  map.
- **Time**: the time that the drive took, divided by the time for the shortest path at full speed. For length and time,
  each cell shows the median over the goals reached, and in brackets the 95th percentile.
- **Off**: the median true distance from the goal at the end of a drive.

We chose the parameters of `careful.yaml` by looking at the failures with seed 7. We ran seed 23 afterwards, and
changed nothing after that. Setups with fewer than {LEAST} goals appear only in `navigation.jsonl`. To run more drives:
`PYTHONPATH=tests/benchmarks uv run python -m rosmini_bench.nav_study FILE house=0-199`.
"""

OTHERS = """## Other robots, planners and files

*Narrower places* are goals with less room around them. *No sweep* means that all beams are measured at the same moment.
Rows without *careful* use the files of `turtlebot3_navigation` without `careful.yaml`.
"""

CYLINDERS = """## Between cylinders that are not on the map

```{drawing} navigation_gaps
<a id="chart-gaps"></a>Figure 2: Goals reached between cylinders, by the width of the gaps
```

The width of a gap is given as a multiple of the Burger's width, 0.21 m. The planner learns about a cylinder only when
the laser sees it. Where the gaps are too narrow, the robot does not reach its goal, but it touches nothing.
"""

EXPLORING = """## Exploring

```{{drawing}} exploring
<a id="chart-exploring"></a>Figure 3: The proportion of the reachable floor that each run saw: a small point for each
run, a large one for the median
```

The two explorers, explore_lite and frontier_exploration, use gmapping with its default of 30 particles, and
`careful:=true`. We let explore_lite abandon a frontier only after 120 s without progress, because in the house a
frontier may be close in a straight line but a long drive away. *Seen* is the proportion of the reachable cells that are
known in the final map; the table shows the median and, in brackets, the lowest value. *Saw all* counts the runs that
saw {good} or more.

In the house and the maze {full} runs saw {good} or more, and {ended} ended by themselves.

In the office both explorers miss rooms: the best run saw {most} of the floor, a quarter of the runs saw less than
{quarter}, and the worst saw {least}. Three rooms have doors that open and shut. A robot that passes a shut door maps it
as a wall, and a wall is not a frontier. The wall often stays on the map when the door opens: gmapping ignores a beam
that hits nothing, and through an open door many beams hit nothing, because the room is deeper than the laser's range.
People walking through a doorway have the same effect as a shut door. Neither explorer looks at a wall a second time,
nor do the original packages.
"""

CROSSING = """## Robots that cross one another's paths

Several Burgers drive in the house, each with its own `amcl`. All set off at the same moment, each for the place where
another started. A contact is counted for each robot that was moving faster than 0.02 m/s when the contact began. Each
planner treats the other robots as obstacles that stay where the last scan saw them.

The robots use the careful files: `multi_turtlebot3_navigation.launch` sets `careful:=true`. We chose this setting using
the 50 runs in the table, with seeds 0 to 49. In the same runs without `careful.yaml`, 197 of 200 goals were reached,
with 13 contacts in three runs. We ran seeds 1000 to 1047 afterwards, and changed nothing after that. In these 48 runs,
all 192 goals were reached without a contact. In the same runs without `careful.yaml`, 190 of 192 goals were reached,
with 10 contacts in four runs.
"""

FAILURES = """## Each failure with the careful files

<details><summary>Goals that were not reached, or reached with a contact</summary>
"""

CAUSES = """## Where it fails, and why

For each failure with seed 7, we looked at the costmaps, the plan, and the reasons why the local planner rejected each
velocity. The chapter {doc}`../../notebooks/7_navigation/95_tune_and_fix` shows how to find and fix such faults. These
are the causes, and what `careful.yaml` changes:

- **Footprint.** The origin of the Burger's base frame is near the robot's front, so the inscribed radius of the
  footprint is only 5 cm. A global plan keeps only this distance from obstacles, and leads through places too narrow for
  the robot, such as the space between the legs of a chair. The local planner checks the whole footprint and refuses to
  drive there. With `careful.yaml`, the global planner treats the robot as a disc.
- **No way back.** A robot whose front is 3 cm from an obstacle can neither drive forward nor turn. `careful.yaml`
  lets it reverse at up to 0.1 m/s, as ROBOTIS's original files do.
- **People.** People came so close to the robot that their cells in the costmap overlapped its footprint. They then
  waited for the robot, which could not leave. In the simulator, people now keep 0.3 m away, and turn back after 5 s.
- **Local costmap.** The local planner is drawn to the point where the plan leaves the local costmap. With a window of 3
  m, that point can lie behind a wall that the plan goes around, and the robot then turns on the spot. `careful.yaml`
  uses a window of 2 m.
- **Ghosts.** A beam that hits nothing clears nothing unless `inf_is_valid` is set, so people leave a trail of obstacles
  in wide rooms. `careful.yaml` sets it.
- **Doors.** The costmap keeps the earlier positions of a door that was seen while it opened. With `careful.yaml`,
  `move_base` plans for up to 10 s before each recovery behavior, rotates only once, and clears the costmap more often.
- **Cells.** In a costmap with cells of 5 cm, an obstacle may appear up to 5 cm too wide. Noise may then mark a cell
  under a robot that is close to an obstacle, and the local planner rejects every way out. `careful.yaml` uses cells of
  2.5 cm in the local costmap.
- **Initial pose.** The initial pose given to `amcl` is right to within about 0.5 m. At the entrance of the house, the
  scan fits nearly as well 0.8 m beyond the true pose, and the mean that `amcl` publishes lies between the two poses.
- **Frontiers.** explore_lite measures progress in a straight line, so it may abandon a frontier while the robot is
  driving around a wall to reach it.
- **Not explained.** In the maze, `move_base` reports two robots as oscillating although their path is clear. In the
  office, a few robots start in a corner in which nearly every sampled velocity would cause a contact.

`carrot_planner` does not plan around walls: its plan is a straight line to the goal, so the robot stops in front of the
first wall on that line.
"""


def write(lines: list[Line]) -> str:
    """The page with the number of drives in it."""
    return page(lines).replace("{}", f"{len(lines):,}", 1)


def main() -> None:
    """Write the page and its charts."""
    lines = load(FILE)
    PAGE.write_text(write(lines), encoding="utf-8")
    for name, svg in charts(lines).items():
        nav_charts.write(name, svg)


if __name__ == "__main__":
    main()
