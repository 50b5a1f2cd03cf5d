"""3D pictures in a real browser: in the book's form below a nested folder, and alone; from file://, offline."""

import io
import math
import shutil
from contextlib import ExitStack
from dataclasses import replace

import numpy as np
import pytest
from PIL import Image

pytest.importorskip("meshcat")

from rosmini import Graph
from rosmini.core.tf import StaticTransformBroadcaster
from rosmini.msgs.geometry_msgs.msg import PoseStamped
from rosmini.msgs.nav_msgs.msg import OccupancyGrid
from rosmini.sim.gazebo.server import GazeboServer
from rosmini.sim.models import BURGER, WAFFLE
from rosmini.sim.recording import Recording
from rosmini.sim.urdf import load
from rosmini.sim.urdf.xacro import expand
from rosmini.sim.worlds import world
from rosmini.viz.embed import MESHCAT, STATIC, asset_path
from rosmini.viz.meshcat.runs import replay_3d
from rosmini.viz.meshcat.urdf import urdf_3d
from rosmini.viz.meshcat.view import robot_3d
from rosmini.viz.replay.grids import Grid, Grids
from rosmini.viz.replay.layers import Shape, Shapes
from rosmini.viz.replay.run import Body, Run
from rosmini.viz.rviz import Scene, turnable

from ..conftest import nightly

pytestmark = pytest.mark.browser

READY = "iframe[data-ready]"


def run():
    """Straight ahead for 5 s, then a turn to the left on the spot for 5 s."""
    times = np.arange(0, 10.01, 0.1)
    truth = np.column_stack([np.minimum(times, 5) * 0.2, 0 * times, np.maximum(times - 5, 0) * 0.3])
    scan_times = np.arange(0, 10, 0.2)
    scans = np.ones((len(scan_times), 360)) * (1 + 0.1 * scan_times[:, None])
    return Recording(world("room"), BURGER, times, truth, truth, np.zeros((0, 3)), scan_times, scans)


def two_in_gazebo():
    """Two equal robots in an empty world of Gazebo."""
    burger = expand("package://turtlebot3_description/urdf/turtlebot3_burger.urdf.xacro")
    with Graph() as graph:
        server = GazeboServer(graph.node("gazebo"), world="empty")
        for i, name in enumerate(("a", "b")):
            server.spawn(burger, name, (0.0, 0.3 * i, 0.0), namespace=name)
        return server.show3d()


def layered():
    """A robot drives along x for 10 s; half of the ground is occupied from the start, all of it from 5 s on."""
    times = np.linspace(0.0, 10.0, 21)
    half = np.zeros((40, 40), dtype=np.uint8)
    half[:20] = 100
    maps = tuple(Grid(cells, 0.1, (-2.0, -2.0, 0.0)) for cells in (half, np.full_like(half, 100)))
    body = Body("base_footprint", times, np.column_stack([0.1 * times, 0 * times, 0 * times]))
    plan = Shapes("/plan", np.array([0.0]), ((Shape("line", np.array([(0.0, 1.0), (1.5, 1.0)]), "#00ff00"),),))
    run = Run("layered", 0.0, 10.0, (body,), (Grids("/map", np.array([0.0, 5.0]), maps), plan))
    return replay_3d(run, robot="burger", focus="world", elevation=80)


def rviz_scene():
    """A map with a wall, a frame with its name, and a solid arrow on the map."""
    grid = OccupancyGrid()
    grid.header.frame_id = "map"
    grid.info.width, grid.info.height, grid.info.resolution = 40, 40, 0.1
    grid.info.origin.orientation.w = 1.0
    cells = np.zeros((40, 40), dtype=np.int8)
    cells[18:22] = 100
    grid.data = cells.ravel()
    goal = PoseStamped()
    goal.header.frame_id, goal.pose.position.x, goal.pose.orientation.w = "map", 0.5, 1.0
    with Graph() as graph, Scene(graph, fixed_frame="map") as scene:
        scene.add("Map", {"Topic": "/map", "Alpha": 1.0})
        scene.add("Pose", {"Topic": "/goal"})
        scene.add("TF", {"Show Axes": False})
        node = graph.node("robot")
        node.publisher("/map", OccupancyGrid, latch=True).publish(grid)
        node.publisher("/goal", PoseStamped, latch=True).publish(goal)
        StaticTransformBroadcaster(node).send("map", "odom", (1.0, 1.0, 0.0))
        graph.run(0.1)
        return turnable(scene)


def two_runs():
    """A run, and the same one twice as fast."""
    slow = run()
    faster = replace(slow, times=slow.times / 2, scan_times=slow.scan_times / 2)
    return replay_3d(slow, faster, names=["as it was", "twice as fast"])


VIEWS = {
    "robot": lambda: robot_3d(world("room"), BURGER, (0.3, 0.2, 0.4), np.full(360, 0.6)),
    "waffle": lambda: robot_3d(world("room"), WAFFLE, (0.3, 0.2, 0.4)),
    "replay": lambda: replay_3d(run()),
    "urdf": lambda: urdf_3d(load("package://turtlebot3_description/urdf/turtlebot3_waffle.urdf.xacro")),
    "gazebo": two_in_gazebo,
    "rviz": rviz_scene,
    "layered": layered,
    "two": two_runs,
}


class Site:
    """A folder with nested pages of a book and its scripts; beside them, live forms. Each is written when asked for."""

    def __init__(self, folder):
        self.folder = folder
        self.views = {}
        shutil.copytree(STATIC, folder / "_static")
        shutil.copyfile(asset_path(MESHCAT), folder / "_static" / MESHCAT)
        (folder / "deep" / "er").mkdir(parents=True)

    def __truediv__(self, path):
        """A page: `deep/er/NAME.html` in the book's form, `alone_NAME.html` in the live one."""
        place = self.folder / path
        if not place.exists() and (name := place.stem.removeprefix("alone_")) in (*VIEWS, "three"):
            place.write_text(self.alone(name) if name != place.stem else self.nested(name), encoding="utf-8")
        return place

    def view(self, name):
        if name not in self.views:
            self.views[name] = VIEWS[name]()
        return self.views[name]

    def nested(self, name):
        """The page `three` has three pictures, two of them the same."""
        chosen = ["robot", "replay", "robot"] if name == "three" else [name]
        figures = "<p style='height:1200px'>far</p>".join(self.view(each)._html(book=True) for each in chosen)
        style = '<link rel="stylesheet" href="../../_static/rosmini.css">'
        head = HEAD.format(' data-content_root="../../"', style)
        return f"{head}<body>{figures}</body></html>"

    def alone(self, name):
        return f"{HEAD.format('', '')}<body>{self.view(name).page}</body></html>"


HEAD = '<!DOCTYPE html><html lang="en"{}><head><meta charset="utf-8"><title>t</title>{}</head>'


@pytest.fixture(scope="module")
def site(tmp_path_factory):
    return Site(tmp_path_factory.mktemp("site"))


@pytest.fixture
def open_page(solid_tabs, site):
    with ExitStack() as stack:

        def open_page(path, *, scheme="light", width=800, ready=True):
            viewport = {"width": width, "height": 560}
            page, _ = stack.enter_context(solid_tabs.open(viewport, color_scheme=scheme))
            page.goto((site / path).as_uri())
            if ready:
                page.wait_for_selector(READY)
            return page

        yield open_page


def pixels(page, selector="iframe"):
    """The picture (height, width, 3) in the viewer, after the next frame."""
    page.evaluate("new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))")
    shot = page.locator(selector).first.screenshot()
    return np.asarray(Image.open(io.BytesIO(shot)).convert("RGB")).astype(float)


def viewer(page, expression):
    return page.evaluate(
        f"(() => {{ const viewer = document.querySelector('iframe').contentWindow.viewer; return {expression}; }})()"
    )


def node(path):
    return f"viewer.scene_tree.find({path.split('/')!r}).object"


@pytest.mark.parametrize(
    ("path", "scheme"),
    [
        ("deep/er/robot.html", "light"),
        *nightly(("deep/er/robot.html", "dark"), ("alone_robot.html", "light"), ("alone_robot.html", "dark")),
    ],
)
def test_the_viewer_draws_the_scene_in_the_colours_of_the_page(open_page, shared_tmp, path, scheme):
    page = open_page(path, scheme=scheme)
    picture = pixels(page)
    page.screenshot(path=shared_tmp / f"meshcat-{path.replace('/', '_')}-{scheme}.png")
    assert picture.std() > 20
    assert len(np.unique(picture.reshape(-1, 3), axis=0)) > 500
    below = picture[-40:].mean()
    assert below > 200 if scheme == "light" else below < 90
    assert page.locator(".rosmini-still").is_hidden()
    assert page.locator("iframe").get_attribute("title") == page.locator("figure").get_attribute("aria-label")


@pytest.mark.parametrize("path", ["deep/er/robot.html", *nightly("deep/er/urdf.html")])
def test_the_drawing_is_what_the_viewer_shows_first(open_page, path, shared_tmp):
    """Both have the same robot at the same place: dark pixels around it."""
    page = open_page(path, width=776)
    page.screenshot(path=shared_tmp / f"meshcat-first-{path.replace('/', '_')}.png")
    shown = pixels(page)
    page.evaluate("(() => { document.querySelector('.rosmini-still').hidden = false; })()")
    drawn = pixels(page, ".rosmini-still svg")
    middles = []
    for picture in (shown, drawn):
        dark = np.argwhere(picture.max(axis=2) < 110)
        middles.append(dark.mean(axis=0) / picture.shape[0])
    assert middles[0] == pytest.approx(middles[1], abs=0.04)


@pytest.mark.nightly
def test_a_narrow_page_shows_as_much_to_both_sides(open_page):
    page = open_page("deep/er/robot.html", width=390)
    sides = "viewer.camera.aspect / viewer.camera.zoom"
    assert viewer(page, "viewer.camera.aspect") < 1.2
    assert viewer(page, sides) == pytest.approx(1.5)
    page.set_viewport_size({"width": 800, "height": 560})
    page.wait_for_function("document.querySelector('iframe').contentWindow.viewer.camera.aspect > 1.6")
    assert viewer(page, "viewer.camera.zoom") == 1


@pytest.mark.parametrize("path", ["deep/er/gazebo.html", *nightly("alone_gazebo.html")])
def test_equal_robots_share_their_geometry(open_page, path):
    page = open_page(path)
    first, second = (f"meshcat/models/{name}/base_footprint/0/<object>" for name in ("a", "b"))
    assert viewer(page, f"{node(first)} !== {node(second)} && {node(first)}.geometry === {node(second)}.geometry")
    assert viewer(page, f"{node(second)}.castShadow && {node(second)}.geometry.attributes.position.count > 100")
    apart = viewer(page, f"(viewer.set_dirty(), {node(second)}.parent.parent.parent.matrix.elements[13])")
    assert apart == pytest.approx(0.3)


@pytest.mark.parametrize(("path", "scheme"), [("deep/er/rviz.html", "light"), *nightly(("alone_rviz.html", "dark"))])
def test_a_scene_of_rviz_has_its_own_background_a_map_and_words(open_page, shared_tmp, path, scheme):
    page = open_page(path, scheme=scheme)
    page.wait_for_function(
        "(path) => document.querySelector('iframe').contentWindow.viewer.scene_tree.find(path).object"
        ".material.map.image?.complete",
        arg=["meshcat", "rviz", "0", "<object>"],
    )
    picture = pixels(page)
    page.screenshot(path=shared_tmp / f"meshcat-rviz-{scheme}.png")
    assert picture[4, 4] == pytest.approx([48, 48, 48], abs=2)
    assert (picture.min(axis=2) > 240).mean() > 0.1  # free cells
    assert (picture.max(axis=2) < 10).mean() > 0.01  # the wall
    assert ((picture[..., 0] > 90) & (picture[..., 1] < 60)).mean() > 0.005  # the arrow
    assert viewer(page, f"{node('meshcat')}.children.filter((each) => each.isSprite).length") == 2


@pytest.mark.nightly
def test_the_page_follows_the_readers_change_of_theme(open_page):
    page = open_page("deep/er/robot.html")
    light = pixels(page)[-40:].mean()
    page.evaluate("document.documentElement.dataset.theme = 'dark'")
    assert pixels(page)[-40:].mean() < light - 100


def test_several_on_a_page_share_one_script_and_wait_until_they_are_near(open_page):
    page = open_page("deep/er/three.html")
    assert page.locator("iframe").count() == 1
    assert page.locator(".rosmini-still:visible").count() == 2
    for figure in page.locator("figure").all():
        figure.scroll_into_view_if_needed()
        figure.locator(READY).wait_for()
    assert page.locator("iframe").count() == 3
    assert page.locator("head script").count() == 3


def test_a_run_plays_and_the_robot_moves(open_page, shared_tmp):
    page = open_page("deep/er/replay.html")
    robot = node("meshcat/robots/robot")
    wheel = node("meshcat/robots/robot/wheel_left")
    assert viewer(page, f"{robot}.position.toArray()") == pytest.approx([0, 0, 0], abs=1e-3)
    before = pixels(page)
    # Slowly: on a busy machine the run would be over before the click, which would start it again.
    page.get_by_role("combobox", name="Speed").select_option("0.25")
    page.get_by_role("button", name="Play").click()
    page.wait_for_function("Number(document.querySelector('input[type=range]').value) > 0.5")
    page.get_by_role("button", name="Pause").click()
    assert viewer(page, f"{robot}.position.x") > 0.05
    assert viewer(page, f"{wheel}.rotation.y") != 0
    assert np.abs(pixels(page) - before).mean() > 1
    page.get_by_role("slider", name="Time").fill("7.5")
    assert viewer(page, f"{robot}.position.toArray()") == pytest.approx([1.0, 0.0, 0.0], abs=0.01)
    assert viewer(page, f"{robot}.rotation.z") == pytest.approx(0.75, abs=0.02)
    assert "7.5 s of 10.0 s" in page.locator("output").inner_text()
    # The camera follows: what it turns around is above the robot.
    x, _, z = viewer(page, "viewer.controls.target.toArray()")
    root = viewer(page, f"{node('meshcat')}.position.toArray()")
    assert (x - root[0], -z - root[1]) == pytest.approx((1.0, 0.0), abs=0.01)
    page.screenshot(path=shared_tmp / "meshcat-replay.png")


def test_a_played_scan_is_the_recorded_one(open_page):
    page = open_page("deep/er/replay.html")
    page.get_by_role("slider", name="Time").fill("5")
    points = viewer(
        page, f"Array.from({node('meshcat/robots/robot/scan/<object>')}.geometry.attributes.position.array)"
    )
    points = np.array(points).reshape(-1, 3)
    assert points.shape == (180, 3)
    assert np.hypot(*points[:, :2].T) == pytest.approx(1.5, abs=0.002)
    assert points[45, :2] == pytest.approx([0, 1.5], abs=0.01)


@pytest.mark.nightly
def test_what_a_sweeping_laser_hit_lies_on_the_walls(open_page, site, turning, off_the_walls, shared_tmp):
    """Also between two scans, while the robot turns on."""
    (site / "turning.html").write_text(f"<!DOCTYPE html><title>t</title>{replay_3d(turning).page}", encoding="utf-8")
    page = open_page("turning.html")
    cloud, root = node("meshcat/robots/robot/scan/<object>"), node("meshcat")
    for time in (1.5, 2.25, 3.1):
        page.get_by_role("slider", name="Time").fill(str(time))
        points = viewer(
            page,
            f"((cloud, root) => {{ cloud.updateWorldMatrix(true, false); const at = cloud.geometry.attributes.position;"
            "return Array.from({ length: at.count }, (_, i) => root.worldToLocal(cloud.localToWorld("
            f"cloud.position.clone().fromBufferAttribute(at, i))).toArray()); }})({cloud}, {root})",
        )
        hits = np.array([point for point in points if point[2] > 0])
        assert len(hits) > 150
        assert off_the_walls(hits).max() < 0.02
    page.screenshot(path=shared_tmp / "meshcat-turning.png")


@pytest.mark.nightly
def test_the_player_has_the_controls_of_the_other_one(open_page):
    page = open_page("deep/er/replay.html")
    slider = page.get_by_role("slider", name="Time")
    page.get_by_role("button", name="Step forward").click()
    assert float(slider.input_value()) == pytest.approx(0.2)
    slider.focus()
    for key, time in (("ArrowRight", 0.4), ("ArrowLeft", 0.2), ("End", 10.0), ("Home", 0.0)):
        page.keyboard.press(key)
        assert float(slider.input_value()) == pytest.approx(time), key
    page.keyboard.press("+")
    assert page.get_by_label("Speed").input_value() == "2"
    at_first = camera(page)
    canvas = page.frame_locator("iframe").locator("canvas")
    canvas.press("ArrowLeft")
    assert np.abs(camera(page) - at_first).max() > 0.01
    page.get_by_role("button", name="Reset the view").click()
    assert camera(page) == pytest.approx(at_first, abs=1e-6)
    slider.focus()
    page.keyboard.press("f")
    assert not page.get_by_role("checkbox", name="follow").is_checked()


@pytest.mark.nightly
def test_maps_and_plans_lie_on_the_ground_and_can_be_switched(open_page, shared_tmp):
    page = open_page("deep/er/layered.html")
    slider = page.get_by_role("slider", name="Time")

    def dark():
        return (pixels(page).max(axis=2) < 90).mean()

    at_first = dark()
    slider.fill("6")
    page.screenshot(path=shared_tmp / "meshcat-layered.png")
    assert dark() > 1.5 * at_first > 0.05
    assert ((pixels(page)[..., 1] > 180) & (pixels(page)[..., 0] < 120)).sum() > 50, "the plan"
    page.get_by_role("checkbox", name="/map").uncheck()
    assert dark() < at_first / 2
    page.get_by_role("checkbox", name="/map").check()
    slider.fill("1")
    assert dark() == pytest.approx(at_first, rel=0.2)
    assert viewer(page, f"{node('meshcat/robots/robot')}.position.x") == pytest.approx(0.1, abs=0.01)
    before = camera(page)
    page.get_by_role("button", name="Zoom in").click()
    assert np.linalg.norm(camera(page)) < np.linalg.norm(before)


def test_a_place_is_asked_what_it_costs(open_page):
    page = open_page("deep/er/layered.html")
    slider = page.get_by_role("slider", name="Time")
    slider.focus()
    page.keyboard.press("w")
    answer = page.locator("small[role=status]")
    # the view turns around (0, 0), where the free half begins
    assert answer.inner_text() == "At 0.00, 0.00 m: /map: free"
    slider.fill("6")
    assert answer.inner_text().endswith("/map: occupied")
    page.get_by_role("button", name="What the place in the middle costs").click()
    assert answer.inner_text() == ""


def test_lines_and_the_laser_can_be_switched(open_page):
    page = open_page("deep/er/replay.html")
    for name, path in (("truth", "meshcat/trails/truth"), ("laser", "meshcat/robots/robot/scan")):
        assert viewer(page, f"{node(path)}.visible") is True
        page.get_by_role("checkbox", name=name).uncheck()
        assert viewer(page, f"{node(path)}.visible") is False


@pytest.mark.nightly
def test_the_path_that_is_still_to_come_is_not_shown(open_page):
    page = open_page("deep/er/replay.html")
    line = f"{node('meshcat/trails/truth/<object>')}.geometry.attributes.position.array"
    robot = node("meshcat/robots/robot")
    for time in ("0", "4", "10", "2.5"):
        page.get_by_role("slider", name="Time").fill(time)
        points = np.array(viewer(page, f"Array.from({line})")).reshape(-1, 3)[:, :2]
        where = np.array(viewer(page, f"{robot}.position.toArray()"))[:2]
        start = points[:2].mean(axis=0)
        # the robot of this run drives along x, forth and perhaps back: no point lies further than where it is
        assert points[-2:].mean(axis=0) == pytest.approx(where, abs=0.03), time
        if time == "0":
            assert np.ptp(points[:, 0]) < 0.02, "nothing is shown at the start"
        assert start == pytest.approx((0.0, 0.0), abs=0.02)


@pytest.mark.nightly
@pytest.mark.parametrize(("scheme", "width"), [("light", 900), ("dark", 390)])
def test_two_runs_have_one_clock_and_one_bar_and_are_seen_from_the_same_side(open_page, shared_tmp, scheme, width):
    page = open_page("deep/er/two.html", scheme=scheme, width=width)
    page.locator("iframe").nth(1).scroll_into_view_if_needed()
    page.wait_for_function("document.querySelectorAll('iframe[data-ready]').length === 2")
    assert page.locator(".rr-title").all_inner_texts() == ["as it was", "twice as fast"]
    assert page.get_by_role("slider", name="Time").count() == 1
    page.get_by_role("slider", name="Time").fill("4")
    robot = node("meshcat/robots/robot")

    def both(expression):
        return page.evaluate(
            "[...document.querySelectorAll('iframe')].map((frame) => { const { viewer } = frame.contentWindow;"
            f"return {expression}; }})"
        )

    assert both(f"{robot}.position.x") == pytest.approx([0.8, 1.0], abs=0.01)
    page.get_by_role("slider", name="Time").fill("8")  # the second is over
    assert both(f"{robot}.rotation.z") == pytest.approx([0.9, 1.5], abs=0.02)
    away = "viewer.camera.position.clone().sub(viewer.controls.target).toArray()"
    before = np.array(both(away))
    page.frame_locator("iframe").nth(1).locator("canvas").press("ArrowLeft")
    page.wait_for_function(
        "(before) => { const { camera, controls } = document.querySelector('iframe').contentWindow.viewer;"
        "return Math.abs(camera.position.x - controls.target.x - before) > 0.01; }",
        arg=before[0, 0],
    )
    after = np.array(both(away))
    assert after[0] == pytest.approx(after[1], abs=1e-3)
    page.get_by_role("button", name="Reset the view").click()
    assert np.array(both(away)) == pytest.approx(before, abs=1e-3)
    page.get_by_role("checkbox", name="truth").uncheck()
    assert both(f"{node('meshcat/trails/truth')}.visible") == [False, False]
    page.screenshot(path=shared_tmp / f"meshcat-two-{width}.png", full_page=True)


@pytest.mark.nightly
def test_a_run_ends_and_begins_anew(open_page):
    page = open_page("alone_replay.html")
    slider = page.get_by_role("slider", name="Time")
    slider.fill("9.9")
    page.get_by_role("button", name="Play").click()
    page.get_by_role("button", name="Play").wait_for()
    assert float(slider.input_value()) == 10
    slider.focus()
    page.keyboard.press("Space")
    page.wait_for_function("Number(document.querySelector('input[type=range]').value) < 9")


def camera(page):
    return np.array(viewer(page, "viewer.camera.position.toArray()"))


def test_keys_turn_and_zoom_it(open_page):
    page = open_page("deep/er/robot.html")
    canvas = page.frame_locator("iframe").get_by_role("application")
    assert "Arrow keys turn it" in canvas.get_attribute("aria-label")
    focused = "document.querySelector('iframe').contentDocument.activeElement?.tagName"
    for _ in range(4):
        page.keyboard.press("Tab")
        if page.evaluate(focused) == "CANVAS":
            break
    begin = camera(page)
    page.keyboard.press("ArrowRight")
    turned = camera(page)
    assert np.linalg.norm(turned) == pytest.approx(np.linalg.norm(begin))
    angle = math.atan2(turned[0], turned[2]) - math.atan2(begin[0], begin[2])
    assert math.remainder(angle, math.tau) == pytest.approx(math.pi / 24, abs=1e-3)
    page.keyboard.press("-")
    assert np.linalg.norm(camera(page)) == pytest.approx(1.15 * np.linalg.norm(begin))
    page.keyboard.press("Home")
    assert camera(page) == pytest.approx(begin, abs=1e-6)
    frame = page.frame_locator("iframe")
    assert frame.locator("canvas").evaluate("(canvas) => getComputedStyle(canvas).outlineWidth") == "3px"
    assert frame.locator("p").is_visible()  # the keys
    page.keyboard.press("Tab")
    assert page.evaluate(focused) != "CANVAS"
    assert not frame.locator("p").is_visible()


def test_who_wants_less_motion_gets_a_picture_each_half_second(open_page):
    page = open_page("deep/er/replay.html")
    page.emulate_media(reduced_motion="reduce")
    slider = page.get_by_role("slider", name="Time")
    first = """(slider) => new Promise((done) => {
      document.querySelector("button[aria-label='Step back'] + button").click();
      const look = () => slider.value === "0" ? requestAnimationFrame(look) : done(Number(slider.value));
      look();
    })"""
    assert slider.evaluate(first) >= 0.45
    page.emulate_media(reduced_motion="null")


@pytest.mark.nightly
def test_the_wheel_is_the_pages_until_the_picture_is_clicked(open_page):
    page = open_page("deep/er/three.html")
    begin = camera(page)
    page.mouse.move(400, 200)
    page.mouse.wheel(0, 120)
    page.wait_for_function("scrollY > 0")
    assert camera(page) == pytest.approx(begin)
    page.evaluate("scrollTo(0, 0)")
    page.mouse.click(400, 200)
    page.mouse.wheel(0, 120)
    page.wait_for_function(
        "document.querySelector('iframe').contentWindow.viewer.camera.position.length() > "
        f"{np.linalg.norm(begin) * 1.01}"
    )
    assert page.evaluate("scrollY") == 0


def test_dragging_turns_it(open_page):
    page = open_page("alone_robot.html")
    begin = camera(page)
    page.mouse.move(300, 200)
    page.mouse.down()
    page.mouse.move(400, 200, steps=4)
    page.mouse.up()
    assert np.linalg.norm(camera(page) - begin) > 0.1


@pytest.mark.nightly
def test_a_frame_that_is_taken_out_and_put_back_draws_again(open_page):
    page = open_page("alone_replay.html")
    page.get_by_role("slider", name="Time").fill("4")
    page.evaluate(
        "(() => { const frame = document.querySelector('iframe'); delete frame.dataset.ready;"
        "const home = frame.parentNode; frame.remove(); home.prepend(frame); })()"
    )
    page.wait_for_selector(READY)
    assert viewer(page, f"{node('meshcat/robots/robot')}.position.x") == pytest.approx(0.8, abs=0.01)
    assert pixels(page).std() > 20


def test_without_webgl_the_drawing_stays(chromium, watch, site):
    page = chromium.new_page()
    page.add_init_script("HTMLCanvasElement.prototype.getContext = () => null")
    watcher = watch(page)
    page.goto((site / "deep/er/robot.html").as_uri())
    page.wait_for_function("globalThis.rosminiMeshcat !== undefined")
    page.locator(".rosmini-still svg").wait_for()
    assert page.locator("iframe").count() == 0
    assert watcher.seen == []
    page.close()


def test_outside_the_book_the_drawing_stays(open_page, site):
    """Committed outputs, opened in JupyterLab: there is no `_static` folder."""
    text = (site / "deep/er/robot.html").read_text(encoding="utf-8")
    (site / "notebook.html").write_text(
        text.replace(' data-content_root="../../"', "").replace("../../_static", "_static"), encoding="utf-8"
    )
    page = open_page("notebook.html", ready=False)
    assert page.locator(".rosmini-still svg").is_visible()
    assert page.locator("head script").count() == 0
