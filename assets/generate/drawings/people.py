"""Where ROS's people came from and where they went: the firms around Willow Garage."""

from __future__ import annotations

from rosmini.viz.graph_drawing import arrow, drawing, rule
from rosmini.viz.layout import Edge, Vertex, layered
from rosmini.viz.metrics import text_width
from rosmini.viz.style import LABEL_SIZE, LIGHT, LINE_WIDTH, TEXT_SIZE
from rosmini.viz.svg import element

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
HEIGHT = 44.0


def people() -> str:
    """The firms as boxes, from left to right."""
    vertices = [Vertex(name, width_of(name, what), HEIGHT) for name, what in FIRMS]
    edges = [Edge(f"{before} {after}", before, after) for before, after in WAYS]
    layout = layered(vertices, edges, direction="right")
    drawn = [element("g", arrow(layout.edges[edge.name]), class_="rb-way") for edge in edges]
    for name, what in FIRMS:
        rect = layout.vertices[name]
        kind = "topic" if name in {"Willow Garage", "OSRF", "OSRA"} else "node"
        x, y = rect.centre
        box = element(
            "rect",
            x=rect.x,
            y=rect.y,
            width=rect.width,
            height=rect.height,
            rx=8,
            fill=LIGHT[f"{kind}-fill"],
            stroke=LIGHT[f"{kind}-line"],
            stroke_width=LINE_WIDTH,
        )
        lines = element(
            "text", name, x=x, y=y - 3, font_size=TEXT_SIZE, text_anchor="middle", fill=LIGHT["ink"]
        )
        lines += element(
            "text",
            what,
            x=x,
            y=y + 14,
            font_size=LABEL_SIZE,
            text_anchor="middle",
            fill=LIGHT["muted"],
            class_="rb-what",
        )
        drawn.append(element("g", box + lines, class_=f"rb-{kind}"))
    css = (
        rule(".rb-topic rect", fill="topic-fill", stroke="topic-line")
        + rule(".rb-node rect", fill="node-fill", stroke="node-line")
        + rule("g text", fill="ink")
        + rule("g .rb-what", fill="muted")
        + rule(".rb-way path:first-of-type", stroke="line")
        + rule(".rb-way path:last-of-type", fill="line")
    )
    colours = ["ink", "line", "muted", "node-fill", "node-line", "topic-fill", "topic-line"]
    return drawing(
        drawn, layout, title="The firms around Willow Garage", alt=_alt(), css=css, colours=colours
    )


def width_of(name: str, what: str) -> float:
    """How wide the box of a firm has to be [CSS px]."""
    return max(text_width(name, TEXT_SIZE), text_width(what, LABEL_SIZE)) + 20


def _alt() -> str:
    about = dict(FIRMS)
    told = "; ".join(f"{before} to {after} ({about[after]})" for before, after in WAYS)
    return f"Firms as boxes, joined by arrows: {told}."
