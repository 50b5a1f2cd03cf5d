"""The node `gazebo_ros/gzclient`: a view of a running server in the same process.

It shows the server's world as of the last poses, which it receives as often as Gazebo's client does. The simulation
runs with or without a client.
"""

from __future__ import annotations

from functools import partial

from rosmini.core.errors import ScriptError
from rosmini.core.graph import Node

from .snapshot import Pictured, Snapshot
from .topics import GazeboMaster, Poses, address, find_master

WAIT_S = 30.0
"""Time a client waits for a server [s]."""

IGNORED = ("--verbose", "-g", "--gui-plugin", "--gui-client-plugin")


class GazeboClient(Pictured):
    """A view of a running server.

    Args:
        node: the started node.
        args: arguments of gzclient: --verbose, -g PLUGIN; they have no effect.

    Raises:
        ScriptError: other arguments.
        ROSException: no server runs at the address of Gazebo's Master.

    """

    node_name = "gazebo_gui"

    def __init__(self, node: Node, *args: str) -> None:
        wrong = [word for word in args if word.startswith("-") and word not in IGNORED]
        if wrong:
            raise ScriptError(f"gzclient: there is no option {wrong[0]}; it has {', '.join(IGNORED)}")
        self.node = node
        graph = node.graph
        node.wait_until(
            lambda: find_master(graph) is not None,
            WAIT_S,
            "Gazebo's server",
            lambda: f"no server runs at {address()}: start one with `rosrun gazebo_ros gzserver`",
        )
        master = find_master(graph)
        if master is None:
            raise ScriptError(f"the server at {address()} has ended")
        self.master: GazeboMaster = master
        self._poses = Poses.of(master.world)
        self._lane = node.spawn(f"{node.name} display")
        self._program = f"gzclient {node.name}"
        master.join(self._program)
        master.poses.listeners.append(self._moved)
        node.on_shutdown(self._close)
        master.poses.publish()
        graph.changes.notify()

    def _close(self) -> None:
        self.master.leave(self._program)
        self.master.poses.listeners.remove(self._moved)

    def _moved(self, poses: Poses) -> None:
        self._lane.post(partial(setattr, self, "_poses", poses))  # as a message, it arrives after the step

    @property
    def models(self) -> tuple[str, ...]:
        """The names of the models."""
        return tuple(self.master.world.models)

    @property
    def text(self) -> str:
        """The number of models, and the position of each that is not static."""
        shown = self.snapshot()
        moving = [
            f"{model.name} at ({model.pose[0]:.2f}, {model.pose[1]:.2f})" for model in shown.models if not model.static
        ]
        count = len(shown.models)
        there = f"{count} model{'' if count == 1 else 's'} in {shown.name}"
        return f"{there}: {', '.join(moving)}" if moving else there

    def snapshot(self) -> Snapshot:
        """Return the world as of the last poses."""
        return Snapshot.of(self.master.world, self._poses)
