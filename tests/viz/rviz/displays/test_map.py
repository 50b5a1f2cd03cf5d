"""Map: RViz's colours, updates, and maps that are none."""

import numpy as np
import pytest

from rosmini.msgs.map_msgs.msg import OccupancyGridUpdate
from rosmini.msgs.nav_msgs.msg import OccupancyGrid
from rosmini.viz.map_colours import MAX_SIDE, colours_of, thinned


def grid(cells, resolution=0.5):
    made = OccupancyGrid()
    cells = np.asarray(cells, dtype=np.int8)
    made.info.height, made.info.width = cells.shape
    made.info.resolution = resolution
    made.info.origin.position.x = -1.0
    made.info.origin.orientation.w = 1.0
    made.data = cells.ravel()
    return made


def test_a_map_is_where_its_origin_is_and_goes_with_its_frame(stage):
    scene, _ = stage.display("Map", "/map", Alpha=1.0)
    stage.place("map", "odom", (10.0, 0.0, 0.0))
    stage.publish("/map", grid([[0, 100, -1]]), "odom")
    (texture,) = scene.update()[0].primitives
    assert texture.corners[0] == pytest.approx((9.0, 0.0, 0.0))
    assert texture.size == pytest.approx((1.5, 0.5))
    assert texture.pixels[0].tolist() == colours_of("map")[[0, 100, 255]].tolist()
    stage.graph.run(0.1)
    stage.place("map", "odom", (20.0, 0.0, 0.0))
    stage.graph.run(0.1)
    (texture,) = scene.update()[0].primitives
    assert texture.corners[0] == pytest.approx((19.0, 0.0, 0.0))


def test_updates_change_a_part(stage, statuses):
    scene, display = stage.display("Map", "/map", Alpha=1.0)
    stage.publish("/map", grid(np.zeros((2, 3))), "map")
    scene.update()
    stage.publish("/map_updates", OccupancyGridUpdate(x=1, y=1, width=2, height=1, data=[100, -1]), "map")
    (texture,) = scene.update()[0].primitives
    assert texture.pixels[..., 0].tolist() == [[255, 255, 255], [255, 0, 0x70]]
    stage.publish("/map_updates", OccupancyGridUpdate(x=2, y=1, width=2, height=1, data=[0, 0]), "map")
    assert statuses(display)["Update"] == ("Error", "Update area outside of original map area.")
    stage.publish("/map_updates", OccupancyGridUpdate(x=-1, y=0, width=1, height=1, data=[0]), "map")
    assert len(scene.update()[0].primitives) == 1


@pytest.mark.parametrize(
    ("change", "said"),
    [
        (lambda m: setattr(m.info, "width", 0), "Map is zero-sized (0x2)"),
        (lambda m: setattr(m.info, "width", 5), "Data size doesn't match width*height"),
        (lambda m: setattr(m.info, "resolution", float("nan")), "a resolution of nan m is invalid"),
        (lambda m: setattr(m.info.origin.position, "x", float("inf")), "nans or infs"),
    ],
)
def test_maps_that_are_none(stage, statuses, change, said):
    scene, display = stage.display("Map", "/map")
    errors = grid(np.zeros((2, 3)))
    change(errors)
    stage.publish("/map", errors, "map")
    assert scene.update()[0].primitives == ()
    level, text = statuses(display)["Topic"]
    assert level == "Error"
    assert said in text


def test_a_large_map_is_thinned_and_its_walls_stay(stage):
    cells = np.full((4000, 4000), -1, dtype=np.int8)
    cells[1000:3000, 1000:3000] = 0
    cells[1000:3000, 2001] = 100
    scene, _ = stage.display("Map", "/map", Alpha=1.0)
    stage.publish("/map", grid(cells, 0.05), "map")
    (texture,) = scene.update()[0].primitives
    assert max(texture.pixels.shape[:2]) <= MAX_SIDE
    middle = texture.pixels[texture.pixels.shape[0] // 2]
    assert (middle[:, :3] == 0).all(axis=1).sum() == 1
    assert texture.size[0] == pytest.approx(200.0, rel=0.01)


def test_the_least_occupied_cell_never_hides_another():
    cells = np.array([[255, 100], [0, 255]], dtype=np.uint8)
    big = np.repeat(np.repeat(cells, MAX_SIDE, axis=0), MAX_SIDE, axis=1)
    small, factor = thinned(big, "map")
    assert factor == 2
    assert small[0, -1] == 100
    assert small[-1, 0] == 0
    assert small[0, 0] == 255
