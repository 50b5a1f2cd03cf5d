"""The committed files are those that `python -m assets.generate` makes."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from assets.generate.__main__ import main, texts

ROOT = Path(__file__).resolve().parents[2]
MAPS = Path("assets/ros/rosmini_sim/maps")


@pytest.fixture(scope="module")
def made(tmp_path_factory):
    folder = tmp_path_factory.mktemp("checkout")
    main(folder)
    return folder


@pytest.mark.parametrize("path", texts())
def test_a_committed_file_is_what_the_generator_makes(made, path):
    assert (ROOT / path).read_bytes() == (made / path).read_bytes(), "run `uv run python -m assets.generate`"


def test_the_maps_are_what_the_generator_makes(made):
    assert {path.name for path in (made / MAPS).iterdir()} == {path.name for path in (ROOT / MAPS).iterdir()}
    for fresh in (made / MAPS).iterdir():
        committed = ROOT / MAPS / fresh.name
        assert committed.stat().st_size < 30_000
        if fresh.suffix == ".png":  # other versions of zlib compress the same pixels otherwise
            assert (np.asarray(Image.open(fresh)) == np.asarray(Image.open(committed))).all()
        else:
            assert fresh.read_bytes() == committed.read_bytes()
