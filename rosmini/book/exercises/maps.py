"""Checks of the exercises in the chapter Maps."""

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

# ---- cell_of: cells ----

PLACES = (
    ((0.0, 0.0, 0.0), (0.31, 0.12), "divide by the resolution, and round down"),
    ((-5.0, 2.0, 0.0), (-4.31, 2.12), "subtract the origin first"),
    ((-5.0, 2.0, 0.0), (-5.01, 2.12), "int() rounds towards 0, so cell -0.1 becomes cell 0: use math.floor"),
    ((1.0, -2.0, 0.0), (1.2, -1.6), "rows go from 0 to height - 1"),
    ((1.0, -2.0, 0.0), (2.1, -1.9), "columns go from 0 to width - 1"),
    ((1.0, 2.0, math.pi / 2), (0.95, 2.55), "rotate the difference by minus the yaw"),
    ((1.0, 2.0, -0.7), (1.4, 1.8), "rotate the difference by minus the yaw"),
    ((-1.0, -1.0, 0.4), (-0.9, -0.4), "rotate the difference by minus the yaw"),
)


@exercise("cell_of", praise="RViz, amcl and every costmap contain these lines.")
def cell_of(answer: Any) -> None:
    """The cell of a point, or None outside the map, with a rotated origin."""
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
        expect(found == wanted, f"{where} the point {place} is {_named(wanted)}, not {_named(found)}.", hint)


def _named(cell: tuple[int, int] | None) -> str:
    return "outside" if cell is None else f"in the cell ({cell[0]}, {cell[1]})"


# ---- classify: pixels ----


@exercise("classify", praise="Loading, saving and loading again gives the same map.")
def classify(answer: Any) -> None:
    """The cells of an image, in the order of a map."""
    picture = np.array([[0, 51, 102], [153, 204, 255]], dtype=np.uint8)
    cases = (
        (0.25, 0.7, 0, [[-1, 0, 0], [100, 100, -1]]),
        (0.25, 0.7, 1, [[-1, 100, 100], [0, 0, -1]]),
        (0.6, 0.8, 0, [[0, 0, 0], [100, -1, -1]]),
    )
    for free, occupied, negate, wanted in cases:
        found = answer(picture, free, occupied, negate)
        expect_type(found, np.ndarray, "It returned", "a numpy array")
        expect(
            found.shape == picture.shape,
            f"An image of the shape {picture.shape} became a map of the shape {found.shape}.",
        )
        said = f"Of {picture.tolist()} with free_thresh {free}, occupied_thresh {occupied} and negate {negate}"
        expect(
            found.tolist() != wanted[::-1],
            f"{said} it returns a map that is upside down.",
            "row 0 is the bottom of a map, and the top of an image",
        )
        expect(
            found.tolist() == wanted,
            f"{said} it returns {found.tolist()}, not {wanted}.",
            "a cell is 100 if p > occupied_thresh, 0 if p < free_thresh, and otherwise -1",
        )


# ---- keepout: no entry ----


@exercise("keepout", praise="The planner of the chapter Global planners will plan around this square.")
def keepout(answer: Script) -> None:
    """A node that marks a square metre of any map as occupied."""
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
            expect(
                bool(heard),
                "A subscriber of keepout_map that starts a second later receives no map.",
                "publish with latch=True",
            )
            _expect_closed(grid, heard[-1])


def _expect_closed(grid: GridMap, message: Any) -> None:
    where = f"On a map with cells of {grid.resolution} m and its origin at {grid.origin[:2]}"
    expect(
        len(message.data) == grid.occupancy.size and message.info == grid.to_message().info,
        f"{where} your map has a different size or origin.",
        "change cells of the received message, and publish it",
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
            "the centre of a cell is origin + (index + 0.5) * resolution, and its value is data[my * width + mx]",
        )


# ---- lift: the lift ----

MAPS = "package://rosmini_sim/maps/"


@exercise("lift", praise="The robot still needs its initial pose on the new floor.")
def lift(answer: Script) -> None:
    """A node that makes the server change maps, and handles a missing map."""
    with TurtleTrial(None) as trial:
        # its log contains paths of this machine
        started = rosrun("map_server", "map_server", f"{MAPS}floor.yaml", graph=trial.graph, capture_output=True)
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
                    f"There is no {name}, and your callback raises an error.",
                    "catch the failure, log an error with rospy.logerr, and return",
                )
                expect(
                    failed and name in logged,
                    f"There is no {name}, and your script logs no error that names it.",
                    "compare answer.result, and use rospy.logerr",
                )
                continue
            shown = server.grid.path
            expect(not failed, f"Your script logged an error for {name}, which exists.", "RESULT_SUCCESS is 0")
            expect(
                shown is not None and shown.name == name,
                f"The lift stopped at {name}, but the server has the map {shown and shown.name}.",
                "call change_map(message.data)",
            )
