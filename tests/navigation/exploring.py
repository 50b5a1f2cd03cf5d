"""A graph with a map that can change, a robot's transforms, and what stands in for move_base."""

from __future__ import annotations

import numpy as np

from rosmini.core.actionlib import SimpleActionServer
from rosmini.core.tf import TransformBroadcaster
from rosmini.core.tf.rigid import from_yaw
from rosmini.msgs import message_class

RESOLUTION = 0.1


class Stage:
    """A map of 4 m x 3 m whose lower left corner is (0, 0), a robot at `pose`, and a base that jumps to its goals."""

    def __init__(self, graph):
        self.graph = graph
        self.pose = (1.05, 1.05, 0.0)
        self.node = node = graph.node("robot")
        self.logs = []
        node.subscriber("/rosout", message_class("rosgraph_msgs/Log"), self.logs.append)
        self.moving = TransformBroadcaster(node)
        self.timer = node.timer(0.05, lambda _: self.moving.send_rigid("map", "base_link", from_yaw(*self.pose)))
        self.maps = node.publisher("map", message_class("nav_msgs/OccupancyGrid"), latch=True)
        self.maps.expect_nobody()
        self.cells = np.full((30, 40), -1, dtype=np.int8)
        self.goals = []
        self.sight = 0.5
        self.answer = "set_succeeded"
        self.refused = lambda *_: False
        """Which goals (x, y) are aborted whatever the answer is."""
        self.detour = None
        """For a goal (x, y) the pose where it is for the 3 s that the way takes, and in which it may be called off."""
        self.base = SimpleActionServer(
            node, "move_base", message_class("move_base_msgs/MoveBaseAction"), execute_cb=self._drive, auto_start=False
        )

    def publish(self):
        """Publish the map."""
        message = message_class("nav_msgs/OccupancyGrid")()
        message.header.frame_id, message.info.resolution = "map", RESOLUTION
        message.info.height, message.info.width = self.cells.shape
        message.data = self.cells.ravel()
        self.maps.publish(message)

    def know(self, x0, y0, x1, y1, value=0):
        """Let a rectangle [m] be known."""
        rows = slice(round(y0 / RESOLUTION), round(y1 / RESOLUTION))
        self.cells[rows, round(x0 / RESOLUTION) : round(x1 / RESOLUTION)] = value
        self.publish()

    def _drive(self, goal):
        p = goal.target_pose.pose.position
        self.goals.append((round(p.x, 3), round(p.y, 3)))
        if self.answer is None:  # it drives and never arrives
            while not self.base.is_preempt_requested():
                self.node.sleep(0.1)
            self.base.set_preempted()
            return
        if self.detour is not None:
            self.pose = self.detour(p.x, p.y)
            for _ in range(30):
                if self.base.is_preempt_requested():
                    self.base.set_preempted()
                    return
                self.node.sleep(0.1)
        self.node.sleep(1.0)
        answer = "set_aborted" if self.refused(p.x, p.y) else self.answer
        if answer == "set_succeeded":
            self.pose = (p.x, p.y, 0.0)
            self.arrived(p.x, p.y)
        getattr(self.base, answer)()

    def arrived(self, x, y):
        """Learn what is within sight."""
        far = self.sight
        self.know(max(x - far, 0.0), max(y - far, 0.0), min(x + far, 4.0), min(y + far, 3.0))

    def said(self, text, name=None):
        """The lines of the log with this text."""
        return [log.msg for log in self.logs if text in log.msg and name in (None, log.name)]
