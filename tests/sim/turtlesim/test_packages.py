"""Scripts and launch files around turtlesim: `turtle_tf`, `turtle_tf2` and `turtlesim_cleaner`."""

import io
import math

import pytest

from rosmini import Graph, rosrun
from rosmini.msgs.geometry_msgs.msg import Twist
from rosmini.ros.launch import roslaunch
from rosmini.sim.turtlesim import window


@pytest.mark.parametrize("version", ["", "2"])
def test_the_second_turtle_comes_after_the_first(version):
    with Graph() as graph:
        launch = roslaunch(f"turtle_tf{version}", f"turtle_tf{version}_demo.launch", graph=graph, console={"stdin": ""})
        graph.run(3.0)
        sim = window("/sim", graph)
        assert list(sim.turtles) == ["turtle1", "turtle2"]
        nodes = {name for name in graph.nodes if name.startswith("/t")}
        names = {f"/turtle{number}_tf{version}_broadcaster" for number in (1, 2)}
        assert nodes == {"/teleop", "/turtle_pointer", *names}
        driver = graph.node("driver").publisher("turtle1/cmd_vel", Twist)
        driver.wait_for_subscribers()
        twist = Twist()
        twist.linear.x, twist.angular.z = 2.0, 1.0
        driver.publish(twist)
        graph.run(0.8)
        first, second = sim.turtles.values()
        assert math.dist((first.x, first.y), (second.x, second.y)) > 0.5
        graph.run(15.0)
        assert math.dist((first.x, first.y), (second.x, second.y)) < 0.1
        launch.stop()


def clean(script, typed, seconds):
    out = io.StringIO()
    with Graph() as graph:
        sim = rosrun("turtlesim", "turtlesim_node", graph=graph).instance()
        run = rosrun("turtlesim_cleaner", script, graph=graph, stdin=typed, stdout=out, stderr=out, prefix="")
        graph.run(seconds)
        return sim, out.getvalue(), run.poll()


def test_a_straight_line_and_a_turn():
    sim, said, status = clean("move.py", "1\n3\ny\n", 6.0)
    assert (status, "moved 3.00 forward" in said) == (0, True)
    assert sim.turtles["turtle1"].x == pytest.approx(5.54 + 3.0, abs=0.1)
    sim, said, status = clean("rotate.py", "90\n180\ny\n", 6.0)
    assert (status, "turned by 180 degrees clockwise" in said) == (0, True)
    assert abs(sim.turtles["turtle1"].theta) == pytest.approx(math.pi, abs=0.1)
    assert clean("move.py", "0\n3\ny\n", 6.0)[1].rstrip().endswith("at the speed 0 the turtle never arrives")


def test_to_a_goal():
    sim, said, status = clean("gotogoal.py", "1\n9\n0.1\n", 20.0)
    turtle = sim.turtles["turtle1"]
    assert (status, f"at ({turtle.x:.2f}, {turtle.y:.2f})" in said) == (0, True)
    assert math.dist((turtle.x, turtle.y), (1.0, 9.0)) < 0.11
    assert "the window is 11 by 11 metres" in clean("gotogoal.py", "50\n9\n0.1\n", 1.0)[1]


def test_a_spiral_and_a_sweep():
    sim, said, status = clean("spiral.py", "", 60.0)
    assert (status, "near a wall" in said) == (0, True)
    turtle = sim.turtles["turtle1"]
    assert math.dist((5.54, 5.54), (turtle.x, turtle.y)) > 4.0
    sim, said, status = clean("sweep.py", "", 80.0)
    assert (status, "swept 10 lanes" in said) == (0, True)
    image = sim.frame.paper.image()
    swept = sum(image[at : at + 3] == b"\xff\xff\xff" for at in range(0, len(image), 3)) / (len(image) / 3)
    assert 0.1 < swept < 0.25  # ten lanes of nine metres, eight pixels wide
