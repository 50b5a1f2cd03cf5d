"""Meshes: triangles of files, and what a flat world has of them."""

import re
import struct

import numpy as np
import pytest

from assets.generate.meshes.shapes import box as solid
from assets.generate.meshes.shapes import join
from rosmini.sim.sdf import converted, load, to_obstacles
from rosmini.sim.sdf.convert import to_world
from rosmini.sim.world import World

# A table: a top of 1 m by 0.6 m at a height from 0.7 to 0.75 m on one foot of 0.1 m by 0.1 m.
TOP = ((-0.5, -0.3, 0.7), (0.5, 0.3, 0.75))
FOOT = ((-0.05, -0.05, 0.0), (0.05, 0.05, 0.7))


def box(low, high):
    middle, size = (np.array(low) + high) / 2, np.array(high) - low
    return join(solid(middle, size), "#ffffff").triangles


TABLE = np.concatenate([box(*TOP), box(*FOOT)])


def binary_stl(triangles):
    records = b"".join(struct.pack("<12fH", 0, 0, 0, *triangle.ravel(), 0) for triangle in triangles)
    return b"solid or not" + bytes(68) + struct.pack("<I", len(triangles)) + records


def world_of(mesh, *, static=True, pose="0 0 0 0 0 0", scale="1 1 1"):
    return load(
        "<sdf version='1.7'><world name='w'><model "
        f"name='m'><static>{str(static).lower()}</static><pose>{pose}</pose><link name='l'><collision "
        f"name='c'><geometry><mesh><uri>file://{mesh}</uri><scale>{scale}</scale></mesh></geometry>"
        "</collision></link></model></world></sdf>"
    ).worlds[0]


def test_a_mesh_is_at_each_height_what_it_is_there(tmp_path):
    (tmp_path / "m.stl").write_bytes(binary_stl(TABLE))
    foot, top = to_world(world_of(tmp_path / "m.stl", pose="1 2 0 0 0 0")).obstacles
    assert (foot.bottom, foot.height, top.bottom, top.height) == pytest.approx((0, 0.7, 0.7, 0.75))
    assert np.ptp(foot.outline(), axis=0) == pytest.approx((0.1, 0.1), abs=1e-6)
    assert top.outline().min(axis=0) == pytest.approx((0.5, 1.7), abs=1e-6)
    assert np.ptp(top.outline(), axis=0) == pytest.approx((1, 0.6), abs=1e-6)


def test_a_mesh_is_scaled_and_turned(tmp_path):
    (tmp_path / "m.stl").write_bytes(binary_stl(TABLE))
    _, top = to_world(world_of(tmp_path / "m.stl", pose="0 0 0 0 0 1.5707963267948966", scale="2 1 0.5")).obstacles
    assert np.ptp(top.outline(), axis=0) == pytest.approx((0.6, 2), abs=1e-6)
    assert top.height == pytest.approx(0.375)


def test_meshes_beyond_a_limit_are_boxes(tmp_path, monkeypatch):
    (tmp_path / "m.stl").write_bytes(binary_stl(TABLE))
    model = (
        "<model name='m{0}'><static>1</static><pose>{0} 0 0 0 0 0</pose><link name='l'><collision name='c'><geometry>"
        "<mesh><uri>file://{1}</uri><scale>1 1 {2}</scale></mesh></geometry></collision></link></model>"
    )
    models = "".join(model.format(i, tmp_path / "m.stl", scale) for i, scale in enumerate((1, 1, 2)))
    document = load(f"<sdf version='1.7'><world name='w'>{models}</world></sdf>")
    monkeypatch.setattr("rosmini.sim.sdf.solids.MAX_CUT_TRIANGLES", 1)
    world, notes = converted(document.worlds[0])
    assert [each.name.partition("::")[0] for each in world.obstacles] == ["m0", "m0", "m1", "m1", "m2"]
    assert np.ptp(world.obstacles[-1].outline(), axis=0) == pytest.approx((1, 0.6), abs=1e-6)
    assert world.obstacles[-1].height == pytest.approx(1.5)
    assert ["m2" in note.text for note in notes] == [True]


def test_a_mesh_that_can_be_pushed_is_the_hull_of_its_shadow(tmp_path):
    (tmp_path / "m.stl").write_bytes(binary_stl(TABLE))
    (thing,) = to_obstacles(world_of(tmp_path / "m.stl", static=False).models[0])
    assert thing.mass == 1
    ((shape, _),) = thing.parts()
    assert np.ptp(shape.outline, axis=0) == pytest.approx((1, 0.6))


def test_a_fence_around_a_court_leaves_the_court_free(tmp_path):
    sides = [
        ((-2, -2, -0.3), (2, -1.9, 0.4)),
        ((-2, 1.9, -0.3), (2, 2, 0.4)),
        ((-2, -1.9, -0.3), (-1.9, 1.9, 0.4)),
        ((1.9, -1.9, -0.3), (2, 1.9, 0.4)),
    ]
    (tmp_path / "m.stl").write_bytes(binary_stl(np.concatenate([box(*side) for side in sides])))
    fence = to_world(world_of(tmp_path / "m.stl"))
    assert fence.blocked((0, 0, 0), 1.85) is None
    assert all(fence.blocked((x, y, 0), 0.01) for x, y in ((1.95, 0), (-1.95, 1), (0, 1.95), (1, -1.95)))
    assert max(each.height for each in fence.obstacles) == pytest.approx(0.4)


def test_a_round_mesh_is_cut_often_enough(tmp_path):
    angles = np.linspace(0, 2 * np.pi, 49)
    triangles = []
    for up in np.linspace(0, 1, 21)[:-1]:
        low, high = (
            np.stack([(1 - z) * np.cos(angles), (1 - z) * np.sin(angles), np.full(49, z)], axis=1)
            for z in (up, min(1.0, up + 0.05))
        )
        for i in range(48):
            triangles += [(low[i], low[i + 1], high[i + 1]), (low[i], high[i + 1], high[i])]
    (tmp_path / "cone.stl").write_bytes(binary_stl(np.array(triangles)))
    cone = to_world(world_of(tmp_path / "cone.stl"))
    for part in cone.obstacles:
        middle = 1 - (part.bottom + part.height) / 2
        assert np.hypot(*part.outline().T) == pytest.approx(np.full(len(part.outline()), middle), abs=0.02)


def test_a_mesh_with_a_hole_in_its_surface_is_noted(tmp_path):
    (tmp_path / "m.stl").write_bytes(binary_stl(box(*TOP)[:-1] - (0, 0, 0.5)))
    world, notes = converted(world_of(tmp_path / "m.stl"))
    assert "where a cut does not close" in notes[0].text
    assert isinstance(world, World)
    assert np.ptp(world.obstacles[0].outline(), axis=0) == pytest.approx((1, 0.6), abs=1e-6)


def test_a_mesh_that_is_broken_is_left_out_of_its_world_with_a_warning(tmp_path):
    (tmp_path / "m.stl").write_bytes(b"nothing")
    made = world_of(tmp_path / "m.stl")
    assert to_world(made).obstacles == ()
    (note,) = made.warnings
    assert re.fullmatch(r"<text>:\d+: this mesh is left out: .*m\.stl: this is not an STL file.*", str(note))
