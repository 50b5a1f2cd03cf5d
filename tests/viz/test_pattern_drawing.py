"""The drawing of the publish/subscribe pattern."""

from __future__ import annotations

import xml.etree.ElementTree as ET
from collections import Counter

from rosmini.viz.pattern_drawing import publish_subscribe


def test_publishers_and_subscribers_call_only_the_service():
    picture = publish_subscribe()
    words = Counter(node.text for node in ET.fromstring(picture.svg).iter("{http://www.w3.org/2000/svg}text"))
    assert words["Publisher"] == words["publish()"] == 2
    assert words["Subscriber"] == words["subscribe()"] == words["notify()"] == 2
    assert "No arrow joins a publisher and a subscriber" in picture.alt
