"""The display funnel: text, image and HTML of a view, and how they reach a file, a notebook and a built page."""

import base64
import re
import tomllib
import xml.etree.ElementTree as ET
from colorsys import rgb_to_hls
from importlib.metadata import EntryPoint, EntryPoints
from pathlib import Path

import numpy as np
import pytest

from rosmini.core.graph import show as show_module
from rosmini.viz import Picture, ViewError, matplotlib_picture, rqt_graph, style
from rosmini.viz.alt_text import AltText
from rosmini.viz.svg import clean, element, escape, number
from rosmini.viz.view import Views

ROOT = Path(__file__).parents[2]
SYSTEM = [[["/chatter", ["/talker"]]], [["/chatter", ["/listener"]]], []]
PNG = base64.b64decode(
    "iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAYAAAAfFcSJAAAADUlEQVR42mNk+M9QDwADhgGAWjR9awAAAABJRU5ErkJggg=="
)


def test_a_terminal_sees_the_text(capsys):
    print(rqt_graph(SYSTEM))
    assert capsys.readouterr().out == "rqt_graph: 2 nodes, 1 topic\n/talker -> /chatter -> /listener\n"


def test_a_notebook_gets_text_image_and_html_with_the_alt_text():
    view = rqt_graph(SYSTEM)
    data, metadata = view._repr_mimebundle_()
    assert data["text/plain"] == view.text == repr(view)
    assert data["image/svg+xml"] == view.svg
    assert metadata == {"image/svg+xml": {"alt": view.alt}}
    figure = ET.fromstring(data["text/html"])
    (svg,) = list(figure)
    assert svg.get("role") == "img"
    assert svg.get("aria-label") == view.alt


def test_a_notebook_may_ask_for_some_forms_only():
    view = rqt_graph(SYSTEM)
    assert list(view._repr_mimebundle_(include={"text/plain"})[0]) == ["text/plain"]
    assert "text/html" not in view._repr_mimebundle_(exclude={"text/html"})[0]


def test_a_png_has_no_html_form_and_its_alt_text_in_the_metadata():
    view = Picture(PNG, text="one pixel", alt="A single pixel.")
    data, metadata = view._repr_mimebundle_()
    assert sorted(data) == ["image/png", "text/plain"]
    assert base64.b64decode(data["image/png"]) == PNG
    assert metadata == {"image/png": {"alt": "A single pixel."}}


def test_a_png_brings_its_caption_in_the_metadata():
    view = Picture(PNG, text="one pixel", alt="A single pixel.", caption="Figure 1: a & b")
    data, metadata = view._repr_mimebundle_()
    assert sorted(data) == ["image/png", "text/plain"]
    assert metadata == {"image/png": {"alt": "A single pixel.", "caption": "Figure 1: a & b"}}


def test_saving_writes_the_form_that_the_suffix_names(tmp_path):
    view = rqt_graph(SYSTEM)
    assert view.save(tmp_path / "a.svg").read_text(encoding="utf-8") == view.svg
    assert view.save(str(tmp_path / "a.txt")).read_text(encoding="utf-8") == view.text + "\n"
    assert view.html in view.save(tmp_path / "a.html").read_text(encoding="utf-8")
    with pytest.raises(ViewError, match=r"no form for the suffix '.jpg'.*\.html, \.svg, \.txt"):
        view.save(tmp_path / "a.jpg")
    with pytest.raises(ViewError, match=r"cannot write .*a\.svg: No such file"):
        view.save(tmp_path / "nowhere" / "a.svg")


@pytest.mark.parametrize(
    ("image", "text", "alt", "message"),
    [
        ("<svg/>", "text", " ", "needs alt text"),
        ("<svg/>", "", "alt", "needs a text form"),
        ("<p/>", "text", "alt", "<svg>"),
        (b"GIF89a", "text", "alt", "PNG"),
    ],
)
def test_a_picture_without_words_or_of_another_kind_is_refused(image, text, alt, message):
    with pytest.raises(ViewError, match=message):
        Picture(image, text=text, alt=alt)


@pytest.mark.parametrize("form", ["svg", "png"])
def test_a_matplotlib_figure_is_a_picture_with_the_same_bytes_each_time(form):
    from matplotlib.figure import Figure

    def picture():
        figure = Figure(figsize=(1, 1))
        figure.subplots().plot([0, 1], [1, 0], label="a")
        return matplotlib_picture(figure, text="a line that falls", alt="A <falling> line.", form=form)

    first, second = picture(), picture()
    assert first._repr_mimebundle_() == second._repr_mimebundle_()
    if form == "svg":
        assert ET.fromstring(first.svg).get("aria-label") == "A <falling> line."
        assert "<dc:date>" not in first.svg


def test_svg_is_escaped_and_numbers_are_short():
    assert element("text", escape("<&\x00>"), x=-0.04, text_anchor='"') == (
        '<text x="0" text-anchor="&quot;">&lt;&amp;\N{REPLACEMENT CHARACTER}&gt;</text>'
    )
    assert [number(v) for v in (1, 1.25, -2.0, 3.14)] == ["1", "1.2", "-2", "3.1"]
    assert clean("a\ud800b") == "a\N{REPLACEMENT CHARACTER}b"


# The house style


def luminance(colour):
    """Relative luminance (WCAG 2.1)."""
    channels = [int(colour[i : i + 2], 16) / 255 for i in (1, 3, 5)]
    linear = [c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4 for c in channels]
    return 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]


def contrast(a, b):
    high, low = sorted((luminance(a), luminance(b)), reverse=True)
    return (high + 0.05) / (low + 0.05)


@pytest.mark.parametrize("palette", [style.LIGHT, style.DARK], ids=["light", "dark"])
def test_text_and_lines_stand_out(palette):
    for text, ground in [
        ("ink", "page"), ("muted", "page"), ("label", "page"), ("muted", "group-fill"), ("label", "group-fill"),
        ("ink", "node-fill"), ("ink", "topic-fill"), ("ink", "bad-fill"),
    ]:  # fmt: skip
        assert contrast(palette[text], palette[ground]) >= 4.5, (text, ground)
    for line in ["line", "node-line", "topic-line", "bad-line", "blue", "green", "vermilion", "purple"]:
        assert contrast(palette[line], palette["page"]) >= 3.0, line


def test_on_paper_lines_differ_without_their_colours():
    """Steps of CIE L*: what is 5 apart is seen as another grey when it lies beside the first."""
    on_page = [contrast(colour, "#ffffff") for colour in style.PRINT.values()]
    lightness = sorted(116 * (1.05 / each - 0.05) ** (1 / 3) - 16 for each in on_page)
    assert min(np.diff(lightness)) > 8
    assert min(on_page) >= 3.0
    for name, colour in style.PRINT.items():
        hues = [rgb_to_hls(*(int(c[i : i + 2], 16) / 255 for i in (1, 3, 5)))[0] for c in (colour, style.LIGHT[name])]
        assert abs(hues[0] - hues[1]) < 0.02, name


def test_both_palettes_name_the_same_colours_and_the_style_sheet_has_them():
    assert list(style.LIGHT) == list(style.DARK)
    sheet = (ROOT / "rosmini/viz/static/rosmini.css").read_text(encoding="utf-8")
    light, dark, paper = re.split("@media (?:not )?print", sheet)
    for rules, palette in ((light, style.LIGHT), (dark, style.DARK), (paper, style.PRINT)):
        assert dict(re.findall(r"--rosmini-([a-z-]+): (#[0-9a-f]{6});", rules)) == palette
    assert f"--rosmini-font: {style.FONT};" in light
    assert all(page in dark.partition("{")[2].partition("{")[0] for page in style.DARK_PAGES)


def test_a_picture_follows_the_theme_of_its_page_and_has_no_id_and_no_link():
    svg = rqt_graph(SYSTEM).svg
    assert 'html[data-theme="dark"] .rosmini-svg' in svg
    assert f"var(--rosmini-node-fill, {style.LIGHT['node-fill']})" in svg
    used = set(re.findall(r"var\(--rosmini-([a-z-]+)", svg))
    assert all(f"--rosmini-{name}:{style.DARK[name]}" in svg for name in used)
    assert " id=" not in svg
    assert re.findall(r"(?:https?:)?//[^\s\"']+", svg) == ["http://www.w3.org/2000/svg"]


# The way from the floors below


def test_a_thing_is_shown_by_the_renderer_of_its_kind(monkeypatch):
    point = EntryPoint("computation_graph", "rosmini.viz.rqt.graph:rqt_graph", show_module.GROUP)
    monkeypatch.setattr(show_module, "entry_points", lambda group: EntryPoints([point]).select(group=group))
    assert show_module.show("computation_graph", SYSTEM, mode="nodes_topics_all").text.startswith("rqt_graph: 2 nodes")
    with pytest.raises(show_module.UnknownExtension, match="did you mean computation_graph"):
        show_module.show("computation_graf", SYSTEM)


def test_the_entry_points_of_the_project_can_be_loaded():
    declared = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"].get("entry-points", {})
    found = {
        name: EntryPoint(name, value, group).load()
        for group in ("rosmini.renderers", "myst_nb.mime_renderers")
        for name, value in declared.get(group, {}).items()
    }
    assert set(found) >= {"computation_graph", "rosmini_alt_text"}


# The built page


@pytest.fixture(scope="module")
def built_page(tmp_path_factory):
    """A page with a graph and a PNG in its committed outputs, built by Sphinx as the book is."""
    import nbformat
    from myst_nb.core import render
    from sphinx.application import Sphinx
    from sphinx.util.docutils import docutils_namespace

    source = tmp_path_factory.mktemp("page")
    outputs = []
    for view in (
        rqt_graph(SYSTEM, title="A caption"),
        Picture(PNG, text="one pixel", alt='A "single" pixel.', caption="One <pixel>"),
    ):
        data, metadata = view._repr_mimebundle_()
        outputs.append(nbformat.v4.new_output("display_data", data=data, metadata=metadata))
    cell = nbformat.v4.new_code_cell("view", execution_count=1, outputs=outputs)
    notebook = nbformat.v4.new_notebook(cells=[nbformat.v4.new_markdown_cell("# Page"), cell])
    notebook.metadata["kernelspec"] = {"name": "python3", "display_name": "Python 3", "language": "python"}
    nbformat.write(notebook, source / "index.ipynb")
    confoverrides = {"extensions": ["myst_nb"], "nb_execution_mode": "off", "numfig": True}
    with pytest.MonkeyPatch.context() as patch, docutils_namespace():
        patch.setattr(render, "load_mime_renders", lambda: [AltText])  # as its entry point makes it
        app = Sphinx(
            source, None, source / "out", source / "trees", "html",
            confoverrides=confoverrides, status=None, warningiserror=True,
        )  # fmt: skip
        app.build()
    return (source / "out" / "index.html").read_text(encoding="utf-8")


def test_the_built_page_shows_pictures_with_their_alt_texts_and_captions(built_page):
    view = rqt_graph(SYSTEM, title="A caption")
    assert view.html in built_page
    assert f'role="img" aria-label="{view.alt}"' in built_page
    (figure,) = re.findall(r"<figure[^>]*>\s*<img [^>]*\.png.*?</figure>", built_page, re.DOTALL)
    assert "rosmini-figure" in figure
    assert 'alt="A &quot;single&quot; pixel."' in figure
    assert "<figcaption>One &lt;pixel&gt;</figcaption>" in figure  # and no number of Sphinx's


def test_views_one_below_the_other_have_the_words_and_the_pages_of_all():
    one, other = (Picture("<svg/>", text=f"text {n}", alt=f"alt {n}") for n in (1, 2))
    both = Views([one, other])
    assert both.text == "text 1\ntext 2"
    assert both.alt == "1. alt 1 2. alt 2"
    assert both.html == one.html + other.html
