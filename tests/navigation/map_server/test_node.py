"""`map_server/map_server`: what is latched, what is answered, and what it says to broken files."""

from __future__ import annotations

import re

import numpy as np
import pytest

from rosmini.core.errors import ServiceException, UsageError
from rosmini.core.graph import Graph
from rosmini.core.maps import GridMap, MapDataError, MapError, MapMetadataError, MapMissing, save_map
from rosmini.msgs import message_class, service_class
from rosmini.navigation.map_server.node import MapServer

CELLS = np.array([[0, 100, -1], [0, 0, 0]], dtype=np.int8)
OccupancyGrid = message_class("nav_msgs/OccupancyGrid")


@pytest.fixture
def files(tmp_path):
    """Two maps."""
    save_map(GridMap(CELLS, 0.05, (1.0, -2.0, 0.5)), tmp_path / "one")
    save_map(GridMap(CELLS.T.copy(), 0.1, (0.0, 0.0, 0.0)), tmp_path / "two")
    return tmp_path


class Bench:
    """A graph with a map server and who listens to it."""

    def __init__(self, *arguments, parameters=None):
        self.graph = Graph()
        self.said = []
        self.heard = []
        self.reader = self.graph.node("reader")
        self.reader.subscriber("/rosout", message_class("rosgraph_msgs/Log"), lambda log: self.said.append(log.msg))
        self.node = self.graph.node("map_server")
        for name, value in (parameters or {}).items():
            self.node.set_param(f"~{name}", value)
        self.graph.run(0.1)
        self.arguments = tuple(map(str, arguments))

    def start(self):
        self.server = MapServer(self.node, *self.arguments)
        self.graph.run(0.1)
        return self

    def listen(self):
        self.reader.subscriber("/map", OccupancyGrid, self.heard.append)
        self.graph.run(0.1)
        return self.heard

    def change(self, address):
        proxy = self.reader.service_client("/change_map", service_class("nav_msgs/LoadMap"))
        answer = proxy(map_url=str(address))
        self.graph.run(0.1)
        return answer


def test_the_map_is_latched_and_asked_for(files):
    bench = Bench(files / "one.yaml").start()
    (heard,) = bench.listen()
    assert heard.header.frame_id == "map"
    assert heard.header.stamp == heard.info.map_load_time
    assert heard.header.stamp.to_sec() > 1000
    assert list(heard.data) == CELLS.ravel().tolist()
    assert heard.info.origin.position.y == -2.0
    metadata = bench.reader.wait_for_message("/map_metadata", message_class("nav_msgs/MapMetaData"), 1.0)
    assert metadata == heard.info
    answer = bench.reader.service_client("/static_map", service_class("nav_msgs/GetMap"))()
    bench.graph.run(0.1)
    assert answer.map.info == heard.info
    assert list(answer.map.data) == list(heard.data)
    assert bench.said == [
        f'Loading map from image "{files / "one.pgm"}"',
        "Read a 3 X 2 map @ 0.050 m/cell",
        "Sending map",
    ]


def test_another_map_takes_its_place(files):
    bench = Bench(files / "one.yaml", parameters={"frame_id": "floor"}).start()
    bench.listen()
    answer = bench.change(files / "two.yaml")
    assert answer.result == answer.RESULT_SUCCESS
    assert len(bench.heard) == 2
    assert bench.heard[1].info.width == 2
    assert bench.heard[1].header.frame_id == "floor"
    assert len(answer.map.data) == 0
    assert bench.said[-1] == f"Changed map to {files / 'two.yaml'}"
    assert bench.change((files / "one.yaml").as_uri()).result == 0
    assert bench.change("package://rosmini_sim/maps/house.yaml").result == 0


@pytest.mark.parametrize(
    ("break_it", "name", "code", "said"),
    [
        (
            lambda f: None, "tow.yaml", "RESULT_MAP_DOES_NOT_EXIST",
            "Map_server could not open {path}. .* did you mean two.yaml",
        ),
        (lambda f: f.with_suffix(".pgm").unlink(), "two.yaml", "RESULT_INVALID_MAP_DATA", "which is not there"),
        (lambda f: f.with_suffix(".pgm").write_bytes(b"P5 3"), "two.yaml", "RESULT_INVALID_MAP_DATA", "cannot be read"),
        (
            lambda f: f.write_text(f.read_text(encoding="utf-8").replace("origin", "orgin"), encoding="utf-8"),
            "two.yaml", "RESULT_INVALID_MAP_METADATA",
            "The map does not contain an origin tag or it is invalid. .*did you mean origin",
        ),
        (
            lambda f: f.write_text(f.read_text(encoding="utf-8").replace("0.100000", "fine"), encoding="utf-8"),
            "two.yaml", "RESULT_INVALID_MAP_METADATA",
            "The map does not contain a resolution tag or it is invalid. .*'fine'",
        ),
        (lambda f: f.write_text("{", encoding="utf-8"), "two.yaml", "RESULT_INVALID_MAP_METADATA", "this is not YAML"),
    ],
)  # fmt: skip
def test_what_cannot_be_read_changes_nothing_and_says_why(files, break_it, name, code, said):
    bench = Bench(files / "one.yaml").start()
    bench.listen()
    break_it(files / "two.yaml")
    answer = bench.change(files / name)
    assert answer.result == getattr(answer, code)
    assert len(bench.heard) == 1
    assert re.search(said.replace("{path}", re.escape(str(files / name))), bench.said[-1])
    assert bench.change("package://no_such_package/map.yaml").result == answer.RESULT_MAP_DOES_NOT_EXIST


@pytest.mark.parametrize(
    ("name", "text", "error", "said"),
    [
        ("none.yaml", None, MapMissing, "there is no map"),
        ("bad.yaml", "image: one.pgm", MapMetadataError, "no field 'resolution'"),
        ("far.yaml", "one.yaml", MapDataError, "which is not there"),
    ],
)
def test_a_server_without_a_map_does_not_start(files, name, text, error, said):
    if text is not None:
        whole = (files / "one.yaml").read_text(encoding="utf-8").replace("one.pgm", "none.pgm")
        (files / name).write_text(whole if text.endswith("yaml") else text, encoding="utf-8")
    bench = Bench(files / name)
    with pytest.raises(error, match=said):
        bench.start()
    assert issubclass(error, MapError)


def test_the_deprecated_form_takes_an_image_and_a_resolution(files):
    bench = Bench(files / "one.pgm", "0.2").start()
    (heard,) = bench.listen()
    assert list(heard.data) == CELLS.ravel().tolist()
    assert heard.info.resolution == pytest.approx(0.2)
    assert (heard.info.origin.position.x, heard.info.origin.orientation.w) == (0.0, 1.0)
    assert bench.said[0] == "Using deprecated map server interface. Please switch to new interface."


def test_the_deprecated_form_has_its_thresholds_from_parameters(files):
    bench = Bench(files / "one.pgm", "0.2", parameters={"negate": 1, "occupied_thresh": 0.9}).start()
    # white, 254, is p = 254 / 255 now; grey, 205, is p = 0.804, between the thresholds
    assert list(bench.listen()[0].data) == [100, 0, -1, 100, 100, 100]


@pytest.mark.parametrize(
    ("arguments", "said"),
    [((), "0 arguments.\nUSAGE: map_server"), (("a", "b", "c"), "3 arguments"), (("one.pgm", "fine"), "'fine'")],
)
def test_a_command_line_that_makes_no_sense_is_told(arguments, said):
    with pytest.raises(UsageError, match=said):
        Bench(*arguments).start()


def test_with_simulated_time_the_map_waits_for_the_clock(files):
    bench = Bench(files / "one.yaml")
    bench.reader.set_param("/use_sim_time", True)
    bench.node = bench.graph.node("later")
    bench.start()
    assert bench.listen() == []
    proxy = bench.reader.service_client("/static_map", service_class("nav_msgs/GetMap"))
    with pytest.raises(ServiceException):  # amcl once got a map of 0 x 0 cells
        proxy()
    clock = bench.reader.publisher("/clock", message_class("rosgraph_msgs/Clock"), queue_size=1)
    message = message_class("rosgraph_msgs/Clock")()
    message.clock.secs = 5
    bench.graph.run(0.1)
    clock.publish(message)
    bench.graph.run(0.1)
    assert bench.heard[0].header.stamp.to_sec() == 5.0
    assert proxy().map == bench.heard[0]
