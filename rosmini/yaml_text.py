"""YAML from outside: its documents, one by one, with errors that name the line.

It is PyYAML's safe loader (YAML 1.1: ``yes`` is a truth value, ``010`` is eight, ``1e5`` without a point is text),
which makes plain data only. A few lines of aliases (``*name``) could grow to gigabytes there, or contain themselves:
such documents are refused before they are constructed.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any

import yaml

__all__ = ["Loader", "children", "documents", "line_of"]

MOST = 100_000
"""How many values a document may have, those that aliases stand for included."""

LONGEST_NUMBER = 1000
"""How many characters a number may have."""

Failure = Callable[[str, str, int | None], Exception]
"""Makes an error of a message, the name of the source, and a line."""


class Loader(yaml.SafeLoader):
    """PyYAML's loader, which counts what it makes."""

    def __init__(self, text: str) -> None:
        super().__init__(text)
        self.made = 0

    def compose_node(self, parent: Any, index: Any) -> Any:
        """Compose one node, which is one more."""
        self.made += 1
        if self.made > MOST:
            raise yaml.MarkedYAMLError(problem=f"more than {MOST} values", problem_mark=self.get_mark())
        return super().compose_node(parent, index)

    def construct_object(self, node: Any, deep: bool = False) -> Any:
        """Make the value of a node; what is wrong with one is told with its line."""
        try:
            return super().construct_object(node, deep)
        # 2026-13-45, .e999, a list as a key; !!float "", !!bool x, !!timestamp 1
        except (ValueError, OverflowError, TypeError, LookupError, AttributeError) as error:
            text = repr(node.value[:60]) if isinstance(node.value, str) else "what is here"
            what = f"{text} is no {node.tag.rpartition(':')[2]}"
            raise yaml.MarkedYAMLError(problem=f"{what}: {error}", problem_mark=node.start_mark) from error

    def construct_yaml_int(self, node: Any) -> Any:
        """Make a whole number of a text."""
        if len(node.value) > LONGEST_NUMBER:
            raise yaml.MarkedYAMLError(problem="a number of too many digits", problem_mark=node.start_mark)
        return super().construct_yaml_int(node)


Loader.add_constructor("tag:yaml.org,2002:int", Loader.construct_yaml_int)


def documents(
    text: str, source: str, failure: Failure, loader: type[Loader] = Loader
) -> Iterator[tuple[Any, yaml.Node]]:
    """The documents in a text, as values and as nodes. Raises what `failure` makes, with `source` and a line."""
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
        raise failure(
            "this is not YAML: its lists and mappings are nested too deeply", source, None
        ) from error
    finally:
        if reading is not None:
            reading.dispose()


def line_of(node: yaml.Node | None) -> int | None:
    """Where a node begins, counted from 1."""
    return None if node is None or node.start_mark is None else node.start_mark.line + 1


def children(node: yaml.Node) -> Iterator[tuple[str, yaml.Node, yaml.Node]]:
    """How each value in a node is reached (``/key``, ``[0]``), where that is written, and its node."""
    if isinstance(node, yaml.MappingNode):
        for key, value in node.value:
            yield f"/{key.value if isinstance(key, yaml.ScalarNode) else '?'}", key, value
    elif isinstance(node, yaml.SequenceNode):
        for number, value in enumerate(node.value):
            yield f"[{number}]", value, value


def _no_yaml(
    error: yaml.MarkedYAMLError | yaml.reader.ReaderError, source: str, failure: Failure
) -> Exception:
    if isinstance(error, yaml.MarkedYAMLError):
        mark = error.problem_mark or error.context_mark
        text = ", ".join(part for part in (error.context, error.problem) if part)
        hint = " (indent with spaces, not with tabs)" if "'\\t'" in text else ""
        return failure(f"this is not YAML: {text}{hint}", source, None if mark is None else mark.line + 1)
    return failure(f"this is not YAML: {error.reason}, at character {error.position}", source, None)


def _refuse_endless(node: yaml.Node, source: str, failure: Failure) -> None:
    """Refuse a document that holds itself, or that grows out of all bounds through its aliases."""
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

    if size(node) > MOST:
        raise failure(
            f"this document has {size(node)} values with its aliases; {MOST} are allowed",
            source,
            line_of(node),
        )
