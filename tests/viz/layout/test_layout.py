"""The layered layout: what it promises for every graph."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rosmini.viz.layout import Edge, Vertex, layered
from rosmini.viz.layout.model import Rect
from rosmini.viz.metrics import text_width

NAMES = [f"v{i}" for i in range(9)]


@st.composite
def graphs(draw):
    names = draw(st.lists(st.sampled_from(NAMES), unique=True, min_size=1))
    group = st.sampled_from([(), (), ("g",), ("h",), ("g", "i")])
    vertices = [
        Vertex(
            name,
            draw(st.integers(20, 200)),
            draw(st.integers(20, 80)),
            draw(st.sampled_from(["box", "ellipse"])),
            draw(group),
        )
        for name in names
    ]
    ends = st.tuples(st.sampled_from(names), st.sampled_from(names), st.sampled_from([0, 0, 40, 120]))
    found = draw(st.lists(ends, max_size=16))
    edges = [Edge(f"e{i}", a, b, width, 14 if width else 0) for i, (a, b, width) in enumerate(found)]
    return vertices, edges


def curve(points, steps=8):
    """Points on a chain of cubic curves."""
    result = [points[0]]
    for i in range(0, len(points) - 1, 3):
        (x0, y0), (x1, y1), (x2, y2), (x3, y3) = points[i : i + 4]
        for step in range(1, steps + 1):
            t = step / steps
            a, b, c, d = (1 - t) ** 3, 3 * t * (1 - t) ** 2, 3 * t * t * (1 - t), t**3
            result.append((a * x0 + b * x1 + c * x2 + d * x3, a * y0 + b * y1 + c * y2 + d * y3))
    return result


def inside(point, rect, margin=0.5):
    x, y = point
    return rect.x + margin < x < rect.right - margin and rect.y + margin < y < rect.bottom - margin


def assert_nothing_overlaps(layout):
    boxes = list(layout.vertices.items()) + [(n, r.label) for n, r in layout.edges.items() if r.label]
    for i, (name, box) in enumerate(boxes):
        for other, another in boxes[:i]:
            assert not box.overlaps(another, 0.01), f"{name} overlaps {other}"


@given(graphs(), st.sampled_from(["right", "down"]))
def test_neither_vertices_nor_labels_overlap(graph, direction):
    assert_nothing_overlaps(layered(*graph, direction=direction))


@given(graphs())
def test_no_edge_runs_over_a_strange_vertex_or_label(graph):
    vertices, edges = graph
    layout = layered(vertices, edges)
    for edge in edges:
        points = curve(layout.edges[edge.name].points)
        for name, rect in layout.vertices.items():
            if name not in (edge.source, edge.target):
                assert not any(inside(p, rect) for p in points), f"{edge} runs over {name}"
        for other, route in layout.edges.items():
            if route.label and other != edge.name and edge.source != edge.target:
                assert not any(inside(p, route.label) for p in points), f"{edge} runs over the label of {other}"


@given(graphs())
def test_edges_lead_from_border_to_border_along_the_layers(graph):
    vertices, edges = graph
    layout = layered(vertices, edges)
    for edge in edges:
        route = layout.edges[edge.name]
        source, target = layout.vertices[edge.source], layout.vertices[edge.target]
        (x0, y0), (x1, y1) = route.points[0], route.points[-1]
        assert source.x - 0.1 <= x0 <= source.right + 0.1 and source.y - 0.1 <= y0 <= source.bottom + 0.1
        assert target.x - 0.1 <= x1 <= target.right + 0.1 and target.y - 0.1 <= y1 <= target.bottom + 0.1
        if edge.source != edge.target:
            rises = layout.layers[edge.source] < layout.layers[edge.target]
            assert rises != route.reversed
            assert (x0 < x1) == rises


@given(graphs())
def test_groups_hold_their_members_and_nothing_else(graph):
    vertices, edges = graph
    layout = layered(vertices, edges)
    for path, box in layout.groups.items():
        for vertex in vertices:
            rect = layout.vertices[vertex.name]
            if vertex.groups[: len(path)] == path:
                assert box.x <= rect.x and box.y <= rect.y and rect.right <= box.right and rect.bottom <= box.bottom
            else:
                assert not box.overlaps(rect, 0.01), f"{vertex.name} lies in {path}"
        for other, another in layout.groups.items():
            if other[: len(path)] != path and path[: len(other)] != other:
                assert not box.overlaps(another, 0.01)


@given(graphs(), st.randoms(use_true_random=False))
def test_the_order_of_the_input_does_not_matter(graph, random):
    vertices, edges = graph
    before = layered(vertices, edges)
    random.shuffle(vertices)
    random.shuffle(edges)
    assert layered(vertices, edges) == before


@given(graphs(), st.sampled_from(["right", "down"]))
def test_everything_is_within_the_page(graph, direction):
    layout = layered(*graph, direction=direction)
    page = Rect(-0.01, -0.01, layout.width + 0.02, layout.height + 0.02)
    boxes = [*layout.vertices.values(), *layout.groups.values()]
    boxes += [route.label for route in layout.edges.values() if route.label]
    for box in boxes:
        assert page.x <= box.x and page.y <= box.y and box.right <= page.right and box.bottom <= page.bottom
    for route in layout.edges.values():
        assert all(inside(point, page, 0) for point in curve(route.points))


def test_names_must_be_unique_and_edges_have_ends():
    a = Vertex("a", 10, 10)
    with pytest.raises(ValueError, match="unique"):
        layered([a, a], [])
    with pytest.raises(ValueError, match="'b'"):
        layered([a], [Edge("e", "a", "b")])


def test_text_width_is_that_of_the_widest_usual_face_and_grows_with_the_text():
    assert text_width("", 12) == 0
    assert text_width("/chatter", 10) == pytest.approx(39.5, rel=0.02)
    assert text_width("/chatter", 20) == 2 * text_width("/chatter", 10)
    assert text_width("iii", 10) < text_width("WWW", 10) < text_width("世世世世", 10)
