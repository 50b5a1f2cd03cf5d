"""The grammar of a Stage world file: properties and entities, and the expansion of `define`.

    resolution 0.02                      # a property of the world
    define erratic position              # from here on an erratic is a position
    (
      size [0.35 0.35 0.25]              # with this property
      ranger( pose [0.05 0 0 0] )        # and this child
    )
    erratic( pose [1 2 0 90] name "era" )

A defined entity begins with the contents of its base, in order, followed by the properties and children at its use.
The last value of a property applies. (Stage's manual: https://player-stage-manual.readthedocs.io, "Worldfiles"; facts
of the grammar from libstage's worldfile.cc.)
"""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass, field
from pathlib import Path

from rosmini.core.errors import nearest

from .errors import Place, StageError
from .tokens import Token, read

Value = float | str

MAX_DEPTH = 100
"""Maximum nesting of entities; a deeper file is broken, or malicious."""

_NUMBER = re.compile(r"\s*[-+]?(\d+\.?\d*|\.\d+)([eE][-+]?\d+)?")

MAX_ENTITIES = 100_000
"""Maximum number of entities of a world."""

MAX_WORDS = 500_000
"""Maximum number of words that definitions insert; those of a definition count at each use."""


@dataclass(frozen=True)
class Property:
    """A name with one value, or with several in brackets."""

    name: str
    values: tuple[Value, ...]
    place: Place


@dataclass
class Entity:
    """An entity with properties and children; the world itself has no kind."""

    kind: str
    place: Place
    title: str = ""
    """Its name at its use: the name of a macro, or the kind itself."""
    properties: dict[str, Property] = field(default_factory=dict)
    children: list[Entity] = field(default_factory=list)


@dataclass(frozen=True)
class _Macro:
    name: str
    base: str
    body: tuple[Token, ...]
    """The words between its parentheses."""
    place: Place


@dataclass
class Parsed:
    """A world file as written, with remarks."""

    root: Entity
    path: Path
    notes: list[tuple[Place, str]] = field(default_factory=list)
    macros: dict[str, Place] = field(default_factory=dict)


def parse_file(path: Path) -> Parsed:
    """Return the entities of a world file and its includes. Raises `StageError`."""
    return parse(read(path), path)


def parse(words: Iterable[Token], path: Path) -> Parsed:
    """Return the entities described by these words. Raises `StageError`."""
    return _Parser(tuple(words), path).world()


class _Words:
    """A sequence of words; `whole`: it is that of the whole file."""

    def __init__(self, words: tuple[Token, ...], end: Place, *, whole: bool = False) -> None:
        self.words = words
        self.whole = whole
        self.at = 0
        self.end = words[-1].place if words else end

    def next(self) -> Token | None:
        if self.at == len(self.words):
            return None
        self.at += 1
        return self.words[self.at - 1]

    def peek(self) -> Token | None:
        return self.words[self.at] if self.at < len(self.words) else None


class _Parser:
    def __init__(self, words: tuple[Token, ...], path: Path) -> None:
        self._words = _Words(words, Place(path, 1), whole=True)
        self._macros: dict[str, _Macro] = {}
        self._parsed = Parsed(Entity("", Place(path, 1)), path)
        self._count = self._inserted = 0

    def world(self) -> Parsed:
        """Parse all words."""
        self._fill(self._parsed.root, self._words, ())
        self._parsed.macros = {name: macro.place for name, macro in self._macros.items()}
        return self._parsed

    def _fill(self, entity: Entity, words: _Words, using: tuple[str, ...]) -> None:
        """Add the properties and children that these words describe to an entity."""
        while (word := words.next()) is not None:
            if word.kind != "word":
                raise StageError(word.place, f"a name is missing before {_shown(word)}")
            following = words.peek()
            if word.text == "define":
                self._define(word, words)
            elif following is None:
                raise StageError(word.place, f"after {word.text} a value is missing, or what is in parentheses")
            elif following.kind == "(":
                body = _between(words, word)
                entity.children.append(self._make(word.text, word.place, body, using))
            else:
                found = _property(word, words, self._parsed.notes)
                entity.properties[found.name] = found

    def _define(self, define: Token, words: _Words) -> None:
        name, base = words.next(), words.next()
        for word in (name, base):
            if word is None or word.kind != "word":
                found = "the end" if word is None else _shown(word)
                example = "define erratic position (...)"
                msg = f"after define come a name and what it is based on, as in {example}, not {found}"
                raise StageError(define.place, msg)
        assert name is not None and base is not None  # noqa: S101, PT018  # for mypy; the loop has told the user
        following = words.peek()
        if following is None or following.kind != "(":
            raise StageError(define.place, f"after define {name.text} {base.text} a ( is missing")
        macro = _Macro(name.text, base.text, _between(words, name), define.place)
        if macro.name in self._macros:
            first = self._macros[macro.name].place
            what = f"{_quoted(name)} is defined already, in {first}, and keeps its first definition"
            self._parsed.notes.append((define.place, what))
            return
        self._macros[macro.name] = macro

    def _make(self, name: str, place: Place, body: tuple[Token, ...], using: tuple[str, ...]) -> Entity:
        """Return the entity called `name`."""
        if len(using) > MAX_DEPTH:
            raise StageError(place, f"entities are nested more than {MAX_DEPTH} deep")
        macro = self._macros.get(name)
        if macro is None:
            entity = Entity(name, place, name)
        else:
            if name in using:
                msg = f"{name} is defined by itself: {' is a '.join((*using[using.index(name) :], name))}"
                raise StageError(macro.place, msg)
            self._inserted += len(macro.body)
            if self._inserted > MAX_WORDS:
                raise StageError(place, f"the definitions insert more than {MAX_WORDS} words, the last of {name}")
            entity = self._make(macro.base, place, macro.body, (*using, name))
            entity.title = name
        self._count += 1
        if self._count > MAX_ENTITIES:
            raise StageError(place, f"the definitions make more than {MAX_ENTITIES} entities of this file")
        self._fill(entity, _Words(body, place), (*using, ""))
        return entity


def _between(words: _Words, owner: Token) -> tuple[Token, ...]:
    """Return the words between the next parenthesis and its partner."""
    words.next()
    begin, depth = words.at, 1
    while depth:
        word = words.next()
        if word is None:
            raise StageError(owner.place, f"the ( after {owner.text} has no )")
        depth += (word.kind == "(") - (word.kind == ")")
    return words.words[begin : words.at - 1]


def _property(name: Token, words: _Words, notes: list[tuple[Place, str]]) -> Property:
    first = words.next()
    if first is None or first.kind not in ("number", "string", "["):
        found = "nothing" if first is None else _shown(first)
        hint = ": a string has to be in double quotes" if first is not None and first.kind == "word" else ""
        raise StageError(name.place, f"{name.text} needs a value, and there is {found}{hint}")
    if first.kind != "[":
        return Property(name.text, (_value(first, notes),), name.place)
    values: list[Value] = []
    while True:
        word = words.next()
        if word is None and words.whole:  # Stage treats the end of the file as the bracket
            notes.append((name.place, f"the [ after {_quoted(name)} has no ]; it ends with the file"))
        if word is None and not words.whole:
            raise StageError(name.place, f"the [ after {name.text} has no ]")
        if word is None or word.kind == "]":
            return Property(name.text, tuple(values), name.place)
        if word.kind not in ("number", "string"):
            raise StageError(word.place, f"{name.text} [...] holds numbers and strings, not {_shown(word)}")
        values.append(_value(word, notes))


def _value(word: Token, notes: list[tuple[Place, str]]) -> Value:
    if word.kind != "number":
        return word.text
    number, whole = leading_number(word.text)
    if not whole:
        notes.append((word.place, f"Stage reads {_quoted(word)} as the number {number:g}"))
    return number


def leading_number(text: str) -> tuple[float, bool]:
    """Return the number that a text begins with, as C's `atof` does, and whether it is the whole text.

    The number is 0 if the text does not begin with one.
    """
    found = _NUMBER.match(text)
    return (float(found.group()), found.end() == len(text.rstrip())) if found else (0.0, False)


def _quoted(word: Token) -> str:
    """Return a word for a note, which does not quote an included file."""
    return "a word of this line" if word.place.included else word.text


def _shown(word: Token) -> str:
    return f'"{word.text}"' if word.kind == "string" else word.text


def unknown_kind(entity: Entity, known: Iterable[str], macros: Iterable[str]) -> StageError:
    """Return the error for an entity of an unknown kind."""
    hint = nearest(entity.kind, [*known, *macros])
    what = f"there is no model {entity.kind!r} in Stage, and none is defined before it is used"
    return StageError(entity.place, f"{what}{'; ' + hint if hint else ''}", "Stage has no such model")
