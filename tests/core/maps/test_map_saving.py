"""Maps into files: what map_saver writes, and that nothing is lost on the way round."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import array_shapes, arrays

from rosmini.core.maps import GridMap, MapError, load_map, save_map

sides = st.integers(1, 2_000_000).map(lambda n: n / 1e6)
places = st.integers(-90_000_000, 90_000_000).map(lambda n: n / 1e6)
turns = st.integers(-3_141_592, 3_141_592).map(lambda n: n / 1e6)
trinary = arrays(np.int8, array_shapes(min_dims=2, max_dims=2, max_side=9), elements=st.sampled_from([0, 100, -1]))


@given(trinary.filter(lambda cells: (cells >= 0).any()), sides, places, places, turns)
def test_a_map_that_was_saved_and_read_is_the_same(tmp_path_factory, cells, resolution, x, y, yaw):
    folder = tmp_path_factory.mktemp("maps")
    yaml, _ = save_map(GridMap(cells, resolution, (x, y, yaw)), folder / "one")
    read = load_map(yaml)
    assert (read.occupancy == cells).all()
    assert (read.resolution, read.origin) == (resolution, (x, y, yaw))
    again, image = save_map(read, folder / "two")
    assert again.read_bytes() == yaml.read_bytes().replace(b"one.pgm", b"two.pgm")
    assert image.read_bytes() == yaml.with_suffix(".pgm").read_bytes()


def test_the_files_are_those_of_map_saver(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    grid = GridMap(np.array([[0, 100], [-1, 0]], dtype=np.int8), 0.05, (-1.0, 2.5, math.pi / 2))
    paths = save_map(grid, "house")
    assert [str(path) for path in paths] == ["house.yaml", "house.pgm"]
    assert paths[0].read_text(encoding="utf-8") == (
        "image: house.pgm\nresolution: 0.050000\norigin: [-1.000000, 2.500000, 1.570796]\n"
        "negate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n\n"
    )
    # the first row of the image is the upper one
    assert paths[1].read_bytes() == b"P5\n# CREATOR: map_saver.cpp 0.050 m/pix\n2 2\n255\n" + bytes([205, 254, 254, 0])


def test_thresholds_decide_what_is_occupied_and_free(tmp_path):
    values = [0, 24, 25, 26, 64, 65, 66, 100, 101, 127, -1, -128]
    grid = GridMap(np.array([values], dtype=np.int8), 1.0, (0.0, 0.0, 0.0))

    def pixels(**thresholds):
        _, image = save_map(grid, tmp_path / "map", **thresholds)
        return list(image.read_bytes()[-len(values) :])

    f, u, o = 254, 205, 0
    assert pixels() == [f, f, f, u, u, o, o, o, o, o, u, u]
    assert pixels(occupied=100, free=0) == [f, u, u, u, u, u, u, o, o, o, u, u]


def test_a_map_in_a_folder_finds_its_image(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "maps").mkdir()
    grid = GridMap(np.array([[0, 100]], dtype=np.int8), 0.05, (0.0, 0.0, 0.0))
    yaml, _ = save_map(grid, "maps/house")
    assert "image: house.pgm\n" in yaml.read_text(encoding="utf-8")
    assert load_map(yaml).occupancy.tolist() == [[0, 100]]
    absolute, image = save_map(grid, tmp_path / "maps" / "there")
    assert f"image: {image}\n" in absolute.read_text(encoding="utf-8")


def test_a_folder_that_is_not_there_is_told(tmp_path):
    grid = GridMap(np.zeros((1, 1), dtype=np.int8), 1.0, (0.0, 0.0, 0.0))
    with pytest.raises(MapError, match=r"Couldn't save map file to .*nowhere.*map\.pgm: No such file"):
        save_map(grid, tmp_path / "nowhere" / "map")
