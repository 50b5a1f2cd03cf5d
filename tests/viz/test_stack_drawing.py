"""The drawing of a distribution, a stack and a package."""

from __future__ import annotations

import xml.etree.ElementTree as ET

from rosmini.core.packages import PackageIndex
from rosmini.viz.stack_drawing import NAVIGATION, stacks_and_packages

NOT_IN_ROSMINI = {"voxel_grid"}
"""Obstacles in three dimensions."""


def test_each_package_of_the_stack_is_drawn_and_exists():
    picture = stacks_and_packages()
    words = [node.text for node in ET.fromstring(picture.svg).iter("{http://www.w3.org/2000/svg}text")]
    index = PackageIndex()
    for package in NAVIGATION:
        assert words.count(package) == 1
        assert package in picture.alt
        assert (package in index) != (package in NOT_IN_ROSMINI)
