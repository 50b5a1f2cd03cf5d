"""Checks of the exercises in the chapter Frontier exploration."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from rosmini import rosrun
from rosmini.book.checks import Script, exercise, expect
from rosmini.book.trials import TurtleTrial
from rosmini.core.actionlib import SimpleActionServer
from rosmini.core.geometry.polygons import area, crossing_sides
from rosmini.msgs.frontier_exploration.msg import ExploreTaskAction
from rosmini.msgs.nav_msgs.msg import OccupancyGrid
from rosmini.msgs.std_msgs.msg import Float64

Cells = set[tuple[int, int]]

GROUPS: tuple[tuple[Cells, list[int], str], ...] = (
    ({(0, 0), (1, 0), (2, 0)}, [3], "three cells in a row are one frontier"),
    ({(0, 0), (1, 1), (2, 2), (3, 1)}, [4], "cells that touch at a corner belong together"),
    ({(0, 0), (5, 5), (6, 5), (6, 6)}, [3, 1], "separate groups are separate frontiers, the largest first"),
    ({(0, 0), (0, 2), (2, 0), (1, 1)}, [4], "cells may be joined by a chain through others"),
    ({(0, 0), (2, 0), (4, 1), (-3, -3)}, [1, 1, 1, 1], "cells with another cell between them do not touch"),
    (set(), [], "without cells there is no frontier"),
    ({(i, 0) for i in range(20_000)}, [20_000], "a frontier may be very long, so do not use recursion"),
)


@exercise("sizes", praise="Your function finds the same groups as the explorer.")
def sizes(answer: Any) -> None:
    """The sizes of the connected groups."""
    expect(callable(answer), f"sizes is {answer!r}, not a function.", "write def sizes(cells): ...")
    for cells, wanted, why in GROUPS:
        given = set(cells)
        try:
            found = answer(given)
        except RecursionError:
            found = "a RecursionError"
        shown = sorted(cells) if len(cells) < 9 else f"{len(cells)} cells in a row"
        said = f"For {shown} it returned {found!r}, not {wanted}."
        ok = isinstance(found, list | tuple) and list(found) == wanted
        expect(ok, said, why)
        expect(given == cells, "It changes the set in its argument.", "left = set(cells) makes a copy")


@exercise("clicker", praise="Your script replaces six clicks in RViz.")
def clicker(answer: Script) -> None:
    """The points that make `explore_client` send a square."""
    with TurtleTrial(None) as trial:
        goals: list[Any] = []
        node = trial.graph.node("explore_server")

        def take(goal: Any) -> None:
            goals.append(goal)
            server.set_succeeded()

        server = SimpleActionServer(node, "explore_server", ExploreTaskAction, take, auto_start=False)
        server.start()
        trial.start(answer)
        trial.run(3.0)
        client: Any = rosrun(
            "frontier_exploration", "explore_client", graph=trial.graph, capture_output=True
        ).instance()
        trial.run(12.0)
        vertices = client.selection.polygon
        expect(
            bool(goals),
            f"explore_client sent no area within 12 s of its start; it has {len(vertices)} vertices.",
            "publish the corners, the first one again, and a point inside; before, wait for get_num_connections()",
        )
        goal = goals[0]
        expect(
            goal.explore_boundary.header.frame_id.lstrip("/") == "map",
            f"The frame is {goal.explore_boundary.header.frame_id!r}, not 'map'.",
            'set header.frame_id = "map"',
        )
        corners = np.array([(p.x, p.y) for p in goal.explore_boundary.polygon.points])
        expect(
            len(corners) == 4 and crossing_sides(corners) is None,
            f"The polygon has the corners {[tuple(map(float, c)) for c in corners]}.",
            "publish four corners, in order around the square",
        )
        expect(
            math.isclose(abs(area(corners)), 16.0, rel_tol=1e-3) and bool((abs(abs(corners) - 2) < 1e-3).all()),
            f"Its area is {abs(area(corners)):.1f} m2; a square with sides of 4 m around the origin has 16 m2.",
            "it goes from -2 to 2 along both axes",
        )


@exercise("surveyor", praise="The number grows while the robot explores.")
def surveyor(answer: Script) -> None:
    """The known area of each map."""
    draw = np.random.default_rng(3)
    with TurtleTrial(None) as trial:
        node = trial.graph.node("mapper")
        heard: list[float] = []
        node.subscriber("known_area", Float64, lambda message: heard.append(message.data))
        maps = node.publisher("map", OccupancyGrid, queue_size=5)
        trial.start(answer)
        trial.run(2.0)
        for width, height, resolution in ((8, 5, 0.5), (20, 30, 0.05)):
            cells = draw.choice(np.array([-1, 0, 100], dtype=np.int8), width * height)
            message = OccupancyGrid()
            message.header.frame_id, message.info.resolution = "map", resolution
            message.info.width, message.info.height, message.data = width, height, cells
            maps.publish(message)
            trial.run(1.0)
            wanted = float((cells >= 0).sum()) * resolution**2
            expect(bool(heard), "There was no message on known_area.", "call area.publish(...) in on_map")
            expect(
                math.isclose(heard[-1], wanted, rel_tol=1e-4),
                f"Of a map with {(cells >= 0).sum()} known cells of {resolution} m it published {heard[-1]:.4g} m2, "
                f"not {wanted:.4g} m2.",
                "multiply the number of known cells by the resolution squared; free is 0, occupied 100, unknown -1",
            )
