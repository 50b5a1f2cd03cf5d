"""Calls of XML-RPC with a socket and expat alone, for programs that ask two questions and end.

:mod:`xmlrpc.client` brings :mod:`http.client`, which brings ``ssl`` and ``email``: to import them takes a third of the
time in which ``rosparam list`` starts, asks and ends. Requests are HTTP/1.0, so that answers come in one part.
"""

from __future__ import annotations

import socket
from binascii import a2b_base64, b2a_base64
from collections.abc import Callable
from typing import TYPE_CHECKING, Any
from urllib.parse import urlsplit
from xml.parsers import expat

from rosmini.errors import TransportException

if TYPE_CHECKING:
    from datetime import datetime

DEEPEST = 100
"""How many elements of an answer may be inside one another."""

LONGEST_HEAD = 64 * 1024
_PIECE = 65536
_TIME = "%Y%m%dT%H:%M:%S"
_MOST, _LEAST = 2**31 - 1, -(2**31)
_ESCAPES = str.maketrans({"&": "&amp;", "<": "&lt;", ">": "&gt;"})


class RefusedAnswer(TransportException):
    """The answer is not one that a ROS program gives."""


# ---- values as text --------------------------------------------------------------------------------------------------


def _written(value: Any) -> str:
    """Return a value as XML. Raises ``TypeError`` and ``OverflowError``, as :func:`xmlrpc.client.dumps` does."""
    if isinstance(value, bool):
        return f"<value><boolean>{int(value)}</boolean></value>"
    if isinstance(value, int):
        if not _LEAST <= value <= _MOST:
            raise OverflowError("int exceeds XML-RPC limits")
        return f"<value><int>{value}</int></value>"
    if isinstance(value, float):
        return f"<value><double>{value!r}</double></value>"
    if isinstance(value, str):
        return f"<value><string>{value.translate(_ESCAPES)}</string></value>"
    if isinstance(value, bytes | bytearray):
        return f"<value><base64>\n{b2a_base64(value).decode()}</base64></value>"
    if isinstance(value, list | tuple):
        return f"<value><array><data>{''.join(map(_written, value))}</data></array></value>"
    if hasattr(value, "strftime"):  # a datetime, whose module takes its time to import
        return f"<value><dateTime.iso8601>{value.strftime(_TIME)}</dateTime.iso8601></value>"
    if isinstance(value, dict):
        return f"<value><struct>{''.join(_member(*item) for item in value.items())}</struct></value>"
    raise TypeError(f"cannot marshal {type(value)} objects")


def _member(name: object, value: Any) -> str:
    if not isinstance(name, str):
        raise TypeError("dictionary key must be string")
    return f"<member><name>{name.translate(_ESCAPES)}</name>{_written(value)}</member>"


def encode_call(method: str, arguments: tuple[Any, ...]) -> bytes:
    """Return the document of a call. Raises ``TypeError`` and ``OverflowError`` for what XML-RPC does not have."""
    params = "".join(f"<param>{_written(each)}</param>" for each in arguments)
    return (
        f"<?xml version='1.0'?>\n<methodCall><methodName>{method}</methodName><params>{params}</params></methodCall>\n"
    ).encode()


# ---- text as values --------------------------------------------------------------------------------------------------


def _time(text: str) -> datetime:
    from datetime import datetime

    return datetime.strptime(text.strip(), _TIME)


def _boolean(text: str) -> bool:
    return {"0": False, "1": True}[text.strip()]


_SCALARS: dict[str, Callable[[str], Any]] = {
    **dict.fromkeys(("int", "i1", "i2", "i4", "i8", "i16", "biginteger"), int),
    **dict.fromkeys(("double", "float"), float),
    **dict.fromkeys(("string", "name"), str),
    "dateTime.iso8601": _time,
    "boolean": _boolean,
    "base64": a2b_base64,
    "nil": lambda _: None,
}


class _Reader:
    """Makes values of a document, by the calls of an expat parser."""

    def __init__(self) -> None:
        self.values: list[Any] = []
        self.is_fault = False
        self._marks: list[int] = []
        self._text: list[str] = []
        self._is_bare = False
        """Whether nothing but text has come since the last ``<value>``, which makes it a string."""
        self._depth = 0

    def parser(self) -> Any:
        """Return the parser; document types, and with them entities that grow without bounds, are refused."""
        made = expat.ParserCreate()
        made.StartElementHandler, made.EndElementHandler = self._start, self._end
        made.CharacterDataHandler = self._text.append
        made.StartDoctypeDeclHandler = made.EntityDeclHandler = self._refuse
        return made

    @staticmethod
    def _refuse(*_declaration: object) -> None:
        raise RefusedAnswer("the answer declares a document type or an entity, which XML-RPC does not have")

    def _start(self, tag: str, _attributes: object) -> None:
        self._depth += 1
        if self._depth > DEEPEST:
            raise RefusedAnswer(f"the answer has more than {DEEPEST} levels of elements")
        if tag in ("array", "struct"):
            self._marks.append(len(self.values))
        self._text.clear()
        self._is_bare = tag == "value"

    def _end(self, tag: str) -> None:
        self._depth -= 1
        if tag in _SCALARS:
            self.values.append(_SCALARS[tag]("".join(self._text)))
        elif tag == "value" and self._is_bare:
            self.values.append("".join(self._text))
        elif tag == "array":
            mark = self._marks.pop()
            self.values[mark:] = [self.values[mark:]]
        elif tag == "struct":
            mark = self._marks.pop()
            flat = self.values[mark:]
            self.values[mark:] = [dict(zip(flat[::2], flat[1::2], strict=True))]
        elif tag == "fault":
            self.is_fault = True
        self._is_bare = False


def decode_answer(document: bytes) -> Any:
    """Return the value of an answer. Raises ``RefusedAnswer``; its text says what is wrong with the answer."""
    reader = _Reader()
    try:
        reader.parser().Parse(document, True)
    except (expat.ExpatError, ValueError, LookupError, TypeError) as error:
        raise RefusedAnswer(
            f"{type(error).__name__}: {error}" if isinstance(error, LookupError) else str(error)
        ) from error
    if len(reader.values) != 1:
        raise RefusedAnswer("the answer holds no value")
    if reader.is_fault:
        fault = reader.values[0]
        raise RefusedAnswer(fault.get("faultString", str(fault)) if isinstance(fault, dict) else str(fault))
    return reader.values[0]


# ---- the way there ---------------------------------------------------------------------------------------------------


def post(uri: str, body: bytes, timeout: float, longest: int) -> bytes:
    """Post a document and return what is answered.

    Args:
        uri: ``http://host:port/``.
        body: the document.
        timeout: how long the peer may be silent [s].
        longest: how many bytes the answer may have.

    Raises ``OSError`` where nobody answers, ``ValueError`` for what is no address, and ``RefusedAnswer``.

    """
    parts = urlsplit(uri)
    if parts.scheme != "http" or not parts.hostname:
        raise ValueError("an address begins with http:// and names a host")
    head = (
        f"POST {parts.path or '/'} HTTP/1.0\r\nHost: {parts.netloc}\r\nUser-Agent: rosmini\r\n"
        f"Content-Type: text/xml\r\nContent-Length: {len(body)}\r\n\r\n"
    )
    with socket.create_connection((parts.hostname, parts.port or 80), timeout=timeout) as wire:
        wire.sendall(head.encode() + body)
        with wire.makefile("rb") as incoming:
            return _body(incoming, _length(incoming, longest), longest)


def _length(incoming: Any, longest: int) -> int | None:
    """Read the head of an answer; return how long its body is, or None if that is not said."""
    status = incoming.readline(LONGEST_HEAD)
    words = status.split(None, 2)
    if len(words) < 2 or not words[0].startswith(b"HTTP/"):
        raise RefusedAnswer(
            f"{status[:60]!r} is no answer of an HTTP server" if status else "the connection was closed"
        )
    if words[1] != b"200":
        raise RefusedAnswer(f"it answered with HTTP status {words[1][:20].decode(errors='replace')}")
    length, size = None, 0
    while (line := incoming.readline(LONGEST_HEAD)).strip():
        size += len(line)
        if size > LONGEST_HEAD:
            raise RefusedAnswer("the head of the answer does not end")
        name, _, value = line.partition(b":")
        if name.strip().lower() == b"content-length":
            length = int(value)
    if length is not None and length > longest:
        raise RefusedAnswer(f"the answer has more than {longest:,} bytes")
    return length


def _body(incoming: Any, length: int | None, longest: int) -> bytes:
    """Read the body of an answer, all that comes where its length is not said."""
    limit = longest + 1 if length is None else length
    pieces, size = [], 0
    while size < limit and (data := incoming.read(min(_PIECE, limit - size))):
        pieces.append(data)
        size += len(data)
    if size > longest:
        raise RefusedAnswer(f"the answer has more than {longest:,} bytes")
    if length is not None and size < length:
        raise RefusedAnswer(f"the answer ended after {size} of {length} bytes")
    return b"".join(pieces)
