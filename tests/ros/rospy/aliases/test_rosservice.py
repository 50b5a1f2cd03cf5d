"""``import rosservice``, as public scripts use it."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest

from rosmini import Graph, set_default_graph
from rosmini.msgs.nav_msgs.srv import GetPlan
from rosmini.msgs.std_srvs.srv import SetBool
from rosmini.ros.rospy.aliases import rosservice
from rosmini.ros.scripts import ScriptSpec, run_scripts

SCRIPT = """
import rospy, rosservice
from std_srvs.srv import SetBool
rospy.init_node("caller")
rospy.Service("switch", SetBool, lambda request: (request.data, "done"))
print(rosservice.get_service_type("/switch"), rosservice.get_service_node("/switch"))
"""


@pytest.fixture
def graph() -> Iterator[Graph]:
    with Graph() as made:
        before = set_default_graph(made)
        node = made.node("server")
        node.service("plan", GetPlan, lambda _: GetPlan._response_class())
        node.service("~switch", SetBool, lambda _: None)
        yield made
        set_default_graph(before)


def test_a_script_imports_it(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "caller.py"
    path.write_text(SCRIPT, encoding="utf-8")
    assert run_scripts([ScriptSpec(str(path))], simulated=True, duration=5.0).status == 0
    printed = [line.removeprefix("[caller] ") for line in capsys.readouterr().out.splitlines()]
    assert printed == ["std_srvs/SetBool /caller"]


def test_lists_and_addresses(graph: Graph) -> None:
    assert "/plan" in rosservice.get_service_list()
    assert "/plan" not in rosservice.get_service_list(node="/rosout")
    assert rosservice.get_service_list(namespace="/plan", include_nodes=True) == [["/plan", ["/server"]]]
    assert rosservice.rosservice_find("nav_msgs/GetPlan") == ["/plan"]
    assert rosservice.get_service_class_by_name("/plan") is GetPlan


def test_what_is_not_there(graph: Graph) -> None:
    assert rosservice.get_service_type("/nope") is None
    assert rosservice.get_service_node("/nope") is None
    with pytest.raises(rosservice.ROSServiceException, match="did you mean /plan"):
        rosservice.get_service_class_by_name("/plna")
