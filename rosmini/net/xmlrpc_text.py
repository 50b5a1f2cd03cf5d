"""XML-RPC documents: calls and answers as text, parsed so that no document takes more memory than it is long.

See http://wiki.ros.org/ROS/Master_API and http://xmlrpc.com/spec.md.
"""

from __future__ import annotations

import re
import xmlrpc.client
from typing import Any, cast

from defusedxml.common import DefusedXmlException
from defusedxml.xmlrpc import DefusedExpatParser

from rosmini.errors import TransportException

NOT_XML = re.compile("[\x00-\x08\x0b\x0c\x0e-\x1f\ufffe\uffff\ud800-\udfff]")
"""Characters that no XML document can hold."""


DEEPEST = 100
"""How many elements of a document may be inside one another: three for a level of a list, five for one of a struct."""


class XmlRpcFault(TransportException):
    """The peer answered that the call went wrong there."""

    def __init__(self, code: int, text: str) -> None:
        super().__init__(f"the call went wrong there: {text}")
        self.code = code
        self.text = text


class _Values(xmlrpc.client.Unmarshaller):
    """Makes values of a document; what is nested so deeply that no caller could go through it is refused."""

    def __init__(self) -> None:
        super().__init__(use_builtin_types=True)
        self._depth = 0

    def start(self, tag: str, attrs: Any) -> None:
        """Begin an element."""
        self._depth += 1
        if self._depth > DEEPEST:
            raise TransportException(f"the document has more than {DEEPEST} levels of elements")
        super().start(tag, attrs)

    def end(self, tag: str) -> None:
        """End an element."""
        self._depth -= 1
        super().end(tag)


def _document(text: str) -> bytes:
    found = NOT_XML.search(text)
    if found is not None:
        msg = f"a text holds the character {found.group()!r}, which XML cannot hold; send it as bytes"
        raise TransportException(msg)
    return text.encode()


def encode_call(method: str, arguments: tuple[Any, ...]) -> bytes:
    """Return the document of a call. Raises ``TransportException`` for a value that XML-RPC does not have."""
    try:
        return _document(xmlrpc.client.dumps(arguments, method))
    except (TypeError, OverflowError, RecursionError) as error:
        raise TransportException(f"{method} cannot be called with these values: {error}") from error


def encode_answer(value: Any) -> bytes:
    """Return the document of an answer. Raises ``TransportException`` for a value that XML-RPC does not have."""
    try:
        return _document(xmlrpc.client.dumps((value,), methodresponse=True))
    except (TypeError, OverflowError, RecursionError) as error:
        raise TransportException(f"the answer cannot be written as XML-RPC: {error}") from error


def encode_fault(code: int, text: str) -> bytes:
    """Return the document that says that a call went wrong."""
    return _document(xmlrpc.client.dumps(xmlrpc.client.Fault(code, NOT_XML.sub("?", text))))


def decode(document: bytes) -> tuple[tuple[Any, ...], str | None]:
    """Return the values of a document, and the method's name if it is a call.

    Raises :class:`XmlRpcFault` for an answer that says so, and ``TransportException`` for what is no XML-RPC.
    """
    target = _Values()
    parser = DefusedExpatParser(target, forbid_dtd=True)
    try:
        parser.feed(document)
        parser.close()
        return cast("tuple[Any, ...]", target.close()), target.getmethodname()
    except xmlrpc.client.Fault as fault:
        raise XmlRpcFault(fault.faultCode, fault.faultString) from None
    except DefusedXmlException as error:
        raise TransportException(
            "the XML declares a document type, as web pages do, or entities, as an XML bomb does"
        ) from error
    except TransportException:
        raise
    except Exception as error:  # the parser lets out ExpatError, ValueError, IndexError, KeyError ...
        raise TransportException(f"the document is no XML-RPC: {type(error).__name__}: {error}") from error
