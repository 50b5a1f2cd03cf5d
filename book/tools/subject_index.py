"""The index, and the links from the first use of a term to the glossary.

Nothing is marked by hand. A page's entries are the terms that it refers to with the role `term` (chapters list theirs
at the end), emphasises or has in a heading, and the commands, packages, types and parameters in its code, cells
included. An entry leads to the sections that mention it most, at most one of a page and `MOST` in all. The directive
`subject-index` lists one kind.
"""

from __future__ import annotations

import re
from collections import Counter, defaultdict
from dataclasses import fields
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, Any

from docutils import nodes
from sphinx import addnodes
from sphinx.transforms import SphinxTransform
from sphinx.util.docutils import SphinxDirective

from book.tools.reference import declared
from rosmini.tools.main import COMMANDS

if TYPE_CHECKING:
    from collections.abc import Iterator

    from sphinx.application import Sphinx

CHECKOUT = Path(__file__).resolve().parents[2]
KINDS = ("terms", "commands", "packages", "types", "parameters")
MOST = 5
"""An entry leads to this many pages at most."""
NOT_INDEXED = (
    "book/about/",
    "book/contents",
    "book/glossary",
    "book/commands",
    "book/bibliography",
    "book/cheat_sheet",
    "book/for_your_course",
    "book/progress",
    "book/subject_index",
)
"""Pages about the book, and lists: an entry leads to the page that explains it."""
LINE = re.compile(
    r"^\s*(?:\$ |!)?(?:uv run )?(?:rosmini )?(?P<magic>%{0,2})(?P<name>[a-z]\w*)(?: (?P<verb>[a-z_]+)\b)?"
)
"""A line of a cell or a terminal."""
TYPE = re.compile(r"\b([a-z]\w+)/([A-Z]\w+)\b")
IMPORT = re.compile(r"^from (\w+)\.(?:msg|srv) import (.+)$", re.MULTILINE)


@cache
def terms() -> dict[str, str]:
    """The terms of the glossary, by themselves in lower case."""
    page = (CHECKOUT / "book" / "glossary.md").read_text(encoding="utf-8")
    return {term.lower(): term for term in re.findall(r"^(\S.*)\n {4}\S", page, re.MULTILINE)}


@cache
def plain_names() -> re.Pattern[str]:
    """A pattern for the terms that a text can mention unmarked: names, and those of several words."""
    found = [term for term in terms().values() if not term.islower() or re.search(r"^ros|[ _]", term)]
    longest_first = sorted(found, key=len, reverse=True)
    return re.compile(rf"(?<![\w/])({'|'.join(map(re.escape, longest_first))})s?(?![\w/])")


@cache
def packages() -> frozenset[str]:
    """The packages that are described here."""
    return frozenset(path.name for path in CHECKOUT.glob("assets/ros/*"))


@cache
def types() -> frozenset[str]:
    """The names of messages, services and actions, with their package."""
    return frozenset(f"{path.parts[-3]}/{path.stem}" for path in CHECKOUT.glob("assets/ros/*/[msa]*/*.[msa]*"))


@cache
def parameters() -> frozenset[str]:
    """The parameters that nodes declare and whose name is no everyday word."""
    names = {each.name for kinds in declared().values() for kind in kinds for each in fields(kind)}
    return frozenset(name for name in names if not name.islower() or "_" in name)


@cache
def verbs(command: str) -> frozenset[str]:
    """The verbs of one of rosmini's commands."""
    tool = COMMANDS[command].tool() if COMMANDS[command].folder is None else None
    return frozenset() if tool is None or tool.only_verb else frozenset(tool.verbs)


def command(line: str, *, is_cell: bool) -> str | None:
    """The command that a line of code contains, with its verb. In a cell it begins with a percent sign."""
    found = LINE.match(line)
    if found is None or (is_cell and not found["magic"] and "$ " not in line):
        return None
    name, verb = found["name"], found["verb"]
    if name.startswith(("ros", "rq", "rviz", "catkin")):
        return (f"{name} {verb}" if verb in verbs(name) else name) if name in COMMANDS else None
    if found["magic"]:
        return None if name == "load_ext" else f"{found['magic']}{name}"
    return f"rosmini {name}" if "rosmini " in line and name in COMMANDS else None


def in_code(text: str, *, is_cell: bool) -> Iterator[tuple[str, str]]:
    """What a piece of code mentions: a kind and a name each."""
    for line in text.splitlines():
        if found := command(line, is_cell=is_cell):
            yield "commands", found
    named = [f"{package}/{name}" for package, name in TYPE.findall(text)]
    for package, names in IMPORT.findall(text):
        named += [f"{package}/{name.split()[0]}" for name in names.split(",") if name.strip()]
    yield from (("types", name) for name in named if name in types())
    pattern = r"\b(?:rosrun|roslaunch|rospack find|roscd|rosmsg package) (\w+)" if is_cell else r"^(\w+)$"
    yield from (("packages", name) for name in re.findall(pattern, text) if name in packages())
    yield from (("parameters", name) for name in {*re.findall(r"(?<![\w/])\w+(?![\w/])", text)} & parameters())


def is_plain(node: nodes.Node) -> bool:
    """Whether a text belongs to a paragraph, and neither to code, a link, a table, a caption, nor a list of aims."""
    while not isinstance(node := node.parent, nodes.paragraph):
        if not isinstance(node, (nodes.strong, nodes.emphasis)):
            return False
    while node is not None:
        if isinstance(node, (nodes.table, nodes.figure)) or "learn" in node.get("classes", ()):
            return False
        node = node.parent
    return True


def section_of(node: nodes.Node) -> nodes.Node | None:
    """The innermost section around a node."""
    while node is not None and not isinstance(node, nodes.section):
        node = node.parent
    return node


class LinkTerms(SphinxTransform):
    """Lets the first use of each term that a page refers to lead to the glossary, and notes what to index."""

    default_priority = 420  # after captions

    def apply(self, **kwargs: Any) -> None:  # noqa: ARG002  (docutils' signature)
        """Do so in the page at hand."""
        if self.env.docname.startswith(NOT_INDEXED):
            return
        listed = [name for node in self.document.findall() for kind, name in mentions(node) if kind == "terms"]
        for term in dict.fromkeys(listed):
            self.link_first(term)
        self.env.metadata[self.env.docname]["subject_index"] = list(self.entries())

    def link_first(self, term: str) -> None:
        """Replace the first use of a term, in a paragraph and before any reference to it, by such a reference."""
        first = f"[{term[0]}{term[0].upper()}]{re.escape(term[1:])}"
        use = re.compile(rf"(?<![\w/-]){first}(?:s|es)?(?![\w/-])")
        for node in self.document.findall(lambda node: isinstance(node, (nodes.Text, addnodes.pending_xref))):
            if isinstance(node, addnodes.pending_xref):
                if node.get("reftarget") == term:
                    return
            elif found := use.search(node.astext()) if is_plain(node) else None:
                text, parent = node.astext(), node.parent
                link = addnodes.pending_xref(
                    "", nodes.inline("", found[0], classes=["xref", "std", "std-term"]),
                    refdomain="std", reftype="term", reftarget=term, refexplicit=True, refwarn=True,
                    refdoc=self.env.docname,
                )  # fmt: skip
                parts = [nodes.Text(text[: found.start()]), link, nodes.Text(text[found.end() :])]
                parent.replace(node, [part for part in parts if part.astext()])
                return

    def entries(self) -> Iterator[tuple[str, str, str, str, int]]:
        """What the page mentions: kind, name, the section with most mentions (id and title), and their number."""
        counts: defaultdict[tuple[str, str], Counter[int]] = defaultdict(Counter)
        sections = list(self.document.findall(nodes.section))
        places = {id(section): place for place, section in enumerate(sections)}
        for node in self.document.findall():
            weight = 5 if isinstance(node, nodes.title) or isinstance(node.parent, nodes.title) else 1
            for mention in [*mentions(node), *names_in(node)]:
                counts[mention][places.get(id(section_of(node)), 0)] += weight
        for (kind, name), found in counts.items():
            section = sections[min(found, key=lambda place: (-found[place], place))]
            yield kind, name, section["ids"][0], section[0].astext(), found.total()


def mentions(node: nodes.Node) -> Iterator[tuple[str, str]]:
    """What one node mentions: a kind and a name each."""
    if isinstance(node, addnodes.pending_xref) and node.get("reftype") == "term":
        yield "terms", node["reftarget"]
    elif isinstance(node, (nodes.strong, nodes.emphasis)):
        word = node.astext().lower().rstrip(".:")
        yield from (
            ("terms", terms()[each]) for each in dict.fromkeys((word, word.removesuffix("s"))) if each in terms()
        )
    elif isinstance(node, nodes.title):
        words = re.split(r"[^\w*]+", node.astext().lower().replace("navigation stack", ""))
        runs = {" ".join(words[start:end]) for start in range(len(words)) for end in range(start + 1, start + 5)}
        yield from (
            ("terms", terms()[each])
            for each in sorted(runs | {run.removesuffix("s") for run in runs})
            if each in terms()
        )
    elif isinstance(node, (nodes.literal, nodes.literal_block)):
        yield from in_code(node.astext(), is_cell=isinstance(node, nodes.literal_block))


def names_in(node: nodes.Node) -> Iterator[tuple[str, str]]:
    """The terms of several words, and those that are names, which one text of a paragraph contains."""
    if isinstance(node, nodes.Text) and isinstance(node.parent, (nodes.paragraph, nodes.literal)):
        yield from (("terms", term) for term in dict.fromkeys(plain_names().findall(node.astext())))


class index_list(nodes.General, nodes.Element):  # noqa: N801  (docutils names nodes like this)
    """Where the index of one kind will be when all pages are read."""


class SubjectIndex(SphinxDirective):
    """The index of one of `KINDS`."""

    required_arguments = 1

    def run(self) -> list[nodes.Node]:
        """Return the place for it. Raises docutils' error for another kind."""
        if self.arguments[0] not in KINDS:
            raise self.error(f"there is no kind {self.arguments[0]}; there are {', '.join(KINDS)}")
        return [index_list(kind=self.arguments[0])]


def fill(app: Sphinx, document: nodes.document, docname: str) -> None:
    """Put the entries into the places of the directive."""
    for place in list(document.findall(index_list)):
        place.replace_self(listed(app, place["kind"], docname))


def listed(app: Sphinx, kind: str, docname: str) -> nodes.bullet_list:
    """The entries of one kind, in alphabetical order, each with its links in the order of the book."""
    order = app.env.toctree_includes[app.config.root_doc]
    entries: dict[str, list[tuple[int, str, str, str]]] = defaultdict(list)
    defined: dict[str, str] = {}
    if kind == "terms":
        for name, _, found_kind, page, anchor, _ in app.env.get_domain("std").get_objects():
            if found_kind == "term":
                entries[name], defined[name] = [], link_to(app, docname, page, anchor)
    for page in order:
        for found_kind, name, anchor, title, count in app.env.metadata[page].get("subject_index", ()):
            if found_kind == kind:
                entries[name].append((count, page, anchor, title))
    titles = {page: app.env.titles[page].astext() for page in order}
    short = Counter(title.split(":")[0] for title in titles.values())
    names = {page: each[0] if short[(each := title.split(":"))[0]] == 1 else title for page, title in titles.items()}
    items = nodes.bullet_list(classes=["subject-index"])
    for name in sorted(entries, key=lambda name: (name.strip("%").lower(), name)):
        chosen = sorted(
            sorted(entries[name], key=lambda entry: -entry[0])[:MOST], key=lambda entry: order.index(entry[1])
        )
        text = nodes.inline("", name) if kind == "terms" else nodes.literal("", name)
        line = nodes.paragraph("", "", link(text, defined[name]) if name in defined else text)
        for number, (_, page, anchor, title) in enumerate(chosen):
            words = nodes.inline("", names[page])
            line += [nodes.Text(", " if number else ": "), link(words, link_to(app, docname, page, anchor), title)]
        items += nodes.list_item("", line)
    return items


def link_to(app: Sphinx, docname: str, page: str, anchor: str) -> str:
    """The address of a section as seen from a page."""
    return f"{app.builder.get_relative_uri(docname, page)}#{anchor}"


def link(content: nodes.Node, address: str, title: str = "") -> nodes.reference:
    """A link within the book; the title is shown while the pointer is over it."""
    attributes = {"reftitle": title} if title else {}
    return nodes.reference("", "", content, internal=True, refuri=address, **attributes)


def setup(app: Sphinx) -> None:
    """Register it with Sphinx."""
    app.add_transform(LinkTerms)
    app.add_node(index_list)
    app.add_directive("subject-index", SubjectIndex)
    app.connect("doctree-resolved", fill)
