"""What is right in the exercises of chapter 37, gmapping."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from rosmini.book.checks import Script, exercise, expect
from rosmini.book.trials import Trial
from rosmini.core.graph import Graph
from rosmini.msgs.nav_msgs.msg import OccupancyGrid
from rosmini.ros.launch import roslaunch
from rosmini.ros.scripts import rosrun


@exercise("37.1", praise="One passer-by kills no particle.")
def log_likelihood(answer: Any) -> None:
    """Beams on a wall, near one, and nowhere."""
    for distances, why in (
        ([0.0, 0.05, 0.1], "All three ends are near a point."),
        ([0.11, 0.4], "No end is near a point."),
        ([math.inf, 0.02], "One beam has no point at all."),
        ([0.03] * 40 + [0.2] * 3, "Forty are near, and three are not."),
    ):
        given = np.array(distances)
        found = answer(given.copy())
        near = given[given <= 0.1]
        wanted = -(float(np.sum(near**2)) + 0.5 * (len(given) - len(near))) / 0.075
        expect(
            isinstance(found, (int, float, np.floating))
            and math.isclose(found, wanted, rel_tol=1e-6, abs_tol=1e-9),
            f"{why} The sum is {wanted:.2f}, and you return {found!r}.",
            "near ones add -d**2 / 0.075, all others -0.5 / 0.075",
        )


@exercise("37.2", praise="RViz would draw it.")
def data_of(answer: Any) -> None:
    """Unknown, free and occupied cells, in order."""
    hits = np.array([[0, 1, 1, 0], [0, 0, 3, 5]])
    visits = np.array([[0, 1, 4, 7], [2, 0, 10, 10]])
    for threshold, wanted in (
        (0.25, [-1, 100, 0, 0, 0, -1, 100, 100]),
        (0.4, [-1, 100, 0, 0, 0, -1, 0, 100]),
    ):
        found = answer(hits.copy(), visits.copy(), threshold)
        expect(
            isinstance(found, list),
            f"It returns a {type(found).__name__}, not a list.",
            "array.ravel().tolist()",
        )
        expect(
            len(found) == len(wanted),
            f"The list has {len(found)} entries for {hits.size} cells.",
            "one for each cell, row by row: ravel()",
        )
        for place, (mine, right) in enumerate(zip(found, wanted, strict=True)):
            row, column = divmod(place, hits.shape[1])
            expect(
                mine == right,
                f"The cell in row {row}, column {column} has {hits[row, column]} hits in {visits[row, column]} visits. "
                f"With occ_thresh {threshold} it is {right}, not {mine!r}.",
                "never visited: -1; more hits per visit than occ_thresh: 100; exactly as many: 0",
            )


@exercise("37.3", praise="Nobody who is heavy dies by accident.")
def survivors(answer: Any) -> None:
    """Marks on a line, or nobody drawn."""
    uneven = [0.02, 0.55, 0.03, 0.3, 0.1]
    cases = (
        (uneven, 0.01, [0, 1, 1, 3, 3]),
        (uneven, 0.15, [1, 1, 1, 3, 4]),
        ([0.25] * 4, 0.2, [0, 1, 2, 3]),
        ([0.4, 0.3, 0.2, 0.1], 0.1, [0, 1, 2, 3]),
        ([0.0, 0.0, 1.0], 0.3, [2, 2, 2]),
    )
    for weights, start, wanted in cases:
        found = answer(list(weights), start)
        kept = wanted == list(range(len(weights)))
        expect(
            list(found) == wanted,
            f"Of the weights {weights} and with start {start}, {wanted} live on, and you return {found!r}.",
            "Neff is large enough here: nobody is drawn"
            if kept
            else "marks at start, start + 1/N, ...; each one's place",
        )


DULL, NEWS = 3, 40
"""A map is done when so many maps in a row have brought less than so many new cells each."""
LONGEST, REST = 150.0, 20.0
"""So long the robot may drive, and so long it has to stand at the end [s]."""
STEP = 0.5


@exercise("37.4", gaps=2, praise="It knows when it is done.")
def surveyor(answer: Script) -> Any:
    """It drives while maps bring news, and stops when they do not."""
    view = None
    for start in (("_x:=0.0", "_y:=0.0"), ("_x:=1.6", "_y:=0.3", "_yaw:=2.0")):
        with Trial("room", *start) as trial:
            view = _surveyed(trial, answer)
    return view


def _surveyed(trial: Trial, answer: Script) -> Any:
    """Drive and map until the robot should have stopped, and a while longer."""
    graph, quiet = trial.graph, {"capture_output": True}
    roslaunch("turtlebot3_bringup", "turtlebot3_remote.launch", "model:=burger", graph=graph, console=quiet)
    near = [f"_{name}:={value}" for name, value in BOUNDS.items()]
    rosrun(
        "gmapping",
        "slam_gmapping",
        "_base_frame:=base_footprint",
        "_particles:=5",
        *near,
        graph=graph,
        capture_output=True,
    )
    maps = _Maps(trial.graph)
    trial.start(answer)
    moved, now, last = 0.0, 0.0, trial.robot.truth()
    while now < LONGEST and now < maps.done + REST:
        trial.run(STEP)
        now += STEP
        x, y, yaw = trial.robot.truth()
        if math.dist((x, y), last[:2]) > 0.01 or abs(yaw - last[2]) > 0.02:
            moved = now
        last = x, y, yaw
    expect(
        maps.count > 1 and moved > 0,
        "The robot did not drive.",
        "publish a Twist for each scan, as wander.py does",
    )
    expect(
        maps.done < math.inf,
        f"After {LONGEST:.0f} s each third map still brings something new: it does not get around.",
        "drive as wander.py does",
    )
    expect(
        moved > maps.done - 2.0,
        f"The robot stopped after {moved:.0f} s; the third map without news came after {maps.done:.0f} s.",
        "three in a row: a map with news sets the count back to 0",
    )
    expect(
        moved < maps.done + 4.0,
        f"The third map without news came after {maps.done:.0f} s, and the robot drove on until {moved:.0f} s.",
        "publish an empty Twist as soon as there are three, and nothing else after that",
    )
    return trial.view()


BOUNDS = {
    "linearUpdate": 0.3, "angularUpdate": 0.4, "map_update_interval": 2,
    "xmin": -5, "ymin": -5, "xmax": 5, "ymax": 5,
}  # fmt: skip


class _Maps:
    """What maps came, and when the last of `DULL` dull ones did [s]."""

    def __init__(self, graph: Graph) -> None:
        self.node = graph.node("judge")
        self.start = self.node.now()
        self.count, self.known, self.dull, self.done = 0, 0, 0, math.inf
        self.node.subscriber("map", OccupancyGrid, self._map)

    def _map(self, grid: Any) -> None:
        known = int((np.asarray(grid.data, dtype=np.int8) >= 0).sum())
        self.dull = self.dull + 1 if known - self.known < NEWS else 0
        self.count, self.known = self.count + 1, known
        if self.dull == DULL:
            self.done = min(self.done, (self.node.now() - self.start).to_sec())
