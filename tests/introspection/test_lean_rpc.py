"""XML-RPC by socket and expat: the same documents as the standard library's, and answers that are none."""

from __future__ import annotations

import os
import socket
import sys
import threading
import xmlrpc.client
from collections.abc import Iterator
from contextlib import contextmanager
from datetime import datetime
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rosmini.introspection.lean_rpc import DEEPEST, RefusedAnswer, decode_answer, encode_call, post

from ..processes import run

PRINTED = st.text(st.characters(exclude_categories=["Cs", "Cc"]))
SCALARS = st.one_of(
    st.booleans(),
    st.integers(-(2**31), 2**31 - 1),
    st.floats(allow_nan=False),
    PRINTED.filter(lambda text: "\ufffe" not in text and "\uffff" not in text),
    st.binary(max_size=200),
    st.datetimes(datetime(1000, 1, 1)).map(lambda when: when.replace(microsecond=0)),
)
VALUES = st.recursive(
    SCALARS,
    lambda inner: (
        st.lists(inner, max_size=4) | st.dictionaries(st.text("ab&<>", max_size=5), inner, max_size=4)
    ),
    max_leaves=12,
)


@given(st.lists(VALUES, max_size=3))
def test_a_call_is_read_as_it_was_written(values: list[Any]) -> None:
    assert xmlrpc.client.loads(encode_call("setParam", tuple(values)), use_builtin_types=True) == (
        tuple(values),
        "setParam",
    )


@given(VALUES)
def test_an_answer_is_read_as_the_standard_library_wrote_it(value: Any) -> None:
    read = decode_answer(xmlrpc.client.dumps((value,), methodresponse=True).encode())
    assert read == value
    assert type(read) is type(value)


def test_a_value_without_a_type_is_a_text() -> None:
    document = b"<methodResponse><params><param><value>a &lt; b</value></param></params></methodResponse>"
    assert decode_answer(document) == "a < b"
    assert decode_answer(document.replace(b"a &lt; b", b"")) == ""


@pytest.mark.parametrize(
    ("value", "error", "says"),
    [
        (2**31, OverflowError, "exceeds"),
        (None, TypeError, "NoneType"),
        ({1: 2}, TypeError, "key must be string"),
    ],
)
def test_what_xml_rpc_does_not_have(value: Any, error: type[Exception], says: str) -> None:
    with pytest.raises(error, match=says):
        encode_call("setParam", (value,))


@pytest.mark.parametrize(
    ("inside", "says"),
    [
        ("<int>five</int>", "invalid literal"),
        ("<boolean>2</boolean>", "KeyError"),
        ("<struct><member><name>a</name></member></struct>", "shorter"),
        ("<array><data>" * DEEPEST, "levels"),
        ("</int>", "mismatched"),
    ],
)
def test_an_answer_that_is_none_is_refused(inside: str, says: str) -> None:
    with pytest.raises(RefusedAnswer, match=says):
        decode_answer(
            f"<methodResponse><params><param><value>{inside}</value></param></params></methodResponse>".encode()
        )


@contextmanager
def saying(data: bytes) -> Iterator[str]:
    """A server that sends these bytes to whoever connects, and closes the connection."""
    with socket.create_server(("127.0.0.1", 0)) as server:

        def serve() -> None:
            connection, _ = server.accept()
            with connection:
                connection.recv(65536)
                connection.sendall(data)

        thread = threading.Thread(target=serve)
        thread.start()
        yield f"http://127.0.0.1:{server.getsockname()[1]}/"
        thread.join()


@pytest.mark.parametrize(
    ("data", "says"),
    [
        (b"", "connection was closed"),
        (b"SSH-2.0-OpenSSH\r\n", "no answer of an HTTP server"),
        (b"HTTP/1.1 404 Not Found\r\n\r\n", "HTTP status 404"),
        (b"HTTP/1.1 200 OK\r\nContent-Length: 40\r\n\r\nshort", "ended after 5 of 40 bytes"),
        (b"HTTP/1.1 200 OK\r\nContent-Length: 4000000000\r\n\r\n", "more than 50 bytes"),
        (b"HTTP/1.1 200 OK\r\n\r\n" + b"x" * 51, "more than 50 bytes"),
    ],
)
def test_a_server_that_speaks_something_else(data: bytes, says: str) -> None:
    with saying(data) as uri, pytest.raises(RefusedAnswer, match=says):
        post(uri, b"<methodCall/>", 5.0, 50)


def test_a_body_of_unsaid_length_is_read_to_its_end() -> None:
    with saying(b"HTTP/1.1 200 OK\r\n\r\nhello") as uri:
        assert post(uri, b"", 5.0, 50) == b"hello"


def test_a_tool_that_asks_imports_nothing_that_takes_long() -> None:
    heavy = "{'http.client', 'ssl', 'email', 'xmlrpc.client', 'numpy', 'yaml', 'asyncio'}"
    code = (
        "import sys; before = set(sys.modules); from rosmini.cli.main import main; main(['rosparam', 'list']); "
        f"print(sorted({heavy} & (set(sys.modules) - before)))"
    )
    done = run([sys.executable, "-c", code], env={**os.environ, "ROS_MASTER_URI": "http://127.0.0.1:1"})
    assert done.stdout == "[]\n"
