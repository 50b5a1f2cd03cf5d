"""Pictures of a camera, small and slow."""

from __future__ import annotations

import numpy as np
import pytest

from rosmini.viz import ViewError
from rosmini.viz.replay.images import MAX_PIXELS, Images, reduced_image

from .unpacking import naturals, unpack


def test_colours_are_rounded_to_sixty_four():
    pixels = np.zeros((2, 3, 3), dtype=np.uint8)
    pixels[0, 0], pixels[1, 2] = (255, 0, 0), (90, 255, 130)
    assert reduced_image(pixels).tolist() == [[48, 0, 0], [0, 0, 16 + 12 + 2]]


def test_near_is_light_and_nothing_is_black():
    assert reduced_image(np.array([[0.0, 0.5, np.nan, np.inf]])).tolist() == [[63, 42, 0, 0]]


def test_large_images_become_small_and_none_is_refused():
    assert max(reduced_image(np.zeros((480, 640, 3), dtype=np.uint8)).shape) <= MAX_PIXELS
    with pytest.raises(ViewError, match="no pixels"):
        reduced_image(np.zeros((0, 0, 3), dtype=np.uint8))


def test_a_picture_that_stays_costs_nothing():
    image = np.arange(12, dtype=np.uint8).reshape(3, 4)
    data = Images("/camera", np.array([0.0, 1.0, 2.0]), (image, image, image)).data()
    assert unpack(data["counts"]).tolist() == [11, 0, 0]
    assert naturals(data["runs"]).reshape(-1, 3)[0].tolist() == [1, 1, 1]
    assert (data["width"], data["height"]) == (4, 3)


def test_pictures_of_two_sizes_are_no_layer():
    with pytest.raises(ViewError, match="the same size"):
        Images("/camera", np.array([0.0, 1.0]), (np.zeros((2, 2), np.uint8), np.zeros((3, 2), np.uint8)))
