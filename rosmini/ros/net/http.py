"""Complete HTTP messages over asyncio's streams, parsed by h11, for XML-RPC servers and clients."""

from __future__ import annotations

import asyncio
from collections.abc import Awaitable, Callable

import h11

from rosmini.core.errors import TransportException

HEAD_LIMIT = 64 * 1024
"""Maximum length of the start line with header fields [bytes]."""

BODY_LIMIT = 64 * 1024 * 1024
"""Maximum length of a document [bytes]; a world map as a parameter still fits."""

CHUNK = 64 * 1024


async def read_message(
    connection: h11.Connection,
    reader: asyncio.StreamReader,
    writer: asyncio.StreamWriter,
    feed: Callable[[bytes], object],
    check: Callable[[h11.Request], Awaitable[None]] | None = None,
) -> h11.Request | h11.Response | None:
    """Return the next message; None if the peer closed the connection before it began.

    Its body goes to ``feed`` in chunks, between which other tasks of the loop run. If ``check`` raises
    an error for a request, its body is read and discarded before the error is raised: a client that is still sending
    when the connection is closed would not get the answer.

    Raises ``TransportException`` for a body over the limit, and ``h11.RemoteProtocolError`` for invalid HTTP.
    """
    head: h11.Request | h11.Response | None = None
    refusal: TransportException | None = None
    length = 0
    while True:
        event = connection.next_event()
        if event is h11.NEED_DATA:
            if connection.they_are_waiting_for_100_continue:
                go_on = connection.send(h11.InformationalResponse(status_code=100, headers=[]))
                writer.write(go_on or b"")
            data = await reader.read(CHUNK)
            if not data and head is None and not connection.trailing_data[0]:
                return None
            connection.receive_data(data)
        elif isinstance(event, h11.Request | h11.Response):
            head = event
            _check(next((int(value) for key, value in event.headers if key == b"content-length"), 0))
            if check is not None and isinstance(event, h11.Request):
                try:
                    await check(event)
                except TransportException as error:
                    refusal = error
        elif isinstance(event, h11.Data):
            if length:
                await asyncio.sleep(0)
            length += len(event.data)
            _check(length)
            if refusal is None:
                feed(event.data)
        elif isinstance(event, h11.EndOfMessage) and head is not None:
            if refusal is not None:
                raise refusal
            return head
        elif isinstance(event, h11.ConnectionClosed) or event is h11.PAUSED:
            return None


def _check(length: int) -> None:
    if length > BODY_LIMIT:
        msg = f"a document of {length} bytes is too long: at most {BODY_LIMIT} are taken"
        raise TransportException(msg)


def write_message(
    connection: h11.Connection, writer: asyncio.StreamWriter, head: h11.Request | h11.Response, body: bytes
) -> None:
    """Write a message whose head contains the length of the body."""
    parts = [connection.send(head), connection.send(h11.Data(data=body)), connection.send(h11.EndOfMessage())]
    writer.write(b"".join(part for part in parts if part))
