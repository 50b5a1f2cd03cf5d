"""The measurements of the simulator run, and give no figure for a robot that is not right.

How fast it is is not judged.
"""

import json
import math
import os

import numpy as np
import pytest
from rosmini_bench import sim, sim_checks, sim_engine, sim_growth, sim_peer, sim_physics, sim_room, sim_run

from rosmini.core.errors import RosminiError
from rosmini.sim.models import BURGER
from rosmini.tools.main import main


@pytest.mark.nightly
def test_the_simulator_is_measured_beside_the_others(tmp_path, capsys):
    file = tmp_path / "figures.json"
    assert main(["bench", "sim", "--rounds", "1", "--scale", "0.01", "--json", str(file)]) == 0
    shown = capsys.readouterr().out
    rows = json.loads(file.read_text(encoding="utf-8"))["figures"]
    irsim = sim_peer.find_irsim()
    measures = list(sim.measures(irsim, 0.01))
    assert [row["name"] for row in rows] == [measure.name for measure in measures]
    assert all(row["name"] in shown for row in rows)
    assert all(row["ours"] > 0 for row in rows if row["unit"].endswith("s/s"))
    if irsim is None:
        assert os.environ.get("ROSMINI_REQUIRE_BENCH") != "1", "ir-sim is required here"
        assert "ir-sim is not installed" in shown
        assert rows[0]["peer"] is None
    else:
        assert rows[0]["peer_name"] == irsim.name
        assert all(row["peer"] > 0 for row in rows[:3])
    assert all(row["peer"] > 0 for row in rows if row["peer_name"].startswith("pymunk"))


def test_robots_have_room_for_their_circles_and_no_more_come_than_that():
    starts = sim_room.starts(100)
    middles = [
        (x - sim_room.RADIUS * math.sin(heading), y + sim_room.RADIUS * math.cos(heading)) for x, y, heading in starts
    ]
    apart = [math.dist(one, other) for i, one in enumerate(middles) for other in middles[:i]]
    assert min(apart) > 2 * (sim_room.RADIUS + BURGER.reach)
    with pytest.raises(RosminiError, match="1000 robots do not fit"):
        sim_room.starts(1000)


@pytest.fixture(scope="module")
def run():
    """What is heard of two robots in one piece of a run, and how far they were told to go."""
    taken = []

    def take(heard, _model, _seconds, way):
        taken.append(
            ({name: {topic: list(rows) for topic, rows in topics.items()} for name, topics in heard.items()}, way)
        )

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(sim_run, "check_run", take)
        assert sim_run.real_time_factor(sim_run.PIECE, 2) > 0
    return taken[0]


def check(run, **changes):
    """Check what was heard, with changes to what the first robot told."""
    heard, way = {name: dict(topics) for name, topics in run[0].items()}, run[1]
    for topic, change in changes.items():
        heard[""][topic] = change(heard[""][topic])
    sim_checks.check_run(heard, BURGER, sim_run.PIECE, way)


def test_a_run_that_is_right_passes(run):
    check(run)
    assert set(run[0]) == {"", "robot_1"}
    assert all(set(topics) == set(sim_checks.READERS) for topics in run[0].values())


def changed(index, change):
    """All rows with another value at `index`."""
    return lambda rows: [(*row[:index], change(row[index]), *row[index + 1 :]) for row in rows]


def moved(place):
    return (place[0] * 1.3, place[1] * 1.3, *place[2:])


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"imu": lambda rows: rows[:-3]}, r"397 messages on imu|398 messages on imu"),
        ({"odom": lambda rows: [*rows[:5], *rows[6:]]}, "odom are not 0.0333 s apart"),
        ({"scan": changed(1, lambda _: "laser")}, "the frame of scan is laser, not base_scan"),
        ({"tf": changed(2, lambda _: "base_link")}, "odom leads to base_footprint, base_link"),
        ({"joint_states": changed(2, lambda names: names[::-1])}, "the joints are"),
        ({"joint_states": changed(3, lambda angle: 2 * angle)}, "not that of the joints"),
        ({"tf": changed(3, moved)}, "odom and tf do not agree"),
        ({"base_pose_ground_truth": changed(3, moved)}, "was told to go"),
        ({"scan": changed(4, lambda ranges: ranges[:-1])}, "359"),
    ],
)
def test_a_run_that_is_not_right_gives_no_figure(run, changes, words):
    with pytest.raises(RosminiError, match=words):
        check(run, **changes)


def test_wrong_ranges_give_no_figure():
    cast = sim.rosmini_scan("numpy")
    with pytest.raises(RosminiError, match="ranges are wrong"):
        sim.scans(lambda world, x, y: cast(world, x + 1e-3, y), 1)


def peers_run(**changes):
    x, y, theta = sim_room.START
    found = {"poses": [[x, y, theta]], "lengths": [1.0], "expected": 1.0, "angle_min": -math.pi, "radius": 0.1}
    found["angle_increment"] = 2 * math.pi / 359
    world = sim_room.room()
    exact = sim.raycast(
        world.segments, world.discs, x, y, theta - math.pi, 2 * math.pi / 359, 360, 3.5, backend="numpy"
    )
    found["ranges"] = np.minimum(exact, 3.5).tolist()
    return found | changes


def test_the_peer_has_to_drive_and_to_see_the_same_room():
    sim_peer.check(peers_run())
    with pytest.raises(RosminiError, match=r"went 0.20 m, not 1.00 m"):
        sim_peer.check(peers_run(lengths=[0.2]))
    with pytest.raises(RosminiError, match="not that of the room"):
        sim_peer.check(peers_run(ranges=[1.0] * 360))


@pytest.mark.nightly
def test_robots_that_do_not_meet_give_no_figure_of_a_crowd():
    assert sim_engine.crowd_factor(1.0, 60) > 0
    with pytest.raises(RosminiError, match="none of 1 robots touched anything"):
        sim_engine.crowd_factor(1.0, 1)


# -- what it is right about --------------------------------------------------------------------------------------


def test_the_test_of_kolmogorov_and_smirnov_is_as_likely_as_it_says():
    rng = np.random.default_rng(2)
    found = np.sort([sim_physics.likelihood(rng.standard_normal(50)) for _ in range(400)])
    assert np.abs(found - (np.arange(400) + 0.5) / 400).max() < 0.08  # p is uniform itself


@pytest.mark.nightly
def test_a_run_that_leaves_something_behind_gives_no_figure(monkeypatch):
    kept = []

    class Hoarder(sim_growth.Run):
        def forget(self):
            kept.extend(dict(enumerate(range(3000))) for _ in range(2))
            super().forget()

    monkeypatch.setattr(sim_growth, "WARM_UP", 1.0)
    monkeypatch.setattr(sim_growth, "Run", Hoarder)
    with pytest.raises(RosminiError, match="blocks of memory"):
        sim_growth.hour(4.0)
