"""Classes from the full text that bags and connection headers carry."""

from __future__ import annotations

import pytest

from rosmini.core.errors import DefinitionError, UnknownPackage, UnknownType
from rosmini.msgs import message_class
from rosmini.msgs.full_text import class_from


@pytest.mark.parametrize(
    "name", ["std_msgs/String", "nav_msgs/Odometry", "sensor_msgs/PointCloud2", "tf2_msgs/TFMessage"]
)
def test_a_class_from_the_full_text_of_another_is_that_class_again(name: str) -> None:
    known = message_class(name)
    made = class_from(name, known._full_text)
    assert made is not known
    assert (made._md5sum, made._slot_types) == (known._md5sum, known._slot_types)
    assert made._encode(made()) == known._encode(known())


@pytest.mark.parametrize("text", ["nonsense", "float64 x y", "other_pkg/Missing part", "no_such_type x"])
def test_a_text_that_defines_nothing_is_refused(text: str) -> None:
    with pytest.raises((DefinitionError, UnknownType, UnknownPackage)):
        class_from("odd_pkg/Odd", text)
