"""Checks of links and joints: a single tree, mimic chains that end, and physically possible inertias."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

import numpy as np

from rosmini.core.errors import nearest
from rosmini.core.geometry.products import eigen
from rosmini.core.markup import Element

from .model import Inertial, Joint, Link

SLACK = 1e-6
"""Tolerance for moments of inertia, relative to the largest, because files round them."""

MAX_MIMIC_LENGTH = 50
"""Maximum length of a chain of joints in which each mimics the next."""


def check_tree(
    robot: Element, links: Mapping[str, Link], joints: Mapping[str, Joint], elements: Mapping[str, Element]
) -> str:
    """Return the root of the tree of links and joints. `elements` contains the joints' elements.

    Raises `UrdfError` if a joint names a link that does not exist, a link is the child of two joints, joints
    form a cycle, or there are several trees.
    """
    above: dict[str, Joint] = {}
    for joint in joints.values():
        here = elements[joint.name]
        for role, name in (("parent", joint.parent), ("child", joint.child)):
            if name not in links:
                hint = nearest(name, links) or f"the links are: {', '.join(links)}"
                raise here.error(f"the {role} of the joint {joint.name!r} is not a link: {name!r}; {hint}")
        if joint.parent == joint.child:
            raise here.error(f"the joint {joint.name!r} connects the link {joint.child!r} to itself")
        if joint.child in above:
            other = above[joint.child]
            raise here.error(
                f"the link {joint.child!r} is the child of two joints: of {joint.name!r} and, in line {other.line}, of "
                f"{other.name!r}; in a tree every link has one parent"
            )
        above[joint.child] = joint
    roots = [name for name in links if name not in above]
    if len(roots) > 1:
        listed = ", ".join(f"{name!r} (line {links[name].line})" for name in roots)
        raise robot.error(
            f"the robot has {len(roots)} roots, links that are no joint's child: {listed}; a tree has one. "
            "Join the others to it"
        )
    _check_circles(robot, links, above)
    return roots[0]


def _check_circles(robot: Element, links: Mapping[str, Link], above: Mapping[str, Joint]) -> None:
    """Raise `UrdfError` unless every link is connected to the root."""
    good: set[str] = set()
    for name in links:
        path: dict[str, None] = {}
        at = name
        while at in above and at not in good:
            if at in path:
                links_above = list(path)
                circle = links_above[links_above.index(at) :]
                joints = ", ".join(f"{above[link].name!r} (line {above[link].line})" for link in circle)
                raise robot.error(f"joints form a circle: {joints}; a tree has a root")
            path[at] = None
            at = above[at].parent
        good.update(path)


def mimic_problem(joint: Joint, joints: Mapping[str, Joint]) -> str:
    """Describe why a joint cannot mimic another; empty if it can, or if it is not a mimic."""
    way = [joint.name]
    at = joint
    while at.mimic is not None:
        followed = at.mimic.joint
        if followed not in joints:
            hint = nearest(followed, joints)
            return f"the joint {at.name!r} mimics {followed!r}, which is not a joint{f'; {hint}' if hint else ''}"
        if followed in way:
            return f"joints mimic one another in a circle: {' -> '.join([*way, followed])}"
        at = joints[followed]
        if not at.moves:
            return f"the joint {joint.name!r} mimics {followed!r}, which is {at.type} and does not move"
        way.append(followed)
        if len(way) > MAX_MIMIC_LENGTH:
            return f"more than {MAX_MIMIC_LENGTH} joints mimic one another, beginning with {joint.name!r}"
    return ""


def inertia_notes(inertial: Inertial) -> Iterator[str]:
    """Yield the reasons why an inertia is impossible: a negative moment, or one above the sum of the others.

    (Each is an integral of two squared distances over the mass; see Featherstone, Rigid Body Dynamics Algorithms,
    2008.)
    """
    moments, _ = eigen(inertial.matrix)
    text = ", ".join(f"{moment:.4g}" for moment in moments)
    largest = float(np.abs(moments).max())
    if moments[0] < -SLACK * largest:
        yield f"the principal moments {text} kg m2 are not all above 0"
    elif moments[2] > (moments[0] + moments[1]) + SLACK * largest:
        yield f"of the principal moments {text} kg m2 the largest is more than the other two together"
    if inertial.mass == 0 and largest > 0:
        yield "the mass is 0, the inertia is not"
