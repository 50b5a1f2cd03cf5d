"""The measurements of the simulator run, and give no figure for a robot that is not right; how fast it is is not judged."""

from __future__ import annotations

import json
import math
import os
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

from rosmini.cli.bench import sim, sim_checks, sim_peer, sim_room
from rosmini.cli.main import main
from rosmini.errors import RosminiError
from rosmini.sim.models import BURGER

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

Heard = dict[str, list[tuple[Any, ...]]]


def test_the_simulator_is_measured_beside_the_others(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = tmp_path / "figures.json"
    assert main(["bench", "sim", "--rounds", "1", "--scale", "0.01", "--json", str(file)]) == 0
    shown = capsys.readouterr().out
    rows = json.loads(file.read_text())["figures"]
    irsim = sim_peer.find_irsim()
    assert len(rows) == len(list(sim.measures(irsim, 1)))
    assert all(row["ours"] > 0 and row["name"] in shown for row in rows)
    if irsim is None:
        assert os.environ.get("ROSMINI_REQUIRE_BENCH") != "1", "ir-sim is required here"
        assert "ir-sim is not installed" in shown
        assert rows[0]["peer"] is None
    else:
        assert rows[0]["peer_name"] == irsim.name
    assert all(row["peer"] > 0 for row in rows[1:])


def test_the_room_is_as_large_as_it_says() -> None:
    room, crowded = sim_room.room(), sim_room.crowded_room()
    assert (len(room.segments), len(room.discs)) == (36, 9)
    assert (len(crowded.segments), len(crowded.discs)) == (100, 10)
    assert room.bounds == (-5.0, -5.0, 5.0, 5.0)


@pytest.fixture(scope="module")
def run() -> tuple[Heard, float]:
    """What is heard in one piece of a run, and how far the robot was told to go."""
    taken: list[tuple[Heard, float]] = []

    def take(heard: Heard, _world: Any, _model: Any, _seconds: float, way: float) -> None:
        taken.append(({topic: list(rows) for topic, rows in heard.items()}, way))

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(sim, "check_run", take)
        assert sim.real_time_factor(sim.PIECE) > 0
    return taken[0]


def check(run: tuple[Heard, float], **changes: Callable[[list[tuple[Any, ...]]], Any]) -> None:
    heard, way = dict(run[0]), run[1]
    for topic, change in changes.items():
        heard[topic] = change(heard[topic])
    sim_checks.check_run(heard, sim_room.room(), BURGER, sim.PIECE, way)


def test_a_run_that_is_right_passes(run: tuple[Heard, float]) -> None:
    check(run)
    assert set(run[0]) == set(sim_checks.READERS)


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
        ({"odom": changed(3, moved), "tf": changed(3, moved)}, "its wheels explain"),
        ({"base_pose_ground_truth": changed(3, moved)}, "was told to go"),
        ({"scan": changed(4, lambda ranges: ranges[:-1])}, "359 ranges"),
        ({"scan": changed(4, lambda ranges: ranges[::-1])}, "not inf|from the exact one"),
        ({"scan": changed(4, lambda ranges: ranges + 0.03)}, "scatter|from the exact one|inf"),
        ({"scan": changed(4, lambda ranges: np.where(ranges > 3.5, 3.5, ranges))}, "not inf where nothing"),
        ({"imu": changed(2, lambda rate: rate + 0.01)}, "the gyroscope says"),
        ({"imu": changed(3, lambda _: 0.0)}, "the imu feels 0.00"),
    ],
)
def test_a_run_that_is_not_right_gives_no_figure(
    run: tuple[Heard, float], changes: dict[str, Any], words: str
) -> None:
    with pytest.raises(RosminiError, match=words):
        check(run, **changes)


def test_odometry_that_is_the_truth_gives_no_figure(run: tuple[Heard, float]) -> None:
    truth = [(*row[:1], "odom", *row[2:]) for row in run[0]["base_pose_ground_truth"]]
    with pytest.raises(RosminiError, match=r"0\.0000 m off"):
        check(run, odom=lambda _: truth, tf=lambda _: [row[:4] for row in truth])


def test_ranges_without_noise_give_no_figure(
    run: tuple[Heard, float], monkeypatch: pytest.MonkeyPatch
) -> None:
    class Quiet(sim.Simulator):
        def __init__(self, node: Any, **options: Any) -> None:
            node.set_param("~noise", 1e-6)
            super().__init__(node, **options)

    monkeypatch.setattr(sim, "Simulator", Quiet)
    with pytest.raises(RosminiError, match=r"scatter by 0\.000"):
        sim.real_time_factor(sim.PIECE)


def test_wrong_ranges_give_no_figure() -> None:
    cast = sim.rosmini_scan("numpy")
    with pytest.raises(RosminiError, match="ranges are wrong"):
        sim.scans(lambda world, x, y: cast(world, x + 1e-3, y), 1)


def peers_run(**changes: Any) -> dict[str, Any]:
    x, y, theta = sim_room.START
    found = {"pose": [x, y, theta], "length": 1.0, "expected": 1.0, "angle_min": -math.pi}
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
        sim_peer.check(peers_run(length=0.2))
    with pytest.raises(RosminiError, match="not that of the room"):
        sim_peer.check(peers_run(ranges=[1.0] * 360))
