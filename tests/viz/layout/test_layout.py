"""The layered layout: what it promises for every graph."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rosmini.viz.layout import Edge, Layout, Vertex, layered
from rosmini.viz.layout.model import Point, Rect
from rosmini.viz.layout.ranks import feedback_arcs, layers
from rosmini.viz.metrics import text_width

NAMES = [f"v{i}" for i in range(9)]


@st.composite
def graphs(draw: st.DrawFn) -> tuple[list[Vertex], list[Edge]]:
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


def curve(points: tuple[Point, ...], steps: int = 8) -> list[Point]:
    """Points on a chain of cubic curves."""
    result = [points[0]]
    for i in range(0, len(points) - 1, 3):
        (x0, y0), (x1, y1), (x2, y2), (x3, y3) = points[i : i + 4]
        for step in range(1, steps + 1):
            t = step / steps
            a, b, c, d = (1 - t) ** 3, 3 * t * (1 - t) ** 2, 3 * t * t * (1 - t), t**3
            result.append((a * x0 + b * x1 + c * x2 + d * x3, a * y0 + b * y1 + c * y2 + d * y3))
    return result


def inside(point: Point, rect: Rect, margin: float = 0.5) -> bool:
    x, y = point
    return rect.x + margin < x < rect.right - margin and rect.y + margin < y < rect.bottom - margin


def assert_nothing_overlaps(layout: Layout) -> None:
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


arcs_of_six = st.lists(st.tuples(st.integers(0, 5), st.integers(0, 5)).filter(lambda a: a[0] != a[1]), max_size=14)


@given(arcs_of_six)
def test_reversing_the_feedback_arcs_breaks_all_cycles_and_no_fewer_would(arcs):
    back = feedback_arcs(6, arcs)

    def turned(chosen):
        return [(h, t) if i in chosen else (t, h) for i, (t, h) in enumerate(arcs)]

    assert not has_cycle(turned(back))
    kept = [arc for i, arc in enumerate(arcs) if i not in back]
    for i in back:
        assert has_cycle([*kept, arcs[i]])


def has_cycle(arcs) -> bool:
    arcs = list(arcs)
    while True:
        tails = {tail for tail, _ in arcs}
        fewer = [arc for arc in arcs if arc[1] in tails]
        if len(fewer) == len(arcs):
            return bool(arcs)
        arcs = fewer


@given(
    st.lists(st.tuples(st.integers(0, 5), st.integers(0, 5)).filter(lambda a: a[0] != a[1]), max_size=5),
    st.tuples(*(st.integers(0, i) for i in range(5))),
    st.lists(st.integers(1, 2), min_size=10, max_size=10),
)
def test_layers_are_feasible_and_the_shortest_that_there_are(arcs, tree, lengths):
    arcs = [(min(a), max(a)) for a in arcs] + [(parent, i + 1) for i, parent in enumerate(tree)]
    lengths = lengths[: len(arcs)]
    found = layers(6, arcs, lengths)
    assert min(found) == 0
    assert all(found[h] - found[t] >= length for (t, h), length in zip(arcs, lengths, strict=True))
    total = sum(found[h] - found[t] for t, h in arcs)
    assert total == least_total(arcs, lengths)


def least_total(arcs, lengths) -> int:
    """By trying out every layering of six vertices that could be the best one, vertex by vertex in their order."""
    best = 10**6
    limit = sum(lengths)

    def place(vertex: int, layer_of: list[int]) -> None:
        nonlocal best
        if vertex == 6:
            best = min(best, sum(layer_of[h] - layer_of[t] for t, h in arcs))
            return
        lowest = max((layer_of[t] + n for (t, h), n in zip(arcs, lengths, strict=True) if h == vertex), default=0)
        for layer in range(lowest, min(lowest + 4, limit + 1)):
            place(vertex + 1, [*layer_of, layer])

    place(0, [])
    return best


def test_names_must_be_unique_and_edges_have_ends():
    a = Vertex("a", 10, 10)
    with pytest.raises(ValueError, match="unique"):
        layered([a, a], [])
    with pytest.raises(ValueError, match="'b'"):
        layered([a], [Edge("e", "a", "b")])


def test_a_chain_is_a_straight_line():
    layout = layered([Vertex(n, 80, 30) for n in "abc"], [Edge("1", "a", "b", 40, 14), Edge("2", "b", "c", 40, 14)])
    assert len({rect.centre[1] for rect in layout.vertices.values()}) == 1
    assert layout.layers == {"a": 0, "b": 2, "c": 4}


def test_planar_order_is_found():
    # A complete binary tree whose names are shuffled: no two edges need to cross.
    tree = {"m": "cz", "c": "xb", "z": "ya", "x": "12", "b": "34", "y": "56", "a": "78"}
    edges = [Edge(p + c, p, c) for p, children in tree.items() for c in children]
    names = sorted({n for e in edges for n in (e.source, e.target)})
    layout = layered([Vertex(n, 30, 20) for n in names], edges)
    for p in edges:
        for q in edges:
            if layout.layers[p.source] == layout.layers[q.source]:
                above = layout.vertices[p.source].y - layout.vertices[q.source].y
                below = layout.vertices[p.target].y - layout.vertices[q.target].y
                assert above * below >= 0, f"{p.name} crosses {q.name}"


def test_a_feeder_waits_beside_the_vertex_that_it_feeds():
    # The longest path would put `map` into the first layer, far from its only reader.
    vertices = [Vertex(n, 60, 30) for n in ("a", "b", "c", "map")]
    layout = layered(vertices, [Edge(x + y, x, y) for x, y in (("a", "b"), ("b", "c"), ("map", "c"))])
    assert layout.layers == {"a": 0, "b": 1, "c": 2, "map": 1}


@pytest.mark.parametrize("turned", [False, True])
def test_an_edge_of_a_narrow_vertex_clears_the_wide_one_beside_it(turned):
    vertices = [Vertex("a", 20, 30), Vertex("b", 500, 300), Vertex("c", 20, 30), Vertex("target", 20, 30)]
    layout = layered(vertices, [Edge(n, "target", n) if turned else Edge(n, n, "target") for n in "abc"])
    assert layout.vertices["a"].y < layout.vertices["b"].y < layout.vertices["c"].y
    for name in "ac":
        assert not any(inside(p, layout.vertices["b"]) for p in curve(layout.edges[name].points, 40))


def test_components_fill_shelves_of_the_page():
    layout = layered([Vertex(f"v{i:02}", 100, 30) for i in range(12)], [])
    assert layout.width <= 680 and layout.height == 3 * 30 + 2 * 26


def test_text_width_is_that_of_the_widest_usual_face_and_grows_with_the_text():
    assert text_width("", 12) == 0
    assert text_width("/chatter", 10) == pytest.approx(39.5, rel=0.02)
    assert text_width("/chatter", 20) == 2 * text_width("/chatter", 10)
    assert text_width("iii", 10) < text_width("WWW", 10) < text_width("世世世世", 10)
