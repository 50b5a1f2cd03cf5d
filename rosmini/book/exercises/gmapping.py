"""Checks of the exercises in the chapter GMapping."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from rosmini.book.checks import Script, exercise, expect, expect_type
from rosmini.book.drives import Launched
from rosmini.book.trials import Trial
from rosmini.core.graph import Graph
from rosmini.msgs.nav_msgs.msg import OccupancyGrid
from rosmini.ros.launch import roslaunch
from rosmini.ros.scripts import rosrun


@exercise("data_of", praise="RViz can draw this map.")
def data_of(answer: Any) -> None:
    """Unknown, free and occupied cells, in the order of the message."""
    hits = np.array([[0, 1, 1, 0], [0, 0, 3, 5]])
    visits = np.array([[0, 1, 4, 7], [2, 0, 10, 10]])
    for threshold, wanted in ((0.25, [-1, 100, 0, 0, 0, -1, 100, 100]), (0.4, [-1, 100, 0, 0, 0, -1, 0, 100])):
        found = answer(hits.copy(), visits.copy(), threshold)
        expect_type(found, list, "It returned", "a list", "use array.ravel().tolist()")
        expect(
            len(found) == len(wanted),
            f"The list has {len(found)} entries for {hits.size} cells.",
            "return one entry for each cell, row by row: ravel()",
        )
        for place, (mine, right) in enumerate(zip(found, wanted, strict=True)):
            row, column = divmod(place, hits.shape[1])
            expect(
                mine == right,
                f"The cell in row {row}, column {column} has {hits[row, column]} hits in {visits[row, column]} visits. "
                f"With occ_thresh {threshold} it is {right}, not {mine!r}.",
                "never visited gives -1; more hits per visit than occ_thresh gives 100, otherwise 0",
            )


MAPPED_S = 40.0
"""Duration of the drive in exercise mapper [s]."""
WANDER = Script(
    "wander.py",
    """
import rospy
from geometry_msgs.msg import Twist
from sensor_msgs.msg import LaserScan

def on_scan(scan):
    command = Twist()
    if min(scan.ranges[:30] + scan.ranges[-30:]) > 0.4:
        command.linear.x = 0.2
    else:
        command.angular.z = 0.7
    cmd_vel.publish(command)

rospy.init_node("wander")
cmd_vel = rospy.Publisher("cmd_vel", Twist, queue_size=1)
rospy.Subscriber("scan", LaserScan, on_scan)
rospy.spin()
""",
)


@exercise("mapper", praise="The robot has a map of the whole room.")
def mapper(answer: Any) -> Any:
    """A launch file with which gmapping maps a room."""
    expect_type(answer, str, "mapper is", "a text")
    with Launched(answer, "/cart") as trial:
        maps = _Maps(trial.graph)
        trial.start(WANDER)
        trial.run(MAPPED_S)
        expect(
            maps.count > 0,
            f"There was no message on map within {MAPPED_S:.0f} s.",
            "which frames does the robot have? rqt_tf_tree draws them",
        )
        expect(
            maps.known > ROOM_CELLS,
            f"After {MAPPED_S:.0f} s the map has {maps.known} known cells; the room has at least {ROOM_CELLS}.",
            "how far does gmapping use the beams? The laser reaches 3.5 m",
        )
        return trial.view()


ROOM_CELLS = 3000
"""Least number of known cells in the map of the room."""

DULL, NEWS = 3, 40
"""A map is complete when this number of maps in a row each has fewer new cells than this."""
LONGEST, REST = 150.0, 20.0
"""Longest time that the robot may drive, and time that it must stand still at the end [s]."""
STEP = 0.5


@exercise("map_is_done", gaps=2, praise="The robot stops by itself when the map is complete.")
def surveyor(answer: Script) -> Any:
    """The robot drives while maps contain new cells, and then stops."""
    view = None
    for start in (("_x:=0.0", "_y:=0.0"), ("_x:=1.6", "_y:=0.3", "_yaw:=2.0")):
        with Trial("room", *start) as trial:
            view = _surveyed(trial, answer)
    return view


def _surveyed(trial: Trial, answer: Script) -> Any:
    """Drive and map until the robot should have stopped, and a little longer."""
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
    expect(maps.count > 1 and moved > 0, "The robot did not drive.", "publish a Twist for each scan")
    expect(
        maps.done < math.inf,
        f"After {LONGEST:.0f} s there were still new cells in every third map: the robot does not cover the room.",
        "drive as in wander.py",
    )
    expect(
        moved > maps.done - 2.0,
        f"The robot stopped after {moved:.0f} s; the third map in a row without new cells came after "
        f"{maps.done:.0f} s.",
        "three in a row: a map with new cells resets the counter",
    )
    expect(
        moved < maps.done + 4.0,
        f"The third map in a row without new cells came after {maps.done:.0f} s, but the robot drove until "
        f"{moved:.0f} s.",
        "after the third, publish an empty Twist and no other command",
    )
    return trial.view()


BOUNDS = {
    "linearUpdate": 0.3, "angularUpdate": 0.4, "map_update_interval": 2,
    "xmin": -5, "ymin": -5, "xmax": 5, "ymax": 5,
}  # fmt: skip


class _Maps:
    """Counts maps, and stores when the last of `DULL` maps without new cells arrived [s]."""

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
