"""How well robots know where they are, stored as rows, one for each seed, and the book's page about them.

`python -m rosmini_bench.nav_located lost house --seeds 1 10` (with PYTHONPATH=tests/benchmarks) adds rows to
assets/benchmarks/localization.json, each with its seed and commit; without a study it only writes
`book/about/localization_figures.md` from them again. `rosmini bench nav` measures the same with a few seeds.
"""

from __future__ import annotations

import argparse
import json
import math
import statistics
from collections.abc import Callable, Iterable, Iterator
from dataclasses import asdict, dataclass, replace
from pathlib import Path
from types import MappingProxyType
from typing import Any

import numpy as np

from rosmini.core.errors import RosminiError

from . import nav_amcl, nav_charts, nav_gmapping, nav_hector
from .nav_amcl import CARRIED, HELD, LOST, WITHIN
from .nav_charts import Mark, chart, label, spoken
from .nav_drives import accompanied, drive, kidnapped
from .nav_goals import wilson
from .nav_quality import commit

ROOT = Path(__file__).resolve().parents[3]
FILE = ROOT / "assets" / "benchmarks" / "localization.json"
PAGE = ROOT / "book" / "about" / "localization_figures.md"

Values = dict[str, float | None]


@dataclass(frozen=True)
class Row:
    """What one seed gave."""

    study: str
    what: str
    seed: int
    commit: str
    values: Values
    """Names with units, and numbers; None where a robot was not found."""


# -- studies -------------------------------------------------------------------------------------------------------


def tracked(what: str, seed: int) -> Values:
    """How far amcl is off while it follows a robot; `what` is a world, and `people` or a laser model."""
    world, _, kind = what.partition(", ")
    one = nav_amcl.drives(world, seed, WITHIN + HELD + 5.0)
    if kind == "people":
        one, _ = accompanied(one, 3, seed)
    changes: dict[str, Any] = {} if kind in ("", "people") else {"laser_model_type": kind}
    track = nav_amcl.follow(one, replace(nav_amcl.ours(), **changes), seed)
    off, turned = 100 * track.off, np.degrees(track.turned_off)
    return {
        "off [cm]": float(off.mean()),
        "straight [cm]": float(off[~track.turning].mean()),
        "turning [cm]": float(off[track.turning].mean()),
        "95th [cm]": float(np.quantile(off, 0.95)),
        "off [deg]": float(turned.mean()),
        "straight [deg]": float(turned[~track.turning].mean()),
        "turning [deg]": float(turned[track.turning].mean()),
        "in the ellipse": float(np.mean(track.inside)),
    }


def lost(what: str, seed: int) -> Values:
    """After how many seconds a robot that may be anywhere is found; `what` is a world, and one of `KINDS`."""
    world, _, kind = what.partition(", ")
    one = nav_amcl.drives(world, seed, WITHIN + HELD + 5.0)
    p = replace(nav_amcl.ours(), **{**LOST, **KINDS[kind]})
    return {"found [s]": _finite(nav_amcl.follow(one, p, seed, lost=True).found())}


KINDS: MappingProxyType[str, dict[str, Any]] = MappingProxyType(
    {
        "": {},
        "uniform": {"recovery_candidates": 1},
        "alphas 0": {"recovery_alpha_slow": 0.0, "recovery_alpha_fast": 0.0},
    }
)
"""What differs from `LOST`."""


def carried(what: str, seed: int) -> Values:
    """After how many seconds a robot is found that somebody has carried away; `what` is as in `lost`."""
    world, _, kind = what.partition(", ")
    first = nav_amcl.drives(world, seed + 1000, CARRIED + 5.0)
    one = kidnapped(first, nav_amcl.drives(world, seed, WITHIN + HELD + 5.0), CARRIED)
    track = nav_amcl.follow(one, replace(nav_amcl.ours(), **{**LOST, **KINDS[kind]}), seed)
    return {"found [s]": _finite(track.found(CARRIED))}


def _finite(value: float) -> float | None:
    return value if math.isfinite(value) else None


def gmapped(what: str, seed: int) -> Values:
    """How good gmapping's path and map are; `what` is a log or a world, and `ours` for parameters of our choice."""
    name, _, kind = what.partition(", ")
    log = {"log_house": nav_gmapping.house, "csail": nav_gmapping.csail}.get(
        name, lambda: nav_gmapping.recorded(name, 1, 240.0)
    )()
    if log is None:
        raise RosminiError(f"{name} is not in {nav_gmapping.DATA}")
    one = nav_gmapping.run(log, seed, **(nav_gmapping.OURS if kind else {}))
    again = nav_gmapping.revisits(log.truth)
    back, turned = nav_gmapping.relative(one.poses, log.truth, again)
    if log.walls is None:
        index = np.arange(len(log.times) - 1)
        next_to, angles = nav_gmapping.relative(one.poses, log.truth, (index, index + 1))
        return {
            "neighbours [m]": float(next_to.mean()),
            "neighbours [deg]": math.degrees(float(np.median(angles))),
            "revisits [m]": float(back.mean()),
            "revisits [deg]": math.degrees(float(np.median(turned))),
            "a scan [ms of CPU]": 1e3 * one.cpu,
        }
    moved = nav_gmapping.onto(one.poses[0], log.truth[0])
    precision, recall = nav_gmapping.map_quality(one.slam, log.walls, moved, 2)
    return {
        "off [m]": nav_gmapping.off_at_start(one.poses[one.taken], log.truth[one.taken]),
        "revisits [m]": float(np.sqrt(np.mean(back**2))),
        "precision": precision,
        "recall": recall,
        "a scan [ms of CPU]": 1e3 * one.cpu,
    }


def hectored(what: str, seed: int) -> Values:
    """How far hector_mapping is off; `what` is `log_house` or how fast the robot turns, and `sweep` or `no sweep`.

    With `off at once` the robot does not stand for a second before it drives off.
    """
    one = nav_hector.house()
    if what != "log_house":
        speed, _, kind = what.partition(" rad/s, ")
        laser, _, start = kind.partition(", ")
        one = drive("house", seed, 120.0, turn=float(speed), sweep=laser == "sweep", rest=0.0 if start else 1.0)
    if one is None:
        raise RosminiError(f"log_house is not in {nav_gmapping.DATA}")
    alone, helped = nav_hector.hector(one), nav_hector.hector(one, odometry=True)
    rms, rms_helped = (float(np.sqrt(np.mean(found.errors**2))) for found in (alone, helped))
    cost = 1e3 * float(np.median(helped.cpu))
    return {"no odometry [m]": rms, "odometry as start [m]": rms_helped, "a scan [ms of CPU]": cost}


STUDIES: MappingProxyType[str, Callable[[str, int], Values]] = MappingProxyType(
    {"tracking": tracked, "lost": lost, "kidnapped": carried, "gmapping": gmapped, "hector": hectored}
)
HIGHER = ("precision", "recall", "in the ellipse")
"""Of these the worst is the least."""
DETAILS = ("straight [cm]", "straight [deg]", "turning [deg]", "a scan [ms of CPU]")
"""These are only in the file."""

# -- rows ----------------------------------------------------------------------------------------------------------


def load(file: Path) -> list[Row]:
    """Read what `store` wrote."""
    return [Row(**each) for each in json.loads(file.read_text(encoding="utf-8"))] if file.is_file() else []


def store(rows: Iterable[Row], file: Path) -> None:
    """Write rows, one a line; of two of the same study, thing and seed the later one."""
    kept = {(row.study, row.what, row.seed): row for row in rows}
    order = list(STUDIES)
    chosen = sorted(kept.values(), key=lambda row: (order.index(row.study), row.what, row.seed))
    lines = []
    for row in chosen:
        plain = asdict(row)
        plain["values"] = {name: None if v is None else round(v, 4) for name, v in row.values.items()}
        lines.append(json.dumps(plain))
    file.write_text("[\n" + ",\n".join(lines) + "\n]\n", encoding="utf-8")


def charts(rows: list[Row]) -> dict[str, str]:
    """The charts of the page as SVG, by name."""
    marks = {study: list(_marks(rows, study, *each)) for study, each in CHARTED.items()}
    found = [Mark("may be anywhere"), *marks["lost"], Mark("was carried away"), *marks["kidnapped"]]
    mapped = [Mark("gmapping"), *marks["gmapping"], Mark("hector_mapping, no odometry"), *marks["hector"]]
    return {
        "amcl_following": chart(
            marks["tracking"],
            (0, 5, 10, 15, 20, 25),
            "Errors of amcl while it follows a robot",
            f"Mean error of each drive. {spoken(marks['tracking'])}",
            shown="{:.0f} cm".format,
        ),
        "amcl_found": chart(
            found, (0.5, 0.6, 0.7, 0.8, 0.9, 1.0), "Lost robots that amcl found", f"Shares found. {spoken(found)}"
        ),
        "mapping_errors": chart(
            mapped,
            (0.0, 0.1, 0.2, 0.3, 0.4, 0.5),
            "Errors of gmapping and hector_mapping",
            f"Error of each drive; values above 0.5 m lie at the right edge. {spoken(mapped)}",
            shown="{:.1f} m".format,
        ),
    }


CHARTED: MappingProxyType[str, tuple[str, str]] = MappingProxyType(
    {
        "tracking": ("off [cm]", "{:.1f} cm"),
        "lost": ("found [s]", ""),
        "kidnapped": ("found [s]", ""),
        "gmapping": ("off [m]", "{:.2f} m"),
        "hector": ("no odometry [m]", "{:.2f} m"),
    }
)
"""Of each study the value that is charted, and how its median is written."""


def _marks(rows: list[Row], study: str, name: str, shown: str) -> Iterator[Mark]:
    whats: dict[str, list[float | None]] = {}
    for row in rows:
        if row.study == study and name in row.values:
            whats.setdefault(row.what, []).append(row.values[name])
    for what, values in whats.items():
        known = tuple(value for value in values if value is not None)
        if shown:
            yield Mark(what, shown.format(statistics.median(known)), statistics.median(known), runs=known)
        else:
            share, interval = len(known) / len(values), wilson(len(known), len(values))
            yield Mark(what, f"{len(known)} of {len(values)}", share, interval)


def page(rows: list[Row]) -> str:
    """The page, as MyST."""
    lines = INTRODUCTION.splitlines()
    for study, words in WORDS.items():
        lines += ["", *words.strip().splitlines(), "", *tables(row for row in rows if row.study == study)]
    return "\n".join(lines) + "\n"


def tables(rows: Iterable[Row]) -> list[str]:
    """The rows of a study as Markdown: a table for each set of values."""
    chosen: dict[tuple[str, ...], dict[str, list[Row]]] = {}
    for row in rows:
        chosen.setdefault(tuple(name for name in row.values if name not in DETAILS), {}).setdefault(
            row.what, []
        ).append(row)
    lines: list[str] = []
    for names, whats in chosen.items():
        lines += [*([""] if lines else []), *_table(names, whats)]
    return lines


def _table(names: tuple[str, ...], chosen: dict[str, list[Row]]) -> Iterator[str]:
    lost = names == ("found [s]",)
    yield f"| drives | {'found | 95% interval | median' if lost else ' | '.join(names)} | seeds |"
    yield "|---|" + "---|" * (4 if lost else len(names) + 1)
    for what, rows in chosen.items():
        cells = list(_found(rows)) if lost else [_middle(name, rows) for name in names]
        anchor = label(f"{rows[0].study} {what}")
        yield f'| <a id="{anchor}"></a>{what} | {" | ".join(cells)} | {_seeds(rows)} |'


def _found(rows: list[Row]) -> Iterator[str]:
    times = [v for row in rows if (v := row.values["found [s]"]) is not None]
    low, high = wilson(len(times), len(rows))
    yield f"{len(times)} of {len(rows)}"
    yield f"{low:.0%} to {high:.0%}"
    yield f"{statistics.median(times):.0f} s" if times else ""


def _middle(name: str, rows: list[Row]) -> str:
    values = [v for row in rows if (v := row.values[name]) is not None]
    worst = min(values) if name in HIGHER else max(values)
    return f"{statistics.median(values):.3g} ({worst:.3g})"


def _seeds(rows: list[Row]) -> str:
    seeds = [row.seed for row in rows]
    whole = len(seeds) > 2 and seeds[-1] - seeds[0] == len(seeds) - 1
    return f"{seeds[0]} to {seeds[-1]}" if whole else ", ".join(map(str, seeds))


INTRODUCTION = """# Localisation and mapping in figures

How well do amcl, gmapping and hector_mapping know where the robot is? A program that knows the true pose drives a
Burger through the simulator's worlds at 0.2 m/s, and turns it on the spot at corners. The laser measures while the
robot moves, and the wheels slip. The runs that a row of a table summarises differ only in their seeds. In a cell with
brackets, the first number is the median over the runs, and the number in brackets is that of the worst run. In Figures
1 and 3 each run is a small point, and the median a large one. Each run is stored in
`assets/benchmarks/localization.json`, with the commit that produced it. A chapter that quotes a number from this page
links to the row that contains it. This command runs more drives:

```
PYTHONPATH=tests/benchmarks uv run python -m rosmini_bench.nav_located lost house --seeds 11 20
```
"""

WORDS: MappingProxyType[str, str] = MappingProxyType(
    {
        "tracking": """
## amcl: following a robot

```{drawing} amcl_following
<a id="chart-following"></a>Figure 1: The mean error of amcl on each drive. The pose is known at the start
```

The initial pose given to amcl is within 0.1 m and 6 degrees of the truth, and the parameters are those of
`turtlebot3_navigation`. *Off* is the mean error, *turning* the mean error during turns, and *95th* the 95th percentile.
In rows marked *people*, three people who walk beside the robot block about a fifth of the beams. *In the ellipse* is
the proportion of estimates for which the true pose was inside the 95% ellipse of the published covariance. Crates that
can be pushed are not on the map; the program drives the robot around them.
""",
        "lost": f"""
## amcl: a robot that may be anywhere

```{{drawing}} amcl_found
<a id="chart-found"></a>Figure 2: Robots that amcl found. The point is the proportion, the bar its 95% interval
```

A robot counts as found if, within {WITHIN:.0f} s of driving, its estimated pose comes within 0.3 m of the true pose and
then stays that close for {HELD:.0f} s. *Median* is the median time until a robot was found. We chose these parameters
using seeds other than those in the table:

{{lost}}

We chose these values for the following reasons. Of 10,000 particles in a house of 125 m², about seven are within half a
metre and 20 degrees of the true pose. With a narrow bell curve (a small `laser_sigma_hit`), these seven are no likelier
than particles in places where a few walls fit by chance, and the filter converges on one of those places. With a
`laser_sigma_hit` of 0.8 m, the seven are likelier. `likelihood_field_prob` multiplies the probabilities of the beams
instead of adding their cubes, so the eight updates between two resampling steps are enough to distinguish the places,
even with such a wide bell curve. `diff-corrected` spreads the copies of a particle further than `diff`, which mistakes
a variance for a standard deviation.

`recovery_candidates` exists only in rosmini. The original amcl draws its random particles uniformly from the free
cells. In our runs, rosmini's amcl draws ten times as many poses as it needs, and chooses among them by the likelihood
of the scan at each pose (*sensor resetting*, Lenser and Veloso 2000). In rows marked *uniform*, it draws them
uniformly, like the original.

For most robots that were not found, the estimated pose settled in the hall or in a corridor, facing the opposite way:
the hall and the corridors look the same from either end.
""",
        "kidnapped": f"""
## amcl: a robot that was carried away

After {CARRIED:.0f} s the robot is carried elsewhere without its odometry noticing. The parameters are those listed
above. amcl adds random particles while the fast average of the likelihood is below the slow average, and resets both
averages after a resampling step in which it added any. With a narrow bell curve, the likelihood varies by powers of ten
from scan to scan, and amcl added random particles only a few times in two minutes. With a wide bell curve, the
likelihood varies less, and the few random particles near the true pose win.
""",
        "gmapping": """
## gmapping

```{drawing} mapping_errors
<a id="chart-mapping"></a>Figure 3: Errors along the path of each drive, for gmapping and for hector_mapping without
odometry. Errors above 0.5 m are drawn at the right edge
```

*Off* is the root mean square distance between the estimated and the true path, aligned at the start. The columns
*neighbours* and *revisits* show the error of the estimated motion between two scans: *neighbours* are consecutive
scans, and *revisits* are scans more than 60 scans apart, but less than a metre from each other. *Precision* and
*recall* are those of the occupied cells, with a tolerance of two cells. `log_house` is a recorded drive on which we
also ran the original gmapping: with its default parameters, it was off by 0.105 m, and by 0.036 m at revisits, with a
precision of 0.80 and a recall of 0.73. *csail* is a log of a real robot, whose true path is not known. The truth in its
row is a path that the original gmapping found; in our runs of the original, the errors were 0.046 m between neighbours
and 0.070 m at revisits. Rows marked *ours* use a scan every 0.2 m or 0.25 rad, and beams of up to 3 m.

When rosmini matches a scan, the end of a beam counts only if the cell in front of it is free. The original is meant to
check this cell, but looks up the wrong one, so every end counts. The check makes the result for csail a little worse,
but the maps of the house better, so we keep it.

*Office* and *maze* are drives of 240 s past people; we did not use these drives for tuning. Their recall counts all
walls, even those that the laser never saw, so it is low for any mapper.
""",
        "hector": """
## hector_mapping

Errors are root mean squares over drives of 120 s in the house. Rows differ in how fast the robot turns, and in whether
the laser sweeps, that is, measures its beams one after another. In `log_house` the robot turns at 1.2 rad/s, which is
14 degrees from one scan to the next. The scan matcher cannot correct such a large turn, so without odometry both
rosmini's hector_mapping and the original lose track of the robot. With odometry as the initial estimate, the original
is off by 0.021 m.

The robot waits for a second before it drives off, except in rows marked *off at once*. In those rows, the robot may
already be turning during the first scan, and if the laser sweeps, that scan is distorted. This rotates the whole map,
and the path with it.
""",
    }
)


def lost_parameters() -> str:
    """What a lost robot takes, as a list."""
    return "\n".join(f"- `{name}`: {value}" for name, value in LOST.items())


def write(rows: list[Row]) -> str:
    """The page with the parameters in it."""
    return page(rows).replace("{lost}", lost_parameters())


def measured(study: str, what: str, seed: int) -> Row:
    """Run a study once. Raises `RosminiError` if it needs a log that is not here."""
    return Row(study, what, seed, commit(), STUDIES[study](what, seed))


def show(*, quick: bool) -> None:
    """Print what the page shows, measured now: of each study all rows with three seeds, or one row with one seed."""
    known: dict[str, list[str]] = {}
    for row in load(FILE):
        known.setdefault(row.study, [])
        if row.what not in known[row.study]:
            known[row.study].append(row.what)
    for study, whats in known.items():
        rows = []
        for what in whats[:1] if quick else whats:
            try:
                rows += [measured(study, what, seed) for seed in ((1,) if quick else (1, 2, 3))]
            except RosminiError as error:
                print(f"{study}: {error}")
        print(f"{study}:", *tables(rows), sep="\n", flush=True)


def main() -> None:
    """Drive, if a study is named, and write the page."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("study", nargs="?", choices=STUDIES)
    parser.add_argument("what", nargs="?", default="house")
    parser.add_argument("--seeds", type=int, nargs=2, default=(1, 10))
    parser.add_argument("--rows", type=Path, default=FILE)
    args = parser.parse_args()
    if args.study:
        for seed in range(args.seeds[0], args.seeds[1] + 1):
            row = measured(args.study, args.what, seed)
            print(row, flush=True)
            store([*load(args.rows), row], args.rows)
    rows = load(args.rows)
    PAGE.write_text(write(rows), encoding="utf-8")
    for name, svg in charts(rows).items():
        nav_charts.write(name, svg)


if __name__ == "__main__":
    main()
