"""The tree of a robot's links and joints as a picture, as `urdf_to_graphiz` draws it, in the house style."""

from __future__ import annotations

from rosmini.sim.urdf import Joint, Robot
from rosmini.viz import style
from rosmini.viz.graph_drawing import arrow, box, drawing, ellipse, facts, name, room_for, rule
from rosmini.viz.layout import Edge, Layout, Vertex, layered
from rosmini.viz.metrics import text_width
from rosmini.viz.rounding import fixed
from rosmini.viz.svg import element
from rosmini.viz.view import Picture
from rosmini.viz.words import plural

COLOURS = [
    "ink", "muted", "line", "node-fill", "node-line",
    "topic-fill", "topic-line", "label", "group-fill", "group-line",
]  # fmt: skip


def urdf_tree(robot: Robot, *, title: str | None = None) -> Picture:
    """Draw the links of a robot, each under its parent, with the joints beside the lines.

    Links with a mass are filled; the root is round. A movable joint has a thick line, with its type and limits.

    Args:
        robot: the robot, for instance from `rosmini.sim.urdf.load`.
        title: a caption under the picture, and the first words of its text form.

    """
    moving = sum(joint.moves for joint in robot.joints.values())
    head = (
        f"{title or robot.name}: {plural(len(robot.links), 'link')}, {plural(len(robot.joints), 'joint')}, "
        f"{moving} of them move; {fixed(robot.mass, 3)} kg"
    )
    lines = [f"{joint.parent} -> {joint.child}: {', '.join(_facts(joint))}{_place(joint)}" for joint in robot.order]
    said = [f"{', '.join(robot.children(link))} under {link}" for link in robot.links if robot.children(link)]
    alt = (
        f"Tree of the {plural(len(robot.links), 'link')} of {robot.name}, with {moving} moving joints: "
        f"{'; '.join(said) or robot.root}."
    )
    return Picture(_draw(robot, title or robot.name, alt), text="\n".join([head, *lines]), alt=alt, caption=title)


def _facts(joint: Joint) -> list[str]:
    """Return the lines beside a joint's edge."""
    facts = [joint.name, joint.type]
    if joint.limit is not None and joint.type in {"revolute", "prismatic"}:
        unit = "rad" if joint.type == "revolute" else "m"
        facts.append(f"{fixed(joint.limit.lower, 2)} to {fixed(joint.limit.upper, 2)} {unit}")
    if joint.mimic is not None:
        facts.append(f"mimics {joint.mimic.joint}")
    return facts


def _place(joint: Joint) -> str:
    """Describe the pose of a child."""
    turned = any(abs(angle) > 1e-9 for angle in joint.origin.rpy)
    at = f", at ({', '.join(fixed(value, 3) for value in joint.origin.xyz)}) m"
    return at + (f", rpy ({', '.join(fixed(value, 3) for value in joint.origin.rpy)})" if turned else "")


def _draw(robot: Robot, title: str, alt: str) -> str:
    vertices = [
        Vertex(
            name, max(64.0, text_width(name, style.TEXT_SIZE) + 22), 32.0, "ellipse" if name == robot.root else "box"
        )
        for name in robot.links
    ]  # fmt: skip
    edges = [Edge(joint.name, joint.parent, joint.child, *room_for(_facts(joint))) for joint in robot.joints.values()]
    layout = layered(vertices, edges, direction="down")
    parts = [_joint(layout, robot.joints[edge.name]) for edge in edges]
    parts += [_link(layout, robot, name) for name in robot.links]
    return drawing(parts, layout, title=title, alt=alt, css=_css(), colours=COLOURS)


def _link(layout: Layout, robot: Robot, link: str) -> str:
    rect = layout.vertices[link]
    label = name(link, rect)
    if link == robot.root:
        return element("g", ellipse(rect, "topic") + label, class_="urdf-root")
    heavy = robot.links[link].inertial is not None
    shape = box(rect, "node" if heavy else "group", 5)
    return element("g", shape + label, class_="urdf-body" if heavy else "urdf-frame")


def _joint(layout: Layout, joint: Joint) -> str:
    route = layout.edges[joint.name]
    width = 2.4 * style.LINE_WIDTH if joint.moves else style.LINE_WIDTH
    return element("g", arrow(route, width=width) + facts(_facts(joint), route.label), class_="urdf-joint")


def _css() -> str:
    return (
        rule(".urdf-root ellipse", fill="topic-fill", stroke="topic-line")
        + rule(".urdf-body rect", fill="node-fill", stroke="node-line")
        + rule(".urdf-frame rect", fill="group-fill", stroke="group-line")
        + rule(".urdf-root text,.rosmini-svg .urdf-body text,.rosmini-svg .urdf-frame text", fill="ink")
        + rule(".urdf-joint text", fill="label")
        + rule(".urdf-joint path:first-of-type", stroke="line")
        + rule(".urdf-joint path:last-of-type", fill="line")
        + f".rosmini-svg ellipse,.rosmini-svg rect{{stroke-width:{style.LINE_WIDTH}}}"
    )
