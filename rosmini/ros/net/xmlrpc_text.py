"""XML-RPC documents: calls and answers as text. Parsing needs memory in proportion to the length.

See http://wiki.ros.org/ROS/Master_API and http://xmlrpc.com/spec.md.
"""

from __future__ import annotations

import re
import xmlrpc.client
from typing import Any, cast

from defusedxml.common import DefusedXmlException
from defusedxml.xmlrpc import DefusedExpatParser

from rosmini.core.errors import TransportException

NOT_XML = re.compile("[\x00-\x08\x0b\x0c\x0e-\x1f\ufffe\uffff\ud800-\udfff]")
"""Characters that an XML document cannot contain."""

ANSWER_HEAD = b"<?xml version='1.0'?>\n<methodResponse>\n<params>\n<param>\n"
ANSWER_TAIL = b"</param>\n</params>\n</methodResponse>\n"
PARAMS_HEAD, PARAMS_TAIL = "<params>\n<param>\n", "</param>\n</params>\n"
"""Text that Python's own encoder writes around a value."""
LIST_HEAD, LIST_TAIL = b"<value><array><data>\n", b"</data></array></value>\n"

MAX_DEPTH = 100
"""Maximum nesting of a document's elements: three per level of a list, five per level of a struct."""


class XmlRpcFault(TransportException):
    """The peer answered with a fault."""

    def __init__(self, code: int, text: str) -> None:
        super().__init__(f"the call went wrong there: {text}")
        self.code = code
        self.text = text


class _Values(xmlrpc.client.Unmarshaller):
    """Decodes the values of a document; refuses nesting too deep for callers to traverse."""

    def __init__(self) -> None:
        super().__init__(use_builtin_types=True)
        self._depth = 0

    def start(self, tag: str, attrs: Any) -> None:
        """Handle the start of an element."""
        self._depth += 1
        if self._depth > MAX_DEPTH:
            raise TransportException(f"the document has more than {MAX_DEPTH} levels of elements")
        super().start(tag, attrs)

    def end(self, tag: str) -> None:
        """Handle the end of an element."""
        self._depth -= 1
        super().end(tag)


class _Parser(DefusedExpatParser):
    """Passes on text in large pieces; one for each line and entity would take nine times the memory."""

    def __init__(self, target: _Values, *, forbid_dtd: bool) -> None:
        super().__init__(target, forbid_dtd=forbid_dtd)
        self._parser.buffer_text = True  # type: ignore[attr-defined]  # the parser of expat


def _document(text: str) -> bytes:
    found = NOT_XML.search(text)
    if found is not None:
        msg = f"a text holds the character {found.group()!r}, which XML cannot hold; send it as bytes"
        raise TransportException(msg)
    return text.encode()


def encode_call(method: str, arguments: tuple[Any, ...]) -> bytes:
    """Return the document of a call. Raises ``TransportException`` for a value that XML-RPC cannot represent."""
    try:
        return _document(xmlrpc.client.dumps(arguments, method))
    except (TypeError, OverflowError, RecursionError) as error:
        raise TransportException(f"{method} cannot be called with these values: {error}") from error


def encode_answer(value: Any) -> bytes:
    """Return the document of an answer. Raises ``TransportException`` for a value that XML-RPC cannot represent."""
    return b"".join((ANSWER_HEAD, encode_value(value), ANSWER_TAIL))


def encode_answers(values: list[bytes]) -> bytes:
    """Return the document of an answer that is a list of elements encoded by :func:`encode_value`."""
    return b"".join((ANSWER_HEAD, LIST_HEAD, *values, LIST_TAIL, ANSWER_TAIL))


def encode_value(value: Any) -> bytes:
    """Return the element of a value. Raises ``TransportException`` for a value that XML-RPC cannot represent."""
    try:
        document = xmlrpc.client.dumps((value,))
    except (TypeError, OverflowError, RecursionError) as error:
        raise TransportException(f"the answer cannot be written as XML-RPC: {error}") from error
    return _document(document.removeprefix(PARAMS_HEAD).removesuffix(PARAMS_TAIL))


def encode_fault(code: int, text: str) -> bytes:
    """Return the document of a fault."""
    return _document(xmlrpc.client.dumps(xmlrpc.client.Fault(code, NOT_XML.sub("?", text))))


def decode(document: bytes) -> tuple[tuple[Any, ...], str | None]:
    """Return the values of a document, and the method's name if it is a call.

    Raises :class:`XmlRpcFault` for a fault, and ``TransportException`` for a document that is not XML-RPC.
    """
    parsed = Document()
    parsed.feed(document)
    return parsed.close()


class Document:
    """A document that arrives in chunks."""

    def __init__(self) -> None:
        self._values = _Values()
        self._parser = _Parser(self._values, forbid_dtd=True)
        self._error: Exception | None = None

    def feed(self, chunk: bytes) -> None:
        """Parse the next chunk; an error is raised by :meth:`close`, and further chunks are ignored."""
        if self._error is None:
            try:
                self._parser.feed(chunk)
            except Exception as error:  # the parser raises ExpatError, ValueError, IndexError, KeyError ...
                self._error = error

    def close(self) -> tuple[tuple[Any, ...], str | None]:
        """Return the result of :func:`decode` for the whole document, or raise its errors."""
        try:
            if self._error is not None:
                raise self._error
            self._parser.close()
            return cast("tuple[Any, ...]", self._values.close()), self._values.getmethodname()
        except xmlrpc.client.Fault as fault:
            raise XmlRpcFault(fault.faultCode, fault.faultString) from None
        except DefusedXmlException as error:
            raise TransportException(
                "the XML declares a document type, as web pages do, or entities, as an XML bomb does"
            ) from error
        except TransportException:
            raise
        except Exception as error:
            raise TransportException(f"the document is not XML-RPC: {type(error).__name__}: {error}") from error
