"""Checks of the exercises in the chapter The Navigation Stack: in each the robot drives with the whole stack."""

from __future__ import annotations

import math
from typing import Any

from rosmini.book.checks import Script, exercise, expect, expect_type
from rosmini.book.drives import Drive, courier

# ---- stack: a launch file in which two nodes are missing ----

TABLE = (1.2, 0.9, 0.0)
"""A free place in the world room."""


@exercise("stack", praise="The robot has a map, knows where it is, and drives.")
def stack(answer: Any) -> Any:
    """A launch file with map and localisation, with which the robot drives in the room."""
    expect_type(answer, str, "stack is", "a text")
    with Drive(answer) as drive:
        nodes: Any = drive.graph.nodes
        expect(
            drive.robot.world.name == "room",
            f"The robot is in the world {drive.robot.world.name}, not in the room.",
            "leave the first tag as it is",
        )
        server = nodes.get("/map_server")
        expect(server is not None, "There is no node /map_server, so there is no map.", "which node publishes /map?")
        path = server.program.grid.path
        expect(
            path is not None and path.name == "room.yaml",
            f"The robot is in the room, but the map is {path and path.name}.",
            "the argument of map_server is the file of the map",
        )
        expect(
            "/fake_localization" in nodes or "/amcl" in nodes,
            "No node publishes the transform from map to odom.",
            "which node says where the robot is on the map?",
        )
        drive.expect_arrival(TABLE, 25.0, "is it the map of this room? Is the chain of transforms complete?")
        return drive.view()


# ---- go_there: a goal from a program ----

PLACE = (-1.0, 2.6, math.pi / 2)
HALL = (-3.0, 1.0, 0.0)


@exercise("go_there", praise="The script waited for a subscriber, and the robot arrived.")
def go_there(script: Any) -> Any:
    """The script sends the robot to the dining room, although it starts before the Navigation Stack listens."""
    expect_type(script, Script, "The answer is", "a script")
    drive, _ = courier("{}", "settings", HALL, before=script)
    with drive:
        drive.finish(30.0)
        goal = drive.graph.nodes["/move_base"].program.goal
        expect(
            goal is None or goal.header.frame_id == "map",
            f"move_base cannot plan to a goal in the frame {goal and goal.header.frame_id!r}.",
            "set goal.header.frame_id to the frame of the map",
        )
        expect(
            bool(drive.results),
            "move_base received no goal, or is not finished with it after 30 s. Your node starts before move_base.",
            "before you publish, wait until get_num_connections() is not 0; the topic is move_base_simple/goal",
        )
        x, y, yaw = drive.robot.truth()
        expect(
            "reached" in drive.results[0],
            f"The robot did not arrive. move_base said: {drive.results[0]}",
            "check the frame, the position, and that the quaternion has length 1",
        )
        expect(
            math.dist((x, y), PLACE[:2]) < 0.25,
            f"The robot is at ({x:.1f}, {y:.1f}), not at {PLACE[:2]}.",
            "set goal.pose.position, and the frame map",
        )
        off = abs(math.remainder(yaw - PLACE[2], math.tau))
        expect(off < 0.4, f"The robot's heading is {off:.1f} rad off.", "a quarter turn to the left has z = w = 0.7071")
        return drive.view()


# ---- nearest: the shortest of four paths ----

STARTS = (
    (HALL, (-5.2, 0.8), "In a straight line (-2.6, 2.4) is nearer, but there is a wall in between."),
    ((-1.0, -1.0, 1.57), (-2.2, -0.9), "The place depends on where the robot starts."),
)


@exercise("nearest", praise="It planned four paths, and drove the shortest.", gaps=2)
def nearest(script: Any) -> Any:
    """The script drives to the customer with the shortest path, from two starts."""
    expect_type(script, Script, "The answer is", "a script")
    for start, place, why in STARTS:
        drive, _ = courier("{}", "settings", start)
        with drive:
            drive.start(script)
            drive.run(5.0)
            drive.expect_no_errors()
            where = f"The robot starts at {start[:2]}"
            expect(bool(drive.goals), f"{where}. After 5 s there was no goal.", "publish one on move_base_simple/goal")
            goal = drive.goals[-1].pose.position
            expect(
                math.dist((goal.x, goal.y), place) < 0.1,
                f"{where}. Your node sent the robot to ({goal.x:.1f}, {goal.y:.1f}), not to {place}. {why}",
                "compare the lengths of the paths; an empty path leads nowhere",
            )
            drive.finish(30.0)
            said = drive.results[0] if drive.results else "nothing"
            expect(
                "reached" in said,
                f"{where}. The robot did not arrive; move_base said: {said}",
                "publish the goal once, with its frame and a heading",
            )
            view = drive.view()
    return view
