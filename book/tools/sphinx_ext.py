"""The Sphinx extension of the book: pages that need no network, and notebooks that need no Sphinx.

- Formulas become MathML when the book is built, so that no MathJax is loaded.
- A quote that begins with a bold word such as "On a real robot" becomes a box, whether it is written with `>` or
  between `<blockquote>` and `</blockquote>`. In JupyterLab it stays a quote.
- What sphinx-thebe adds to each page (a script from a CDN, declared twice) is taken out.
- The chatter of the theme's scripts in the browser's console is taken out too.
- The style sheet and the scripts of `rosmini.viz` come along, and meshcat's viewer if a page needs it.
- Cells with `%%node`, `%%launch` or `%%terminal` are coloured as what they hold.
- A caption (`book.tools.captions`) becomes that of the figure before it, or of the table after it.
- A picture's alternative text in the metadata of its cell replaces the one that the picture made itself.
- An id that two pictures of a page share, such as that of a clip path, gets a number in the second one.
- Chapters have the number of their part and of their place in it, from `_toc.yml` alone.
- The directive `drawing` puts a drawing of `book/static/drawings` into a prose page, with a caption.
- The directive `stored` shows a figure that a notebook has stored, such as the pad on the cover.
- The substitutions `repository_copy`, `reading_hours`, `largest_chapter` and `largest_memory` are computed: the first
  from the one setting with the repository's address (`repository.url` in `_config.yml`), the second from the
  notebooks, the last two from the measurement of the chapters.
- The first use of a term leads to the glossary, and the index is collected (`book.tools.subject_index`).
- The directive `progress-list` lists pages and exercises to tick (`book.tools.progress`).
- Some pages have the button *Run in this page* (`book.tools.run_in_page`).
- A notebook that a reader downloads begins with a cell that says how to get what it needs.
"""

from __future__ import annotations

import json
import re
import shutil
from collections import Counter
from html import escape
from itertools import pairwise
from pathlib import Path
from typing import TYPE_CHECKING, Any, ClassVar

from docutils import nodes
from latex2mathml.converter import convert
from sphinx import addnodes
from sphinx.transforms import SphinxTransform
from sphinx.util.docutils import SphinxDirective

from book.tools import costs, notebooks, progress, reading, reference, run_in_page, subject_index
from book.tools.captions import CAPTION
from book.tools.lexer import CellLexer
from book.tools.pages import VIEWER_CALL
from rosmini.viz.embed import MESHCAT, STATIC, asset_path

if TYPE_CHECKING:
    from sphinx.application import Sphinx
    from sphinx.config import Config
    from sphinx.environment import BuildEnvironment
    from sphinx.writers.html5 import HTML5Translator

# How a quote begins -> the classes of the box that it becomes (the theme gives "note", "tip" and so on their look).
BOXES: dict[str, tuple[str, ...]] = {
    "On a real robot": ("real-robot",),
    "You will learn": ("learn",),
    "Summary": ("summary-box",),
    "Note": ("note",),
    "Tip": ("tip",),
    "Warning": ("warning",),
}


STATIC_PICTURES = Path(__file__).resolve().parents[1] / "static"
"""The folders `drawings` and `films` hold the pictures of the prose pages, which `assets/generate` makes."""


def mathml(tex: str, *, display: bool) -> str:
    """The formula `tex` as a MathML element, with the TeX source as its accessible label."""
    return convert(tex.strip(), display="block" if display else "inline")


def visit_inline_math(self: HTML5Translator, node: nodes.math) -> None:
    """Write an inline formula."""
    self.body.append(mathml(node.astext(), display=False))
    raise nodes.SkipNode


def visit_block_math(self: HTML5Translator, node: nodes.math_block) -> None:
    """Write a displayed formula, with its number if it has one; the arrow keys scroll it where it is too wide."""
    self.body.append(self.starttag(node, "div", CLASS="math-block", tabindex="0"))
    self.body.append(mathml(node.astext(), display=True))
    if node.get("number"):
        self.body.append(f'<span class="eqno">({node["number"]})')
        self.add_permalink_ref(node, "Link to this equation")
        self.body.append("</span>")
    self.body.append("</div>\n")
    raise nodes.SkipNode


class QuoteBoxes(SphinxTransform):
    """Turns quotes that begin with one of `BOXES` in bold into boxes with that title."""

    default_priority = 400

    def apply(self, **kwargs: Any) -> None:  # noqa: ARG002  (docutils' signature)
        """Replace them in the page at hand."""
        for tag in list(self.document.findall(is_opening_tag)):
            gather_quote(tag)
        for quote in list(self.document.findall(nodes.block_quote)):
            title = box_title(quote)
            if title is not None:
                quote.replace_self(make_box(quote, title))


def is_opening_tag(node: nodes.Node) -> bool:
    """Return whether `node` is the line `<blockquote>`."""
    return isinstance(node, nodes.raw) and node.astext().strip() == "<blockquote>"


def gather_quote(tag: nodes.Node) -> None:
    """Replace the line `<blockquote>`, the line `</blockquote>` and everything between them by one quote.

    Without the second line, nothing is replaced.
    """
    siblings, start = tag.parent.children, tag.parent.index(tag)
    end = next((i for i in range(start, len(siblings)) if siblings[i].astext().strip() == "</blockquote>"), None)
    if end is not None:
        quote = nodes.block_quote("", *siblings[start + 1 : end])
        tag.parent[start : end + 1] = [quote]


def box_title(quote: nodes.block_quote) -> str | None:
    """The title with which `quote` asks to be a box, if it does."""
    first = quote.children[0] if quote.children else None
    if not isinstance(first, nodes.paragraph):
        return None
    lead = next((child for child in first.children if child.astext().strip()), None)
    title = lead.astext().strip().rstrip(".:") if isinstance(lead, nodes.strong) else ""
    return title if title in BOXES else None


def make_box(quote: nodes.block_quote, title: str) -> nodes.admonition:
    """The box that takes the place of `quote`: its bold lead becomes the title."""
    first, *rest = quote.children
    lead = next(first.findall(nodes.strong))
    words = list(first.children[first.children.index(lead) + 1 :])
    if words and isinstance(words[0], nodes.Text):
        words[0] = nodes.Text(words[0].lstrip(" .:\n"))
    text = nodes.paragraph("", "", *words)
    body = [text, *rest] if text.astext().strip() else rest
    return nodes.admonition("", nodes.title("", title), *body, classes=[*BOXES[title], "box"])


ANCHOR = re.compile(r'<a id="([a-z0-9-]+)">')


class Captions(SphinxTransform):
    """Gives each caption to its picture or table, and makes its label known to links."""

    default_priority = 410  # before MyST resolves the links

    def apply(self, **kwargs: Any) -> None:  # noqa: ARG002  (docutils' signature)
        """Do so in the page at hand."""
        for figure in self.document.findall(nodes.figure):
            for label in figure["ids"]:
                self.know(label, figure.astext())
        for paragraph in list(self.document.findall(nodes.paragraph)):
            label = caption_label(paragraph)
            if label is not None:
                self.know(label, paragraph.astext())
                place_caption(paragraph, label)

    def know(self, label: str, text: str) -> None:
        """Let links of this page and of others find the label, as MyST does with the anchors of headings."""
        slug = (0, label, text)
        vars(self.document).setdefault("myst_slugs", {})[label] = slug
        self.env.metadata[self.env.docname].setdefault("myst_slugs", {})[label] = slug


def caption_label(paragraph: nodes.paragraph) -> str | None:
    """The label of a paragraph that is a caption."""
    first = paragraph.children[0] if paragraph.children else None
    anchor = ANCHOR.fullmatch(first.astext()) if isinstance(first, nodes.raw) else None
    return anchor[1] if anchor else None


def place_caption(paragraph: nodes.paragraph, label: str) -> None:
    """Put the caption above the table after it, or below the last output of the cell before it.

    Elsewhere it stays a paragraph, which has the label.
    """
    words = paragraph.children[2:]  # what follows <a id="..."></a>
    siblings, place = paragraph.parent.children, paragraph.parent.index(paragraph)
    before = siblings[place - 1] if place else None
    after = siblings[place + 1] if place + 1 < len(siblings) else None
    outputs = [
        part
        for part in (before.children if isinstance(before, nodes.container) else ())
        if isinstance(part, nodes.container) and "cell_output" in part.get("classes", ()) and part.children
    ]
    if outputs and not isinstance(after, nodes.table):
        picture = outputs[-1].children[-1]
        outputs[-1].remove(picture)
        outputs[-1].append(nodes.figure("", picture, nodes.caption("", "", *words), ids=[label]))
        paragraph.parent.remove(paragraph)
    elif isinstance(after, nodes.table):
        after.insert(0, nodes.title("", "", *words))
        after["ids"].append(label)
        paragraph.parent.remove(paragraph)
    else:
        paragraph.children = list(words)
        paragraph["ids"].append(label)


def describe_pictures(app: Sphinx, docname: str, content: list[str]) -> None:
    """Give the pictures of a notebook the alternative texts of its cells' metadata."""
    if Path(app.env.doc2path(docname)).suffix != ".ipynb":
        return
    notebook = json.loads(content[0])
    for cell in notebook["cells"]:
        if "alt" in cell["metadata"]:
            label = f'aria-label="{escape(cell["metadata"]["alt"])}"'.replace("\\", r"\\")
            for output in cell["outputs"]:
                if "image/png" in output.get("data", {}):
                    output["metadata"].setdefault("image/png", {})["alt"] = cell["metadata"]["alt"]
                if html := output.get("data", {}).get("text/html"):
                    output["data"]["text/html"] = re.sub(r'aria-label="[^"]*"', label, "".join(html), count=1)
    content[0] = json.dumps(notebook)


SVG = re.compile(r"<svg\b.*?</svg>", re.DOTALL)
ID = re.compile(r'\sid="([^"]+)"')


def separate_ids(
    _app: Sphinx, _page: str, _template: str, context: dict[str, Any], _doctree: nodes.Node | None
) -> None:
    """Give each element of a page's SVGs an id that occurs once on the page, and change the references to it.

    Chapters store pictures whose ids derive from the content of the element (`rosmini.viz.themed`), so that the same
    marker has the same id in each picture, and also where one picture defines it twice.
    """
    counts: Counter[str] = Counter()

    def separate(svg: str) -> str:
        ids = set(ID.findall(svg))
        counts.update(ids)
        for old in sorted(ids):
            first, *others = re.split(rf'\sid="{re.escape(old)}"', svg)
            new = old if counts[old] == 1 else f"{old}-{counts[old]}"
            svg = re.sub(rf'#{re.escape(old)}(?=["\)])', f"#{new}", f'{first} id="{new}"{"".join(others)}')
        return svg

    context["body"] = SVG.sub(lambda found: separate(found[0]), context.get("body", ""))


CODE = re.compile(r'(?<=<span class="pre">)[^<]+')


def let_names_break(
    _app: Sphinx, _page: str, _template: str, context: dict[str, Any], _doctree: nodes.Node | None
) -> None:
    """Let long names break after a slash or an underscore: `geometry_msgs/Twist` in a narrow column of a table."""
    context["body"] = CODE.sub(lambda text: re.sub(r"(?<=\w[/_])(?=\w)", "<wbr>", text[0]), context.get("body", ""))


def number_chapters(app: Sphinx, env: BuildEnvironment) -> list[str]:
    """Put the number of its part before the number of each chapter: Sphinx counts in each part from 1.

    Take out Sphinx's numbers of figures and tables: `sphinx_jupyterbook_latex` switches them on, captions have others.
    """
    env.toc_fignumbers.clear()
    part = 0
    for toctree in env.get_doctree(app.config.root_doc).findall(addnodes.toctree):
        if not toctree.get("numbered"):
            continue
        part += 1
        for _, docname in toctree["entries"]:
            env.toc_secnumbers[docname] = {
                anchor: (part, *number) if number else number for anchor, number in env.toc_secnumbers[docname].items()
            }
            numbered = [*env.tocs[docname].findall(nodes.reference), env.titles[docname]]
            for node in numbered:
                if node.get("secnumber"):
                    node["secnumber"] = [part, *node["secnumber"]]
    return []


class Drawing(SphinxDirective):
    """A drawing by the name of its file, inline so that it follows the page's theme; its caption is the content."""

    required_arguments = 1
    has_content = True
    option_spec: ClassVar[dict[str, Any]] = {}

    def run(self) -> list[nodes.Node]:
        """Return the figure. Raises docutils' error for a name that is no drawing, and for one without a caption."""
        self.assert_has_content()
        drawings = {path.stem: path for path in sorted(STATIC_PICTURES.glob("[df]*/*.svg"))}
        path = drawings.get(self.arguments[0])
        if path is None:
            raise self.error(f"there is no drawing {self.arguments[0]}; there are {', '.join(drawings)}")
        self.env.note_dependency(str(path))
        words = " ".join(self.content)
        caption = CAPTION.match(words)
        words = words.partition("</a>")[2] if caption else words
        svg = path.read_text(encoding="utf-8").strip()
        raw = nodes.raw("", f'<div class="rosmini-figure">{svg}</div>', format="html")
        return [nodes.figure("", raw, nodes.caption("", words), ids=[caption["label"]] if caption else [])]


class Stored(SphinxDirective):
    """A figure that a notebook has stored, by the notebook's path and the label of the figure's caption.

    The content is its caption here.
    """

    required_arguments = 2
    has_content = True

    def run(self) -> list[nodes.Node]:
        """Return the figure. Raises docutils' error if the notebook has stored no such figure."""
        self.assert_has_content()
        name, label = self.arguments
        path = Path(self.env.srcdir, f"{name}.ipynb")
        self.env.note_dependency(str(path))
        cells = notebooks.read(path).cells if path.is_file() else []
        for cell, caption in pairwise(cells):
            if caption.source.startswith(f'<a id="{label}"></a>'):
                htmls = [output.get("data", {}).get("text/html") for output in cell.get("outputs", ())]
                for html in filter(None, htmls):
                    words = nodes.caption("", " ".join(self.content))
                    return [nodes.figure("", nodes.raw("", html, format="html"), words)]
        raise self.error(f"{name}.ipynb has stored no figure {label}: execute it first")


def silence_thebe(app: Sphinx) -> None:
    """Disconnect what sphinx-thebe does to each page: the book starts no remote kernels."""
    for listeners in app.events.listeners.values():
        for listener in list(listeners):
            if listener.handler.__module__.startswith("sphinx_thebe"):
                app.disconnect(listener.id)


def add_viz_files(app: Sphinx) -> None:
    """Add the style sheet of `rosmini.viz`'s pictures, and put its scripts beside it for pages to load."""
    app.config.html_static_path.append(str(STATIC))
    app.add_css_file("rosmini.css")


def copy_viewer(app: Sphinx, error: Exception | None) -> None:
    """Copy meshcat's viewer out of its wheel, with its licences, if a page shows something in it."""
    if error is not None or app.builder.format != "html":
        return
    pages = (path for path in Path(app.outdir).rglob("*.html") if "_static" not in path.parts)
    if any(VIEWER_CALL in path.read_text(encoding="utf-8") for path in pages):
        script = asset_path(MESHCAT)
        shutil.copyfile(script, Path(app.outdir, "_static", MESHCAT))
        shutil.copyfile(
            script.with_name("main.min.js.LICENSE.txt"), Path(app.outdir, "_static", f"{MESHCAT}.LICENSE.txt")
        )


def substitute(app: Sphinx, config: Config) -> None:
    """Define the substitutions that are computed, and show the buttons to the repository if its address is known.

    These lead to the repository, to the source of the page, and to a form for reporting a mistake in it.
    """
    url = config.html_theme_options.get("repository_url", "")
    for button in ("use_repository_button", "use_source_button", "use_issues_button"):
        config.html_theme_options[button] = bool(url)
    chapters = sorted(Path(app.srcdir, "notebooks").rglob("*.ipynb"))
    minutes = sum(reading.minutes(notebooks.read(path)) for path in chapters)
    largest = costs.largest()
    config.myst_substitutions |= {
        "repository_copy": f"[a copy of the repository]({url})" if url else "a copy of this repository",
        "reading_hours": str(round(minutes / 60)),
        "largest_chapter": f"{{doc}}`/{largest['chapter']}`",
        "largest_memory": str(largest["memory"]),
    }


def direct_downloads(app: Sphinx, error: Exception | None) -> None:
    """Begin each notebook that readers can download with the way to what it needs."""
    if error is not None or app.builder.format != "html":
        return
    url = app.config.html_theme_options.get("repository_url", "")
    for path in sorted(Path(app.outdir, "_sources", "notebooks").rglob("*.ipynb")):
        notebook = notebooks.read(path)
        reading.add_directions(notebook, path.name, url)
        notebooks.write(notebook, path)


def prepare(app: Sphinx) -> None:
    """When the builder is ready, and before the handlers of the other extensions."""
    silence_thebe(app)
    add_viz_files(app)


def hush(app: Sphinx, error: Exception | None) -> None:
    """Take the chatter out of the theme's scripts ("Changed to auto mode ..."): the reader's console stays empty.

    Errors and warnings are left as they are.
    """
    if error is not None or app.builder.format != "html":
        return
    # The theme's search page has a script of its own.
    for script in (*Path(app.outdir, "_static").rglob("*.js"), Path(app.outdir, "search.html")):
        text = script.read_text(encoding="utf-8")
        if "console.log(" in text:
            script.write_text(text.replace("console.log(", "void("), encoding="utf-8", newline="\n")


CORRECTIONS = (
    # The text of a button is its name, which a label may not contradict.
    (re.compile(r'(<button class="btn search-button-field[^>]*?) aria-label="Search"'), r"\1"),
    (re.compile(r'(<i class="theme-switch [^>]*?) title="[^"]*"'), r"\1"),
    (re.compile(r'<summary aria-label="Toggle hidden content">'), "<summary>"),
    # Everything belongs to a landmark.
    (
        re.compile(r'<div class="sidebar-primary-item">(?=[^<]*<a class="navbar-brand)'),
        r'<div role="navigation" aria-label="Home">',
    ),
    (re.compile(r'<th class="head"><p></p></th>'), "<td></td>"),
    # Citations: a role that is deprecated, and a list whose entries are none.
    (re.compile(r' role="doc-biblioentry"'), ""),
    (re.compile(r'<div role="list" class="citation-list">'), '<div class="citation-list">'),
)
"""What axe finds in the pages of the theme and of docutils, and how it is put right."""


def make_accessible(app: Sphinx, error: Exception | None) -> None:
    """Correct the markup of the theme's pages for screen readers (WCAG 2.2)."""
    if error is not None or app.builder.format != "html":
        return
    for page in Path(app.outdir).rglob("*.html"):
        text = corrected = page.read_text(encoding="utf-8")
        for found, better in CORRECTIONS:
            corrected = found.sub(better, corrected)
        if corrected != text:
            page.write_text(corrected, encoding="utf-8", newline="\n")


def setup(app: Sphinx) -> dict[str, Any]:
    """Register all of it with Sphinx."""
    app.add_html_math_renderer("mathml", (visit_inline_math, None), (visit_block_math, None))
    app.add_transform(QuoteBoxes)
    app.add_transform(Captions)
    subject_index.setup(app)
    progress.setup(app)
    run_in_page.setup(app)
    app.add_directive("drawing", Drawing)
    app.add_directive("stored", Stored)
    app.add_directive("parameters", reference.ParameterTables)
    app.add_directive("interface", reference.Interface)
    app.add_directive("fidelity", reference.FidelityTables)
    app.add_directive("costs", reference.CostTable)
    app.add_directive("browser-runs", reference.BrowserRuns)
    for language in ("python", "ipython3"):  # of fences, and of cells
        app.add_lexer(language, CellLexer)
    app.connect("config-inited", substitute)
    app.connect("source-read", describe_pictures)
    app.connect("env-get-updated", number_chapters, priority=900)  # after Sphinx has counted
    app.connect("builder-inited", prepare, priority=1)
    app.connect("html-page-context", separate_ids)
    app.connect("html-page-context", let_names_break)
    app.connect("build-finished", direct_downloads)
    app.connect("build-finished", copy_viewer, priority=998)
    app.connect("build-finished", make_accessible)
    # After every extension has copied its scripts.
    app.connect("build-finished", hush, priority=999)
    return {"version": "1", "parallel_read_safe": True, "parallel_write_safe": True}
