"""A drive of turtles, to be played."""

from rosmini import Graph, rosrun


def call(sim):
    graph = sim.node.graph
    tape = sim.record()
    rosrun("turtlesim", "draw_square", graph=graph)
    graph.run(5.0)
    sim.spawn(2.0, 2.0, 0.0, "ann")
    graph.run(1.0)
    tape.stop()
    graph.run(5.0)
    return tape.replay(title="Figure 1: A square")


def test_a_tape_is_played():
    with Graph() as graph:
        view = call(rosrun("turtlesim", "turtlesim_node", graph=graph).instance())
    assert view.text == (
        "Figure 1: A square: 6.0 s\n"
        "turtle1: start (5.54, 5.54, 0.0 deg), end (5.54, 5.54, 0.0 deg), 0.00 m\n"
        "turtle1: start (5.54, 5.54, 0.0 deg), end (7.45, 5.64, 89.5 deg), 2.00 m\n"
        "ann: start (2.00, 2.00, 0.0 deg), end (2.00, 2.00, 0.0 deg), 0.00 m\n"
        "drawing: 1 stroke, 2.00 m"
    )
    assert "Layers that can be switched: drawing." in view.alt
    assert view.data["background"] == "#4556ff"
    assert view.data["bounds"] == [0.0, 0.0, 11.089, 11.089]
    assert view.still.svg is not None
    assert len(view.html) < 120_000
