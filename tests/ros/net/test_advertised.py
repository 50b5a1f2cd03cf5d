"""The Master's word about nodes that others will not find."""

from __future__ import annotations

import asyncio
from concurrent.futures import ThreadPoolExecutor

import pytest

from rosmini.ros.net.master_server import MAX_WARNED, Advertised


def told(*registrations: tuple[str, str, str]) -> list[str]:
    """Return what is said of registrations: the address that each came from, the node, and where it says it is."""
    said: list[str] = []

    async def look() -> None:
        advertised = Advertised(said.append)
        for registration in registrations:
            advertised.look(*registration)
        await asyncio.gather(*asyncio.all_tasks() - {asyncio.current_task()})

    with ThreadPoolExecutor(1) as pool:  # this thread may have a loop that runs: a browser's
        pool.submit(lambda: asyncio.run(look())).result()
    return said


@pytest.mark.parametrize("host", ["localhost", "127.0.1.1", "[::1]"])
def test_loopback_of_another_machine_is_told_once_with_the_address_that_it_came_from(host: str) -> None:
    uri = f"http://{host}:4000/"
    (said,) = told(("10.0.0.5", "/talker", uri), ("10.0.0.5", "/talker", uri))
    assert f"/talker, on the machine at 10.0.0.5, advertises {uri}" in said
    assert "set ROS_IP=10.0.0.5" in said


def test_a_name_that_does_not_resolve_here_is_told() -> None:
    (said,) = told(("10.0.0.5", "/talker", "http://no-such-host.invalid:4000/"))
    assert "the name no-such-host.invalid does not resolve here" in said


@pytest.mark.parametrize(
    ("caller", "uri"),
    [
        ("127.0.0.1", "http://localhost:4000/"),
        ("10.0.0.5", "http://10.0.0.5:4000/"),
        ("10.0.0.5", "http://192.168.1.5:4000/"),
        ("10.0.0.5", "http://[::1"),
        ("10.0.0.5", ""),
    ],
)
def test_of_other_addresses_nothing_is_said(caller: str, uri: str) -> None:
    assert told((caller, "/talker", uri)) == []


def test_only_so_many_are_remembered() -> None:
    many = [("10.0.0.5", f"/talker{number}", "http://localhost:4000/") for number in range(MAX_WARNED + 5)]
    assert len(told(*many)) == MAX_WARNED
