"""The timeline of a bag: counts, rates and gaps in its text, and where they are drawn."""

import re
from io import BytesIO

import pytest

from rosmini.core.time import Time
from rosmini.msgs import message_class
from rosmini.ros.bag import Bag, ROSBagException
from rosmini.viz import ViewError, rqt_bag

String = message_class("std_msgs/String")


@pytest.fixture
def bag():
    """10 Hz for ten seconds without the seconds from 4 to 6; one message on /map at 1 s."""
    file = BytesIO()
    with Bag(file, "w") as bag:
        for i in range(101):
            if not 40 < i < 60:
                bag.write("/chatter", String("x"), Time(100 + i // 10, i % 10 * 100_000_000))
        bag.write("/map", String("world"), Time(101))
    return Bag(file)


def test_text(bag):
    assert rqt_bag(bag).text.splitlines() == [
        "rqt_bag: 83 messages of 2 topics in 10.0 s",
        "/chatter [std_msgs/String]: 82 messages, 8.1 Hz on average, 0.0 s to 10.0 s; 1 gap: 4.0 to 6.0 s",
        "/map [std_msgs/String]: 1 message, 1.0 s",
    ]
    picture = bag.show(topics=["/map"], title="Figure 1: a map")
    assert picture.text.startswith("Figure 1: a map: 1 message of 1 topic in 10.0 s")
    assert "Timeline of a bag, 10.0 s long" in picture.alt


def test_where_it_is_drawn(bag):
    svg = rqt_bag(bag).svg
    left, room = (float(x) for x in re.search(r'class="r" x="([\d.]+)" y="[\d.]+" width="([\d.]+)"', svg).groups())
    x, wide = (float(x) for x in re.search(r'class="x" x="([\d.]+)" y="[\d.]+" width="([\d.]+)"', svg).groups())
    assert (x - left) / room == pytest.approx(0.4, abs=0.002)
    assert wide / room == pytest.approx(0.2, abs=0.002)
    chatter, one = re.findall(r'class="m" d="([^"]+)"', svg)
    assert chatter.count("M") >= 2
    assert one.count("M") == 1
    middle = float(one[1:].partition(",")[0]) + 0.8
    assert (middle - left) / room == pytest.approx(0.1, abs=0.002)
    assert rqt_bag(bag).html == rqt_bag(bag).html


def test_what_cannot_be_drawn(bag, tmp_path):
    with pytest.raises(ROSBagException, match="did you mean /map"):
        rqt_bag(bag, topics=["/mapp"])
    with pytest.raises(ViewError, match="gap"):
        rqt_bag(bag, gap=1.0)
    with Bag(tmp_path / "empty.bag", "w"):
        pass
    with pytest.raises(ViewError, match="no message"):
        rqt_bag(tmp_path / "empty.bag")


def test_topics_named_like_markup_are_text(tmp_path):
    with Bag(tmp_path / "x.bag", "w") as bag:
        bag.write("/<b>&", String("x"), Time(1))
    picture = rqt_bag(tmp_path / "x.bag")
    assert "/&lt;b&gt;&amp;" in picture.svg
    assert "all at one time" in picture.svg
