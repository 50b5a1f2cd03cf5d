"""Logo drives the turtles of turtlesim: in one process, in simulated time."""

from math import pi

import pytest

from rosmini import Graph
from rosmini.msgs import service_class
from rosmini.sim.logo import Logo, LogoError
from rosmini.sim.turtlesim.node import TurtleSim

MIDDLE = 499 / 90


@pytest.fixture
def graph():
    with Graph(strict=False) as graph:
        yield graph


@pytest.fixture
def sim(graph):
    made = TurtleSim(graph.node("turtlesim"))
    graph.run(0.1)
    return made


@pytest.fixture
def node(graph):
    return graph.node("logo")


def place(sim, name="turtle1"):
    """Where a turtle is in the window, in steps from the middle, and its angle."""
    turtle = sim.frame.turtles[name]
    return 45 * (turtle.x - MIDDLE), 45 * (turtle.y - MIDDLE), turtle.theta


def printed(logo, program):
    lines = []
    logo.state.say = lines.append
    logo.run(program)
    return lines


def test_a_new_turtle_turns_up_and_draws_a_square(sim, node):
    logo = Logo.on(node)
    assert place(sim) == pytest.approx((0, 0, pi / 2), abs=1e-4)
    assert printed(logo, "forward 100 right 90 print pos print heading") == ["0 100", "90"]
    assert place(sim) == pytest.approx((0, 100, 0), abs=1e-4)
    logo.run("repeat 3 [forward 100 right 90]")
    assert place(sim) == pytest.approx((0, 0, pi / 2), abs=1e-4)
    lines = [stroke for stroke in sim.frame.paper.strokes() if (stroke.x1, stroke.y1) != (stroke.x2, stroke.y2)]
    assert len(lines) == len(logo.drawing.lines) == 4


def test_pens(sim, node):
    logo = Logo.on(node)
    logo.run('setpencolor "red setpensize 7 forward 10 penup forward 10')
    pens = {(s.pen.colour, s.pen.width) for s in sim.frame.paper.strokes() if (s.x1, s.y1) != (s.x2, s.y2)}
    assert pens == {((255, 0, 0), 7)}
    assert not sim.frame.turtles["turtle1"].pen_on
    logo.run("clearscreen")
    assert list(sim.frame.paper.strokes()) == []
    assert logo.drawing.lines == ()


def test_a_turtle_keeps_its_pen_when_the_window_is_reset(sim, node):
    logo = Logo.on(node)
    logo.run('setpencolor "red')
    node.service_client("reset", service_class("std_srvs/Empty"))()
    logo.run("forward 10")
    assert {s.pen.colour for s in sim.frame.paper.strokes() if (s.x1, s.y1) != (s.x2, s.y2)} == {(255, 0, 0)}


def test_several_turtles(sim, node):
    logo = Logo.on(node)
    logo.run('newturtle "bob tell "bob right 90 forward 50 ask "turtle1 [forward 30]')
    assert place(sim, "bob") == pytest.approx((50, 0, 0), abs=1e-4)
    assert place(sim) == pytest.approx((0, 30, pi / 2), abs=1e-4)
    logo.run("tell [turtle1 bob] forward 10")
    assert place(sim, "bob")[0] == pytest.approx(60, abs=1e-4)
    assert place(sim)[1] == pytest.approx(40, abs=1e-4)
    with pytest.raises(LogoError, match=r"there is no turtle bobb; did you mean bob\?"):
        logo.run('tell "bobb')
    assert [turtle.name for turtle in Logo.on(node, "bob", "turtle1").flock.active] == ["bob", "turtle1"]


def test_turtles_moved_spawned_and_killed_by_others(sim, node, graph):
    logo = Logo.on(node)
    logo.run("forward 10")
    node.service_client("turtle1/teleport_absolute", service_class("turtlesim/TeleportAbsolute"))(1.0, 2.0, 0.0)
    sim.spawn(2.0, 3.0, 0.0, "ann")
    graph.run(0.1)
    assert printed(logo, 'print xcor ask "ann [print heading]') == ["-204.5", "90"]
    node.service_client("kill", service_class("turtlesim/Kill"))("turtle1")
    assert printed(logo, "print heading") == ["90"]
    assert [turtle.name for turtle in logo.flock.active] == ["ann"]


def test_a_turtle_stays_in_the_window(sim, node):
    logo = Logo.on(node)
    with pytest.raises(LogoError, match=r"line 2: turtle out of bounds: turtle1 would leave the window at \[0 1010\]"):
        logo.run("forward 10\nforward 1000")
    assert place(sim) == pytest.approx((0, 10, pi / 2), abs=1e-4)
    logo.run("home forward 249.5")
    assert place(sim)[1] == pytest.approx(249.5, abs=1e-3)


def test_a_program_that_never_ends_is_stopped_and_the_simulator_goes_on(sim, node, graph):
    logo = Logo.on(node)
    with pytest.raises(LogoError, match="stopped after"):
        logo.run("forever []")
    before = sim.frame.updates
    graph.run(1.0)
    assert sim.frame.updates > before


def test_a_simulator_that_has_ended_is_reported(sim, node):
    logo = Logo.on(node)
    logo.state.say = lambda _: sim.node.shutdown()
    with pytest.raises(LogoError, match="turtle1 does not answer"):
        logo.run("print 1 forward 10")


def test_unknown_names(sim, node):
    with pytest.raises(LogoError, match=r"no turtle and no robot turtle9 in the graph; did you mean turtle1\?"):
        Logo.on(node, "turtle9")


def test_without_turtles_there_is_paper(graph):
    logo = Logo.on(graph.node("logo"))
    assert printed(logo, "fd 10 print pos") == ["0 10"]


def test_a_turtlesim_started_later_replaces_the_paper(graph):
    logo = Logo.on(graph.node("logo"))
    logo.run("to twice :n\nfd :n fd :n\nend\ntwice 10")
    paper = logo.flock
    logo.run("fd 5")
    assert logo.flock is paper
    assert len(logo.drawing.lines) == 3
    sim = TurtleSim(graph.node("turtlesim"))
    graph.run(0.1)
    logo.run("twice 20")
    assert place(sim) == pytest.approx((0, 40, pi / 2), abs=1e-4)
