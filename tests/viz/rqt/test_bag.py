"""The timeline of a bag: counts, rates and gaps in its text, and where they are drawn."""

from __future__ import annotations

import re
from io import BytesIO
from pathlib import Path

import pytest

from rosmini.core.time import Time
from rosmini.msgs import message_class
from rosmini.ros.bag import Bag, ROSBagException
from rosmini.viz import ViewError, rqt_bag
from rosmini.viz.rqt.bag import bars, gaps

String = message_class("std_msgs/String")
REAL = Path("/work/shared/data/real_robot.bag")


@pytest.fixture
def bag() -> Bag:
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


def test_bars_and_gaps():
    assert bars([10.0, 12.0, 30.0]) == [(9.2, 12.8), (29.2, 30.8)]
    assert bars([]) == []
    assert gaps([0, 1, 2, 3, 9, 10], 3.0) == ((3, 9),)
    assert gaps([0, 1, 9], 3.0) == ()
    assert gaps([0, 1, 2, 5, 6], 3.0) == ()
    bursts = [10 * burst + part / 100 for burst in range(10) for part in range(3)]
    assert gaps(bursts, 3.0) == ()
    assert gaps([*bursts, 150.0], 3.0) == ((90.02, 150.0),)


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


@pytest.mark.skipif(not REAL.is_file(), reason="the recording of a real robot is not part of the project")
def test_a_real_robots_bag():
    """What a robot recorded in 2015: it is read, played, and its laser and odometry are drawn."""
    from rosmini.core.graph import Graph
    from rosmini.ros.bag import Player
    from rosmini.viz import scan_picture
    from rosmini.viz.track_pictures import track_picture

    text = rqt_bag(REAL).text
    assert text.startswith("rqt_bag: 2418 messages of 3 topics in 5.4 s")
    assert "/scan [sensor_msgs/LaserScan]: 136 messages, 25.0 Hz on average" in text
    scans = []
    with Graph() as graph, Bag(REAL) as bag:
        graph.node("listener").subscriber("scan", bag.message_class("/scan"), scans.append)
        player = Player(graph.node("play"), bag, quiet=True)
        graph.run()
        assert player.played == 2418
        odom = bag.table("/odom")
    assert len(scans) == 136
    assert "beams hit" in scan_picture(scans[0]).text
    assert track_picture(odom).text.endswith("1086 positions")
