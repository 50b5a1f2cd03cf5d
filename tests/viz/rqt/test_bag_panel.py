"""The panel of a bag."""

import pytest

from rosmini.core.time import Time
from rosmini.msgs.std_msgs.msg import String
from rosmini.ros.bag import Bag, ROSBagException
from rosmini.viz.rqt.bag import BagTimeline
from rosmini.viz.rqt.window import Rqt
from rosmini.viz.view import ViewError


@pytest.fixture
def bag(tmp_path):
    path = tmp_path / "talk.bag"
    with Bag(path, "w") as made:
        for second in range(4):
            made.write("/chatter", String("hello"), Time(100 + second))
    return path


def test_a_bag_that_is_named_is_shown(graph, bag, tmp_path):
    panel = BagTimeline(graph)
    assert "name a file" in panel.text
    panel.set("file", str(bag))
    assert "4 messages of 1 topic in 3.0 s" in panel.text
    assert "<svg" in panel.markup(live=True)
    with pytest.raises(ViewError, match=r"none\.bag cannot be opened: No such file"):
        panel.set("file", str(tmp_path / "none.bag"))
    (tmp_path / "no.bag").write_text("no bag", encoding="utf-8")
    with pytest.raises(ROSBagException):
        panel.load(str(tmp_path / "no.bag"))
    assert panel.path == str(bag)


def test_it_is_in_the_window_and_in_its_perspectives(graph, bag):
    window = Rqt(graph)
    window.set("plugins/Logging", "Bag")
    window.set("1/file", str(bag))
    kept = window.perspective()
    window.arrange(kept)
    assert window.missing == []
    assert "/chatter" in window.text
