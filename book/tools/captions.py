"""Numbers of figures, tables and exercises: counted within their page, and referred to by label.

A caption is a paragraph such as `<a id="two-laps"></a>Figure 2: The robot drives two laps.` For a figure it stands in
the cell below it, for a table above it, and in a prose page in the directive `drawing`. A reference is a link to the
label, `[Figure 2](#two-laps)`. JupyterLab shows both as they are. `python -m book.tools.notebooks clean` writes the
numbers, so that an author never counts, and the tests fail if one is wrong.
"""

from __future__ import annotations

import re
from collections import Counter
from typing import TYPE_CHECKING

from rosmini.core.errors import RosminiError, nearest

if TYPE_CHECKING:
    from collections.abc import Sequence

CAPTION = re.compile(r'^<a id="(?P<label>[a-z0-9-]+)"></a>(?P<kind>Figure|Table) \d+: (?P<text>.*)$', re.MULTILINE)
"""A caption, in the source of a page."""
REFERENCE = re.compile(r"\[(?:Figure|Table) \d+\]\(#(?P<label>[a-z0-9-]+)\)")
"""A reference to a caption of the same page."""
EXERCISE = re.compile(r"^### Exercise \d+: ", re.MULTILINE)
"""The heading of an exercise, up to its title."""


class CaptionError(RosminiError):
    """A label exists twice or not at all, or does not begin with a letter."""


def numbered(texts: Sequence[str]) -> list[str]:
    """Return the texts of one page, in reading order, with the numbers of captions, references and exercises.

    Raises `CaptionError` if two captions have the same label, a reference has one that no caption has, or a label does
    not begin with a letter.
    """
    names: dict[str, str] = {}
    counts: Counter[str] = Counter()

    def next_number(kind: str) -> int:
        counts[kind] += 1
        return counts[kind]

    def caption(found: re.Match[str]) -> str:
        label, kind, text = found["label"], found["kind"], found["text"]
        if not label[0].isalpha():
            raise CaptionError(
                f"the label {label!r} does not begin with a letter: the page's scripts could not find it"
            )
        if label in names:
            raise CaptionError(f"two captions have the label {label!r}: {names[label]}, and {kind} {text!r}")
        names[label] = f"{kind} {next_number(kind)}"
        return f'<a id="{label}"></a>{names[label]}: {text}'

    def reference(found: re.Match[str]) -> str:
        label = found["label"]
        if label not in names:
            raise CaptionError(
                f"no caption of this page has the label {label!r}. {nearest(label, names) or ''}".rstrip()
            )
        return f"[{names[label]}](#{label})"

    captioned = [CAPTION.sub(caption, text) for text in texts]
    headed = [EXERCISE.sub(lambda _: f"### Exercise {next_number('Exercise')}: ", text) for text in captioned]
    return [REFERENCE.sub(reference, text) for text in headed]
