"""The replay player: what of a run reaches the page, how exactly, how heavy, and in which words."""

from __future__ import annotations

import base64
import json
import math
import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from book.tools.pages import page_problems
from rosmini.core.geometry.poses import arc
from rosmini.msgs import message_class
from rosmini.sim.geometry.raycast import raycast
from rosmini.sim.models import BURGER, model
from rosmini.sim.recording import Moved, Recording, RecordingError
from rosmini.sim.world import Box, Compound, Cylinder, Obstacle, Polygon, Sphere, World
from rosmini.sim.worlds import world
from rosmini.viz import ViewError, style
from rosmini.viz.replay.canvas_data import scene_data
from rosmini.viz.replay.encode import MAX_SCANS, replay_data
from rosmini.viz.replay.packing import ANGLE, LENGTH, TIME, pack, whole
from rosmini.viz.replay.player import replay

from ...recordings import part

STATIC = Path(style.__file__).parent / "static"


def run(duration=8.0, *, scans=True, where=None) -> Recording:
    """A drive on arcs in the room, with a laser's view computed from its walls and an odometry that overrates turns."""
    room = where or world("room")
    times = np.arange(round(duration * 30) + 1) / 30
    turns = np.where(np.sin(times) > 0, 0.4, -0.3)
    truth, odom = [(0.0, 0.0, 0.0)], [(0.0, 0.0, 0.0)]
    for turn in turns[1:]:
        truth.append(arc(truth[-1], 0.15, turn, 1 / 30))
        odom.append(arc(odom[-1], 0.15, 1.05 * turn, 1 / 30))
    poses = np.array(truth)
    seen = np.arange(0, len(times), 6) if scans else np.arange(0)
    ranges = [
        raycast(room.segments, room.discs, x, y, heading, 2 * math.pi / 360, 360, 3.5, backend="numpy")
        for x, y, heading in poses[seen].tolist()
    ]
    changes = np.flatnonzero(np.diff(turns, prepend=0.0))
    commands = np.column_stack([times[changes], np.full(len(changes), 0.15), turns[changes]])
    return Recording(
        room,
        BURGER,
        times=times,
        truth=poses,
        odom=np.array(odom),
        commands=commands,
        scan_times=times[seen],
        scans=np.array(ranges).reshape(len(seen), 360),
    )


def unpack(text: str) -> np.ndarray:
    """The reverse of `pack`, written from its description."""
    values, value, number, shift = [], 0, 0, 0
    for byte in base64.b64decode(text):
        number |= (byte & 127) << shift
        shift += 7
        if byte < 128:
            value += -(number + 1) // 2 if number % 2 else number // 2
            values.append(value)
            number = shift = 0
    return np.array(values, dtype=np.int64)


def track(text: str) -> np.ndarray:
    return unpack(text).reshape(3, -1).T * (LENGTH, LENGTH, ANGLE)


def test_the_scene_is_the_world_in_plain_numbers():
    given = World(
        "yard",
        (
            Obstacle("box", Box(2.0, 1.0), (1.0, 1.0, math.pi / 2), colour="blue"),
            Obstacle("pillar", Cylinder(0.25), (-1.0, 0.12345, 0.0)),
            Obstacle("wedge", Polygon(((1.0, 0.0), (0.0, 1.0), (0.0, 0.0))), (0.0, -2.0, 0.0)),
        ),
        walls=np.array([(-3.0, -3.0, 3.0, -3.0)]),
    )
    scene = scene_data(given, BURGER)
    assert scene["bounds"] == [-3.0, -3.0, 3.0, 2.0]
    assert scene["segments"] == [[-3.0, -3.0, 3.0, -3.0]]
    box, pillar, wedge = scene["shapes"]
    assert box == {"kind": "polygon", "points": [[1.5, 0.0], [1.5, 2.0], [0.5, 2.0], [0.5, 0.0]], "colour": "blue"}
    assert pillar == {"kind": "disc", "x": -1.0, "y": 0.123, "r": 0.25, "colour": "grey"}
    assert wedge["points"] == [[1.0, -2.0], [0.0, -1.0], [0.0, -2.0]]
    robot = scene["robot"]
    assert robot["lidar"] == {"x": -0.032, "beams": 360, "min": 0.12, "max": 3.5}
    assert (robot["max_linear"], robot["wheel_separation"], robot["wheel_radius"]) == (0.22, 0.16, 0.033)
    assert json.loads(json.dumps(scene)) == scene
    assert "robot" not in scene_data(given)


def test_a_robot_that_has_its_speed_at_once_can_be_drawn():
    scene = scene_data(World("field"), replace(BURGER, wheel_acceleration=math.inf))
    assert scene["robot"]["acceleration"] >= 1e6
    assert json.loads(json.dumps(scene, allow_nan=False)) == scene


def test_a_laser_says_how_it_looks_where_it_is_no_plain_one():
    lidar = replace(BURGER.laser, mount=(0.1, 0.05, 0.2), angle_min=-1.0, angle_max=1.0, beams=5, yaw=0.25)
    found = scene_data(World("field"), replace(BURGER, lidar=replace(lidar, range_max=math.inf)))["robot"]["lidar"]
    assert found == {"x": 0.1, "y": 0.05, "beams": 5, "min": 0.12, "max": 1e6, "start": -0.75, "step": 0.5}


def test_the_scene_does_not_hang_on_the_last_bit():
    def scene(nudge):
        poses = [(0.0005 + nudge, -1.0 - nudge, 0.0), (-0.0005 - nudge, 0.1235 - nudge, math.pi / 2 + nudge)]
        return scene_data(World("w", tuple(Obstacle(f"o{i}", Box(0.25, 0.333), pose) for i, pose in enumerate(poses))))

    assert scene(0.0) == scene(1e-12) == scene(-1e-12)
    assert "-0.0," not in json.dumps(scene(0.0))


@given(st.lists(st.integers(-(2**50), 2**50)))
def test_whole_numbers_come_back_as_they_were(values):
    array = np.array(values, dtype=np.int64)
    assert unpack(pack(array)).tolist() == values


def test_small_steps_take_one_byte():
    assert base64.b64decode(pack(np.array([0, -1, 0, 63, 0]))) == bytes([0, 1, 2, 126, 125])
    assert base64.b64decode(pack(np.array([64, 64 - 8192]))) == bytes([0x80, 0x01, 0xFF, 0x7F])


@given(arrays(float, st.integers(1, 50), elements=st.floats(-1e4, 1e4)), st.sampled_from([LENGTH, ANGLE, TIME]))
def test_rounding_is_off_by_little_more_than_half_a_quantum(values, quantum):
    assert np.abs(whole(values, quantum) * quantum - values).max() <= 0.54 * quantum + 1e-9


def test_what_is_beyond_all_measure_is_bounded():
    assert np.abs(whole([1e308, -1e308], LENGTH)).max() <= 2**50 + 1
    wild = replace(run(1.0), commands=np.array([(0.0, 1e308, -1e308), (0.1, 0.0, 0.0)]))
    assert unpack(replay_data(wild)["commands"])[-1] == 0


def test_the_run_comes_back_to_the_millimetre():
    recording = run()
    data = replay_data(recording)
    even = np.linspace(0.0, recording.duration, len(track(data["truth"])))
    for name, poses in (("truth", recording.truth), ("odom", recording.odom_in_map())):
        expected = np.column_stack([np.interp(even, recording.times, column) for column in poses.T])
        off = np.abs(track(data[name]) - expected).max(axis=0)
        assert (off <= np.array([LENGTH, LENGTH, ANGLE]) * 0.55).all()
    scans = unpack(data["scans"]).reshape(-1, 360) * LENGTH
    hit = np.isfinite(recording.scans)
    assert hit.any()
    assert not hit.all()
    assert np.abs(scans - recording.scans)[hit].max() <= 0.55 * LENGTH
    assert (scans[~hit] == 0).all()
    assert np.abs(unpack(data["scan_times"]) * TIME - recording.scan_times).max() <= 0.55 * TIME
    assert "time_increment" not in data
    swept = replay_data(replace(recording, time_increment=-0.2 / 360))
    assert swept == {**data, "time_increment": -555556}
    commands = unpack(data["commands"]).reshape(3, -1).T * (TIME, LENGTH, ANGLE)
    assert commands == pytest.approx(recording.commands, abs=1e-3)


def test_commands_that_change_nothing_are_left_out():
    recording = replace(run(2.0), commands=np.array([(0.0, 0.1, 0.0), (0.5, 0.1, 0.0), (1.0, 0.1, 0.2)]))
    assert unpack(replay_data(recording)["commands"]).tolist() == [0, 1000, 100, 100, 0, 2000]


def test_odometry_starts_where_the_robot_is_and_a_window_keeps_its_times():
    moved = run(3.0)
    moved = part(replace(moved, odom=moved.odom + (5.0, 5.0, 0.0)), 1.0, 2.0)
    data = replay_data(moved)
    assert (data["start"], data["duration"]) == (1000, 1000)
    assert track(data["odom"])[0] == pytest.approx(track(data["truth"])[0], abs=1e-3)


def test_a_minute_with_its_scans_weighs_less_than_300_kb_and_an_hour_too():
    minute = run(60.0)
    for book in ("book", "live"):
        with pytest.MonkeyPatch.context() as patch:
            patch.setenv("ROSMINI_DISPLAY", book)
            assert len(replay(minute).html.encode()) < 300_000
    hours = np.arange(3600 * 30) / 30
    poses = np.column_stack([np.cos(hours / 9), np.sin(hours / 9), hours / 9])
    scan_times = np.arange(3600 * 5) / 5
    scans = np.resize(minute.scans, (len(scan_times), 360))
    long = replace(minute, times=hours, truth=poses, odom=poses, scan_times=scan_times, scans=scans)
    data = replay_data(long)
    assert len(unpack(data["scan_times"])) <= MAX_SCANS
    assert len(json.dumps(data)) < 260_000


@pytest.mark.nightly
def test_two_minutes_with_a_map_and_a_costmap_weigh_less_than_300_kb(monkeypatch):
    two = run(120.0)
    rng = np.random.default_rng(0)
    grid, header = message_class("nav_msgs/OccupancyGrid"), message_class("std_msgs/Header")

    def of(cells, corner):
        made = grid(header=header(frame_id="map"), data=cells.ravel().tolist())
        made.info.height, made.info.width = cells.shape
        made.info.resolution = 0.05
        made.info.origin.position.x, made.info.origin.position.y = corner
        return made

    known = np.full((384, 384), -1, dtype=np.int8)
    messages = []
    for second in range(0, 120, 5):
        size = 40 + second
        known[192 - size : 192 + size, 192 - size : 192 + size] = 0
        known[rng.integers(150, 230, 40), rng.integers(150, 230, 40)] = 100
        messages.append((float(second), "/map", of(known, (-9.6, -9.6))))
    for half in range(240):
        costs = np.clip(rng.normal(40, 30, (60, 60)), 0, 100).astype(np.int8)
        messages.append((half / 2, "/local_costmap/costmap", of(costs, (0.05 * half, 0.0))))
    view = replay(replace(two, messages=tuple(sorted(messages, key=lambda each: each[0]))))
    for form in ("book", "live"):
        monkeypatch.setenv("ROSMINI_DISPLAY", form)
        assert len(type(view)(view.runs).html.encode()) < 300_000
    assert [layer["name"] for layer in view.data["layers"]] == ["/map", "/local_costmap/costmap"]
    assert "/local_costmap/costmap is thinned" in " ".join(view.data["notes"])
    assert "scan_unit" in view.data
    assert len(unpack(view.data["scan_times"])) / 120 >= 1.6, "scans a second"


def test_the_same_run_gives_the_same_bytes_and_the_last_bit_does_not_matter():
    recording = run()
    nudged = replace(
        recording,
        truth=recording.truth + 1e-12,
        odom=recording.odom - 1e-12,
        scans=recording.scans + 1e-12,
        commands=recording.commands + 1e-12,
    )
    assert replay_data(recording) == replay_data(run()) == replay_data(nudged)
    assert replay(recording).html == replay(run()).html
    assert replay(recording).text == replay(nudged).text


def test_the_text_says_how_the_run_went():
    recording = run()
    lines = replay(recording).text.splitlines()
    off = math.dist(recording.truth[-1, :2], recording.odom[-1, :2])
    hits = np.isfinite(recording.scans[-1]).sum()
    assert "burger in room" in lines[0] and "1.20 m in 8.0 s" in lines[0]
    assert f"{off:.3f} m" in lines[2]
    assert "241 poses, 41 scans, 4 commands" in lines[3]
    assert f"{hits} of 360 beams hit" in lines[4]
    assert repr(recording.replay()) == replay(recording).text
    assert replay(recording, title="Two bends").text.startswith("Two bends: 1.20 m in 8.0 s")


@pytest.mark.parametrize("form", ["book", "live"])
def test_the_page_gets_the_player_the_picture_and_words_for_both(monkeypatch, form):
    monkeypatch.setenv("ROSMINI_DISPLAY", form)
    view = replay(run(), title="Two bends")
    html = view.html
    assert (page_problems(html) == []) is (form == "book")  # the live form is not for committed notebooks
    assert "<svg" in html
    assert "<figcaption>Two bends</figcaption>" in html
    assert f'"alt":"{view.alt}"' in html
    assert ("globalThis.rosminiReplay =" in html) is (form == "live")
    data, metadata = view._repr_mimebundle_()
    assert data["image/svg+xml"].startswith("<svg")
    assert metadata["image/svg+xml"] == {"alt": view.alt}
    assert "8.0 seconds" in view.alt
    assert "1.20 m" in view.alt


def test_a_run_of_one_sample_and_one_without_scans_can_be_replayed():
    recording = run()
    one = part(recording, 0.0, 0.0)
    data = replay_data(one)
    assert (data["duration"], len(track(data["truth"]))) == (0, 1)
    assert replay(one).text.startswith("Replay of burger in room: 0.00 m in 0.0 s")
    assert "<svg" in replay(one).html
    blind = run(2.0, scans=False)
    data = replay_data(blind)
    assert (data["scans"], data["scan_times"]) == ("", "")
    assert "last scan" not in replay(blind).text
    unmoved = replace(blind, commands=np.empty((0, 3)))
    assert replay_data(unmoved)["commands"] == ""


def test_what_is_no_run_is_refused():
    recording = run(1.0)
    with pytest.raises(ViewError, match="replay shows a Recording, a bag, an MCAP file or a Run, not 'recording'"):
        replay("recording")
    with pytest.raises(RecordingError, match="at least one sample"):
        replace(recording, times=np.empty(0), truth=np.empty((0, 3)), odom=np.empty((0, 3)))
    with pytest.raises(RecordingError, match="which is not a number"):
        replace(recording, truth=recording.truth * math.nan)


@pytest.mark.parametrize(("name", "palette"), [("LIGHT", style.LIGHT), ("DARK", style.DARK)])
def test_the_scripts_palette_is_that_of_the_house(name, palette):
    script = (STATIC / "rosmini-canvas.js").read_text(encoding="utf-8")
    body = re.search(rf"const {name} = \{{(.*?)\}};", script, re.DOTALL)[1]
    colours = dict(re.findall(r'"([\w-]+)": "(#\w+)"', body))
    assert len(colours) >= 12
    assert colours.items() <= palette.items()
    for page in style.DARK_PAGES:
        assert page in script


# ---- several robots, and things that move ----


def unpacked(text: str) -> list[int]:
    """What `pack` wrote, by the rule that it states."""
    values, value, folded, shift = [], 0, 0, 0
    for byte in base64.b64decode(text):
        folded |= (byte & 127) << shift
        shift += 7
        if byte & 128:
            continue
        value += -(folded + 1) // 2 if folded % 2 else folded // 2
        values.append(value)
        folded = shift = 0
    return values


def together() -> Recording:
    own = run(4.0)
    crate = next(o for o in own.world.obstacles if o.movable)
    moved = Moved(crate, np.array([0.0, 4.0]), np.array([(1.0, 0.0, 0.0), (1.5, 0.0, 1.0)]))
    other = replace(own, truth=own.truth + (0.0, 0.5, 0.0), name="tb3_1", model=model("waffle"))
    return replace(own, name="tb3_0", others=(other,), things=(moved,))


def test_a_run_of_one_robot_says_nothing_of_others():
    assert not {"others", "things", "name"} & set(replay_data(run(2.0)))


def test_other_robots_reach_the_page_with_their_own_shape_and_way():
    data = replay_data(together())
    [other] = data["others"]
    assert (data["name"], other["name"], other["colour"]) == ("tb3_0", "tb3_1", "green")
    assert other["robot"]["wheel_separation"] == 0.287
    own, theirs = unpacked(data["truth"]), unpacked(other["track"])
    count = len(own) // 3
    assert [b - a for a, b in zip(own[count : 2 * count], theirs[count : 2 * count], strict=True)] == [500] * count


def test_what_moves_is_no_part_of_the_still_scene():
    data = replay_data(together())
    [thing] = data["things"]
    assert len(data["scene"]["shapes"]) == len(scene_data(together().world)["shapes"]) - 1
    track = unpacked(thing["track"])
    count = len(track) // 3
    assert (track[0], track[count - 1], track[-1]) == (1000, 1500, 10000)
    assert np.abs(np.mean(thing["shapes"][0]["points"], axis=0)).max() < 1e-9
    assert data["scene"]["bounds"] == scene_data(together().world)["bounds"]


def test_shapes_say_what_is_high_up_and_what_colour_they_have_in_the_dark():
    things = World("w", [
        Obstacle("lamp", Sphere(0.2), (1.0, 0.0, 0.0), colour="#102040", bottom=1.0),
        Obstacle("pair", Compound(((Box(1, 1), (0, 0, 0)), (Cylinder(0.5), (2, 0, 0))))),
    ])  # fmt: skip
    lamp, *pair = scene_data(things)["shapes"]
    assert (lamp["kind"], lamp["r"], lamp["bottom"]) == ("disc", 0.2, 1.0)
    assert lamp["dark"] == style.dark_of("#102040")
    assert [shape["kind"] for shape in pair] == ["polygon", "disc"] and "bottom" not in pair[0]


def test_the_words_name_the_others():
    view = replay(together())
    assert "Beside it drive tb3_1." in view.alt and "tb3_1 (waffle)" in view.text
