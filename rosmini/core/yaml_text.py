"""Safe reading of YAML: one document after another, with line numbers in errors.

It uses PyYAML's safe loader (YAML 1.1: ``yes`` is a boolean, ``010`` is eight, ``1e5`` without a point is text),
which only makes plain data. A few lines of aliases (``*name``) could expand to gigabytes, or contain themselves:
such documents are refused before they are constructed.
"""

from __future__ import annotations

from collections.abc import Callable, Hashable, Iterator
from typing import Any

import yaml
from yaml.composer import Composer
from yaml.constructor import SafeConstructor
from yaml.resolver import Resolver

from rosmini.core.collisions import collide

MAX_VALUES = 100_000
"""Maximum number of values in a document, with aliases expanded."""

MAX_DIGITS = 1000
"""Maximum length of a number [characters]."""

Failure = Callable[[str, str, int | None], Exception]
"""A function that returns an exception for a message, the name of the source, and a line (None if not known)."""


SHORT, SHORT_WITH_TABS = 10_000, 100_000
"""Maximum length of a text [characters], without and with tabs, for PyYAML's pure-Python parser.

That parser is ten times as slow as libyaml, but has better error messages, and rejects tabs as ROS does.
"""


class _Parser(yaml.reader.Reader, yaml.scanner.Scanner, yaml.parser.Parser):
    """PyYAML's pure-Python parser (libyaml's is `CParser`)."""

    def __init__(self, text: str) -> None:
        yaml.reader.Reader.__init__(self, text)
        yaml.scanner.Scanner.__init__(self)
        yaml.parser.Parser.__init__(self)


def _parser(text: str) -> Any:
    """Return the parser for a text: libyaml's for a long one, if available."""
    is_short = len(text) <= (SHORT_WITH_TABS if "\t" in text else SHORT)
    if is_short or not yaml.__with_libyaml__:
        return _Parser(text)
    from yaml._yaml import CParser  # type: ignore[import-untyped,import-not-found,unused-ignore]

    try:
        return CParser(text)
    except UnicodeEncodeError:  # a lone surrogate, which PyYAML's parser rejects with a YAML error
        return _Parser(text)


class Loader(Composer, SafeConstructor, Resolver):
    """PyYAML's safe loader with a limit on the number of values."""

    name = ""

    def __init__(self, text: str) -> None:
        parser = _parser(text)
        self.check_event, self.peek_event = parser.check_event, parser.peek_event
        self.get_event, self.dispose = parser.get_event, parser.dispose
        Composer.__init__(self)
        SafeConstructor.__init__(self)
        Resolver.__init__(self)
        self.made = 0

    def compose_node(self, parent: Any, index: Any) -> Any:
        """Compose one node. Raises ``MarkedYAMLError`` for more than `MAX_VALUES` nodes."""
        self.made += 1
        if self.made > MAX_VALUES:
            mark = self.peek_event().start_mark
            raise yaml.MarkedYAMLError(problem=f"more than {MAX_VALUES} values", problem_mark=mark)
        return super().compose_node(parent, index)

    def construct_object(self, node: Any, deep: bool = False) -> Any:
        """Return the value of a node. Raises ``MarkedYAMLError``, which contains its line, if the value is invalid."""
        try:
            return super().construct_object(node, deep)
        # Raised for 2026-13-45, .e999, a list as a key, !!float "", !!bool x, !!timestamp 1.
        except (ValueError, OverflowError, TypeError, LookupError, AttributeError) as error:
            text = repr(node.value[:60]) if isinstance(node.value, str) else "what is here"
            what = f"{text} is no {node.tag.rpartition(':')[2]}"
            raise yaml.MarkedYAMLError(problem=f"{what}: {error}", problem_mark=node.start_mark) from error

    def construct_mapping(self, node: Any, deep: bool = False) -> Any:
        """Return a mapping. Raises ``MarkedYAMLError`` for many keys with the same hash, which take quadratic time."""
        if isinstance(node, yaml.MappingNode):
            self.flatten_mapping(node)
            keys = [key for key, _ in node.value if key.tag != "tag:yaml.org,2002:str"]
            if len(keys) > 1 and collide(self._hashable(key, deep) for key in keys):
                raise yaml.MarkedYAMLError(problem="too many keys with the same hash", problem_mark=node.start_mark)
        return super().construct_mapping(node, deep)

    def _hashable(self, node: Any, deep: bool) -> Hashable:
        """Return the value of a key; None for one that is not hashable, which is reported later."""
        value = self.construct_object(node, deep)
        return value if isinstance(value, Hashable) else None

    def construct_yaml_int(self, node: Any) -> Any:
        """Return an integer.

        Raises ``MarkedYAMLError`` for more than `MAX_DIGITS` characters, because conversion takes quadratic time.
        """
        if len(node.value) > MAX_DIGITS:
            raise yaml.MarkedYAMLError(problem="a number of too many digits", problem_mark=node.start_mark)
        return super().construct_yaml_int(node)


# PyYAML's type stubs accept only its own loaders.
Loader.add_constructor("tag:yaml.org,2002:int", Loader.construct_yaml_int)  # type: ignore[type-var]


def documents(
    text: str, source: str, failure: Failure, loader: type[Loader] = Loader
) -> Iterator[tuple[Any, yaml.Node]]:
    """Yield the value and the node of each document in a text.

    Raises `failure(message, source, line)` for invalid YAML, and for documents that are too large or too deep.
    """
    reading: Loader | None = None
    try:
        reading = loader(text)
        reading.name = source
        while reading.check_node():
            node: Any = reading.get_node()
            _refuse_endless(node, source, failure)
            yield reading.construct_document(node), node
    except (yaml.MarkedYAMLError, yaml.reader.ReaderError) as error:
        raise _no_yaml(error, source, failure) from error
    except RecursionError as error:
        raise failure("this is not YAML: its lists and mappings are nested too deeply", source, None) from error
    finally:
        if reading is not None:
            reading.dispose()


def line_of(node: yaml.Node | None) -> int | None:
    """Return the line of a node, counted from 1, or None if it is not known."""
    return None if node is None or node.start_mark is None else node.start_mark.line + 1


def children(node: yaml.Node) -> Iterator[tuple[str, yaml.Node, yaml.Node]]:
    """Yield (path, position, value) of each direct child: the path is ``/key`` or ``[0]``, the others are nodes.

    The position is the node whose line to report: the key in a mapping, the value in a list.
    """
    if isinstance(node, yaml.MappingNode):
        for key, value in node.value:
            yield f"/{key.value if isinstance(key, yaml.ScalarNode) else '?'}", key, value
    elif isinstance(node, yaml.SequenceNode):
        for number, value in enumerate(node.value):
            yield f"[{number}]", value, value


def _no_yaml(error: yaml.MarkedYAMLError | yaml.reader.ReaderError, source: str, failure: Failure) -> Exception:
    if isinstance(error, yaml.MarkedYAMLError):
        mark = error.problem_mark or error.context_mark
        text = ", ".join(part for part in (error.context, error.problem) if part)
        hint = " (indent with spaces, not with tabs)" if "'\\t'" in text else ""
        return failure(f"this is not YAML: {text}{hint}", source, None if mark is None else mark.line + 1)
    return failure(f"this is not YAML: {error.reason}, at character {error.position}", source, None)


def _refuse_endless(node: yaml.Node, source: str, failure: Failure) -> None:
    """Raise `failure(...)` if a document contains itself, or more than `MAX_VALUES` values with aliases expanded."""
    sizes: dict[int, int] = {}
    open_nodes: set[int] = set()

    def size(part: yaml.Node) -> int:
        if id(part) in open_nodes:
            raise failure("this value contains itself, through an alias", source, line_of(part))
        if id(part) not in sizes:
            open_nodes.add(id(part))
            inside = [*([key for key, _ in part.value] if isinstance(part, yaml.MappingNode) else [])]
            inside += [value for _, _, value in children(part)]
            sizes[id(part)] = 1 + sum(map(size, inside))
            open_nodes.discard(id(part))
        return sizes[id(part)]

    if size(node) > MAX_VALUES:
        raise failure(
            f"this document has {size(node)} values with its aliases; {MAX_VALUES} are allowed", source, line_of(node)
        )
