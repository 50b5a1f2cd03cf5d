"""What the environment and the command line say about addresses."""

from __future__ import annotations

import re
from socket import gaierror

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rosmini.core.errors import ROSInitException
from rosmini.core.names import Remappings
from rosmini.ros.net.addresses import addresses, host_and_port, is_loopback

PORTS = st.integers(1, 65535)
ADDRESSES = st.ip_addresses(v=4).map(str)
NAMES = st.from_regex(r"[a-z][a-z0-9-]{0,20}(\.[a-z]{1,5})?", fullmatch=True)
HOSTS = ADDRESSES | NAMES


def test_without_anything_said_only_this_machine_reaches_a_process() -> None:
    found = addresses({})
    assert found.master_uri == "http://localhost:11311"
    assert found.master == ("localhost", 11311)
    assert (found.host, found.bind) == ("localhost", "127.0.0.1")
    assert found.uri(4711) == "http://localhost:4711/"
    assert found.uri(4711, "rosrpc") == "rosrpc://localhost:4711"
    assert found.announcement is None
    assert found.warning is None


def test_a_master_at_an_address_of_loopback_is_answered_in_kind() -> None:
    found = addresses({"ROS_MASTER_URI": "http://127.0.0.1:11391/"})
    assert (found.host, found.bind) == ("127.0.0.1", "127.0.0.1")


@pytest.mark.parametrize("variable", ["ROS_IP", "ROS_HOSTNAME"])
def test_an_address_of_the_network_opens_the_process(variable: str) -> None:
    found = addresses({variable: "192.168.1.5", "ROS_MASTER_URI": "http://robot:11311"})
    assert (found.host, found.bind) == ("192.168.1.5", "0.0.0.0")
    assert found.is_open
    assert found.announcement is not None
    assert "192.168.1.5" in found.announcement
    assert found.warning is None


def test_each_address_of_loopback_can_stand_for_a_host() -> None:
    found = addresses({"ROS_IP": "127.0.0.3"})
    assert (found.host, found.bind) == ("127.0.0.3", "127.0.0.3")
    assert found.announcement is None


def test_the_name_goes_before_the_address_and_arguments_before_both() -> None:
    environ = {"ROS_IP": "10.0.0.1", "ROS_HOSTNAME": "robot", "ROS_MASTER_URI": "http://base:11311"}
    assert addresses(environ).host == "robot"
    assert addresses({**environ, "ROS_HOSTNAME": ""}).host == "10.0.0.1"
    argv = ["__ip:=10.0.0.2", "__master:=http://other:1234"]
    found = addresses(environ, Remappings.from_argv(argv).special)
    assert (found.host, found.master) == ("10.0.0.2", ("other", 1234))
    assert addresses(environ, Remappings.from_argv([*argv, "__hostname:=arm"]).special).host == "arm"


def test_a_master_elsewhere_that_cannot_reach_back_is_warned_of() -> None:
    warning = addresses({"ROS_MASTER_URI": "http://192.168.1.2:11311"}).warning
    assert warning is not None
    assert "ROS_IP" in warning
    assert "192.168.1.2" in warning


@pytest.mark.parametrize(
    "uri",
    ["localhost:11311", "robot", "http://", "http://:11311", "ftp://robot:11311", "http://robot:no", "http://robot:99999",
     "http://robot:11311/path", "http://[::1", "http://robot:0"],
)  # fmt: skip
def test_an_address_of_a_master_that_is_none_says_what_one_looks_like(uri: str) -> None:
    with pytest.raises(ROSInitException, match=r"ROS_MASTER_URI is .* http://host:port"):
        addresses({"ROS_MASTER_URI": uri})


@pytest.mark.parametrize("host", ["http://robot", "robot:11311", "two words", "0.0.0.0", "224.0.0.1", "::"])
def test_an_address_of_this_machine_that_is_none_is_refused(host: str) -> None:
    with pytest.raises(ROSInitException, match=r"ROS_IP is .*"):
        addresses({"ROS_IP": host})


def test_addresses_of_ipv6_stand_in_brackets() -> None:
    found = addresses({"ROS_MASTER_URI": "http://[::1]:11311", "ROS_IP": "fe80::1"})
    assert found.master == ("::1", 11311)
    assert found.uri(80) == "http://[fe80::1]:80/"


@given(HOSTS, PORTS)
def test_what_is_told_of_a_server_is_read_again(host: str, port: int) -> None:
    found = addresses({"ROS_MASTER_URI": f"http://{host}:{port}"})
    assert found.master == (host, port)
    assert host_and_port(found.uri(port)) == (found.host, port)
    assert is_loopback(found.host)
    assert (found.warning is None) == is_loopback(host)


@given(st.text())
def test_any_text_is_an_address_or_a_clear_refusal(text: str) -> None:
    for environ in ({"ROS_MASTER_URI": text}, {"ROS_IP": text}, {"ROS_HOSTNAME": text}):
        try:
            found = addresses(environ)
        except ROSInitException:
            continue
        assert found.master[0]
        assert found.host


def test_an_address_that_is_not_this_machines_is_told() -> None:
    """203.0.113.0/24 is for examples: nobody has it."""
    (listens, wrong) = addresses({"ROS_IP": "203.0.113.7"}).notes
    assert listens.endswith("203.0.113.7")
    assert addresses({"ROS_IP": "203.0.113.7"}).faults == [wrong]
    assert wrong.startswith("203.0.113.7 is not an address of this machine")
    assert "ROS_IP" in wrong
    assert addresses({"ROS_IP": "127.0.0.3"}).notes == []


REFUSED, UNKNOWN, NO_ROUTE = ConnectionRefusedError(), gaierror(-2, "unknown"), OSError(113, "no route")
OPEN = {"ROS_IP": "192.168.1.5", "ROS_MASTER_URI": "http://192.168.1.2:11311"}


@pytest.mark.parametrize(
    ("environ", "host", "reason", "says"),
    [
        ({}, "localhost", REFUSED, r"^No node listens there: it has been shut down.*rosnode cleanup[^.]*$"),
        (OPEN, "localhost", REFUSED, r"^localhost always means.*that asks.*set ROS_IP there.*rosnode cleanup"),
        (OPEN, "127.0.1.1", REFUSED, r"^127.0.1.1 always means the machine that asks"),
        (OPEN, "192.168.1.7", REFUSED, r"rosnode cleanup.*If 192.168.1.7 is not its machine, set ROS_IP there"),
        (OPEN, "robot", UNKNOWN, r"calls itself robot, set ROS_IP there.*or add robot to /etc/hosts here"),
        (OPEN, "172.17.0.1", NO_ROUTE, r"If 172.17.0.1 is not the address.*set ROS_IP there.*firewall"),
    ],
)  # fmt: skip
def test_what_is_wrong_with_an_address_is_told_by_what_the_system_says(
    environ: dict[str, str], host: str, reason: Exception, says: str
) -> None:
    assert re.search(says, addresses(environ).advice(host, reason))
