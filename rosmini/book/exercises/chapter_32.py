"""What is right in the exercises of chapter 32, Maps."""

from __future__ import annotations

import math
from typing import Any, cast

import numpy as np

from rosmini.book.checks import Script, exercise, expect, expect_type
from rosmini.book.trials import TurtleTrial
from rosmini.core.maps import GridMap
from rosmini.msgs.nav_msgs.msg import OccupancyGrid
from rosmini.msgs.std_msgs.msg import String
from rosmini.navigation.map_server.node import MapServer
from rosmini.ros.scripts import rosrun

# ---- 32.1: cells ----

PLACES = (
    ((0.0, 0.0, 0.0), (0.31, 0.12), "divide by the resolution, and round down"),
    ((-5.0, 2.0, 0.0), (-4.31, 2.12), "subtract the origin first"),
    ((-5.0, 2.0, 0.0), (-5.01, 2.12), "int() rounds towards 0, so cell -0.1 becomes cell 0: use math.floor"),
    ((1.0, -2.0, 0.0), (1.2, -1.6), "there are `height` rows"),
    ((1.0, -2.0, 0.0), (2.1, -1.9), "there are `width` columns"),
    ((1.0, 2.0, math.pi / 2), (0.95, 2.55), "turn the difference by minus the yaw"),
    ((1.0, 2.0, -0.7), (1.4, 1.8), "turn the difference by minus the yaw"),
    ((-1.0, -1.0, 0.4), (-0.9, -0.4), "turn the difference by minus the yaw"),
)


@exercise("32.1", praise="RViz, amcl and every costmap begin with these lines.")
def cell_of(answer: Any) -> None:
    """The cell of a place, or None outside, with an origin that is turned."""
    cells = np.zeros((3, 10), dtype=np.int8)
    for origin, place, hint in PLACES:
        grid = GridMap(cells, 0.1, origin)
        found = answer(*place, grid.to_message().info)
        wanted = grid.world_to_map(*place)
        where = f"On a map of 10 x 3 cells of 0.1 m with its origin at {tuple(round(n, 2) for n in origin)}"
        if isinstance(found, list | np.ndarray):
            found = tuple(found)
        expect(
            found is None or (isinstance(found, tuple) and len(found) == 2),
            f"{where} it returned {found!r} for {place}.",
            "return two whole numbers, (mx, my), or None",
        )
        expect(found == wanted, f"{where} the place {place} is {_named(wanted)}, not {_named(found)}.", hint)


def _named(cell: tuple[int, int] | None) -> str:
    return "outside" if cell is None else f"in the cell ({cell[0]}, {cell[1]})"


# ---- 32.2: pixels ----


@exercise("32.2", praise="Load, save, load: nothing is lost.")
def classify(answer: Any) -> None:
    """The cells of a picture, in the order of a map."""
    picture = np.array([[0, 51, 102], [153, 204, 255]], dtype=np.uint8)
    cases = (
        (0.25, 0.7, 0, [[-1, 0, 0], [100, 100, -1]]),
        (0.25, 0.7, 1, [[-1, 100, 100], [0, 0, -1]]),
        (0.6, 0.8, 0, [[0, 0, 0], [100, -1, -1]]),
    )
    for free, occupied, negate, wanted in cases:
        found = answer(picture, free, occupied, negate)
        expect_type(found, np.ndarray, "It returned", "a numpy array")
        expect(found.shape == picture.shape, f"A picture of the shape {picture.shape} became {found.shape}.")
        said = (
            f"Of {picture.tolist()} with free_thresh {free}, occupied_thresh {occupied} and negate {negate}"
        )
        expect(
            found.tolist() != wanted[::-1],
            f"{said} it makes a map that stands on its head.",
            "row 0 of a map is the lowest, that of a picture the highest",
        )
        expect(
            found.tolist() == wanted,
            f"{said} it makes {found.tolist()}, not {wanted}.",
            "p above occupied_thresh is 100, below free_thresh 0, everything else -1, also on a threshold",
        )


# ---- 32.3: no entry ----


@exercise("32.3", praise="The planner of chapter 34 will go round it, and never know why.")
def keepout(answer: Script) -> None:
    """A node that closes a square metre of any map."""
    for resolution, origin in ((0.5, (-1.0, -1.0, 0.0)), (0.25, (0.5, -0.75, 0.0))):
        cells = np.tile(np.array([0, -1, 0, 100, 0, 0], dtype=np.int8), (5, 1))
        grid = GridMap(cells, resolution, origin)
        with TurtleTrial(None) as trial:
            server = trial.graph.node("mapper")
            server.publisher("map", OccupancyGrid, latch=True, queue_size=1).publish(grid.to_message())
            trial.start(answer)
            trial.run(1.0)
            heard: list[Any] = []
            trial.graph.node("late").subscriber("keepout_map", OccupancyGrid, heard.append)
            trial.run(0.5)
            expect(bool(heard), "Who subscribes to keepout_map a second later gets nothing.", "latch=True")
            _expect_closed(grid, heard[-1])


def _expect_closed(grid: GridMap, message: Any) -> None:
    where = f"On a map with cells of {grid.resolution} m and its origin at {grid.origin[:2]}"
    expect(
        len(message.data) == grid.occupancy.size and message.info == grid.to_message().info,
        f"{where} the size or the origin of what you publish differs from the map's.",
        "change the cells of the message that came, and publish that",
    )
    found = GridMap.from_message(message).occupancy
    rows, columns = np.indices(found.shape)
    x, y = (grid.origin[n] + (cells + 0.5) * grid.resolution for n, cells in enumerate((columns, rows)))
    inside = (x > 0) & (x < 1) & (y > 0) & (y < 1)
    wanted = np.where(inside, 100, grid.occupancy)
    wrong = np.argwhere(found != wanted)
    if len(wrong):
        my, mx = wrong[0].tolist()
        expect(
            False,
            f"{where} the cell ({mx}, {my}) is {found[my, mx]}, not {wanted[my, mx]}.",
            "the middle of a cell is origin + (number + 0.5) * resolution; data[my * width + mx]",
        )


# ---- 32.4: the lift ----

MAPS = "package://rosmini_sim/maps/"


@exercise("32.4", praise="Somebody still has to tell the robot where it gets out.")
def lift(answer: Script) -> None:
    """A node that has the server change maps, and survives one that is not there."""
    with TurtleTrial(None) as trial:
        # its log, with paths of this machine, is not the reader's
        started = rosrun(
            "map_server", "map_server", f"{MAPS}floor.yaml", graph=trial.graph, capture_output=True
        )
        server: MapServer = cast("Any", started).instance()
        trial.start(answer)
        button = trial.graph.node("button").publisher("floor", String, queue_size=5)
        trial.run(1.0)
        for name in ("house.yaml", "cellar.yaml", "office.yaml"):
            errors = trial.output.count("[ERROR]")
            button.publish(String(MAPS + name))
            trial.run(0.5)
            failed = trial.output.count("[ERROR]") > errors
            if name == "cellar.yaml":
                logged = trial.output.rpartition("[ERROR]")[2]
                expect(
                    " raised " not in logged,
                    f"There is no {name}, and your callback fails of it.",
                    "a callback that fails is logged by ROS; log your own error, and return",
                )
                expect(
                    failed and name in logged,
                    f"There is no {name}, and no error of yours names it.",
                    "answer.result, rospy.logerr",
                )
                continue
            shown = server.grid.path
            expect(
                not failed, f"For {name}, which is there, your script logged an error.", "RESULT_SUCCESS is 0"
            )
            expect(
                shown is not None and shown.name == name,
                f"The lift stopped at {name}, and the server has the map {shown and shown.name}.",
                "change_map(message.data)",
            )
