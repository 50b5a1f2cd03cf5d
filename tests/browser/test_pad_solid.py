"""A robot in three dimensions under the reader's keys, in a page without a kernel, drawn in software."""

import math

import pytest

from rosmini import Graph
from rosmini.sim.simulator import Simulator
from rosmini.sim.worlds import world
from rosmini.viz.live.pad import TeleopPad

pytestmark = pytest.mark.browser

ROBOT = """() => {
  const { viewer } = document.querySelector("iframe").contentWindow;
  const { position, rotation } = viewer.scene_tree.find(["meshcat", "robots", "robot"]).object;
  const camera = viewer.camera.position;
  return [position.x, position.y, rotation.z, camera.x, -camera.z];
}"""


@pytest.fixture(scope="module")
def site(tmp_path_factory):
    folder = tmp_path_factory.mktemp("solid")
    with Graph() as graph:
        simulator = Simulator(graph.node("simulator"), world=world("room"))
        graph.run(0.3)
        TeleopPad(simulator, solid=True).save(folder / "solid.html")
        TeleopPad(simulator).save(folder / "flat.html")
    return folder


def test_the_keys_drive_a_robot_in_three_dimensions_and_the_camera_goes_along(webgl, watch, site, shared_tmp):
    page = webgl.new_page(viewport={"width": 900, "height": 800})
    watcher = watch(page)
    page.goto((site / "solid.html").as_uri())
    page.wait_for_selector("iframe[data-ready]")
    assert not page.locator(".rp-sight canvas").first.is_visible()
    before = page.evaluate(ROBOT)
    page.locator(".rp-stage").click(position={"x": 120, "y": 120})  # on the picture, which the keys are for then
    for _ in range(12):
        page.keyboard.press("w")
    page.keyboard.press("a")
    page.wait_for_function("(x) => (" + ROBOT + ")()[0] > x + 0.2", arg=before[0])
    page.screenshot(path=shared_tmp / "pad_solid.png")
    page.keyboard.press("s")
    x, y, heading, *camera = page.evaluate(ROBOT)
    assert heading > before[2]
    assert math.dist((x, y), camera) == pytest.approx(math.dist(before[:2], before[3:]), abs=0.02)
    readings = page.locator(".rp-readings").inner_text()
    assert f"x {x:.2f} m, y {y:.2f} m" in readings
    assert watcher.seen == []
    page.close()


def test_without_webgl_the_map_stays(chromium, site):
    context = chromium.new_context()
    context.add_init_script(
        "HTMLCanvasElement.prototype.getContext = ((own) => function (kind, ...rest) {"
        " return kind === 'webgl2' ? null : own.call(this, kind, ...rest); })"
        "(HTMLCanvasElement.prototype.getContext)"
    )
    page = context.new_page()
    page.goto((site / "solid.html").as_uri())
    page.wait_for_selector(".rp-sight canvas")
    assert page.locator(".rp-sight canvas").is_visible()
    assert page.locator("iframe").count() == 0
    context.close()


def test_a_pad_that_is_flat_brings_no_viewer(site):
    flat, solid = ((site / name).stat().st_size for name in ("flat.html", "solid.html"))
    assert flat < 200_000 < solid
