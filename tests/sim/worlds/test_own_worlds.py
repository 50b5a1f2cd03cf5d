"""The worlds that rosmini brings as SDF files: fresh, free where robots start, and wide enough for them everywhere."""

import math
from itertools import pairwise

import numpy as np
import pytest

from rosmini.core.geometry import polygons
from rosmini.sim.sdf import SdfError, load
from rosmini.sim.world import Door, Walk
from rosmini.sim.worlds import kind_of, names, source, title, world
from rosmini.sim.worlds.world_map import to_map

FILES = [name for name in names() if (path := source(name)) is not None and path.suffix == ".world"]
WIDTH = 0.34
"""Of a robot, with a little room to each side: a Waffle is 0.306 m wide [m]."""


@pytest.mark.parametrize("name", FILES)
def test_the_files_are_worlds_with_ground_and_sun(name):
    (made,) = load(source(name)).worlds
    assert made.name == "default"
    assert "ground_plane" in [model.name for model in made.models]
    assert kind_of(source(name)) == "sdf"
    assert world(name).title == title(name)


def grown(occupied, cells):
    """Everything nearer than so many cells."""
    rows, columns = occupied.shape
    found = np.zeros_like(occupied)
    for up in range(-cells, cells + 1):
        reach = int(math.sqrt(cells * cells - up * up))
        for along in range(-reach, reach + 1):
            rows_to, rows_from = slice(max(up, 0), rows + min(up, 0)), slice(max(-up, 0), rows + min(-up, 0))
            to, start = (slice(max(along, 0), columns + min(along, 0)), slice(max(-along, 0), columns + min(-along, 0)))
            found[rows_to, to] |= occupied[rows_from, start]
    return found


def reachable(free, start):
    """Which free cells a way leads to."""
    seen = np.zeros_like(free)
    todo = [start]
    while todo:
        row, column = todo.pop()
        if free[row, column] and not seen[row, column]:
            seen[row, column] = True
            todo += [(row + 1, column), (row - 1, column), (row, column + 1), (row, column - 1)]
    return seen


@pytest.mark.parametrize("name", [*FILES, "floor", "room"])
def test_a_robot_can_drive_from_every_start_to_every_other(name):
    here = world(name)
    resolution = 0.05
    grid = to_map(here, resolution)
    free = ~grown(grid.occupied, round(WIDTH / 2 / resolution))
    cells = [
        (int((y - grid.origin[1]) / resolution), int((x - grid.origin[0]) / resolution)) for x, y, _ in here.starts
    ]
    seen = reachable(free, cells[0])
    assert all(seen[cell] for cell in cells)


def test_what_a_file_is_hangs_on_what_stands_in_it(tmp_path):
    sdf = source("pillars").read_text(encoding="utf-8")
    (tmp_path / "a.txt").write_text(f"<!-- <robot> -->\n{sdf.partition('?>')[2]}", encoding="utf-8")
    assert kind_of(tmp_path / "a.txt") == "sdf"
    pillars = world(tmp_path / "a.txt")
    assert (pillars.name, len(pillars.obstacles)) == ("a", 21)
    (tmp_path / "b.world").write_text(
        "floorplan ( size [4 4 1] )\ndefine floorplan model ( boundary 1 )\n", encoding="utf-8"
    )
    assert kind_of(tmp_path / "b.world") == "stage"
    (tmp_path / "c").write_text(
        source("floor").read_text(encoding="utf-8").replace("floor.png", str(source("floor").with_name("floor.png"))),
        encoding="utf-8",
    )
    assert kind_of(tmp_path / "c") == "map"
    assert world(tmp_path / "c").walls.shape == world("floor").walls.shape
    assert world("package://rosmini_sim/worlds/maze.world").bounds == world("maze").bounds
    assert kind_of("package://rosmini_sim/worlds/maze.world") == "sdf"
    (tmp_path / "wide.txt").write_text("<?xml version='1.0' encoding='utf-16'?><robot name='r'/>", "utf-16")
    assert kind_of(tmp_path / "wide.txt") == "urdf"
    for name, kind in (
        ("a.urdf", "urdf"),
        ("a.xacro", "urdf"),
        ("a.sdf", "sdf"),
        ("a.world", "stage"),
        ("a.yaml", "map"),
    ):
        for data in (b"", b"\0\xff\x12 what is this"):
            (tmp_path / name).write_bytes(data)
            assert kind_of(tmp_path / name) == kind
    (tmp_path / "m.sdf").write_text(
        "<sdf version='1.7'><model name='m'><link name='l'/></model></sdf>", encoding="utf-8"
    )
    with pytest.raises(SdfError, match=r"no <world> .* the model 'm'"):
        world(tmp_path / "m.sdf")
    (tmp_path / "r.urdf").write_text("<robot name='r'><link name='l'/></robot>", encoding="utf-8")
    with pytest.raises(SdfError, match="URDF"):
        world(tmp_path / "r.urdf")


def test_what_moves_in_the_office_meets_nothing_that_stands():
    office = world("office")
    moving = [each for each in office.obstacles if each.motion is not None]
    assert sum(isinstance(each.motion, Walk) for each in moving) == 2
    assert sum(isinstance(each.motion, Door) for each in moving) == 3
    for each in moving:
        for t in np.arange(0.0, each.motion.period, 0.25):
            at = each.at(float(t))
            if isinstance(each.motion, Walk):
                assert office.blocked(at, each.shape.radius, 1.0) is None, (each.name, t)
            else:
                assert office.blocked(at, each.shape.outline, 1.0) is None, (each.name, t)
    walkers = [each.motion for each in moving if isinstance(each.motion, Walk)]
    for start in office.starts:
        for walk in walkers:
            way = [*walk.waypoints, walk.waypoints[0]]
            sides = np.array([[*a, *b] for a, b in pairwise(way)])
            assert polygons.distances(np.array([start[:2]]), sides)[0] > 0.5


def test_the_pillars_stand_as_in_turtlebot3_world():
    stage = world("pillars")
    assert sorted(map(tuple, stage.discs.round(6).tolist())) == [
        (x, y, 0.15) for x in (-1.1, 0.0, 1.1) for y in (-1.1, 0.0, 1.1)
    ]
    assert stage.starts[0] == (-2.0, -0.5, 0.0)


def test_the_house_is_free_where_the_launch_files_put_robots():
    house = world("house")
    for place in ((-3.0, 1.0), (-7.0, -1.0), (7.0, -1.0), (0.5, 3.0)):
        assert house.blocked((*place, 0.0), 0.25, 0.4) is None
    assert house.blocked((-1.3, 3.6, 0.0), 0.2, 0.3) is None, "there is room under the table"
    assert house.blocked((-1.3, 3.6, 0.0), 0.2, 0.8) is not None, "but not for all"
    assert sum(each.movable for each in house.obstacles) == 4
