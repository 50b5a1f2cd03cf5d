"""rqt_msg, rqt_srv, rqt_action: types as trees."""

import pytest

from rosmini.viz import ViewError
from rosmini.viz.rqt.definitions import rqt_action, rqt_msg, rqt_srv
from rosmini.viz.rqt.parts import Row


def test_the_fields_of_a_message_with_their_paths():
    table = rqt_msg("geometry_msgs/PoseStamped")
    assert table.part.columns == ("Tree", "Type", "Path")
    assert Row(("position", "geometry_msgs/Point", "pose/position"), 2) in table.part.rows
    assert Row(("x", "float64", "pose/position/x"), 3) in table.part.rows
    assert len(table) == 1 + 1 + 3 + 1 + 1 + 3 + 1 + 4


def test_both_halves_of_a_service_and_all_parts_of_an_action():
    assert [row.cells[2] for row in rqt_srv("std_srvs/SetBool").part.rows] == [
        "std_srvs/SetBoolRequest", "request/data", "std_srvs/SetBoolResponse", "response/success", "response/message",
    ]  # fmt: skip
    paths = [row.cells[2] for row in rqt_action("actionlib_tutorials/Fibonacci").part.rows]
    assert paths[1::2] == ["goal/order", "result/sequence", "feedback/sequence"]


@pytest.mark.parametrize("kind", ["geometry_msgs/Twits", "nowhere/Twist", "Twist!", "a/b/c", ""])
def test_a_type_that_is_none(kind):
    for draw in (rqt_msg, rqt_srv, rqt_action):
        with pytest.raises(ViewError):
            draw(kind)
