"""Who is who: the firms around Willow Garage, and what the community hands on."""

from __future__ import annotations

from .flows import flow

FIRMS: tuple[tuple[str, str], ...] = (
    ("Stanford", "STAIR, PR1"),
    ("Willow Garage", "2006 to 2014"),
    ("OSRF", "2012: ROS, Gazebo"),
    ("Suitable Technologies", "Beam"),
    ("Industrial Perception", "robots that see"),
    ("Redwood Robotics", "2012: arms"),
    ("Unbounded Robotics", "2013 to 2014"),
    ("Savioke", "robots in hotels"),
    ("Clearpath Robotics", "2014: care of PR2s"),
    ("OSRA", "2024: the alliance"),
    ("Intrinsic (Alphabet)", "2022: OSRF's firm"),
    ("Google", "2013: bought both"),
    ("Fetch Robotics", "2021: bought by Zebra"),
)
WAYS: tuple[tuple[str, str], ...] = (
    ("Stanford", "Willow Garage"),
    ("Willow Garage", "OSRF"),
    ("Willow Garage", "Suitable Technologies"),
    ("Willow Garage", "Industrial Perception"),
    ("Willow Garage", "Redwood Robotics"),
    ("Willow Garage", "Unbounded Robotics"),
    ("Willow Garage", "Savioke"),
    ("Willow Garage", "Clearpath Robotics"),
    ("OSRF", "OSRA"),
    ("OSRF", "Intrinsic (Alphabet)"),
    ("Industrial Perception", "Google"),
    ("Redwood Robotics", "Google"),
    ("Unbounded Robotics", "Fetch Robotics"),
)
"""From whom people, or what they had made, went to whom."""
COMMUNITY: tuple[tuple[str, str], ...] = (
    ("Authors", "universities, companies, you"),
    ("Repositories", "packages, with their history"),
    ("Documentation", "wiki, docs.ros.org, REPs"),
    ("rosdistro", "the list: what, where, which version"),
    ("Build farm", "compiles, tests, packs"),
    ("Distribution", "versions that fit"),
    ("Users", "with their robots"),
    ("Questions, issues", "Stack Exchange, Discourse, ROSCon"),
)
HANDED_ON: tuple[tuple[str, str], ...] = (
    ("Authors", "Repositories"),
    ("Authors", "Documentation"),
    ("Repositories", "rosdistro"),
    ("rosdistro", "Build farm"),
    ("Build farm", "Distribution"),
    ("Distribution", "Users"),
    ("Documentation", "Users"),
    ("Users", "Questions, issues"),
    ("Questions, issues", "Authors"),
)
"""What goes where in the community: code, words, and what comes back."""


def people() -> str:
    """Where ROS's people came from and where they went."""
    about = dict(FIRMS)
    told = "; ".join(f"{before} to {after} ({about[after]})" for before, after in WAYS)
    return flow(
        FIRMS,
        WAYS,
        marked={"Willow Garage", "OSRF", "OSRA"},
        title="The firms around Willow Garage",
        alt=f"Firms as boxes, joined by arrows: {told}.",
    )


def community() -> str:
    """How what somebody writes comes to those who use it, and back."""
    about = dict(COMMUNITY)
    told = "; ".join(f"from {before} to {after} ({about[after]})" for before, after in HANDED_ON)
    return flow(
        COMMUNITY,
        HANDED_ON,
        marked={"Repositories", "Documentation", "Distribution"},
        title="What the community hands on",
        alt=f"Boxes joined by arrows, in a ring: {told}.",
        direction="down",
    )
