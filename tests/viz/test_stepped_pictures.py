"""The stepped players of the chapters: their text, their frames, and input that they refuse."""

import re

import numpy as np
import pytest
from PIL import Image

from rosmini.core.maps import MapDataError, load_map, map_file
from rosmini.core.maps.grid_map import GridMap
from rosmini.navigation.amcl import show_steps as show_filter
from rosmini.navigation.costmap_2d import Costmap2D
from rosmini.navigation.dwa_local_planner.dwa_planner import DWAPlanner, DWAPlannerParameters
from rosmini.navigation.global_planner import GlobalAStar
from rosmini.navigation.hector_mapping import OccupancyGrid, match
from rosmini.navigation.navfn import NavfnSearch
from rosmini.navigation.navfn import show_steps as show_searches
from rosmini.viz.stepped_pictures import (
    MAX_PARTICLES,
    filter_steps,
    inflation_steps,
    map_steps,
    match_steps,
    search_steps,
    trajectory_steps,
)
from rosmini.viz.view import ViewError

# -- maps ----------------------------------------------------------------------------------------------------------

YAML = """image: {image}
resolution: 0.05
origin: [0, 0, 0]
occupied_thresh: 0.65
free_thresh: 0.196
negate: 0
mode: {mode}
"""


@pytest.fixture
def write(tmp_path):
    def write(pixels, mode="trinary", image="map.png"):
        Image.fromarray(np.array(pixels, dtype=np.uint8)).save(tmp_path / "map.png")
        path = tmp_path / "map.yaml"
        path.write_text(YAML.format(image=image, mode=mode), encoding="utf-8")
        return path

    return write


def test_a_map_is_shown_first_with_the_numbers_of_its_file(write):
    path = write([[0, 100, 200, 255], [255] * 4])
    view = map_file(path).show(title="Figure 3")
    assert view.text == (
        "Figure 3: map.png, 4 x 2 pixels\n"
        "mode trinary, negate 0, free_thresh 0.196, occupied_thresh 0.65\n"
        "free 62.5 %, occupied 12.5 %, unknown 25.0 %"
    )
    assert view.frame(view.data["first"]).text == view.text.split("\n")[-1]
    assert view.svg.count("<image") == 2
    scale = map_file(write([[0, 100, 200, 255]], mode="scale")).show()
    assert "between 50.0 %" in scale.text
    assert load_map(path).occupancy.tolist() == [[100, 89, 5, 0]]


def test_each_frame_of_a_map_is_the_map_of_its_numbers(write):
    view = map_file(write([[0, 100, 200, 255], [255] * 4])).show()
    frees, occupieds, modes, negates = (list(axis.values) for axis in view.axes)

    def text(free, occupied, mode="trinary", negate="0"):
        return view.frame([frees.index(free), occupieds.index(occupied), modes.index(mode), negates.index(negate)]).text

    assert text("0.25", "0.65") == "free 75.0 %, occupied 12.5 %, unknown 12.5 %"
    assert text("0.25", "0.5") == "free 75.0 %, occupied 25.0 %, unknown 0.0 %"
    assert text("0.196", "0.65", negate="1").startswith("free 12.5 %")
    assert text("0.4", "0.3").startswith("free 75.0 %, occupied 25.0 %")
    assert "occupied_thresh is below free_thresh" in text("0.4", "0.3")


def test_images_that_a_map_cannot_show_are_refused(write):
    with pytest.raises(ViewError, match=r"map\.png has 3 channels"):
        map_file(write(np.zeros((2, 2, 3)))).show()
    with pytest.raises(ViewError, match=r"map\.png has 300 x 2 pixels"):
        map_file(write(np.zeros((2, 300)))).show()
    with pytest.raises(MapDataError, match="which is not there"):
        map_file(write([[0]], image="none.png")).show()
    with pytest.raises(ViewError, match="not a str"):
        map_steps("map.yaml")


# -- inflation -----------------------------------------------------------------------------------------------------


def room():
    costs = np.zeros((20, 30), dtype=np.uint8)
    costs[0], costs[10, 10], costs[:, 29] = 254, 254, 255
    costs[5, 5] = 100
    return Costmap2D.of(costs, 0.05)


def test_inflation_is_shown_first_with_the_given_numbers():
    view = room().show_inflation(title="Figure 33.2", inscribed_radius=0.1, inflation_radius=0.2)
    assert view.text == (
        "Figure 33.2: 30 x 20 cells of 0.05 m\n"
        "inflation_radius 0.2 m, cost_scaling_factor 10, inscribed radius 0.1 m\n"
        "free 64 %, near something 16 %, inscribed 12 %, obstacle 5 %, unknown 3 %"
    )
    assert view.frame(view.data["first"]).text == view.text.split("\n")[-1]
    assert "inscribed radius" in inflation_steps(room(), inscribed_radius=0.3).frame([0, 0, 1]).text


def test_a_costmap_that_is_too_large_for_inflation_is_refused():
    with pytest.raises(ViewError, match="500 x 10 cells"):
        inflation_steps(Costmap2D(500, 10, 0.05))


# -- searches ------------------------------------------------------------------------------------------------------


def walls():
    costs = np.zeros((20, 30), np.uint8)
    costs[:14, 15] = 254
    costs[10:, 5] = 255
    return costs


def searches():
    return {"Dijkstra": NavfnSearch(walls(), (3, 5), (25, 5)), "A*": GlobalAStar(walls(), (3, 5), (25, 5))}


def test_searches_are_shown_after_equal_numbers_of_expanded_cells():
    both = searches()
    view = show_searches(both, title="Figure 2")
    assert [line.partition(" cells")[0] for line in view.text.split("\n")] == [
        "Figure 2",
        *(f"{name}: {each.expanded}" for name, each in both.items()),
    ]
    assert view.frames[0].text.startswith("Dijkstra: 0 cells taken up, 1 reached")
    assert view.frames[-1].text.split("\n") == [
        f"{name}: {each.expanded} cells taken up, {each.reached.sum()} reached, arrived" for name, each in both.items()
    ]
    reached = [int(frame.text.split("A*: ")[1].split(", ")[1].split()[0]) for frame in view.frames]
    assert reached == sorted(reached)
    assert "rm-route" not in view.frames[1].pictures[0]
    assert "rm-route" in view.frames[-1].pictures[0]
    assert show_searches(searches(), title="Figure 2").html == view.html


def test_searches_that_cannot_be_stepped_are_refused():
    begun = NavfnSearch(walls(), (3, 5), (25, 5))
    begun.expand(5)
    with pytest.raises(ViewError, match="the search 'A' has started"):
        search_steps({"A": begun})
    with pytest.raises(ViewError, match="grids of one size"):
        search_steps({**searches(), "B": NavfnSearch(walls()[:18], (3, 5), (25, 5))})
    with pytest.raises(ViewError, match="too large"):
        search_steps({"A": NavfnSearch(np.zeros((200, 200), np.uint8), (3, 5), (25, 5))})
    with pytest.raises(ViewError, match="given by name"):
        search_steps({})


# -- trajectories --------------------------------------------------------------------------------------------------

FOOTPRINT = np.array([(-0.105, -0.105), (-0.105, 0.105), (0.041, 0.105), (0.041, -0.105)])
PLAN = np.column_stack([np.arange(0, 1, 0.05), np.zeros(20), np.zeros(20)])


@pytest.fixture
def costmap():
    grid = Costmap2D(60, 60, 0.05, (-1.5, -1.5))
    grid.costs[20:, 36:40] = 254
    return grid


@pytest.fixture
def samples(costmap):
    parameters = DWAPlannerParameters(max_vel_y=0.0, min_vel_y=0.0, vy_samples=1, vx_samples=4, vth_samples=5)
    planner = DWAPlanner(parameters, 0.1)
    planner.update_plan(costmap, (0.0, 0.0, 0.0), PLAN, FOOTPRINT)
    return planner.find_best(costmap, (0.0, 0.0, 0.0), np.array([0.2, 0.0, 0.3]))


def test_trajectories_go_from_the_best_to_the_rejected(samples, costmap):
    view = samples.show(costmap=costmap, plan=PLAN, footprint=FOOTPRINT, title="Figure 1")
    head, best, rejected = view.text.split("\n")
    assert head == f"Figure 1: {len(samples)} of {len(samples) + samples.refused} velocities driven"
    assert best.startswith("best: 0.") and view.frames[0].text == best
    assert rejected == f"rejected: obstacle {samples.counts()['obstacle']}"
    assert view.svg.count('class="tx"') == samples.counts()["obstacle"] + 1
    costs = [float(re.search(r"cost ([\d.]+)", frame.text)[1]) for frame in view.frames if "cost" in frame.text]
    assert costs == sorted(costs) and len(costs) == samples.accepted.sum()
    assert "rejected by obstacle: " in view.frames[-1].text
    # Where no page sets the palette, as in a viewer of notebooks, each colour needs a fallback.
    assert re.findall(r"var\(--rosmini-[a-z]+\)", view.svg) == []


def test_trajectories_that_cannot_be_shown_are_refused(samples):
    with pytest.raises(ViewError, match="no trajectories to show"):
        trajectory_steps(None)
    with pytest.raises(ViewError, match="there is no trajectory 9999"):
        samples.show(chosen=9999)
    with pytest.raises(ViewError, match="300 x 300 cells"):
        samples.show(costmap=Costmap2D(300, 300, 0.05))


# -- particles -----------------------------------------------------------------------------------------------------


def house():
    cells = np.zeros((20, 40), dtype=np.int8)
    cells[[0, -1], :] = cells[:, [0, -1]] = 100
    return GridMap(cells, 0.1, (-1.0, 0.0, 0.0))


def particles(count, seed=1):
    return np.random.default_rng(seed).uniform((-1, 0, -3), (3, 2, 3), (count, 3))


def test_a_filter_says_how_it_began_and_ended():
    near = np.tile((1.0, 1.0, 0.5), (10, 1))
    truth = (1.0, 1.2, 0.0)
    steps = [("start", particles(500), None, truth), ("resample", near, np.ones(10), truth)]
    view = show_filter(house(), steps, title="Found")
    begun, ended = view.text.splitlines()[1:]
    for line, parts in ((begun, ("500 particles", "1.3 m", "0.2 m")), (ended, ("10 particles", "0.0 m", "0.2 m"))):
        assert [part for part in parts if part not in line] == []
    assert "In the end, resample" in view.alt
    assert [frame.text for frame in view.frames] == view.text.split("\n")[1:]


def test_of_many_particles_a_sample_is_drawn_and_the_heaviest():
    weights = np.full(5000, 1e-3)
    weights[4321] = 1.0
    many = particles(5000)
    drawn = filter_steps(house(), steps=[("weigh", many, weights, None)]).frames[0].pictures[0]
    assert len(re.findall("M", drawn)) == MAX_PARTICLES
    heavy = re.search(r'd="M(\d+) (\d+)l[^"M]*" class="rm-heavy"', drawn)
    x, y = many[4321, :2]
    assert [int(heavy[1]), int(heavy[2])] == pytest.approx([(x + 1) * 165, (2 - y) * 165], abs=0.6)


@pytest.mark.parametrize(
    ("steps", "message"),
    [
        ([], "1 to 200 steps"),
        ([("a", np.zeros((3, 2)), None, None)], "rows of finite x, y and heading"),
        ([("a", np.full((3, 3), np.nan), None, None)], "rows of finite x, y and heading"),
        ([("a", np.zeros((3, 3)), [1.0, 2.0], None)], "3 numbers >= 0"),
        ([("a", np.zeros((3, 3)), [0.0, 0.0, 0.0], None)], "3 numbers >= 0"),
        ([("a", np.zeros((3, 3)), None, (1.0, 2.0))], "true pose"),
    ],
)
def test_steps_of_a_filter_that_do_not_match_are_refused(steps, message):
    with pytest.raises(ViewError, match=message):
        filter_steps(house(), steps=steps)


def test_a_filter_needs_a_map():
    with pytest.raises(ViewError, match="shown on a GridMap"):
        filter_steps(3, steps=[("a", np.zeros((3, 3)), None, None)])


# -- matching ------------------------------------------------------------------------------------------------------


def test_a_match_goes_step_by_step_to_the_pose_of_the_mapper():
    grid = OccupancyGrid((80, 80), 0.05, (-2.0, -2.0))
    side = np.linspace(-1.2, 1.2, 40)
    ends = np.concatenate([np.column_stack([side, np.full(40, 1.2)]), np.column_stack([np.full(40, 1.0), side])])
    for _ in range(3):
        grid.update((0.0, 0.0), ends)
    view = match_steps(grid, ends, (0.06, 0.05, 0.03), steps=6, title="Figure 1")
    assert view.text.startswith("Figure 1: 6 steps\nrobot: start (0.06, 0.05, 1.7 deg)")
    assert "80 points" in view.text
    assert len(view.frames) == 7
    x, y, _ = match(grid, ends, (0.06, 0.05, 0.03), 5).pose
    assert abs(x) < 0.02 and abs(y) < 0.02
    with pytest.raises(ViewError, match="without points"):
        match_steps(grid, np.empty((0, 2)), (0.0, 0.0, 0.0))
