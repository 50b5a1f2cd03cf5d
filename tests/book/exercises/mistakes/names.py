"""Wrong answers to the exercises of the chapter Names."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

from rosmini.core.graph import Graph
from rosmini.msgs import message_class

if TYPE_CHECKING:
    from collections.abc import Callable


def _resolve(
    *, in_root: str = "/", private: Callable[[str, str], str] = lambda node, rest: f"{node}/{rest}"
) -> Callable[[], Any]:
    def resolve(name: str, namespace: str, node_name: str) -> str:
        if name[0] == "/":
            return name
        if name[0] == "~":
            return private(node_name, name[1:])
        return (in_root if namespace == "/" else namespace + "/") + name

    return lambda: resolve


# ---- start_reporter: one report for all ----


def _reporter(
    battery: str = "battery", report: str = "/report", text: str = "{ns}: {value:.1f} V", name: str = "reporter"
) -> Callable[[], Any]:
    def start(graph: Graph, namespace: str) -> None:
        node = graph.node(name, namespace=namespace)
        out = node.publisher(report, message_class("std_msgs/String"), queue_size=10)
        node.subscriber(
            battery,
            message_class("std_msgs/Float32"),
            lambda message: out.publish(text.format(ns=node.namespace, value=message.data, name=node.name)),
        )

    return lambda: start


def _without_namespace(graph: Graph, _: str) -> None:
    _reporter()()(graph, "/")


# ---- find_file: find the file ----


def _finder(*, manifest: bool = True, first_only: bool = True, check: bool = True, cut: int = 1) -> Callable[[], Any]:
    def find(url: str, folders: list[Path]) -> Path | None:
        name, *rest = url.removeprefix("package://").split("/", cut)
        for folder in folders:
            if (folder / name / ("package.xml" if manifest else "")).exists():
                file = folder.joinpath(name, rest[0])
                if file.exists() or (first_only and not check):
                    return file
                if first_only:
                    return None
        return None

    return lambda: find


def _last_first(url: str, folders: list[Path]) -> Path | None:
    found: Path | None = _finder()()(url, folders[::-1])
    return found


MISTAKES = {
    "resolve": [
        _resolve(in_root="//"),
        _resolve(in_root=""),
        _resolve(private=lambda node, rest: f"{node}/~{rest}"),
        _resolve(private=lambda node, rest: f"{node.rpartition('/')[0]}/{rest}"),
        _resolve(private=lambda node, rest: node + rest),
        lambda: lambda name, namespace, _: name if name[0] == "/" else f"{namespace.rstrip('/')}/{name}",
        lambda: lambda name, namespace, _: f"{namespace.rstrip('/')}/{name}",
        lambda: lambda *_: "/map",
    ],
    "arguments": [
        list,
        lambda: ["__ns:=/crew", "__name:=eve", "chatter:=/crew/radio/news", "_text:=landed"],
        lambda: ["__ns:=/crew", "__name:=eve", "chatter:=news", "_text:=landed"],
        lambda: ["__ns:=/crew", "_name:=eve", "chatter:=radio/news", "_text:=landed"],
        lambda: ["__ns:=/crew", "__name:=eve", "chatter:=radio/news", "text:=landed"],
        lambda: ["__name:=eve", "chatter:=/crew/radio/news", "_text:=landed"],
        lambda: ["__ns:=/crew", "__name:=eve", "/chatter:=radio/news", "_text:=landed"],
        lambda: ["__ns:=/crew", "__name:=crew/eve", "chatter:=radio/news", "_text:=landed"],
        lambda: "__ns:=/crew __name:=eve chatter:=radio/news _text:=landed",
    ],
    "start_reporter": [
        _reporter(battery="/battery"),
        _reporter(battery="~battery"),
        _reporter(report="report"),
        _reporter(text="{name}: {value:.1f} V"),
        _reporter(text="{ns}: {value} V"),
        _reporter(name="reporter1"),
        lambda: _without_namespace,
        lambda: lambda graph, namespace: graph.node("reporter", namespace=namespace),
    ],
    "find_file": [
        _finder(manifest=False),
        _finder(first_only=False),
        _finder(check=False),
        _finder(cut=2),
        lambda: _last_first,
        lambda: lambda _, folders: folders[0],
    ],
}
