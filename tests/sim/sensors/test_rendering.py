"""A camera sees what stands where the numbers of its camera_info say, and as far as rays go."""

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rosmini.core.geometry.poses import compose
from rosmini.sim.geometry.raycast import raycast
from rosmini.sim.models import CameraModel
from rosmini.sim.sensors.rendering import camera_info, camera_noise, develop, expose, eye_of, look
from rosmini.sim.sensors.scene import Scene, parts_of
from rosmini.sim.shapes import Box, Compound, Cylinder, Part, Polygon, Sphere
from rosmini.sim.world import World
from rosmini.sim.worlds import world

CAMERA = CameraModel("camera", (0.073, -0.011, 0.094), 161, 121, 1.085595)
HERE = (0.0, 0.0, 0.0)


def part(shape, pose=(2.0, 0.0, 0.0), bottom=0.0, top=0.5, colour="blue"):
    return Part(shape, pose, bottom, top, colour)


def at(mount, **numbers):
    return CameraModel("camera", mount, 161, 121, 1.085595, **numbers)


def scene_of(view):
    if isinstance(view, World):
        return Scene.walls(view.walls, view.wall_height, solid=view.solid) + Scene.of(parts_of(view.obstacles))
    return view if isinstance(view, Scene) else Scene.of(view)


def depth(camera, pose, view):
    return expose(camera, pose, scene_of(view))[1]


def render(camera, pose, view, noise=None):
    return develop(expose(camera, pose, scene_of(view))[0], noise)


def test_camera_info_has_the_numbers_that_gazebo_ros_writes():
    info = camera_info(CameraModel("camera", HERE, 640, 480, 1.085595))
    f = 640 / (2 * math.tan(1.085595 / 2))
    assert pytest.approx((f, 0, 320.5, 0, f, 240.5, 0, 0, 1)) == info.K
    assert pytest.approx((f, 0, 320.5, 0, 0, f, 240.5, 0, 0, 0, 1, 0)) == info.P
    assert (info.distortion_model, info.D) == ("plumb_bob", (0.0,) * 5)
    assert camera_info(CAMERA, baseline=0.07).P[3] == pytest.approx(-0.07 * CAMERA.focal_length)


@given(x=st.floats(-3, 3), y=st.floats(-3, 3), theta=st.floats(-4, 4), yaw=st.floats(-2, 2), pitch=st.floats(-1, 1))
def test_a_point_is_seen_where_the_camera_matrix_says(x, y, theta, yaw, pitch):
    camera = CameraModel("camera", (0.1, 0.05, 0.3), 320, 240, 1.2, yaw=yaw, pitch=pitch)
    eye = eye_of(camera, (x, y, theta))
    ahead = np.array(
        [math.cos(theta + yaw) * math.cos(pitch), math.sin(theta + yaw) * math.cos(pitch), -math.sin(pitch)]
    )
    c, s = math.cos(theta), math.sin(theta)
    centre = np.array([x + 0.1 * c - 0.05 * s, y + 0.1 * s + 0.05 * c, 0.3])
    [(u, v, z)] = eye.project(centre + 2.0 * ahead)
    k = np.array(camera_info(camera).K).reshape(3, 3)
    assert (u, v, z) == pytest.approx((k[0, 2], k[1, 2], 2.0))
    np.testing.assert_allclose(eye.axes @ eye.axes.T, np.eye(3), atol=1e-12)
    assert np.linalg.det(eye.axes) == pytest.approx(1.0)


@pytest.mark.parametrize("pose", [HERE, (0.4, 0.3, -0.2), (-1.0, -0.5, 0.1)])
def test_the_corners_of_a_box_are_within_half_a_pixel_of_where_they_are_drawn(pose):
    thing = part(Box(0.4, 0.6), compose(pose, (2.0, 0.3, 0.0)), 0.05, 0.4)
    eye = eye_of(CAMERA, pose)
    scene = Scene.of([thing])
    _, shown = look(eye, scene)
    [front] = np.flatnonzero(scene.normals @ eye.axes[2] < -0.99)
    rows, columns = np.nonzero(shown == front)
    u, v, _ = eye.project(scene.faces[front]).T
    # a pixel is drawn if its middle is inside, so a border lies half a pixel beyond the last one, give or take half a
    # pixel
    assert columns.min() - 0.5 == pytest.approx(u.min(), abs=0.5001)
    assert columns.max() + 0.5 == pytest.approx(u.max(), abs=0.5001)
    assert rows.min() - 0.5 == pytest.approx(v.min(), abs=0.5001)
    assert rows.max() + 0.5 == pytest.approx(v.max(), abs=0.5001)


@given(x=st.floats(-0.4, 0.4), y=st.floats(-0.4, 0.4), theta=st.floats(-math.pi, math.pi))
def test_depth_is_what_rays_measure(x, y, theta):
    room = world("room")
    room = replace(room, obstacles=[o for o in room.obstacles if not o.movable])
    eye = eye_of(CAMERA, (x, y, theta))
    row = int(eye.lens.cy)
    assert row == eye.lens.cy
    inverse, _ = look(eye, scene_of(room))
    ex, ey, height = eye.position
    assert all(o.height > height for o in room.obstacles)
    sideways = (np.arange(eye.lens.width) - eye.lens.cx) / eye.lens.fx
    for column in range(0, eye.lens.width, 7):
        angle = theta - math.atan(sideways[column])
        [away] = raycast(room.segments, room.discs, ex, ey, angle, 0.0, 1, 100.0)
        assert 1 / inverse[row, column] * math.hypot(1, sideways[column]) == pytest.approx(away, abs=1e-9)


def test_depth_of_the_ground_is_exact():
    camera = at((0.0, 0.0, 0.5), pitch=0.4)
    seen = depth(camera, HERE, [])
    eye = eye_of(camera, HERE)
    row = 100
    down = math.sin(0.4) + math.cos(0.4) * (row - eye.lens.cy) / eye.lens.fy
    np.testing.assert_allclose(seen[row], 0.5 / down, rtol=1e-6)


def test_a_ball_is_nearest_in_its_middle():
    ball = part(Sphere(0.3), (2.0, 0.0, 0.0), 0.2, 0.8)
    inverse, shown = look(eye_of(at((0.0, 0.0, 0.5)), HERE), Scene.of([ball]))
    assert shown[61, 81] == 0
    assert 1 / inverse[61, 81] == pytest.approx(1.7)
    assert inverse[shown == 0].max() == pytest.approx(1 / 1.7)


def test_what_floats_is_looked_under():
    table = part(Box(0.8, 0.8), bottom=0.3, top=0.35)
    behind = part(Box(0.1, 3.0), (3.0, 0.0, 0.0), colour="orange")
    low = depth(at((0.0, 0.0, 0.1)), HERE, [table, behind])
    assert low[61, 81] == pytest.approx(2.95)
    from_below = render(at((0.0, 0.0, 0.1), pitch=-0.2), HERE, [table])
    assert (from_below[..., 2] > from_below[..., 0] + 50).any()


def test_far_is_infinite_and_what_is_too_near_is_not_seen():
    wall = part(Box(0.1, 3.0), (2.0, 0.0, 0.0), top=2.0)
    camera = at((0.0, 0.0, 0.5))
    assert depth(camera, HERE, [wall])[61, 81] == pytest.approx(1.95)
    assert depth(at((0.0, 0.0, 0.5), near=2.2), HERE, [wall])[61, 81] == math.inf
    assert depth(at((0.0, 0.0, 0.5), depth_far=1.9), HERE, [wall])[61, 81] == math.inf


def test_walls_are_seen_from_both_sides_and_boxes_not_from_inside():
    wall = World("wall", walls=[(1.0, -2.0, 1.0, 2.0)])
    for pose in (HERE, (2.0, 0.0, math.pi)):
        assert np.isfinite(depth(CAMERA, pose, wall)[61, 81])
    box = part(Box(2.0, 2.0), (0.0, 0.0, 0.0))
    assert np.isinf(depth(CAMERA, HERE, [box])[61, 81])


def test_walls_that_go_round_something_have_a_top():
    ring = [(1, -1, 3, -1), (3, -1, 3, 1), (3, 1, 1, 1), (1, 1, 1, -1)]
    camera = at((0.0, 0.0, 1.5), pitch=math.atan2(1.0, 2.0))
    open_, solid = (depth(camera, HERE, World("block", walls=ring, solid=s))[61, 81] for s in (False, True))
    assert solid == pytest.approx(math.hypot(1, 2), rel=1e-6)
    assert open_ > solid


def test_no_gap_is_seen_between_faces_that_meet():
    corners = tuple((math.cos(a) * 3, math.sin(a) * 3) for a in np.arange(24) * math.pi / 12)
    star = tuple((x * (1 if i % 2 else 0.45), y * (1 if i % 2 else 0.45)) for i, (x, y) in enumerate(corners))
    camera = at((0.0, 0.0, 3.0), pitch=math.pi / 2)
    _, shown = look(eye_of(camera, HERE), Scene.of([part(Polygon(star), HERE)]))
    sides = look(eye_of(camera, HERE), Scene.of([part(Polygon(corners), HERE, top=0.4)]))[1]
    middle = (slice(45, 77), slice(65, 97))
    assert (shown[middle] >= 0).all() and (sides[middle] >= 0).all()


def test_parts_of_a_compound_are_where_they_are_with_their_colour():
    shape = Compound(((Cylinder(0.1), (1.0, 0.0, 0.0)), (Sphere(0.2), (0.0, 1.0, 0.0))))
    scene = Scene.of([Part(shape, (0.0, 0.0, math.pi / 2), 0.3, 0.7, "#ff8000")])
    np.testing.assert_allclose(scene.rods, [(0.0, 1.0, 0.1, 0.3, 0.7)], atol=1e-12)
    np.testing.assert_allclose(scene.balls, [(-1.0, 0.0, 0.5, 0.2)], atol=1e-12)
    np.testing.assert_allclose(scene.ball_paints, [(1.0, 128 / 255, 0.0)])


def test_things_have_their_colours_and_faces_differ_in_the_light():
    image = render(at((0.0, 0.0, 0.8), pitch=0.3), HERE, [part(Box(0.5, 0.5), (2.0, 0.0, 0.6))])
    blue = image[(image[..., 2] > image[..., 0].astype(int) + 60) & (image[..., 2] < image[..., 1].astype(int) * 2)]
    assert len(np.unique(blue.reshape(-1, 3), axis=0)) >= 3
    red, green, bright = blue.mean(axis=0)
    assert red < 60 and green < bright


def test_the_sky_is_above_and_the_ground_has_two_tones():
    image = render(CAMERA, HERE, [])
    assert image[0, 0, 2] > image[0, 0, 0]
    bottom = image[-1].astype(int).sum(axis=1)
    assert bottom.max() - bottom.min() > 30


def test_noise_is_of_the_stated_size_and_the_same_for_the_same_seed():
    camera = at((0.0, 0.0, 0.5), noise=0.02)
    sky = (slice(0, 40), slice(None))
    clean = render(camera, HERE, []).astype(float)[sky]
    drawn = camera_noise(camera, np.random.default_rng(1))
    noisy = render(camera, HERE, [], noise=drawn).astype(float)[sky]
    assert np.std(noisy - clean) == pytest.approx(0.02 * 255, rel=0.05)
    np.testing.assert_array_equal(drawn, camera_noise(camera, np.random.default_rng(1)))
    assert camera_noise(CAMERA, np.random.default_rng(1)) is None


def test_a_hundred_thousand_walls_can_be_looked_at():
    rng = np.random.default_rng(0)
    middle, way = rng.uniform(-60, 60, (100_000, 2)), rng.uniform(-0.2, 0.2, (100_000, 2))
    scene = Scene.walls(np.hstack([middle - way, middle + way]), 0.3)
    assert np.isfinite(depth(CAMERA, HERE, scene)[61]).mean() > 0.9
