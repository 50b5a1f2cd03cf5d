"""What programs written for other Logos use and this one does not have, and what to write in its place."""

from __future__ import annotations

import re

_ARRAYS = "there are no arrays here: keep a list"
_TABLES = "there are no property lists here: keep lists of two, or one variable each"
_READS = "a program here reads nothing: give its values as inputs"
_PROGRAMS = "programs do not change themselves here: write to ... end"
_LIST = "take first, butfirst, fput and lput"
_EDGES = "turtlesim's window has walls, and Logo's paper none"

ABSENT: dict[str, str] = {
    name: advice
    for names, advice in (
        ("array listtoarray arraytolist setitem mdarray mditem mdsetitem", _ARRAYS),
        ("pprop gprop remprop plist proplist", _TABLES),
        ("readlist readword readchar rl rw rc readrawline key? keyp", _READS),
        ("define text copydef def fulltext edit ed edall po pots erase er erall save load", _PROGRAMS),
        ("push pop queue dequeue", _LIST),
        ("wrap fence window", _EDGES),
        ("dotimes loop", "take repeat with repcount, or for [i 1 10]"),
        ("cond case", "take ifelse, one in another"),
        ("do.while do.until", "take while or until, whose condition comes first"),
        ("reduce apply invoke", "take foreach, or a procedure that calls itself with butfirst"),
        ("iseq rseq", "take for, or lput in a loop"),
        ("arc circle circle2", "draw it: repeat 36 [forward 5 right 10]"),
        ("fill filled label", "turtlesim draws lines only"),
        ("penerase pe penpaint ppt penreverse px", "draw in the colour of the background"),
        ("char ascii", "words here have no numbers for their letters"),
        ("error continue", "an error ends the program here, and its message says where"),
        ("global", "a name is global unless it is local or an input: make alone will do"),
        ("bye exit quit", "a program ends with its last line"),
        ("setcolor setpencolour setpenwidth", "it is setpencolor, setpensize here"),
    )
    for name in names.split()
}
"""The advice for each of these words."""


def advice(written: str, known: list[str]) -> str:
    """What to do about a word that is not known, ``"; ..."``, or nothing.

    >>> advice("fd10", ["fd"])
    '; a space is missing: fd 10'
    """
    name = written.lower()
    if name in ABSENT:
        return f"; {ABSENT[name]}"
    if name.startswith(("{", "}")) or name.endswith("}"):
        return "; lists stand in [ ]"
    if name.startswith("'") or name.endswith(("'", '"')):
        return '; a word begins with one " and ends at a space, and more words are a list: [hello world]'
    glued = re.fullmatch(r"([a-z]+)([0-9.]+)", name)
    if glued is not None and glued[1] in known:
        return f"; a space is missing: {glued[1]} {glued[2]}"
    if "^" in name:
        return "; take power: power 2 3"
    return ""
