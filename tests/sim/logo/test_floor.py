"""Logo drives a robot: by velocities, with feedback from odometry."""

import pytest

from rosmini.book.trials import Trial
from rosmini.sim.logo import Logo, LogoError
from rosmini.sim.logo.floor import FloorFlock


@pytest.fixture
def trial():
    with Trial("empty") as trial:
        trial.graph.run(0.5)
        yield trial


def test_a_robot_drives_a_square_and_comes_home(trial):
    lines = []
    logo = Logo.on(trial.graph.node("logo"), say=lines.append)
    assert isinstance(logo.flock, FloorFlock)
    logo.run("repeat 4 [forward 50 right 90] print distance [0 0] print heading")
    assert float(lines[0]) < 1.0
    assert min(float(lines[1]), 360 - float(lines[1])) < 1.0
    x, y, _ = trial.robot.truth()
    assert abs(x) < 0.05 and abs(y) < 0.05
    xs = [stroke.end.x for stroke in logo.drawing.lines]
    ys = [stroke.end.y for stroke in logo.drawing.lines]
    assert max(xs) == pytest.approx(50, abs=2) and max(ys) == pytest.approx(50, abs=2)
    trial.graph.run(1.0)
    assert trial.robot.truth()[:2] == pytest.approx((x, y), abs=2e-3)


def test_backwards_a_whole_turn_and_to_points(trial):
    lines = []
    logo = Logo.on(trial.graph.node("logo"), say=lines.append)
    start = trial.robot.truth()[2]
    logo.run("back 20 show pos right 360")
    assert trial.robot.truth()[2] == pytest.approx(start - 6.283, abs=0.2)
    logo.run("left 90 setxy 20 0 show pos print heading")
    place = [float(part) for part in lines[0][1:-1].split()]
    assert place == pytest.approx([0, -20], abs=1)
    place = [float(part) for part in lines[1][1:-1].split()]
    assert place == pytest.approx([20, 0], abs=1)
    assert float(lines[2]) == pytest.approx(270, abs=1)


def test_a_robot_without_progress_is_reported(trial):
    logo = Logo.on(trial.graph.node("logo"))
    trial.robot.node.shutdown()
    with pytest.raises(LogoError, match=r"line 1: robot is stuck: .* 5 s"):
        logo.run("forward 10")


def test_logo_cannot_make_robots(trial):
    logo = Logo.on(trial.graph.node("logo"), "/")
    with pytest.raises(LogoError, match="robot bob"):
        logo.run('newturtle "bob')
