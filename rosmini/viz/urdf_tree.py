"""The tree of a robot's links and joints as a picture, as `urdf_to_graphiz` draws it, in the house style."""

from __future__ import annotations

from rosmini.urdf import Joint, Robot
from rosmini.viz import style
from rosmini.viz.layout import Edge, Layout, Vertex, layered
from rosmini.viz.metrics import text_width
from rosmini.viz.rounding import fixed
from rosmini.viz.rqt.drawing import with_arrow
from rosmini.viz.svg import bezier, document, element, escape, number
from rosmini.viz.view import Picture

MARGIN = 12.0
LINE_HEIGHT = 15.0
COLOURS = ["ink", "muted", "line", "node-fill", "node-line", "topic-fill", "topic-line", "label", "group-fill", "group-line"]  # fmt: skip


def urdf_tree(robot: Robot, *, title: str | None = None) -> Picture:
    """Draw the links of a robot, each under the one on which it hangs; at the lines stand the joints.

    Links that have a mass are filled; the root is round. A joint that moves has a thick line, and its type and limits beside it.

    Args:
        robot: as `rosmini.urdf.load` gives it.
        title: a caption under the picture, and the first words of its text form.

    """
    moving = sum(joint.moves for joint in robot.joints.values())
    head = (
        f"{title or robot.name}: {_plural(len(robot.links), 'link')}, {_plural(len(robot.joints), 'joint')}, "
        f"{moving} of them move; {fixed(robot.mass, 3)} kg"
    )
    lines = [
        f"{joint.parent} -> {joint.child}: {', '.join(_facts(joint))}{_place(joint)}" for joint in robot.order
    ]
    said = [f"{', '.join(robot.children(link))} under {link}" for link in robot.links if robot.children(link)]
    alt = f"Tree of the {_plural(len(robot.links), 'link')} of {robot.name}, with {moving} moving joints: {'; '.join(said) or robot.root}."
    return Picture(
        _draw(robot, title or robot.name, alt), text="\n".join([head, *lines]), alt=alt, caption=title
    )


def _plural(count: int, noun: str) -> str:
    return f"{count} {noun}" + ("" if count == 1 else "s")


def _facts(joint: Joint) -> list[str]:
    """What stands beside a joint's line."""
    facts = [joint.name, joint.type]
    if joint.limit is not None and joint.type in {"revolute", "prismatic"}:
        unit = "rad" if joint.type == "revolute" else "m"
        facts.append(f"{fixed(joint.limit.lower, 2)} to {fixed(joint.limit.upper, 2)} {unit}")
    if joint.mimic is not None:
        facts.append(f"mimics {joint.mimic.joint}")
    return facts


def _place(joint: Joint) -> str:
    """Where a child stands, in words."""
    turned = any(abs(angle) > 1e-9 for angle in joint.origin.rpy)
    at = f", at ({', '.join(fixed(value, 3) for value in joint.origin.xyz)}) m"
    return at + (f", rpy ({', '.join(fixed(value, 3) for value in joint.origin.rpy)})" if turned else "")


def _draw(robot: Robot, title: str, alt: str) -> str:
    vertices = [
        Vertex(name, max(64.0, text_width(name, style.TEXT_SIZE) + 22), 32.0, "ellipse" if name == robot.root else "box")
        for name in robot.links
    ]  # fmt: skip
    edges = []
    for joint in robot.joints.values():
        facts = _facts(joint)
        width = max(text_width(fact, style.LABEL_SIZE) for fact in facts) + 10
        edges.append(Edge(joint.name, joint.parent, joint.child, width, LINE_HEIGHT * len(facts) + 4))
    layout = layered(vertices, edges, direction="down")
    parts = [_joint(layout, robot.joints[edge.name]) for edge in edges]
    parts += [_link(layout, robot, name) for name in robot.links]
    moved = element("g", "".join(parts), transform=f"translate({number(MARGIN)},{number(MARGIN)})")
    width, height = layout.width + 2 * MARGIN, layout.height + 2 * MARGIN
    return document(moved, width=width, height=height, title=title, alt=alt, css=_css(), colours=COLOURS)


def _link(layout: Layout, robot: Robot, name: str) -> str:
    rect = layout.vertices[name]
    x, y = rect.centre
    root, heavy = name == robot.root, robot.links[name].inertial is not None
    fill, line = (
        ("topic-fill", "topic-line")
        if root
        else (("node-fill", "node-line") if heavy else ("group-fill", "group-line"))
    )
    colours = {"fill": style.LIGHT[fill], "stroke": style.LIGHT[line]}
    if root:
        shape = element("ellipse", cx=x, cy=y, rx=rect.width / 2, ry=rect.height / 2, **colours)
    else:
        shape = element(
            "rect", x=x - rect.width / 2, y=y - rect.height / 2, width=rect.width, height=rect.height, rx=5, **colours
        )  # fmt: skip
    label = element(
        "text", escape(name), x=x, y=y + 4.5, font_size=style.TEXT_SIZE, text_anchor="middle", fill=style.LIGHT["ink"]
    )  # fmt: skip
    return element("g", shape + label, class_="urdf-root" if root else "urdf-body" if heavy else "urdf-frame")


def _joint(layout: Layout, joint: Joint) -> str:
    route = layout.edges[joint.name]
    points, arrow = with_arrow(route.points)
    width = 2.4 * style.LINE_WIDTH if joint.moves else style.LINE_WIDTH
    line = element("path", d=bezier(points), fill="none", stroke=style.LIGHT["line"], stroke_width=width)
    tip = element("path", d=arrow, fill=style.LIGHT["line"])
    labels = ""
    if route.label:
        labels = "".join(
            element(
                "text", escape(fact), x=route.label.x + 6, y=route.label.y + LINE_HEIGHT * (row + 1) - 2,
                font_size=style.LABEL_SIZE, fill=style.LIGHT["label"],
            )
            for row, fact in enumerate(_facts(joint))
        )  # fmt: skip
    return element("g", line + tip + labels, class_="urdf-joint")


def _css() -> str:
    def rule(selector: str, **properties: str) -> str:
        body = ";".join(f"{name}:{style.variable(value)}" for name, value in properties.items())
        return f".rosmini-svg {selector}{{{body}}}"

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
