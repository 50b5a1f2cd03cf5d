"""Wrong answers to the exercises of the chapter catkin."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence

CMAKE = """
cmake_minimum_required(VERSION 3.0.2)
project(weather)
find_package(catkin REQUIRED COMPONENTS message_generation geometry_msgs)
add_message_files(FILES Rain.msg Wind.msg)
add_service_files(FILES Forecast.srv)
generate_messages(DEPENDENCIES geometry_msgs)
catkin_package(CATKIN_DEPENDS message_runtime geometry_msgs)
"""

BOB = {"move_base": "/opt/ros/noetic", "amcl": "~/base_ws", "alarm": "~/base_ws"}
ADA = {"move_base": "~/try_ws", "amcl": "~/base_ws", "alarm": "~/try_ws"}


def wrong(old: str, new: str = "") -> Callable[[], str]:
    """Return what makes the CMakeLists.txt with one place of it changed."""
    assert old in CMAKE
    return lambda: CMAKE.replace(old, new)


def alphabetical() -> Callable[[Mapping[str, Sequence[str]]], list[str]]:
    return sorted


def blind_to_circles() -> Callable[[Mapping[str, Sequence[str]]], list[str]]:
    def build_order(needs: Mapping[str, Sequence[str]]) -> list[str]:
        order: list[str] = []

        def visit(name: str) -> None:
            if name in needs and name not in order and name not in waiting:
                waiting.append(name)
                for other in needs[name]:
                    visit(other)
                order.append(name)

        waiting: list[str] = []
        for name in needs:
            visit(name)
        return order

    return build_order


def waiting_for_ever() -> Callable[[Mapping[str, Sequence[str]]], list[str]]:
    def build_order(needs: Mapping[str, Sequence[str]]) -> list[str]:
        order: list[str] = []
        while len(order) < len(needs):
            for name in needs:
                if name not in order and all(other in order or other not in needs for other in needs[name]):
                    order.append(name)
        return order

    return build_order


def round_and_round() -> Callable[[Mapping[str, Sequence[str]]], list[str]]:
    def build_order(needs: Mapping[str, Sequence[str]]) -> list[str]:
        order: list[str] = []

        def visit(name: str) -> None:
            for other in needs[name]:
                if other in needs and other not in order:
                    visit(other)
            if name not in order:
                order.append(name)

        for name in needs:
            visit(name)
        return order

    return build_order


def with_what_is_built_already() -> Callable[[Mapping[str, Sequence[str]]], list[str]]:
    def build_order(needs: Mapping[str, Sequence[str]]) -> list[str]:
        return [*{other for others in needs.values() for other in others} - {*needs}, *blind_to_circles()(needs)]

    return build_order


MISTAKES = {
    "build_order": [
        alphabetical,
        blind_to_circles,
        round_and_round,
        waiting_for_ever,
        with_what_is_built_already,
        lambda: lambda needs: [],
        lambda: ", ".join,
        lambda: lambda needs: list(needs) * 2,
    ],
    "rain_and_wind": [
        wrong(" Wind.msg"),
        wrong("add_service_files(FILES Forecast.srv)\n"),
        wrong("generate_messages(DEPENDENCIES geometry_msgs)\n"),
        wrong("COMPONENTS message_generation", "COMPONENTS"),
        wrong("project(weather)", "project(wheather)"),
        wrong("message_runtime geometry_msgs", "message_runtime"),
        wrong("catkin_package(CATKIN_DEPENDS message_runtime geometry_msgs)\n"),
        wrong("geometry_msgs)\nadd", "geometry_msgs\nadd"),
        lambda: ["project(weather)"],
    ],
    "which_one": [
        lambda: 42,
        lambda: (BOB,),
        lambda: (BOB, BOB),
        lambda: (ADA, ADA),
        lambda: (BOB, ADA | {"amcl": "/opt/ros/noetic"}),
        lambda: ({"amcl": "~/base_ws"}, ADA),
        lambda: ("~/base_ws", "~/try_ws"),
    ],
}
