"""Meshes: triangles of files, and what a flat world has of them."""

from __future__ import annotations

import re
import struct

import numpy as np
import pytest

from assets.generate.meshes.shapes import box as solid
from assets.generate.meshes.shapes import join
from rosmini.sim.sdf import converted, load, to_obstacles, to_world
from rosmini.sim.urdf.meshes import MeshError, read
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


def text_stl(triangles):
    lines = ["solid s"]
    for triangle in triangles:
        lines += [
            "facet normal 0 0 0",
            "outer loop",
            *(f"vertex {x!r} {y!r} {z!r}" for x, y, z in triangle.tolist()),
            "endloop",
            "endfacet",
        ]
    return "\n".join([*lines, "endsolid s"]).encode()


def obj(*parts):
    lines, count = [], 0
    for i, triangles in enumerate(parts, 1):
        lines.append(f"o part{i}")
        lines += [f"v {x!r} {y!r} {z!r}" for x, y, z in triangles.reshape(-1, 3).tolist()]
        lines += [
            f"f {count + 3 * k + 1}/1/1 {count + 3 * k + 2}//2 {count + 3 * k + 3}" for k in range(len(triangles))
        ]
        count += 3 * len(triangles)
    return "\n".join(lines).encode()


def dae(triangles, *, unit=1.0, up="Z_UP", node="<matrix>1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1</matrix>", kind="triangles"):
    numbers = " ".join(repr(v) for v in triangles.ravel().tolist())
    count = len(triangles) * 3
    order = " ".join(f"{i} 0" for i in range(count))
    vcount = f"<vcount>{'3 ' * len(triangles)}</vcount>" if kind == "polylist" else ""
    return f"""<?xml version="1.0"?><COLLADA version="1.4.1"><asset><unit meter="{unit}"/>
      <up_axis>{up}</up_axis></asset>
    <library_geometries><geometry id="g"><mesh><source id="p">
      <float_array id="a" count="{count * 3}">{numbers}</float_array></source>
    <vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
    <{kind} count="{len(triangles)}"><input semantic="VERTEX" source="#v" offset="0"/>
      <input semantic="NORMAL" source="#p" offset="1"/>{vcount}<p>{order}</p></{kind}>
    </mesh></geometry></library_geometries>
    <library_visual_scenes><visual_scene id="s"><node name="n">{node}<instance_geometry url="#g"/></node>
      </visual_scene></library_visual_scenes>
    </COLLADA>""".encode()


def load_mesh(path, part=""):
    return np.concatenate([surface.triangles for surface in read(path, part)])


@pytest.mark.parametrize(
    ("name", "data"),
    [
        ("m.stl", binary_stl(TABLE)),
        ("m.STL", text_stl(TABLE)),
        ("m.obj", obj(TABLE)),
        ("m.dae", dae(TABLE)),
        ("m.dae", dae(TABLE, kind="polylist")),
        ("m.dae", dae(TABLE * 100, unit=0.01)),
        ("m.dae", dae(TABLE, up="Y_UP")),
        ("m.dae", dae(TABLE / 2 - (1, 0, 0), node="<scale>2 2 2</scale><translate>1 0 0</translate>")),
        ("m.dae", dae(TABLE @ np.array([[0.0, -1, 0], [1, 0, 0], [0, 0, 1]]), node="<rotate>0 0 1 90</rotate>")),
    ],
)
def test_every_kind_of_mesh_gives_its_triangles(tmp_path, name, data):
    (tmp_path / name).write_bytes(data)
    found = load_mesh(tmp_path / name)
    assert found.shape == TABLE.shape
    assert found.reshape(-1, 3).min(axis=0) == pytest.approx(TABLE.reshape(-1, 3).min(axis=0), abs=1e-6)
    assert found.reshape(-1, 3).max(axis=0) == pytest.approx(TABLE.reshape(-1, 3).max(axis=0), abs=1e-6)


def test_one_part_of_a_mesh(tmp_path):
    (tmp_path / "m.obj").write_bytes(obj(box(*TOP), box(*FOOT)))
    assert load_mesh(tmp_path / "m.obj", "part2").max() == pytest.approx(0.7)
    (tmp_path / "m.dae").write_bytes(dae(TABLE))
    assert len(load_mesh(tmp_path / "m.dae", "n")) == 24
    with pytest.raises(MeshError, match="called 'other'"):
        load_mesh(tmp_path / "m.dae", "other")


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
