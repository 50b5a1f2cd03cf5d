"""A scene as a picture: its words, a still that is the same on every machine, and a view that can be turned."""

import base64
import io
import re

import numpy as np
import pytest
from PIL import Image

from rosmini import Graph
from rosmini.msgs.nav_msgs.msg import OccupancyGrid
from rosmini.msgs.sensor_msgs.msg import LaserScan
from rosmini.viz import ViewError
from rosmini.viz.rviz import Display, rviz, still, turnable
from rosmini.viz.rviz.primitives import Pane, Text
from rosmini.viz.rviz.views import Orbit, TopDownOrtho


class Given(Display):
    """Draws what a test gives it."""

    def __init__(self, *primitives, panes=()):
        super().__init__("given")
        self.given, self.shown = primitives, panes

    def primitives(self, context):
        return self.given

    def panes(self, context, shown=()):
        return self.shown


def grid():
    made = OccupancyGrid()
    made.info.width, made.info.height, made.info.resolution = 3, 2, 1.0
    made.info.origin.orientation.w = 1.0
    made.data = np.array([0, 100, -1, 0, 0, 0], dtype=np.int8)
    return made


def test_the_text_says_what_is_shown_and_what_is_not_and_why(stage):
    scene = stage.scene()
    scene.add("Map", {"Topic": "/map"})
    scene.add("LaserScan", {"Topic": "/scan"})
    scene.add("TF").enabled = False
    stage.place("map", "odom")
    stage.publish("/map", grid(), "map")
    picture = still(scene, title="A map")
    assert picture.text == (
        "A map: 3 displays, fixed frame map\n"
        "Global Status: Ok\n"
        "  Fixed Frame: OK\n"
        "Map (rviz/Map): Ok\n"
        "  Topic: 1 message received\n"
        "  Map: Map received: 3 x 2 cells of 1 m\n"
        "  Update Topic: OK\n"
        "  Transform [sender=/robot]: Transform OK\n"
        "LaserScan (rviz/LaserScan): Warn\n"
        "  Topic: Warn: No messages received: nobody publishes /scan\n"
        "TF (rviz/TF): off"
    )
    said = "RViz in the frame map: it shows Map. Nothing of LaserScan (No messages received: nobody publishes /scan)."
    assert picture.alt == said
    assert picture.caption == "A map"


def test_a_map_in_a_still_has_its_cells_in_their_places(stage):
    scene = stage.scene()
    scene.add("Map", {"Topic": "/map", "Alpha": 1.0})
    stage.publish("/map", grid(), "map")
    svg = still(scene, fit=True).svg
    data, matrix = re.search(r'href="data:image/gif;base64,([^"]+)".*?transform="matrix\(([^)]*)\)"', svg).groups()
    cells = np.asarray(Image.open(io.BytesIO(base64.b64decode(data))).convert("RGB"))
    assert cells[0].tolist() == [[255, 255, 255], [0, 0, 0], [0x70, 0x89, 0x86]]
    a, b, c, d, *_ = map(float, matrix.split())
    assert (b, c) == (0, 0)
    assert a / -d == pytest.approx(1.5)  # x to the right, y upwards
    assert a > 0 > d


def test_a_costmap_shows_nothing_where_it_costs_nothing(stage):
    scene = stage.scene()
    scene.add("Map", {"Topic": "/map", "Alpha": 0.5, "Color Scheme": "costmap"})
    stage.publish("/map", grid(), "map")
    svg = still(scene).svg
    data = re.search(r"data:image/gif;base64,([^\"]+)", svg)[1]
    cells = np.asarray(Image.open(io.BytesIO(base64.b64decode(data))).convert("RGBA"))
    assert cells[0, :, 3].tolist() == [0, 255, 255]
    assert 'opacity="0.5"' in svg


def test_an_empty_scene_and_one_without_frames_are_pictures(stage):
    scene = stage.scene()
    assert still(scene).svg.startswith("<svg")
    assert turnable(scene).html


def test_views_look_from_where_files_say(stage):
    scene = stage.scene()
    stage.place("map", "base", (2.0, 1.0, 0.0), yaw=np.pi / 2)
    stage.graph.run(0.1)
    above = TopDownOrtho({"Scale": 90, "X": 1.0, "Target Frame": "base", "Angle": -np.pi / 2}).viewpoint(scene.context)
    assert above.target == pytest.approx([3, 1, 0])
    assert above.width == pytest.approx(10.0)
    orbit = Orbit({"Focal Point": {"X": 1, "Y": 0, "Z": 0}, "Target Frame": "base", "Yaw": 0.5}).viewpoint(
        scene.context
    )
    assert (orbit.yaw, *orbit.target) == pytest.approx((0.5, 3, 1, 0))
    assert Orbit({"Target Frame": "nowhere"}).viewpoint(scene.context).target == pytest.approx([0, 0, 0])


def test_a_pixel_is_a_point_of_the_ground(stage):
    from rosmini.viz.rviz.picture import flat_projection

    for view in (None, TopDownOrtho({"Angle": 0.3}), Orbit({"Yaw": 1.0, "Pitch": 0.7})):
        scene = stage.scene()
        scene.view = view
        look = flat_projection(scene, scene.update(), 400.0, 300.0)
        (pixel,) = look.pixels(np.array([(0.7, -0.4, 0.0)]))
        assert look.metres(*pixel) == pytest.approx((0.7, -0.4, 0.0), abs=0.2 / look.scale)


def test_words_do_not_overlap_and_what_finds_no_room_is_counted(stage):
    scene = stage.scene()
    at = np.zeros(3)
    white = np.ones(4)
    scene.add(Given(*(Text(f"link{i}", at, 0.1, white) for i in range(7))))
    found = re.findall(r"<text[^>]*>([^<]*)</text>", still(scene).svg)
    assert found == ["link0", "link1", "link2", "link3 +3"]
    assert [each["text"] for each in turnable(scene).extra["labels"]] == ["link0 +6"]


def test_panes_are_below(stage):
    scene = stage.scene()
    pixels = np.zeros((60, 80, 3), dtype=np.uint8)
    before = still(scene).svg
    scene.add(Given(panes=[Pane("Camera", pixels, "/image"), Pane("Temperature", pixels)]))
    after = still(scene).svg
    assert "Camera: /image" in after
    assert after.count("data:image/gif") == 2

    def high(svg):
        return float(re.search(r'viewBox="0 0 [\d.]+ ([\d.]+)"', svg)[1])

    assert high(after) > high(before) + 60


def test_rviz_of_a_graph_shows_what_is_published_and_leaves():
    with Graph() as graph:
        node = graph.node("robot")
        node.publisher("/map", OccupancyGrid, latch=True).publish(grid())
        publisher = node.publisher("/scan", LaserScan)
        node.timer(0.1, lambda _: publisher.publish(LaserScan()))
        text = rviz(graph, duration=0.5).text
        assert "/map (rviz/Map)" in text
        assert "/scan (rviz/LaserScan)" in text
        assert sorted(graph.nodes) == ["/robot", "/rosout"]
        with pytest.raises(ViewError, match="positive"):
            rviz(graph, duration=0.0)
        with pytest.raises(ViewError, match="width"):
            rviz(graph, width=1e9)
