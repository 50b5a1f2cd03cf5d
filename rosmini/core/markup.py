"""XML as a tree with line numbers, from which URDF, SDF and launch files are read.

All errors in such a file have the form ``file:line: text``; `Element.error` makes such an error for code
that interprets the tree. Files may be hostile: defusedxml refuses entities, which can expand to gigabytes
or read other files, and trees nested deeper than any robot needs are refused too.
"""

from __future__ import annotations

import io
import math
import re
import xml.sax
import xml.sax.handler
from collections.abc import Iterator
from dataclasses import dataclass, field
from os import PathLike, fspath
from typing import Any
from xml.sax.saxutils import escape, quoteattr
from xml.sax.xmlreader import AttributesImpl, Locator

from rosmini.core.errors import DefinitionError, nearest, shown
from rosmini.core.files import read

MAX_LENGTH_M = 1e9
"""Maximum of a length [m] or an angle; larger ones are mistakes and cause overflows."""

MAX_MASS_KG = 1e15
"""Maximum of a mass [kg] or an inertia."""

MAX_DEPTH = 200
"""Maximum nesting depth of elements."""

NO_PATH = "<text>"


class MarkupError(DefinitionError):
    """An XML file is broken, or has invalid contents, at ``file``, line ``line``."""


@dataclass(eq=False)
class Element:
    """An element: its tag, attributes, text and child elements, with file and line."""

    tag: str
    attributes: dict[str, str] = field(default_factory=dict)
    text: str = ""
    """The text between the children, joined, and without white space at its ends."""
    children: list[Element] = field(default_factory=list)
    line: int = 0
    """Counted from 1."""
    path: str = NO_PATH
    failure: type[MarkupError] = MarkupError
    """The class of the errors that `error` makes."""
    written: str = ""
    """The text with all its white space, which is significant in YAML."""

    def __repr__(self) -> str:
        return f"<{self.tag}> at {self.path}:{self.line}"

    def __iter__(self) -> Iterator[Element]:
        return iter(self.children)

    def error(self, message: str) -> MarkupError:
        """Return an error at this element, to be raised."""
        return self.failure(message, self.path, self.line)

    # ---- child elements ----

    def all(self, *tags: str) -> list[Element]:
        """Return the children with one of these tags, in order."""
        return [child for child in self.children if child.tag in tags]

    def find(self, path: str) -> Element | None:
        """Return the element at a path of tags (``"inertial/mass"``), or None; at each level the first one counts."""
        at = self
        for tag in path.split("/"):
            found = next((child for child in at.children if child.tag == tag), None)
            if found is None:
                return None
            at = found
        return at

    def need(self, tag: str) -> Element:
        """Return the child with this tag. Raises `MarkupError` if there is none."""
        found = self.find(tag)
        if found is None:
            there = {child.tag for child in self.children}
            hint = nearest(tag, there)
            raise self.error(f"<{self.tag}> has no <{tag}>{f'; {hint}' if hint else ''}")
        return found

    def walk(self) -> Iterator[Element]:
        """Yield the element and all its descendants, in document order."""
        yield self
        for child in self.children:
            yield from child.walk()

    def word(self, path: str, default: str = "") -> str:
        """Return the text of the element that `find` returns, or `default` if it is missing or empty."""
        found = self.find(path)
        return (found.text if found is not None else "") or default

    # ---- attributes ----

    def get(self, name: str, default: str = "") -> str:
        """Return an attribute, or `default`."""
        return self.attributes.get(name, default)

    def attribute(self, name: str) -> str:
        """Return a required attribute. Raises `MarkupError` if it is missing or empty."""
        value = self.attributes.get(name, "").strip()
        if not value:
            hint = nearest(name, self.attributes)
            missing = "is empty in" if name in self.attributes else "is missing in"
            raise self.error(f'{name}="..." {missing} <{self.tag}>{f"; {hint}" if hint else ""}')
        return value

    def number(self, name: str, default: float | None = None, *, most: float = math.inf) -> float:
        """Return a number from an attribute, or `default` if it is missing.

        Raises `MarkupError` unless there is a default or a finite number, of at most `most` in absolute value.
        """
        if default is not None and name not in self.attributes:
            return default
        return self.floats(self.attribute(name), 1, name, most=most)[0]

    def numbers(
        self, name: str, count: int, default: tuple[float, ...] | None = None, *, most: float = math.inf
    ) -> tuple[float, ...]:
        """Return `count` numbers from an attribute, or `default` if it is missing. Raises `MarkupError` as `number`."""
        if default is not None and name not in self.attributes:
            return default
        return self.floats(self.attribute(name), count, name, most=most)

    def floats(
        self, text: str, count: int | None = None, what: str = "", *, most: float = math.inf
    ) -> tuple[float, ...]:
        """Return the numbers in a text of this element: `count` of them, or any number if `count` is None.

        Raises `MarkupError` unless all are finite and at most `most` in absolute value. The message calls the text
        `what`, by default the tag.
        """
        name = what or f"<{self.tag}>"
        words = text.split()
        if count is not None and len(words) != count:
            raise self.error(f"{name} takes {_plural(count, 'number')}, not {len(words)}: {shown(text.strip())}")
        values = []
        for word in words:
            try:
                value = float(word)
            except ValueError:
                raise self.error(f"{shown(word)} in {name} of <{self.tag}> is not a number") from None
            if not math.isfinite(value):
                raise self.error(f"{shown(word)} in {name} of <{self.tag}> is not finite")
            if abs(value) > most:
                raise self.error(f"{shown(word)} in {name} of <{self.tag}> is too large: {most:g} is allowed")
            values.append(value)
        return tuple(values)

    def flag(self, text: str, what: str = "") -> bool:
        """Return the boolean in a text of this element: true or false in any case, or 1 or 0.

        Raises `MarkupError` for any other text. The message calls the text `what`, by default the tag.
        """
        value = {"true": True, "1": True, "false": False, "0": False}.get(text.strip().lower())
        if value is None:
            raise self.error(f"{what or f'<{self.tag}>'} is true or false, not {shown(text.strip())}")
        return value

    # ---- serialisation ----

    def source(self, indent: str = "") -> str:
        """Return the element as XML, with the same tags, attributes and texts, but without white space and comments."""
        head = f"{indent}<{self.tag}" + "".join(f" {k}={quoteattr(v)}" for k, v in self.attributes.items())
        if not self.children:
            return f"{head}>{escape(self.text)}</{self.tag}>" if self.text else f"{head}/>"
        inside = [f"{indent}  {escape(self.text)}"] if self.text else []
        inside += [child.source(indent + "  ") for child in self.children]
        return "\n".join([head + ">", *inside, f"{indent}</{self.tag}>"])


def parse(
    text: str | bytes,
    path: str | PathLike[str] = NO_PATH,
    failure: type[MarkupError] = MarkupError,
    *,
    late_declaration: bool = False,
) -> Element:
    """Return the root element of an XML text; `path` appears in errors.

    With `late_declaration`, comments and blank lines may precede `<?xml ...?>`, as in TinyXML, which Gazebo uses.

    Raises `MarkupError`, or its subclass `failure`, for a text that is not XML, defines entities, or is nested
    deeper than `MAX_DEPTH`; `Element.error` of all elements makes errors of that class too.
    """
    from defusedxml.common import DefusedXmlException
    from defusedxml.sax import make_parser

    name = fspath(path)
    builder = _Builder(name, failure)
    parser = make_parser()
    parser.setContentHandler(builder)
    source = xml.sax.xmlreader.InputSource(name)
    if isinstance(text, str):
        # A str is already decoded: ignore the encoding in its declaration.
        text = text.encode("utf-8", "surrogatepass")
        source.setEncoding("utf-8")
    if late_declaration:
        text = _LATE_DECLARATION.sub(lambda found: found[1] + b" " * len(found[2]), text, count=1)
    source.setByteStream(io.BytesIO(text))
    try:
        parser.parse(source)
    except xml.sax.SAXParseException as error:
        line, column = error.getLineNumber() or 1, error.getColumnNumber() or 0
        raise failure(_reason(error.getMessage(), column, text, builder), name, line) from error
    except DefusedXmlException as error:
        what = "may not define or use entities: they can make a small file huge, or read other files"
        raise failure(f"an XML file from outside {what}", name, builder.place()) from error
    except (LookupError, ValueError) as error:  # an unknown encoding
        raise failure(f"this is not XML: {error}", name, 1) from error
    return builder.root


_LATE_DECLARATION = re.compile(rb"\A((?:\xef\xbb\xbf)?\s*(?:<!--(?:(?!-->)[\s\S])*-->\s*)*)(<\?xml\s[^<>]*\?>)")


def parse_file(
    path: str | PathLike[str], failure: type[MarkupError] = MarkupError, *, late_declaration: bool = False
) -> Element:
    """Return the root element of an XML file. Raises `failure` as `parse` does, and if the file cannot be read."""
    try:
        text = read(path)
    except OSError as error:
        raise failure(f"cannot be read: {error.strerror}", fspath(path)) from error
    return parse(text, path, failure, late_declaration=late_declaration)


class _Builder(xml.sax.handler.ContentHandler):
    """Makes elements from the parser's events."""

    root: Element

    def __init__(self, path: str, failure: type[MarkupError]) -> None:
        super().__init__()
        self.path, self.failure = path, failure
        self.open: list[tuple[Element, list[str]]] = []
        self.locator: Locator | None = None

    def setDocumentLocator(self, locator: Any) -> None:
        self.locator = locator

    def place(self) -> int:
        return (self.locator.getLineNumber() if self.locator is not None else None) or 1

    def startElement(self, name: str, attrs: AttributesImpl) -> None:
        element = Element(name, dict(attrs.items()), "", [], self.place(), self.path, self.failure)
        if len(self.open) >= MAX_DEPTH:
            raise element.error(f"elements are nested deeper than {MAX_DEPTH}")
        if self.open:
            self.open[-1][0].children.append(element)
        else:
            self.root = element
        self.open.append((element, []))

    def endElement(self, name: str) -> None:  # noqa: ARG002
        element, texts = self.open.pop()
        element.written = "".join(texts)
        element.text = element.written.strip()

    def characters(self, content: str) -> None:
        if self.open:
            self.open[-1][1].append(content)


def _reason(message: str, column: int, text: bytes, builder: _Builder) -> str:
    """Return an explanation of the parser's error `message`."""
    if not text.strip():
        return "this is empty, there is no XML in it"
    if message == "mismatched tag" and builder.open:
        inner = builder.open[-1][0]
        return f"this closes another element than <{inner.tag}>, which was opened in line {inner.line}"
    if message == "no element found" and builder.open:
        inner = builder.open[-1][0]
        return f"the file ends, but <{inner.tag}> of line {inner.line} is still open"
    if "declaration not at start" in message:
        return "<?xml ...?> must be the very first thing in the file: nothing may precede it, not even a blank line"
    return f"this is not XML: {message} at column {column + 1}"


def _plural(count: int, noun: str) -> str:
    return f"{count} {noun}{'' if count == 1 else 's'}"
