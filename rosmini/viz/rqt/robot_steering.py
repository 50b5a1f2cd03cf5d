"""`rqt_robot_steering`: a pad with keys that drives a robot or a turtle (http://wiki.ros.org/rqt_robot_steering)."""

from __future__ import annotations

from optparse import Values

from rosmini.core.verbs import Call, Parser
from rosmini.viz.view import View

from .plugin import Plugin


class RobotSteering(Plugin):
    """A pad for a robot of the graph's simulator: the named robot, or the first."""

    tool, heading, plugin = "rqt_robot_steering", "Robot Steering", "rqt_robot_steering/RobotSteering"
    group, summary = "Robot Tools", "drive a robot, with keys"
    usage, instead = "[ROBOT]", "roslaunch turtlebot3_teleop turtlebot3_teleop_key.launch"

    @classmethod
    def add_options(cls, parser: Parser) -> None:
        """Add the caption."""
        parser.add_option("--title", metavar="TEXT", help="a caption under the pad")

    @classmethod
    def opened(cls, given: Values, call: Call) -> View:
        """Open a pad; without a simulator it publishes on /cmd_vel."""
        from rosmini.sim.simulation import Simulation
        from rosmini.sim.turtlesim import TurtleSim
        from rosmini.viz.live.pad import TeleopPad

        programs = [node.program for _, node in sorted(call.graph.nodes.items())]
        driven = next((each for each in programs if isinstance(each, Simulation | TurtleSim)), call.graph)
        return TeleopPad(driven, robot="".join(given.words), title=given.title)
