"""A reader's own matplotlib figure takes the house style on its way to the page."""

from __future__ import annotations

import re

import numpy as np
import pytest
from matplotlib.figure import Figure

from rosmini.viz import matplotlib_picture, style
from rosmini.viz.dressing import CYCLE, dress
from rosmini.viz.figures import add_axes, blank_figure, house_style


def drawn(figure: Figure) -> str:
    svg = matplotlib_picture(figure, text="a plot", alt="A plot.", form="svg").svg
    assert svg is not None
    return svg[svg.index("</style>") :]


@pytest.fixture
def figure():
    made = Figure(figsize=(4, 3), layout="constrained")
    axes = made.subplots()
    axes.plot([0, 1, 2], [0, 1, 0], "C0", label="there")
    axes.plot([0, 1, 2], [1, 0, 1], "C3--", label="back")
    axes.set(title="a way", xlabel="x [m]", ylabel="y [m]")
    axes.legend()
    return made


def test_there_is_no_box_no_ground_and_no_tick(figure):
    svg = drawn(figure)
    (axes,) = figure.axes
    assert not any(spine.get_visible() for spine in axes.spines.values())
    assert not axes.patch.get_visible()
    assert not figure.patch.get_visible()
    assert "<use" not in svg  # ticks are markers


def test_lines_have_the_colours_of_the_palette_and_stay_dashed(figure):
    svg = drawn(figure)
    assert f'stroke="{style.LIGHT["blue"]}"' in svg
    (dashed,) = re.findall(rf'<path d="M[^"]{{9,}}"[^>]*stroke="{style.LIGHT["vermilion"]}"[^>]*>', svg)[:1]
    assert "stroke-dasharray" in dashed
    assert not any(colour in svg for colour in CYCLE)


def test_words_have_the_size_of_the_house_but_for_those_that_somebody_chose(figure):
    figure.axes[0].annotate("small", (1, 0.5), size=9)
    written = re.findall(r'font-size="([\d.]+)"[^>]*>([^<]+)<', drawn(figure))
    by_word = {word: float(size) for size, word in written}
    assert by_word["small"] == 9
    assert {size for word, size in by_word.items() if word != "small"} == {style.LABEL_SIZE}


def test_axes_that_somebody_opened_stay_as_they_are():
    made = Figure(figsize=(4, 3))
    axes = made.subplots()
    axes.spines[["top", "right"]].set_visible(False)
    dress(made)
    assert axes.spines["left"].get_visible()
    assert axes.patch.get_visible()
    with house_style():
        ours = blank_figure(300, 200)
        inner = add_axes(ours, 30, 30, 200, 100)
        inner.tick_params(labelsize=7)
        dress(ours)
    assert inner.xaxis.get_ticklabels()[0].get_fontsize() == 7


def test_an_image_gets_no_grid():
    made = Figure(figsize=(4, 3))
    axes = made.subplots()
    axes.imshow(np.zeros((3, 4)))
    dress(made)
    assert not any(line.get_visible() for line in axes.get_xgridlines())
