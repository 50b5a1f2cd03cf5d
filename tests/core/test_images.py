"""Images are refused before they are decoded, if that would take too much memory."""

from __future__ import annotations

import pytest
from PIL import Image

from rosmini.core import images

SIDE = 200


@pytest.mark.parametrize(
    ("name", "mode", "options", "fits"),
    [
        ("a.png", "L", {}, True),
        ("a.png", "RGB", {}, True),
        ("a.png", "RGBA", {}, True),
        ("a.bmp", "RGB", {}, True),
        ("a.ppm", "RGB", {}, True),
        ("a.gif", "P", {}, True),
        ("a.tif", "RGB", {"compression": "tiff_lzw", "tiffinfo": {278: 10}}, True),
        ("a.tif", "RGB", {"compression": "tiff_lzw", "tiffinfo": {278: SIDE}}, False),
        ("a.jpg", "L", {}, True),
        ("a.jpg", "RGB", {"progressive": True}, False),
        ("a.webp", "RGB", {}, False),
    ],
)
def test_the_memory_of_pixels_and_decoder_is_limited(name, mode, options, fits, tmp_path, monkeypatch):
    Image.new(mode, (SIDE, SIDE)).save(tmp_path / name, **options)
    monkeypatch.setattr(images, "MEMORY", 5 * SIDE * SIDE)
    if fits:
        with images.opened(tmp_path / name) as image:
            assert sum(strip.height for _, strip in images.strips(image)) == SIDE
    else:
        with pytest.raises(images.ImageError, match=f"{SIDE} x {SIDE}"), images.opened(tmp_path / name):
            pass


def test_numbers_as_text_count_twice(tmp_path, monkeypatch):
    (tmp_path / "a.ppm").write_text(f"P3 {SIDE} {SIDE} 255 {'0 ' * 3 * SIDE * SIDE}", encoding="ascii")
    monkeypatch.setattr(images, "MEMORY", 5 * SIDE * SIDE)
    with pytest.raises(images.ImageError, match=f"{SIDE} x {SIDE}"), images.opened(tmp_path / "a.ppm"):
        pass


@pytest.mark.parametrize("size", [(65_536, 1), (1, 65_536)])
def test_the_sides_are_limited(size, tmp_path):
    Image.new("L", size).save(tmp_path / "a.png")
    with pytest.raises(images.ImageError, match="65536"), images.opened(tmp_path / "a.png"):
        pass
