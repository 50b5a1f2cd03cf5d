"""Maps in files: values worked out by hand from http://wiki.ros.org/map_server, and what is no map."""

from __future__ import annotations

import os
import struct
import tracemalloc
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from rosmini.core.errors import RosminiError
from rosmini.core.maps import GridMap, MapDataError, MapError, load_map

FIELDS = {
    "image": "map.png",
    "resolution": "0.05",
    "origin": "[-1.0, 2.5, 0.0]",
    "occupied_thresh": "0.65",
    "free_thresh": "0.196",
    "negate": "0",
}


@pytest.fixture
def write(tmp_path):
    """A map of pixels (h, w) or (h, w, channels), the first row at the top; `None` leaves a field out."""

    def write(pixels=((0, 255),), mode=None, file="map.png", **fields):
        array = np.array(pixels, dtype=np.uint8)
        if array.ndim == 2 or array.shape[2] == 3:
            Image.fromarray(array).save(tmp_path / file)
        else:
            Image.fromarray(array, {2: "LA", 4: "RGBA"}[array.shape[2]]).save(tmp_path / file)
        lines = FIELDS | {"image": file} | ({"mode": mode} if mode else {}) | fields
        path = tmp_path / "map.yaml"
        path.write_text(
            "".join(f"{name}: {value}\n" for name, value in lines.items() if value is not None), encoding="utf-8"
        )
        return path

    return write


GREYS = [[255, 206, 205, 150, 90, 89, 0]]  # p = 0, 0.192, 0.196078, 0.412, 0.647, 0.651, 1


@pytest.mark.parametrize(
    ("mode", "negate", "expected"),
    [
        ("trinary", "0", [0, 0, -1, -1, -1, 100, 100]),
        (None, "0", [0, 0, -1, -1, -1, 100, 100]),
        ("scale", "0", [0, 0, 1, 47, 98, 100, 100]),
        ("raw", "0", [-1, -50, -51, -106, 90, 89, 0]),
        ("trinary", "1", [100, 100, 100, -1, -1, -1, 0]),
        ("scale", "1", [100, 100, 100, 85, 34, 34, 0]),
        ("raw", "1", [0, 49, 50, 105, -91, -90, -1]),
    ],
)
def test_greys_mean_what_map_server_makes_of_them(write, mode, negate, expected):
    grid = load_map(write(GREYS, mode=mode, negate=negate))
    assert grid.occupancy.dtype == np.int8
    assert grid.occupancy.tolist() == [expected]


def test_a_pixel_on_a_threshold_is_neither_free_nor_occupied(write):
    path = write([[0, 51, 102, 255]], mode="scale", occupied_thresh="0.8", free_thresh="0.6")
    assert load_map(path).occupancy.tolist() == [[100, 99, 1, 0]]
    path = write([[0, 51, 102, 255]], occupied_thresh="0.8", free_thresh="0.8")
    assert load_map(path).occupancy.tolist() == [[100, -1, 0, 0]]


@pytest.mark.parametrize(
    ("pixel", "mode", "expected"),
    [
        ((0, 0, 255), "trinary", 100),  # the mean is 85, p = 0.667
        ((255, 255, 0), "trinary", -1),  # 170, p = 0.333
        ((255, 255, 240), "trinary", 0),  # 250
        ((255, 255, 1), "scale", 30),  # 170.33, p = 0.33203, 1 + 98 * 0.29962
        ((0, 0, 0, 255), "trinary", 100),  # 63.75, p = 0.75: alpha is averaged too
        ((0, 0, 0, 0), "trinary", 100),
        ((150, 150, 150, 255), "scale", 47),
        ((150, 150, 150, 0), "scale", -1),
        ((150, 150, 150, 1), "scale", 47),
        ((255, 255, 255, 0), "scale", 0),
        ((100, 100, 103, 0), "raw", 101),
    ],
)
def test_colours_are_averaged_and_alpha_counts_as_in_map_server(write, pixel, mode, expected):
    grid = load_map(write([[pixel, (0,) * len(pixel), (255,) * len(pixel)]], mode=mode))
    assert grid.occupancy[0, 0] == expected


def test_row_0_is_at_the_bottom(write):
    grid = load_map(write([[0, 255], [255, 255], [255, 0]]))
    assert grid.occupancy.tolist() == [[0, 100], [0, 0], [100, 0]]
    assert grid.occupied.tolist() == [[False, True], [False, False], [True, False]]
    assert (grid.free == ~grid.occupied).all()
    assert "map.yaml: 2 x 3 cells of 0.05 m" in repr(grid)


def test_the_numbers_are_those_of_the_file(write):
    path = write(resolution="5e-2", origin="[1, -2.5, 1e-1]")
    grid = load_map(path)
    assert (grid.resolution, grid.origin, grid.path) == (0.05, (1.0, -2.5, 0.1), path)
    assert isinstance(grid, GridMap)
    with pytest.raises(ValueError, match="read-only"):
        grid.occupancy[0, 0] = 5


@pytest.mark.parametrize("image", ["map.pgm", "map.png", "map.bmp", "folder/map.pgm"])
def test_images_of_several_formats_are_read(write, tmp_path, image):
    (tmp_path / "folder").mkdir()
    assert load_map(write([[0, 200, 255]], file=image)).occupancy.tolist() == [[100, -1, 0]]


def test_an_absolute_path_of_the_image_is_taken_as_it_is(write, tmp_path):
    path = write()
    moved = tmp_path / "elsewhere"
    moved.mkdir()
    text = path.read_text(encoding="utf-8").replace("map.png", str(tmp_path / "map.png"))
    (moved / "map.yaml").write_text(text, encoding="utf-8")
    assert load_map(moved / "map.yaml").occupancy.tolist() == [[100, 0]]


def test_a_text_pgm_a_palette_16_bits_and_1_bit_are_read(write, tmp_path):
    path = write()
    (tmp_path / "map.png").write_bytes(b"P2\n# made by hand\n3 1\n255\n0 200 255\n")
    assert load_map(path).occupancy.tolist() == [[100, -1, 0]]
    Image.fromarray(np.array([[0, 200, 255]], dtype=np.uint8)).convert("P").save(tmp_path / "map.png")
    assert load_map(path).occupancy.tolist() == [[100, -1, 0]]
    Image.fromarray(np.array([[255, 200 * 256, 65535]], dtype=np.uint16)).save(tmp_path / "map.png")
    assert load_map(path).occupancy.tolist() == [[100, -1, 0]]
    Image.fromarray(np.array([[0, 255]], dtype=np.uint8)).convert("1").save(tmp_path / "map.png")
    assert load_map(path).occupancy.tolist() == [[100, 0]]


@pytest.mark.parametrize(
    ("name", "value", "part"),
    [
        ("image", None, "no field 'image'"),
        ("image", "''", "'image' is ''"),
        ("image", "7", "'image' is 7"),
        ("image", "other.png", r"other\.png, which is not there"),
        ("image", "map.yaml", r"map\.yaml, which cannot be read: this is not an image"),
        ("image", "'.'", "cannot be read"),
        ("resolution", None, "no field 'resolution'"),
        ("resolution", "0", "'resolution' is 0"),
        ("resolution", "-0.05", "'resolution' is -0.05"),
        ("resolution", "1.0e-320", "'resolution' is 1e-320; it must be .* 1e-06 or more"),
        ("resolution", "1.0e+308", r"'resolution' is 1e\+308; .* no more than 1e\+09"),
        ("resolution", f"'{'x' * 100}'", f"'resolution' is '{'x' * 56}[.][.][.]; it must"),
        ("resolution", "fine", "'resolution' is 'fine'"),
        ("origin", None, "no field 'origin'"),
        ("origin", "[0, 0]", "x, y and yaw"),
        ("origin", "[0, 0, .nan]", "'origin' is nan"),
        ("origin", "[0, a, 0]", "'origin' is 'a'"),
        ("origin", "0", "x, y and yaw"),
        ("occupied_thresh", None, "no field 'occupied_thresh'"),
        ("negate", None, "no field 'negate'"),
        ("negate", "false", "'negate' is False; it must be 0 or 1"),
        ("negate", "0.5", "'negate' is 0.5"),
        ("mode", "trinery", "one of trinary, scale, raw; did you mean trinary"),
        ("mode", "''", "'mode' is"),
    ],
)
def test_an_error_names_the_file_and_the_field(write, name, value, part):
    path = write(**{name: value})
    with pytest.raises(MapError, match=part) as caught:
        load_map(path)
    assert str(path) in str(caught.value)
    if value is not None:
        line = path.read_text(encoding="utf-8").splitlines().index(f"{name}: {value}") + 1
        assert str(caught.value).startswith(f"{path}:{line}: ")


def test_a_misspelt_field_is_named(write):
    path = write(occupied_thresh=None, ocupied_thresh="0.65")
    with pytest.raises(MapError, match="ocupied_thresh: did you mean occupied_thresh"):
        load_map(path)


def test_files_that_are_not_there_folders_and_images_are_no_maps(write, tmp_path):
    path = write()
    with pytest.raises(MapError, match=r"did you mean map\.yaml"):
        load_map(tmp_path / "maap.yaml")
    with pytest.raises(MapError, match="no folder"):
        load_map(tmp_path / "nowhere" / "map.yaml")
    with pytest.raises(MapError, match="cannot be read"):
        load_map(tmp_path)
    with pytest.raises(MapError, match="names the image"):
        load_map(path.with_suffix(".png"))
    assert issubclass(MapError, RosminiError)


def test_a_broken_image_is_no_map(write, tmp_path):
    path = write(np.random.default_rng(0).integers(0, 256, (40, 40)))
    whole = (tmp_path / "map.png").read_bytes()
    (tmp_path / "map.png").write_bytes(whole[: len(whole) // 2])
    with pytest.raises(MapError, match=r"map\.png, which cannot be read"):
        load_map(path)
    (tmp_path / "map.png").write_bytes(b"P5\n0 0\n255\n")
    with pytest.raises(MapError, match=r"map\.png"):
        load_map(path)


def test_a_map_that_is_only_unknown_is_warned_of_but_not_in_the_mode_raw(write):
    with pytest.warns(UserWarning, match="every cell of the map is unknown"):
        assert load_map(write([[200, 150]])).occupancy.tolist() == [[-1, -1]]
    assert load_map(write([[255, 255]], mode="raw")).occupancy.tolist() == [[-1, -1]]


def test_a_real_map_is_read():
    default = Path(__file__).resolve().parents[4] / "shared" / "data"
    file = Path(os.environ.get("ROSMINI_SHARED_DATA", default)) / "depot.yaml"
    if not file.is_file():
        pytest.skip(f"{file} is not there")
    grid = load_map(file)
    assert grid.occupancy.shape == (307, 604)
    assert grid.resolution == 0.05
    assert grid.origin == (-7.14, -7.83, 0.0)
    assert np.count_nonzero(grid.occupied) == 5947
    # Its grey is 205, p = 0.196, which free_thresh 0.25 makes free.
    assert np.count_nonzero(grid.free) == 604 * 307 - 5947


# ---- what wants to break something ----

BOMB = "a0: &a0 [1, 1, 1, 1, 1, 1, 1, 1, 1, 1]\n" + "".join(
    f"a{i + 1}: &a{i + 1} [{', '.join([f'*a{i}'] * 10)}]\n" for i in range(9)
)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        (BOMB, "values with its aliases"),
        ("a: &a [*a]", "this value contains itself"),
        ("a: &a {b: 1}\nc: &c {<<: [*a, *a]}", "has no field 'image'"),
        ("[" * 3000, "this is not YAML"),
        ("image: !!python/object/apply:os.system [echo]",
         "map.yaml:1: this is not YAML: could not determine a constructor"),
        ("resolution: 2001-13-45", "is no timestamp: month"),
        (f"resolution: {'1' * 5000}", "map.yaml:1: this is not YAML: a number of too many digits"),
        (f"resolution: {'1:' * 5000}1", "a number of too many digits"),
        ("? [a]\n: 1", "this is not YAML"),
        ("? {a: 1}\n: 1", "this is not YAML"),
        ("%YAML 9.9\n---\na: 1", "this is not YAML"),
        ("a: 1\n---\nb: 2", "has no field 'image'"),
        ("", "has no fields"),
        ("\0", "this is not YAML"),
        ("- 1", "has no fields"),
    ],
)  # fmt: skip
def test_a_map_is_small_plain_yaml(tmp_path, text, said):
    (tmp_path / "map.yaml").write_text(text, encoding="utf-8")
    with pytest.raises(MapError, match=said):
        load_map(tmp_path / "map.yaml")


@pytest.mark.parametrize(
    "data",
    [
        b"P5 100000 100000 255\n", b"P5 99999999999999999999 1 255\n", b"P5 -5 10 255\n", b"P5 10 10 0\n",
        b"P5 10 10 99999999\n", b"P5 10 10 255\n",
        b"P2 3 3 255\n1 2 x", b"P5", b"", b"\x89PNG\r\n\x1a\n",
        b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR\x7f\xff\xff\xff\x7f\xff\xff\xff\x08\0\0\0\0",
        b"%!PS-Adobe-3.0 EPSF-3.0\n%%BoundingBox: 0 0 9 9\n", b"GIF89a", b"BM", b"II*\0",
    ],
)  # fmt: skip
def test_an_image_is_looked_at_before_it_is_read(write, tmp_path, data):
    path = write([[0, 255]])
    (tmp_path / "map.png").write_bytes(data)
    with pytest.raises(MapError, match=r"map\.yaml:\d: the field 'image' names .*map\.png, which cannot be read: "):
        load_map(path)


@pytest.mark.parametrize("image", ["/dev/zero", ".", "'a\\0b'", "x" * 5000])
def test_an_image_is_a_file(write, image):
    path = write([[0, 255]], image=f'"{image[1:-1]}"' if image.startswith("'") else image)
    with pytest.raises(MapError, match=r"map\.yaml:"):
        load_map(path)


@pytest.mark.parametrize(
    ("fields", "wanted"),
    [
        ({"mode": ""}, [100, -1, 0]),
        ({"mode": "[scale]"}, [100, -1, 0]),
        ({"negate": "2"}, [0, -1, 100]),
        ({"negate": "'1'"}, [0, -1, 100]),
        ({"origin": "[-1.0, 2.5, 0.0, 0.0]"}, [100, -1, 0]),
        ({"resolution": "'5e-2'"}, [100, -1, 0]),
    ],
)
def test_odd_fields_are_read_as_map_server_reads_them(write, fields, wanted):
    found = load_map(write([[0, 150, 255]], **fields))
    assert found.occupancy.tolist() == [wanted]
    assert found.origin == (-1.0, 2.5, 0.0)
    assert found.resolution == 0.05


@pytest.mark.parametrize(
    ("fields", "wanted", "said"),
    [
        # occupied is asked first
        ({"free_thresh": "0.7", "occupied_thresh": "0.3"}, [100, 100, 0], r"\(0.3\) is below free_thresh \(0.7\)"),
        ({"occupied_thresh": "65"}, [-1, -1, 0], r"occupied_thresh \(65\) .* no cells can be occupied"),
        ({"free_thresh": "-0.1"}, [100, -1, -1], r"free_thresh \(-0.1\) .* no cells can be free"),
        ({"free_thresh": "19.6", "occupied_thresh": "65"}, [0, 0, 0], "no cells can be occupied"),
    ],
)
def test_odd_thresholds_are_taken_with_a_warning(write, fields, wanted, said):
    with pytest.warns(UserWarning, match=said):
        assert load_map(write([[0, 150, 255]], **fields)).occupancy.tolist() == [wanted]


def test_a_comment_in_another_encoding_does_no_harm(write):
    path = write([[0, 150, 255]])
    path.write_bytes(b"\xef\xbb\xbf# Pr\xfcfstand\n" + path.read_bytes())
    assert load_map(path).occupancy.tolist() == [[100, -1, 0]]


def test_a_large_image_is_converted_a_strip_at_a_time(write, tmp_path):
    path = write([[0]], file="map.png")
    grey = np.full((3000, 4000), 255, dtype=np.uint8)
    grey[100:1500, 5] = 0
    Image.fromarray(grey).convert("RGBA").save(tmp_path / "map.png")
    load_map(path)
    tracemalloc.start()
    try:
        found = load_map(path)
        _, most = tracemalloc.get_traced_memory()
    finally:
        tracemalloc.stop()
    assert np.array_equal(found.occupied, (grey == 0)[::-1])
    assert most < 4 * grey.size


def test_a_picture_in_colour_may_have_fewer_pixels(write, tmp_path):
    path = write([[0]], file="map.bmp")
    header = b"BM" + struct.pack("<IIIIiiHHIIiiII", 54, 0, 54, 40, 9000, 9000, 1, 24, 0, 0, 0, 0, 0, 0)
    (tmp_path / "map.bmp").write_bytes(header)
    with pytest.raises(MapDataError, match="9000 x 9000 pixels"):
        load_map(path)
