"""The index of the book, and the links from the first use of a term: a small book of four pages."""

from __future__ import annotations

import re
from io import StringIO

import pytest

pytest.importorskip("sphinx")

from book.tools.subject_index import in_code

CONFIGURATION = "extensions = ['myst_nb', 'book.tools.sphinx_ext']\nhtml_theme = 'sphinx_book_theme'\n"
KINDS = ("terms", "commands", "packages", "types", "parameters")
PAGES = {
    "index": "# A book\n\n```{toctree}\none\ntwo\nglossary\nlist\n```\n",
    "one": """# One: nodes

Each node has a name, and a node is a process.

## Ask

`rosnode info` and `std_msgs/String`.

```console
$ rosnode info /talker
$ rosrun turtlesim turtlesim_node
```

In the glossary: {term}`node`.
""",
    "two": "# Two\n\nA *node* has `min_particles`.\n",
    "glossary": "# Glossary\n\n```{glossary}\nnode\n    A process.\n```\n",
    "list": "# Index\n\n" + "\n".join(f"```{{subject-index}} {kind}\n```\n" for kind in KINDS),
}


@pytest.fixture(scope="module")
def html(tmp_path_factory):
    from sphinx.application import Sphinx
    from sphinx.util.docutils import docutils_namespace

    source = tmp_path_factory.mktemp("source")
    (source / "conf.py").write_text(CONFIGURATION, encoding="utf-8")
    for name, text in PAGES.items():
        (source / f"{name}.md").write_text(text, encoding="utf-8")
    warnings = StringIO()
    with docutils_namespace():
        app = Sphinx(source, source, source / "out", source / "doctrees", "html", status=None, warning=warnings)
        app.build()
    assert warnings.getvalue() == ""
    return {name: (source / "out" / f"{name}.html").read_text(encoding="utf-8") for name in PAGES}


def entries(page):
    """Each entry of the index: its text, and the addresses of its links."""
    items = re.findall(r"<li><p>(.*?)</p></li>", page.partition('class="subject-index')[2], re.DOTALL)
    return {re.sub("<[^>]*>", "", item): re.findall(r'href="([^"]*)"', item) for item in items}


def test_an_entry_leads_to_the_sections_that_mention_it(html):
    assert entries(html["list"]) == {
        "node: One, Two": ["glossary.html#term-node", "one.html#one-nodes", "two.html#two"],
        "rosnode info: One": ["one.html#ask"],
        "rosrun: One": ["one.html#ask"],
        "turtlesim: One": ["one.html#ask"],
        "std_msgs/String: One": ["one.html#ask"],
        "min_particles: Two": ["two.html#two"],
    }


def test_the_first_use_of_a_term_leads_to_the_glossary(html):
    before, link, _ = html["one"].partition('href="glossary.html#term-node"')
    assert link
    assert before.rpartition("<p>")[2].startswith("Each ")
    assert html["one"].count("#term-node") == 2
    assert html["two"].count("#term-node") == 1


@pytest.mark.parametrize(
    ("code", "is_cell", "found"),
    [
        ("%rostopic echo /scan", True, [("commands", "rostopic echo")]),
        ("rostopic.echo()", True, []),
        ("%rosrun amcl amcl", True, [("commands", "rosrun"), ("packages", "amcl")]),
        ("from std_msgs.msg import Bool, Nope", True, [("types", "std_msgs/Bool")]),
        ("rosmini book", False, [("commands", "rosmini book")]),
        ("book", False, []),
        ("rosnode go", False, [("commands", "rosnode")]),
        ("planner_patience", False, [("parameters", "planner_patience")]),
    ],
)
def test_what_code_mentions(code, is_cell, found):
    assert list(in_code(code, is_cell=is_cell)) == found
