"""An office floor of our own for navigation: rooms on both sides of a corridor, most with two entrances.

A robot starts in the corridor, at the origin. Two people walk around, and three doors open and close.
"""

from __future__ import annotations

import math

from rosmini.sim.motion import Door, Walk
from rosmini.sim.shapes import Box, Cylinder
from rosmini.sim.world import Obstacle, World

from .furniture import block, chair, corner, desk, facing, post, round_table, sofa, table
from .walls import wall

STARTS = (
    (0.0, 0.0, 0.0),
    (-9.0, 0.3, 0.0),
    (9.0, 0.3, math.pi),
    (-4.6, -5.3, math.pi / 2),
    (8.0, -3.0, math.pi / 2),
    (3.2, 1.7, math.pi / 2),
    (-8.0, 1.8, math.pi / 2),
)

OUTER, INNER = 0.2, 0.15
NORTH, SOUTH = 0.975, -0.975
"""The middles of the corridor's walls [m]."""
DOOR_HEIGHT = 1.15
LEAF = 0.05


def office() -> World:
    """The floor, as its file is written from."""
    things = [
        *_walls(),
        *_offices(),
        *_meeting_room(),
        *_copy_room(),
        *_open_plan(),
        *_kitchenette(),
        *_lobby(),
        *_doors(),
        *_people(),
    ]
    return World("office", tuple(things), starts=STARTS)


def _walls() -> list[Obstacle]:
    x, y, o = 10.1, 6.1, OUTER / 2
    north = [(-8.6, -7.6), (-4.6, -3.6), (-0.5, 0.5), (3.6, 4.8), (8.1, 9.0)]
    south = [(-9.0, -7.5), (-0.6, 0.9), (3.4, 4.7), (6.9, 9.1)]
    return [
        *wall("north", (-x - o, y), (x + o, y), OUTER),
        *wall("south", (-x - o, -y), (x + o, -y), OUTER),
        *wall("west", (-x, -6.0), (-x, 6.0), OUTER),
        *wall("east", (x, -6.0), (x, 6.0), OUTER),
        *wall("corridor north", (-10.0, NORTH), (10.0, NORTH), INNER, north),
        *wall("corridor south", (-10.0, SOUTH), (10.0, SOUTH), INNER, south),
        *wall("office 1 east", (-6.025, 1.05), (-6.025, 6.0), INNER),
        *wall("office 2 east", (-2.025, 1.05), (-2.025, 6.0), INNER, [(1.6, 2.6)]),
        *wall("office 3 east", (1.975, 1.05), (1.975, 6.0), INNER),
        *wall("meeting room east", (6.975, 1.05), (6.975, 6.0), INNER),
        *wall("open plan east", (2.075, -6.0), (2.075, -1.05), INNER, [(-3.7, -2.7)]),
        *wall("kitchenette east", (6.075, -6.0), (6.075, -1.05), INNER),
    ]


def _offices() -> list[Obstacle]:
    return [
        *desk("desk 1", (1.7, 0.8), facing(-8.0, 4.0)),
        *chair("desk chair 1", facing(-7.85, 3.35, 90)),
        *block("cupboard 1", (0.45, 2.2), facing(-9.77, 3.4), 1.2, "purple"),
        *post("palm 1", 0.2, facing(-6.4, 5.65), 1.0, "green"),
        *desk("desk 2", (1.7, 0.8), facing(-4.2, 4.6)),
        *chair("desk chair 2", facing(-4.05, 3.95, 90)),
        *block("cupboard 2", (0.45, 1.8), facing(-5.72, 3.6), 1.2, "purple"),
        *chair("guest chair 2", facing(-4.0, 5.55, -90)),
        *desk("desk 3", (1.7, 0.8), facing(0.4, 4.2)),
        *chair("desk chair 3", facing(0.55, 3.55, 90)),
        *block("cupboard 3", (1.8, 0.45), facing(-0.9, 5.77), 1.2, "purple"),
        *sofa("visitors' sofa", (1.5, 0.8), facing(-1.53, 4.1, -90)),
        *post("palm 3", 0.2, facing(1.55, 1.45), 1.0, "green"),
    ]


def _meeting_room() -> list[Obstacle]:
    seats = [
        *((x, 2.92, 90) for x in (3.4, 4.4, 5.4)),
        *((x, 4.68, -90) for x in (3.4, 4.4, 5.4)),
        (2.6, 3.8, 0),
        (6.2, 3.8, 180),
    ]
    return [
        *table("meeting table", (2.8, 1.2), facing(4.4, 3.8)),
        *(each for i, seat in enumerate(seats, 1) for each in chair(f"meeting chair {i}", facing(*seat))),
        *block("screen", (1.8, 0.15), facing(4.4, 5.9), 1.2, "grey"),
        *post("palm 4", 0.2, facing(6.6, 5.65), 1.0, "green"),
    ]


def _copy_room() -> list[Obstacle]:
    return [
        *block("copier", (0.7, 1.1), facing(9.6, 3.2), 1.1, "grey"),
        *block("shelf west", (0.4, 2.6), facing(7.27, 3.6), 1.2, "purple"),
        *block("shelf north", (2.4, 0.4), facing(8.6, 5.78), 1.2, "purple"),
        *block("paper 1", (0.4, 0.3), facing(8.6, 4.4, 25), 0.3, "vermilion", mass=4.0),
        *block("paper 2", (0.4, 0.3), facing(8.9, 2.0, 80), 0.3, "vermilion", mass=4.0),
    ]


def _open_plan() -> list[Obstacle]:
    found = []
    for i, x in enumerate((-8.4, -5.4, -2.4), 1):
        for side, (y, turn) in enumerate(((-3.2, 0), (-4.04, 180)), 1):
            ahead = -1 if turn else 1
            found += desk(f"team desk {i}{side}", (1.6, 0.8), facing(x, y, turn))
            found += chair(f"team chair {i}{side}", facing(x + 0.2 * ahead, y + 0.62 * ahead, -90 * ahead), "sky")
        found += block(f"partition {i}", (1.6, 0.04), facing(x, -3.62), 1.1, "grey")
    return [
        *found,
        *block("lockers", (0.45, 2.4), facing(-9.77, -4.6), 1.2, "purple"),
        *post("palm 5", 0.22, facing(-6.9, -1.4), 1.0, "green"),
        *post("palm 6", 0.22, facing(-1.0, -1.4), 1.0, "green"),
        *block("whiteboard", (0.15, 1.8), facing(1.9, -4.9), 1.2, "grey"),
        *round_table("standing table", 0.4, facing(0.5, -4.6), 1.05),
    ]


def _kitchenette() -> list[Obstacle]:
    counter = ((2.15, -6.0), (6.0, -6.0), (6.0, -4.2), (5.4, -4.2), (5.4, -5.4), (2.15, -5.4))
    return [
        *corner("counter", counter, 0.9, "grey"),
        *block("fridge", (0.65, 0.65), facing(5.66, -3.85), 1.2, "sky"),
        *round_table("coffee table", 0.45, facing(4.3, -3.4)),
        *post("stool 1", 0.16, facing(3.6, -3.75), 0.45, "sky"),
        *post("stool 2", 0.16, facing(4.9, -2.95), 0.45, "sky"),
        *post("bin", 0.17, facing(2.4, -1.35), 0.6, "vermilion"),
    ]


def _lobby() -> list[Obstacle]:
    reception = ((6.9, -5.4), (8.9, -5.4), (8.9, -4.1), (8.35, -4.1), (8.35, -4.85), (6.9, -4.85))
    return [
        *corner("reception", reception, 1.05, "orange"),
        *sofa("lobby sofa", (2.0, 0.85), facing(9.56, -2.6, 90)),
        *post("lobby palm", 0.22, facing(9.7, -1.3), 1.1, "green"),
        *post("lobby fern", 0.22, facing(6.45, -5.7), 0.8, "green"),
        *block("poster stand", (0.6, 0.3), facing(6.5, -1.9), 1.1, "purple"),
    ]


def _doors() -> list[Obstacle]:
    """Two that turn about their left ends, into the rooms, and one that slides along the wall of the corridor."""
    slide = Door(1.2, slide=math.pi, open=15.0, closed=5.0, phase=3.0)
    return [
        _leaf("door of office 1", 1.0, (-8.1, NORTH), Door(hinge=(-0.47, 0.0), open=12.0, closed=6.0)),
        _leaf("door of the copy room", 0.9, (8.55, NORTH), Door(hinge=(-0.42, 0.0), open=10.0, closed=8.0, phase=7.0)),
        _leaf("door of the meeting room", 1.26, (4.2, NORTH + INNER / 2 + LEAF / 2 + 0.01), slide),
    ]


def _leaf(name: str, opening: float, place: tuple[float, float], door: Door) -> Obstacle:
    """The leaf of a door, which is 3 cm narrower than the opening on either side."""
    pose = (round(place[0], 6), round(place[1], 6), 0.0)
    return Obstacle(name, Box(round(opening - 0.06, 6), LEAF), pose, DOOR_HEIGHT, "vermilion", motion=door)


def _people() -> list[Obstacle]:
    body = Cylinder(0.2)
    corridor = Walk(((-7.4, -0.45), (-1.5, -0.45), (-1.5, 0.4), (-7.4, 0.4)), speed=0.6, wait=2.0)
    way = (
        (-8.2, -2.0),
        (1.2, -2.0),
        (1.2, -3.2),
        (3.0, -3.2),
        (3.0, -2.0),
        (4.05, -2.0),
        (4.05, 0.0),
        (0.6, 0.0),
        (0.6, -2.0),
    )
    coffee = Walk(way, speed=0.5, wait=1.0)
    return [
        Obstacle("walker 1", body, (-7.4, -0.45, 0.0), 1.75, "purple", motion=corridor),
        Obstacle("walker 2", body, (-8.2, -2.0, 0.0), 1.75, "purple", motion=coffee),
    ]
