"""The measurements of the simulator run, and give no figure for a robot that is not right.

How fast it is is not judged.
"""

from __future__ import annotations

import json
import math
import os
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest
from rosmini_bench import sim, sim_checks, sim_engine, sim_growth, sim_mujoco, sim_peer, sim_physics, sim_room, sim_run

from rosmini.core.errors import RosminiError
from rosmini.sim.models import BURGER
from rosmini.tools.main import main

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

Heard = dict[str, list[tuple[Any, ...]]]
Robots = dict[str, Heard]


@pytest.mark.nightly
def test_the_simulator_is_measured_beside_the_others(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file = tmp_path / "figures.json"
    assert main(["bench", "sim", "--rounds", "1", "--scale", "0.01", "--json", str(file)]) == 0
    shown = capsys.readouterr().out
    rows = json.loads(file.read_text(encoding="utf-8"))["figures"]
    irsim, mujoco = sim_peer.find_irsim(), sim_mujoco.find_mujoco()
    measures = list(sim.measures(irsim, mujoco, 0.01))
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
    assert ("MuJoCo is not installed" in shown) == (mujoco is None)
    assert all(row["peer"] > 0 for row in rows if row["peer_name"].startswith("pymunk"))


def test_robots_have_room_for_their_circles_and_no_more_come_than_that() -> None:
    starts = sim_room.starts(100)
    middles = [
        (x - sim_room.RADIUS * math.sin(heading), y + sim_room.RADIUS * math.cos(heading)) for x, y, heading in starts
    ]
    apart = [math.dist(one, other) for i, one in enumerate(middles) for other in middles[:i]]
    assert min(apart) > 2 * (sim_room.RADIUS + BURGER.reach)
    with pytest.raises(RosminiError, match="1000 robots do not fit"):
        sim_room.starts(1000)


def test_the_room_is_as_large_as_it_says() -> None:
    room, crowded = sim_room.room(), sim_room.crowded_room()
    assert (len(room.segments), len(room.discs)) == (36, 9)
    assert (len(crowded.segments), len(crowded.discs)) == (100, 10)
    assert room.bounds == (-5.0, -5.0, 5.0, 5.0)


@pytest.fixture(scope="module")
def run() -> tuple[Robots, float]:
    """What is heard of two robots in one piece of a run, and how far they were told to go."""
    taken: list[tuple[Robots, float]] = []

    def take(heard: Robots, _model: Any, _seconds: float, way: float) -> None:
        taken.append(
            ({name: {topic: list(rows) for topic, rows in topics.items()} for name, topics in heard.items()}, way)
        )

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(sim_run, "check_run", take)
        assert sim_run.real_time_factor(sim_run.PIECE, 2) > 0
    return taken[0]


def check(run: tuple[Robots, float], **changes: Callable[[list[tuple[Any, ...]]], Any]) -> None:
    """Check what was heard, with changes to what the first robot told."""
    heard, way = {name: dict(topics) for name, topics in run[0].items()}, run[1]
    for topic, change in changes.items():
        heard[""][topic] = change(heard[""][topic])
    sim_checks.check_run(heard, BURGER, sim_run.PIECE, way)


def test_a_run_that_is_right_passes(run: tuple[Robots, float]) -> None:
    check(run)
    assert set(run[0]) == {"", "robot_1"}
    assert all(set(topics) == set(sim_checks.READERS) for topics in run[0].values())


def changed(index: int, change: Callable[[Any], Any]) -> Callable[[list[tuple[Any, ...]]], Any]:
    """All rows with another value at `index`."""
    return lambda rows: [(*row[:index], change(row[index]), *row[index + 1 :]) for row in rows]


def moved(place: tuple[float, ...]) -> tuple[float, ...]:
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
def test_a_run_that_is_not_right_gives_no_figure(
    run: tuple[Robots, float], changes: dict[str, Any], words: str
) -> None:
    with pytest.raises(RosminiError, match=words):
        check(run, **changes)


def test_wrong_ranges_give_no_figure() -> None:
    cast = sim.rosmini_scan("numpy")
    with pytest.raises(RosminiError, match="ranges are wrong"):
        sim.scans(lambda world, x, y: cast(world, x + 1e-3, y), 1)


def peers_run(**changes: Any) -> dict[str, Any]:
    x, y, theta = sim_room.START
    found = {"poses": [[x, y, theta]], "lengths": [1.0], "expected": 1.0, "angle_min": -math.pi, "radius": 0.1}
    found["angle_increment"] = 2 * math.pi / 359
    world = sim_room.room()
    exact = sim.raycast(
        world.segments, world.discs, x, y, theta - math.pi, 2 * math.pi / 359, 360, 3.5, backend="numpy"
    )
    found["ranges"] = np.minimum(exact, 3.5).tolist()
    return found | changes


def test_the_peer_has_to_drive_and_to_see_the_same_room() -> None:
    sim_peer.check(peers_run())
    with pytest.raises(RosminiError, match=r"went 0.20 m, not 1.00 m"):
        sim_peer.check(peers_run(lengths=[0.2]))
    with pytest.raises(RosminiError, match="not that of the room"):
        sim_peer.check(peers_run(ranges=[1.0] * 360))


def test_mujocos_room_is_the_same_room() -> None:
    """36 walls are 8 partitions of four sides and the four outside; a body for each robot."""
    text = sim_mujoco.model_text(3)
    assert (text.count('type="box"'), text.count("<body ")) == (8 + 4, 3)
    assert text.count('type="cylinder"') == 9 + 3


def test_mujoco_drives_and_sees_the_room() -> None:
    pytest.importorskip("mujoco")
    sim_peer.check(sim_mujoco.simulate(1.0, 2), "MuJoCo")


def test_robots_that_do_not_meet_give_no_figure_of_a_crowd() -> None:
    assert sim_engine.crowd_factor(1.0, 60) > 0
    with pytest.raises(RosminiError, match="none of 1 robots touched anything"):
        sim_engine.crowd_factor(1.0, 1)


# -- what it is right about --------------------------------------------------------------------------------------


def test_a_sample_of_another_distribution_is_found_out() -> None:
    rng = np.random.default_rng(1)
    assert sim_physics.likelihood(rng.standard_normal(2000)) > 0.01
    assert sim_physics.likelihood(1.3 * rng.standard_normal(2000)) < 1e-4
    assert sim_physics.likelihood(0.2 + rng.standard_normal(2000)) < 1e-4
    assert sim_physics.likelihood(rng.uniform(-1.7, 1.7, 2000)) < 1e-4


def test_the_test_of_kolmogorov_and_smirnov_is_as_likely_as_it_says() -> None:
    rng = np.random.default_rng(2)
    found = np.sort([sim_physics.likelihood(rng.standard_normal(50)) for _ in range(400)])
    assert np.abs(found - (np.arange(400) + 0.5) / 400).max() < 0.08  # p is uniform itself


def test_cost_that_grows_with_a_power_has_that_exponent() -> None:
    assert sim_growth.exponent([1, 10, 100], [3.0, 30.0, 300.0]) == pytest.approx(1.0)
    assert sim_growth.exponent([1, 10, 100], [5.0, 5.0, 5.0]) == pytest.approx(0.0)


def test_a_run_that_leaves_something_behind_gives_no_figure(monkeypatch: pytest.MonkeyPatch) -> None:
    kept: list[Any] = []

    class Hoarder(sim_growth.Run):
        def forget(self) -> None:
            kept.extend(dict(enumerate(range(3000))) for _ in range(2))
            super().forget()

    monkeypatch.setattr(sim_growth, "WARM_UP", 1.0)
    monkeypatch.setattr(sim_growth, "Run", Hoarder)
    with pytest.raises(RosminiError, match="blocks of memory"):
        sim_growth.hour(4.0)
