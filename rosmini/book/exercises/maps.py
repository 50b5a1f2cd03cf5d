"""Checks of the exercises in the chapter Maps."""

from __future__ import annotations

from typing import Any

import numpy as np

from rosmini.book.checks import Script, exercise, expect, expect_type
from rosmini.book.drives import Drive, courier
from rosmini.book.trials import TurtleTrial
from rosmini.core.maps import GridMap
from rosmini.msgs.geometry_msgs.msg import PointStamped
from rosmini.msgs.nav_msgs.msg import OccupancyGrid
from rosmini.msgs.std_msgs.msg import Int8, String

# ---- here: the value of a cell ----

PLACES = (
    ((0.0, 0.0, 0.0), (0.37, 0.12), "divide by the resolution, round down; the index is row * width + column"),
    ((-5.0, 2.0, 0.0), (-4.31, 2.12), "subtract the origin first"),
    ((-5.0, 2.0, 0.0), (-5.01, 2.12), "int() rounds towards 0, so column -0.1 becomes 0: use math.floor"),
    ((1.0, -2.0, 0.0), (1.2, -1.6), "rows go from 0 to height - 1"),
    ((1.0, -2.0, 0.0), (2.1, -1.9), "columns go from 0 to width - 1"),
)


@exercise("here", praise="RViz, amcl and every costmap contain these lines.")
def here(answer: Script) -> None:
    """The value of the map at a clicked point; -1 outside the map."""
    expect_type(answer, Script, "The answer is", "a script")
    cells = np.arange(30, dtype=np.int8).reshape(3, 10)
    for origin in dict.fromkeys(origin for origin, _, _ in PLACES):
        grid = GridMap(cells, 0.1, origin)
        with TurtleTrial(None) as trial:
            desk = trial.graph.node("desk")
            desk.publisher("map", OccupancyGrid, latch=True, queue_size=1).publish(grid.to_message())
            clicks = desk.publisher("clicked_point", PointStamped, queue_size=5)
            heard: list[Any] = []
            desk.subscriber("cell_value", Int8, heard.append)
            trial.start(answer)
            trial.run(1.0)
            for _, (x, y), hint in (place for place in PLACES if place[0] == origin):
                point = PointStamped()
                point.header.frame_id, point.point.x, point.point.y = "map", x, y
                heard.clear()
                clicks.publish(point)
                trial.run(0.5)
                where = f"On a map of 10 x 3 cells of 0.1 m with its origin at {origin[:2]}"
                trial.expect_no_errors()
                expect(bool(heard), f"{where} a click at ({x}, {y}) gave no message on cell_value.", "publish an Int8")
                cell = grid.world_to_map(x, y)
                wanted = -1 if cell is None else int(cells[cell[1], cell[0]])
                said = "outside" if cell is None else f"in column {cell[0]} and row {cell[1]}"
                expect(
                    heard[-1].data == wanted,
                    f"{where} the point ({x}, {y}) is {said}. The value is {wanted}, not {heard[-1].data}.",
                    hint,
                )


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
            f"An image of shape {picture.shape} was turned into a map of shape {found.shape}.",
        )
        said = f"For {picture.tolist()} with free_thresh {free}, occupied_thresh {occupied} and negate {negate}"
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

KEEPOUT = "global_costmap: {static_layer: {map_topic: keepout_map}}"
CORRIDOR, FAR_END = (-1.3, 0.6, 0.0), (1.6, 0.6, 0.0)


@exercise("keepout", praise="The robot drives round the wet floor, although its laser sees nothing there.")
def keepout(answer: Script) -> Any:
    """A node that marks a square metre of any map as occupied, so that a robot drives round it."""
    expect_type(answer, Script, "The answer is", "a script")
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
                "A subscriber to keepout_map that starts a second later receives no map.",
                "publish with latch=True",
            )
            _expect_closed(grid, heard[-1])
    drive, _ = courier(KEEPOUT, "settings", CORRIDOR, before=answer)
    with drive:
        drive.expect_arrival(FAR_END, 40.0, "publish each map that you receive")
        inside = [(x, y) for x, y in drive.driven() if 0 < x < 1 and 0 < y < 1]
        expect(not inside, f"The robot drove through the forbidden square, at {inside[:1]}.", "publish on keepout_map")
        return drive.view()


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
            f"{where} the cell in column {mx} and row {my} is {found[my, mx]}, not {wanted[my, mx]}.",
            "the centre of a cell is origin + (index + 0.5) * resolution, and its value is data[row * width + column]",
        )


# ---- lift: the lift ----

MAPS = "package://rosmini_sim/maps/"
WRONG_FLOOR = """
<launch>
  <include file="$(find rosmini_sim)/launch/navigation.launch">
    <arg name="map_file" value="$(find rosmini_sim)/maps/floor.yaml"/>
  </include>
</launch>
"""


@exercise("lift", praise="With the map of its floor the robot finds its way.")
def lift(answer: Script) -> Any:
    """A node that makes the server change maps, and handles a missing map; then the robot drives."""
    expect_type(answer, Script, "The answer is", "a script")
    with Drive(WRONG_FLOOR) as drive:
        server: Any = drive.graph.nodes["/map_server"].program
        drive.start(answer)
        button = drive.graph.node("button").publisher("floor", String, queue_size=5)
        drive.run(1.0)
        for name in ("office.yaml", "cellar.yaml", "house.yaml"):
            errors = drive.output.count("[ERROR]")
            button.publish(String(MAPS + name))
            drive.run(0.5)
            failed = drive.output.count("[ERROR]") > errors
            if name == "cellar.yaml":
                logged = drive.output.rpartition("[ERROR]")[2]
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
        drive.expect_arrival((-1.5, 0.8, 0.0), 25.0, "change the map once for each message")
        return drive.view()
