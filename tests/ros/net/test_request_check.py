"""Which requests a server of XML-RPC answers: none that a browser sends for a web page."""

from __future__ import annotations

import asyncio
import socket
from concurrent.futures import ThreadPoolExecutor

import h11
import pytest

from rosmini.ros.net import request_check
from rosmini.ros.net.addresses import addresses
from rosmini.ros.net.request_check import Refused, RequestCheck

OURS = {"Host": "localhost:11311", "Content-Type": "text/xml"}


@pytest.fixture(autouse=True)
def named(monkeypatch: pytest.MonkeyPatch) -> None:
    """A machine with a host name and a full name."""

    async def full_name() -> str:
        return "Robot.Lab.Example."

    monkeypatch.setattr(socket, "gethostname", lambda: "Robot")
    monkeypatch.setattr(request_check, "full_name", full_name)


def refused(method: str = "POST", version: str = "1.1", **headers: str | None) -> int:
    """The status with which a request is refused; 200 if it is not. A header that is None is left out."""
    fields = OURS | {name.replace("_", "-"): value for name, value in headers.items()}
    request = h11.Request(
        method=method,
        target="/RPC2",
        headers=[(name, value.encode("latin-1")) for name, value in fields.items() if value is not None],
        http_version=version,
    )
    known = addresses({"ROS_HOSTNAME": "robot-of-mine", "ROS_IP": "192.0.2.7"}).names
    try:
        # A worker that has driven a browser has a running loop in this thread.
        with ThreadPoolExecutor(1) as pool:
            pool.submit(asyncio.run, RequestCheck(known).check(request)).result()
    except Refused as error:
        return error.status
    return 200


OWN_HOSTS = [
    "localhost", "LocalHost.", "127.0.0.1", "127.0.1.1:11311", "[::1]:11311", "::1:11311", "robot", "ROBOT:11311",
    "robot.local", "robot.lab.example:80", "robot-of-mine:11311", "192.0.2.7:11311", "0.0.0.0:11311",
]  # fmt: skip
OTHER_HOSTS = [
    "", "evil.example", "evil.example:11311", "localhost.evil.example", "127.0.0.1.evil.example",
    "robot.evil.example", "evil.example#localhost", "user@localhost", "192.0.2.8", "[::1.evil.example]",
    "[2001:db8::1]:11311", "\u00b2",
]  # fmt: skip
"""A page of such a host may be from anywhere: its owner's DNS server says which address the name has."""

OTHER_TYPES = [
    None, "", "text/plain", "text/plain; text/xml", "application/x-www-form-urlencoded", "text/xmlx",
]  # fmt: skip


@pytest.mark.parametrize(
    ("field", "values", "status"),
    [
        ("Host", OWN_HOSTS, 200),
        ("Host", OTHER_HOSTS, 403),
        ("Origin", ["http://evil.example", "null", "http://localhost:11311", ""], 403),
        ("Content_Type", ["text/xml", "text/xml; charset=utf-8", "Text/XML;charset=UTF-8"], 200),
        ("Content_Type", OTHER_TYPES, 415),
    ],
)
def test_a_request_is_judged_by_its_fields(field: str, values: list[str | None], status: int) -> None:
    found = {value: refused(**{field: value}) for value in values}
    assert found == dict.fromkeys(values, status)


@pytest.mark.parametrize("method", ["GET", "HEAD", "OPTIONS", "PUT"])
def test_other_methods_are_refused(method: str) -> None:
    assert refused(method) == 405


def test_a_client_of_http_1_0_need_not_name_a_host() -> None:
    assert refused(version="1.0", Host=None) == 200
    assert refused(version="1.0", Host="evil.example") == 403


def test_a_name_service_that_does_not_answer_is_given_up(monkeypatch: pytest.MonkeyPatch) -> None:
    async def full_name() -> str:
        await asyncio.Event().wait()
        return ""

    monkeypatch.setattr(request_check, "full_name", full_name)
    monkeypatch.setattr(request_check, "NAME_S", 0.01)
    assert refused(Host="evil.example") == 403
