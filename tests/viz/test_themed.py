"""Matplotlib's SVG, rewritten: themed, small, and the same whatever the last digit of a coordinate."""

import re
import xml.etree.ElementTree as ET

import pytest
from matplotlib.figure import Figure

from rosmini.viz import matplotlib_picture, style
from rosmini.viz.figures import add_axes, blank_figure, house_style
from rosmini.viz.themed import CYCLE, themed_svg
from rosmini.viz.view import ViewError

SVG = """<?xml version="1.0"?>
<svg xmlns:xlink="http://www.w3.org/1999/xlink" viewBox="0 0 100 50" xmlns="http://www.w3.org/2000/svg">
 <metadata>Matplotlib</metadata>
 <defs><style type="text/css">*{stroke-linejoin: round; stroke-linecap: butt}</style></defs>
 <g id="figure_1"><g id="patch_1">
  <path d="M 1.234999 0.125000
L 20 -0.001
L 20 30
z
" clip-path="url(#p1)" style="fill: #000000; stroke: #0072b2; stroke-width: 1.5; stroke-linejoin: round"/>
  <path d="M 0 0 L 1 1" style="fill: none"/>
  <path d="M 5 5
L 5 5
M 6 7
L 6 7" style="fill: none; stroke: #d55e00; stroke-linecap: round"/>
  <defs><path id="m1" d="M 0 0 L 0 3.5" style="stroke: #000000"/></defs>
  <use xlink:href="#m1" x="3" y="4" style="stroke: #000000; stroke-width: 0.8"/>
  <text style="font: 700 10px 'DejaVu Sans', sans-serif; text-anchor: middle" x="1" y="2"
   transform="rotate(-0 1 2)">x &lt; <tspan>1</tspan></text>
 </g></g>
 <defs><clipPath id="p1"><rect x="1" y="1" width="9.0" height="9"/></clipPath></defs>
</svg>"""


def body(svg):
    return svg[svg.index("</style>") :]


def test_what_matplotlib_wrote_is_kept_and_shortened():
    drawn = body(themed_svg(SVG, title="t", alt="a"))
    assert 'd="M1.23 0.12L20 0L20 30z"' in drawn
    assert 'd="M5 5h0M6 7h0"' in drawn
    assert "M 0 0 L 1 1" not in drawn
    assert "M0 0L1 1" not in drawn  # neither filled nor stroked
    assert "figure_1" not in drawn
    assert "font-family" not in drawn
    assert "Matplotlib" not in drawn
    assert 'font-size="10" font-weight="700" text-anchor="middle" fill="' in drawn  # in the order of newer versions
    assert "rotate" not in drawn
    assert "x &lt; <tspan" in drawn
    assert 'stroke-linejoin="round" stroke' not in drawn


def test_black_is_ink_and_each_colour_follows_the_theme():
    svg = themed_svg(SVG, title="t", alt="a")
    ink, blue = style.LIGHT["ink"], style.LIGHT["blue"]
    assert f'fill="{ink}"' in svg
    assert f'.rosmini-plot [fill="{ink}"]{{fill:var(--rosmini-ink, {ink})}}' in svg
    assert f'.rosmini-plot [stroke="{blue}"]{{stroke:var(--rosmini-blue, {blue})}}' in svg
    assert f"--rosmini-blue:{style.DARK['blue']}" in svg
    assert "--rosmini-green" not in svg  # no rule for what is not there
    rules = re.findall(r"([^{}]+)\{", svg[svg.index("<style>") + 7 : svg.index("</style>")])
    selectors = [part for rule in rules if not rule.startswith("@") for part in rule.split(",")]
    assert len(selectors) > 5
    for selector in selectors:  # no rule for other pictures of the page
        assert ".rosmini-plot" in selector or selector == "svg:root", selector


def test_a_colour_beside_the_palette_is_lighter_on_dark_pages():
    dull, bright = SVG.replace("#0072b2", "#102040"), SVG.replace("#0072b2", "#ffe0c0")
    svg = themed_svg(dull, title="t", alt="a", adapt=True)
    assert '.rosmini-plot [stroke="#102040"]{stroke:var(--rosmini-102040, #102040)}' in svg
    [dark] = set(re.findall(r"--rosmini-102040:(#[0-9a-f]{6})", svg))
    assert sum(int(dark[i : i + 2], 16) for i in (1, 3, 5)) > 2 * (0x10 + 0x20 + 0x40)
    assert "--rosmini-ffe0c0:#ffe0c0" in themed_svg(bright, title="t", alt="a", adapt=True)
    assert "--rosmini-102040" not in themed_svg(dull, title="t", alt="a")


def test_the_picture_is_one_document_with_text_that_stays_text():
    with house_style():
        figure = blank_figure(300, 150)
        axes = add_axes(figure, 50, 20, 200, 80)
        axes.set(xlabel="x [m]", title="<&>")
        view = matplotlib_picture(figure, text="first line\nsecond", alt="A plot.", form="svg", caption="C")
    root = ET.fromstring(view.svg)
    assert root.get("role") == "img"
    assert root.get("aria-label") == "A plot."
    assert root.get("viewBox") == "0 0 300 150"
    words = [node.text for node in root.iter("{http://www.w3.org/2000/svg}text")]
    assert "x [m]" in words
    assert "<&>" in words
    assert root[0].text == "first line"
    assert "<figcaption>C</figcaption>" in view.html


def test_the_house_style_asks_no_matplotlibrc_and_leaves_no_trace():
    import matplotlib as mpl

    with mpl.rc_context({"axes.facecolor": "#123456", "font.size": 30}):
        with house_style():
            assert mpl.rcParams["axes.facecolor"] == "none"
        assert mpl.rcParams["axes.facecolor"] == "#123456"
        assert mpl.rcParams["font.size"] == 30


def test_without_matplotlib_the_error_says_what_to_install(monkeypatch):
    import sys

    monkeypatch.setitem(sys.modules, "matplotlib", None)
    with pytest.raises(ViewError, match=r"pip install matplotlib"), house_style():
        pass


@pytest.mark.parametrize("size", [(50, 300), (300, 9000), (float("nan"), 300)])
def test_a_picture_of_no_size_is_refused(size):
    with pytest.raises(ViewError, match="100 to 4000 pixels"):
        blank_figure(*size)


def drawn(figure):
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


def test_lines_have_the_colours_of_the_palette_and_stay_dashed(figure):
    svg = drawn(figure)
    assert f'stroke="{style.LIGHT["blue"]}"' in svg
    (dashed,) = re.findall(rf'<path d="M[^"]{{9,}}"[^>]*stroke="{style.LIGHT["vermilion"]}"[^>]*>', svg)[:1]
    assert "stroke-dasharray" in dashed
    assert not any(colour in svg for colour in CYCLE)
