"""The turtlesim that runs in a graph is found."""

import pytest

from rosmini import Graph, rosrun
from rosmini.sim.turtlesim import TurtleError, window


def test_the_one_that_runs_is_found_and_of_several_the_named_one():
    with Graph() as graph:
        with pytest.raises(TurtleError, match="rosrun turtlesim turtlesim_node"):
            window(graph=graph)
        first = rosrun("turtlesim", "turtlesim_node", graph=graph).instance()
        assert window(graph=graph) is window("turtlesim", graph) is first
        second = rosrun("turtlesim", "turtlesim_node", "__ns:=/left", graph=graph).instance()
        assert window("/left/turtlesim", graph) is second
        with pytest.raises(TurtleError, match="2 windows: say which one is meant, of /left/turtlesim, /turtlesim"):
            window(graph=graph)
        with pytest.raises(TurtleError, match="no turtlesim is called /turtlesin: did you mean /turtlesim"):
            window("turtlesin", graph)
