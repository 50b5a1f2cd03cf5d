"""The chapter RViz: its pictures are small, and each status that it explains is printed."""

from __future__ import annotations

from .conftest import printed


def test_its_pictures_are_light(cells):
    for cell in cells:
        for output in cell.get("outputs", []):
            svg = output.get("data", {}).get("image/svg+xml", "")
            assert len(svg) <= 60_000


def test_the_statuses_that_it_explains_are_those_that_are_printed(cells, prose):
    said = printed(cells, "-d faulty.rviz")
    for words in (
        "Fixed Frame: OK", "For frame [base_scan]", "No transform from [base_scan] to [odom]", "nobody publishes /scam",
        "has the type sensor_msgs/LaserScan",
    ):  # fmt: skip
        assert words in said
    assert "No transform from [base_scan] to [odom]" in prose
