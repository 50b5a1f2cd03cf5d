"""Three computers, one Master: a teleop on the first drives a turtle there, and one on another."""

from __future__ import annotations

import json
import os
import re
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

import pytest

from ...conftest import nightly
from ...processes import run, wait_until
from ..conftest import need_ros
from .harness import ROSMINI, Stage
from .hosts import three_hosts

if TYPE_CHECKING:
    from collections.abc import Iterator

    from .harness import Child, Peer
    from .hosts import Host, Hosts

pytestmark = pytest.mark.ros


CHAPTER = Path(__file__).parents[3] / "notebooks/5_turtlesim/40_many_machines.ipynb"
TURTLES = {"master_turtle": "10.77.0.1", "node1_turtle": "10.77.0.2"}
"""The turtlesims of the chapter Many machines, and where they run in its listings."""


class Site(Stage):
    """A stage whose Master runs on the first of the computers."""

    kind = "ours"
    """Whose roscore it is: "ours", or the "real" one."""


@pytest.fixture(scope="module")
def hosts() -> Iterator[Hosts]:
    """Three computers."""
    need_ros("roscore", "rostopic", modules="rospy")
    with three_hosts() as found:
        yield found


@pytest.fixture(scope="module")
def site(hosts: Hosts, request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Site]:
    """A roscore on the first host, ours or the real one."""
    with Site(tmp_path_factory.mktemp(f"hosts_{request.param}"), host=hosts.a.address) as found:
        found.roscore(request.param, within=hosts.a.within)
        found.kind = request.param
        yield found


def ask(site: Site, host: Host, *words: str) -> tuple[str, str]:
    """Run a tool on a host; return what it wrote to standard output and standard error."""
    env = site.environment(ROS_IP=host.address)
    found = run([*host.within, *words], env=env, cwd=site.home)
    return found.stdout, found.stderr


@pytest.fixture(scope="module")
def watcher(site: Site, hosts: Hosts) -> Peer:
    """A node on the first host, which sees all robots, and through which the tests ask the Master."""
    return site.peer("ours", "watcher", within=hosts.a.within).ready()


def plain(text: str) -> str:
    """Replace what is another on each run: times and ports."""
    return re.sub(r"\[\d+\.\d+\]", "[TIME]", re.sub(r"(//[\d.]+):\d+/", r"\1:PORT/", text))


def listings() -> str:
    """The console listings of the chapter Many machines, without times and ports."""
    text = "\n".join("".join(cell["source"]) for cell in json.loads(CHAPTER.read_text(encoding="utf-8"))["cells"])
    return plain("\n".join(re.findall(r"^```console\n(.*?)^```", text, re.DOTALL | re.MULTILINE)))


@pytest.mark.nightly
def test_one_teleop_drives_two_turtles_as_chapter_63_shows(site: Site, hosts: Hosts, watcher: Peer) -> None:
    """One turtlesim beside the Master, one on another host, and a teleop; each prints what the chapter lists."""
    shown = listings()
    at = dict(zip(TURTLES, (hosts.a, hosts.b), strict=True))

    def as_listed(text: str) -> str:
        for name, address in TURTLES.items():
            text = text.replace(at[name].address, address)
        # The chapter leaves out where the window is, which differs each time.
        return plain(re.sub(r"^.*: its window is the page .*\n", "", text, flags=re.MULTILINE))

    turtles = []
    for name, host in at.items():
        words = [*ROSMINI, "rosrun", "turtlesim", "turtlesim_node", f"__name:={name}"]
        turtle: Child = site.start(name, words, {"ROS_IP": host.address}, within=host.within)
        turtle.wait_for("Spawning turtle .*\n")
        turtles.append(turtle)
    words = [*ROSMINI, "rosrun", "turtlesim", "turtle_teleop_key"]
    teleop: Child = site.start("turtle_keys", words, {"ROS_IP": hosts.a.address}, within=hosts.a.within)
    teleop.wait_for("'q' to quit.\n")
    for child in (*turtles, teleop):
        assert as_listed(child.output) in shown
    listed, _ = ask(site, hosts.b, *ROSMINI, "rosnode", "list", "-a")
    rows = [line for line in as_listed(listed).splitlines() if line.split("/")[-1] in {*TURTLES, "teleop_turtle"}]
    assert len(rows) == 3
    assert all(row in shown.splitlines() for row in rows)
    # Both publish on one topic with poses, so its own wall tells where a turtle is: three keys away, of which one that
    # is connected late misses some.
    teleop.process.stdin.write("A" * 30)
    teleop.process.stdin.flush()
    for turtle in turtles:
        turtle.wait_for("Oh no! I hit the wall!")
    for child in (teleop, *turtles):
        child.interrupt()


@pytest.mark.parametrize("kind", ["ours", *nightly("real")])
def test_an_address_that_others_do_not_reach_is_explained(site: Site, hosts: Hosts, watcher: Peer, kind: str) -> None:
    """The classic: all is listed, and nothing arrives. Our subscriber, our tools and our Master say why."""
    for number, wrong in enumerate(hosts.wrong):
        topic, name = f"/said_{kind}_{number}", f"lost_{kind}_{number}"
        host = hosts.b
        lost = site.peer(kind, name, within=host.within, ROS_HOSTNAME=wrong, ROS_IP="").ready()
        lost.ask("advertise", topic, "std_msgs/String")
        assert lost.uri.startswith(f"http://{wrong}:")
        listed, _ = ask(site, hosts.a, "rostopic", "list")
        assert topic in listed.split()
        watcher.ask("subscribe", topic, "std_msgs/String")
        watcher.wait_for(
            rf"\[WARN\].*/watcher cannot connect to /{name}, which publishes {topic} at {lost.uri}: .*{wrong}.*ROS_IP"
        )
        _, said = ask(site, hosts.a, *ROSMINI, "rosnode", "ping", "-c", "1", f"/{name}")
        assert f"The Master lists it at {lost.uri}." in said
        assert "set ROS_IP there" in said
        if site.kind == "ours" and hosts.are_apart:
            (core,) = (child for child in site.children if child.name == "roscore_ours")
            core.wait_for(rf"/{name}, on the machine at {host.address}, advertises {lost.uri}.*ROS_IP={host.address}")
        watcher.ask("unsubscribe", topic)
        lost.interrupt()


@contextmanager
def walled(host: Host) -> Iterator[None]:
    """Be a firewall: drop, without an answer, what others send to the ports on which this host listens now.

    Neither iptables nor nft is needed for that: rules of routing know ports, and may come before the local table.
    What the host has begun itself, and answers to it, still pass.
    """
    listening = run([*host.within, "ss", "-Htln"]).stdout
    ports = sorted({line.split()[3].rpartition(":")[2] for line in listening.splitlines()})
    rules = ["ip rule add pref 20 lookup local", "ip rule del pref 0"]
    rules += [f"ip rule add pref 10 iif eth0 ipproto tcp dport {port} blackhole" for port in ports]
    back = ["ip rule add pref 0 lookup local", "ip rule del pref 20", *["ip rule del pref 10"] * len(ports)]
    for commands in rules, back:
        done = run([*host.within, "sh", "-ec", "\n".join(commands)])
        assert done.returncode == 0, done.stderr
        if commands is rules:
            yield


@pytest.mark.nightly
def test_behind_a_firewall_a_turtle_obeys_and_nobody_hears_it(site: Site, hosts: Hosts) -> None:
    """Calls go out and none come in: what the chapter Many machines calls one direction only; how it is recognised."""
    if not hosts.are_apart:
        pytest.skip("the hosts of this machine have one network")
    words = [*ROSMINI, "rosrun", "turtlesim", "turtle_teleop_key"]
    teleop: Child = site.start("keys", words, {"ROS_IP": hosts.a.address}, within=hosts.a.within)
    teleop.wait_for("'q' to quit.\n")
    words = [*ROSMINI, "rosrun", "turtlesim", "turtlesim_node", "__name:=walled_turtle"]
    turtle: Child = site.start("walled_turtle", words, {"ROS_IP": hosts.c.address}, within=hosts.c.within)
    turtle.wait_for("Spawning turtle .*\n")
    wait_until(
        lambda: "/teleop_turtle" in ask(site, hosts.c, *ROSMINI, "rosnode", "info", "/walled_turtle")[0].split(),
        "the turtle to be connected",
    )
    with walled(hosts.c):
        ping = [*ROSMINI, "rosnode", "ping", "-c", "1", "/walled_turtle"]
        _, said = ask(site, hosts.a, *ping)
        assert "connection to [/walled_turtle] timed out" in said
        assert "look for a firewall" in said
        words = [*ROSMINI, "rostopic", "echo", "/turtle1/pose"]
        echo: Child = site.start("echo", words, {"ROS_IP": hosts.a.address}, within=hosts.a.within)
        echo.wait_for("/walled_turtle")
        echo.interrupt()
        assert "x:" not in echo.output
        assert "xmlrpc reply from" in ask(site, hosts.c, *ping)[0]
        teleop.process.stdin.write("A" * 30)
        teleop.process.stdin.flush()
        turtle.wait_for("Oh no! I hit the wall!")
    for child in (teleop, turtle):
        child.interrupt()


NAMED = 'mount --bind "$0" /etc/hosts && hostname "$1" && shift && exec "$@"'


def named(host: Host, name: str, hosts_file: Path) -> Host:
    """The same computer with a host name and a table of hosts."""
    words = ["unshare", "--uts", "--mount", "sh", "-c", NAMED, str(hosts_file), name]
    return host._replace(within=[*host.within, *words])


@pytest.mark.nightly
def test_two_hosts_that_know_each_other_by_name_answer_each_other(hosts: Hosts, tmp_path: Path) -> None:
    """Each answers calls for its own host name, from real nodes and ours; roscore refuses those for another name."""
    if not hosts.are_apart or os.geteuid() != 0:
        pytest.skip("names of hosts need namespaces and root")
    table = tmp_path / "hosts"
    lines = ["127.0.0.1 localhost", f"{hosts.a.address} robot robot.local alias", f"{hosts.b.address} laptop"]
    table.write_text("\n".join(lines) + "\n", encoding="utf-8")
    robot, laptop = named(hosts.a, "robot", table), named(hosts.b, "laptop", table)
    (tmp_path / "stage").mkdir()
    with Site(tmp_path / "stage", host="robot") as site:
        env = {"ROS_IP": hosts.a.address}  # so that it is the host name by which it is known as robot
        words = [*ROSMINI, "roscore", "-p", str(site.port)]
        core: Child = site.start("roscore", words, env, within=robot.within)
        core.wait_for(r"started core service \[/rosout\]")
        for number, kind in enumerate(("ours", "real")):
            speaker = site.peer(kind, f"speaker_{kind}", within=robot.within, ROS_HOSTNAME="robot", ROS_IP="")
            hearer = site.peer(kind, f"hearer_{kind}", within=laptop.within, ROS_HOSTNAME="laptop", ROS_IP="")
            speaker.ready().ask("advertise", f"/said_{number}", "std_msgs/String")
            hearer.ready().ask("subscribe", f"/said_{number}", "std_msgs/String")
            assert speaker.uri.startswith("http://robot:")
            assert hearer.uri.startswith("http://laptop:")
            env = site.environment(ROS_HOSTNAME="laptop", ROS_IP="")
            for name in (f"/speaker_{kind}", f"/hearer_{kind}"):
                for tool in (["rosnode"], [*ROSMINI, "rosnode"]):
                    said = run([*laptop.within, *tool, "ping", "-c", "1", name], env=env, cwd=site.home)
                    assert "xmlrpc reply from" in said.stdout, said
        for host, is_known in (("robot.local", True), ("alias", False)):
            env |= {"ROS_MASTER_URI": f"http://{host}:{site.port}"}
            said = run([*laptop.within, "rosparam", "list"], env=env, cwd=site.home)
            assert ("/rosversion" in said.stdout) == is_known
        core.wait_for("refused a request from .*'alias'")
