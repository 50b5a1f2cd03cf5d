"""The pictures outside of notebooks: `python -m rosmini.book.pictures` draws them again."""

from __future__ import annotations

from typing import TYPE_CHECKING

from rosmini.book.checkout import find_checkout

if TYPE_CHECKING:
    from pathlib import Path


def talker_and_listener() -> str:
    """The graph of the README's example, as SVG."""
    from rosmini.graph import Graph
    from rosmini.msgs import message_class
    from rosmini.viz import rqt_graph

    string = message_class("std_msgs/String")
    with Graph() as graph:
        graph.node("talker").publisher("chatter", string, queue_size=10)
        graph.node("listener").subscriber("chatter", string, print)
        return rqt_graph(graph).svg or ""


def draw_all(checkout: Path) -> list[Path]:
    """Draw each picture into `checkout`; the files that were written."""
    target = checkout / "book" / "static" / "talker_listener.svg"
    target.write_text(talker_and_listener() + "\n", encoding="utf-8", newline="\n")
    return [target]


if __name__ == "__main__":
    for written in draw_all(find_checkout()):
        print(written)
