"""The book as an EPUB: its files, its contents and its links."""

from __future__ import annotations

import io
import zipfile
from urllib.parse import urldefrag
from xml.etree import ElementTree as ET

import matplotlib.image
import pytest

from book.tools.epub import make_epub, resolve_variables
from book.tools.paper import contents, listed_pages, read_sheets

from ..conftest import nightly

XHTML = "{http://www.w3.org/1999/xhtml}"
OPF = "{http://www.idpf.org/2007/opf}"
KINDS = {"xhtml": "application/xhtml+xml", "css": "text/css", "png": "image/png", "jpg": "image/jpeg"}
PAGES = ("book/intro", "notebooks/2_graph/20_topics_and_messages", "notebooks/7_navigation/30_costmaps")


def check(path, paper):
    """As epubcheck does: the package, well-formed pages, links with targets; and contents with every section."""
    with zipfile.ZipFile(path) as archive:
        first = archive.infolist()[0]
        files = {name: archive.read(name) for name in archive.namelist()}
    assert (first.filename, first.compress_type) == ("mimetype", zipfile.ZIP_STORED)
    assert files.pop("mimetype") == b"application/epub+zip"
    container = ET.fromstring(files.pop("META-INF/container.xml"))
    package = next(iter(container.iter("{urn:oasis:names:tc:opendocument:xmlns:container}rootfile"))).get("full-path")
    opf = ET.fromstring(files.pop(package))
    files = {name.removeprefix("EPUB/"): content for name, content in files.items()}
    items = {item.get("id"): item for item in opf.iter(f"{OPF}item")}
    assert sorted(item.get("href") for item in items.values()) == sorted(files)
    for item in items.values():
        assert item.get("media-type") == KINDS[item.get("href").rpartition(".")[2]]
    pages = {name: ET.fromstring(text) for name, text in files.items() if name.endswith(".xhtml")}
    spine = [items[ref.get("idref")].get("href") for ref in opf.iter(f"{OPF}itemref")]
    assert spine == ["cover.xhtml", "nav.xhtml", *(f"{sheet.key}.xhtml" for sheet in paper.sheets)]
    (cover,) = [item.get("href") for item in items.values() if item.get("properties") == "cover-image"]
    assert [image.get("src") for image in pages["cover.xhtml"].iter(f"{XHTML}img")] == [cover]
    assert matplotlib.image.imread(io.BytesIO(files[cover])).shape[:2] == (1753, 1240)
    ids = {name: [tag.get("id") for tag in page.iter() if tag.get("id")] for name, page in pages.items()}
    for name, page in pages.items():
        assert len(ids[name]) == len(set(ids[name]))
        assert not [tag.tag for tag in page.iter() if tag.tag.rpartition("}")[2] in {"script", "details", "input"}]
        for image in page.iter(f"{XHTML}img"):
            assert image.get("src") in files
        for link in page.iter(f"{XHTML}a"):
            target, place = urldefrag(link.get("href", "https:"))
            assert target.startswith(("https:", "http:", "mailto:")) or place in ids[target], (name, link.get("href"))
        assert b"var(--" not in files[name]
    shown = ["".join(link.itertext()) for link in pages["nav.xhtml"].iter(f"{XHTML}a")]
    assert shown == [title for _, _, title in contents(paper)]


@pytest.mark.parametrize("names", [PAGES, *nightly(None)])
def test_chapters_make_a_sound_epub_and_so_does_the_whole_book(book_html, root, tmp_path, names):
    listed = listed_pages(root)
    paper = read_sheets(book_html, {name: listed[name] for name in names or listed})
    check(make_epub(book_html, paper, tmp_path / "book.epub"), paper)


def test_css_variables_become_the_values_of_the_light_theme():
    text = "<style>:root{--a:#111}@media dark{:root{--a:#eee}}</style>fill:var(--a);stroke:var(--b, var(--c, #222))"
    assert resolve_variables(text).endswith("fill:#111;stroke:#222")
