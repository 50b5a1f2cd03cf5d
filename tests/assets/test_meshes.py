"""The meshes of the TurtleBot3 have the measures of the robots, and look right from all sides."""

from __future__ import annotations

import numpy as np
import pytest

from assets.generate.meshes.turtlebot3 import HOLE, MESHES
from rosmini.core.packages import assets_dir
from rosmini.sim.urdf.meshes import read
from rosmini.viz.meshcat.scene3d import OMITTED_COLOURS

FOLDER = assets_dir() / "ros" / "turtlebot3_description" / "meshes"


def test_together_they_are_small():
    found = [path for path in FOLDER.rglob("*") if path.is_file()]
    assert {path.relative_to(FOLDER).as_posix() for path in found} == set(MESHES)
    assert sum(path.stat().st_size for path in found) < 300_000


def test_what_a_world_leaves_out_of_them_is_the_holes():
    assert OMITTED_COLOURS == (HOLE,)


def bounds(name):
    both = [surface.bounds for surface in read(FOLDER / name)]
    return np.min([low for low, _ in both], axis=0), np.max([high for _, high in both], axis=0)


@pytest.mark.parametrize(
    ("name", "size"),
    [
        ("wheels/tire.dae", (0.066, 0.0185, 0.066)),  # description: radius 33 mm, width 18 mm; the hub stands out
        ("sensors/lds.dae", (0.0955, 0.0695, 0.040)),  # LDS-01: 95.5 x 69.5 x 39.5 mm
        ("sensors/r200.dae", (0.0136, 0.130, 0.025)),  # R200: 130 x 20 x 7 mm, on a foot
        (
            "bases/waffle_base.dae",
            (0.266, 0.272, 0.104),
        ),  # description: 266 x 266 mm; horns of the motors reach the wheels
        ("bases/burger_base.dae", (0.138, 0.142, 0.152)),  # e-manual: 138 mm long
    ],
)
def test_measures(name, size):
    low, high = bounds(name)
    assert high - low == pytest.approx(size, abs=2.5e-3)


@pytest.mark.parametrize("name", sorted(MESHES))
def test_every_surface_has_a_colour_and_looks_to_all_sides(name):
    surfaces = read(FOLDER / name)
    assert len({surface.colour for surface in surfaces}) >= 2
    for surface in surfaces:
        assert surface.colour is not None
        assert np.isfinite(surface.vertices).all()
    for shape in MESHES[name]():  # the files are made of these, which `test_generate.py` compares
        corners = shape.triangles
        flat = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        size = np.linalg.norm(flat, axis=1)
        towards = np.einsum("ij,ikj->ik", flat, shape.normals[shape.faces])
        assert (towards[size > 1e-9] > 0).all()
