"""A furnished house of our own: seven rooms and a hall, large enough for several robots, with its origin in the hall.

It is not the house of ROBOTIS's package of the same name, but the ground is free where ROBOTIS's launch
files put robots.
"""

from __future__ import annotations

import math

from rosmini.sim.shapes import Sphere
from rosmini.sim.world import Obstacle, World

from .furniture import bed, block, chair, corner, desk, facing, post, round_table, sofa, table
from .walls import wall

STARTS = (
    (-3.0, 1.0, 0.0),  # where turtlebot3_house.launch puts a robot
    (-7.0, -1.0, 0.0),  # where multi_turtlebot3.launch puts three
    (7.0, -1.0, math.pi),
    (0.5, 3.0, 0.0),
    (0.8, -1.2, -math.pi / 2),
    (5.4, 2.2, 0.0),
    (-6.8, 2.3, math.pi / 2),
)

OUTER, INNER = 0.2, 0.15


def house() -> World:
    """The house, as its file is written from."""
    things = [
        *_walls(),
        *_living_room(),
        *_kitchen(),
        *_dining_room(),
        *_bathroom(),
        *_child_s_room(),
        *_study(),
        *_bedroom(),
        *_hobby_room(),
    ]
    return World("house", tuple(things), starts=STARTS)


def _walls() -> list[Obstacle]:
    x, y, o = 8.1, 5.1, OUTER / 2
    west, east, north, south = -3.525, 3.475, 1.675, -0.075
    return [
        *wall("north", (-x - o, y), (x + o, y), OUTER),
        *wall("south", (-x - o, -y), (x + o, -y), OUTER),
        *wall("west", (-x, -5.0), (-x, 5.0), OUTER, [(-0.5, 0.5)]),
        *wall("east", (x, -5.0), (x, 5.0), OUTER),
        *wall("kitchen south", (-8.0, north), (-3.6, north), INNER, [(-5.4, -4.4)]),
        *wall("hall north", (-3.6, north), (3.55, north), INNER, [(-1.4, -0.4), (2.15, 3.05)]),
        *wall("hobby room south", (3.55, north), (8.0, north), INNER, [(4.4, 5.4)]),
        *wall("kitchen east", (west, 1.75), (west, 5.0), INNER, [(2.6, 3.8)]),
        *wall("living room east", (west, -5.0), (west, 1.6), INNER, [(0.3, 1.3)]),
        *wall("bedroom west", (east, -5.0), (east, 1.6), INNER, [(0.3, 1.3)]),
        *wall("bathroom east", (east, 1.75), (east, 5.0), INNER),
        *wall("bathroom west", (1.675, 1.75), (1.675, 5.0), INNER),
        *wall("hall south", (-3.45, south), (3.4, south), INNER, [(-1.5, -0.6), (1.2, 2.1)]),
        *wall("study west", (-0.025, -5.0), (-0.025, -0.15), INNER),
        *block("front door", (0.06, 1.0), (-8.1, 0.0, 0.0), 1.15, "vermilion"),
    ]


def _living_room() -> list[Obstacle]:
    return [
        *block("television bench", (0.4, 1.8), facing(-7.78, -3.0), 0.45, "grey"),
        *sofa("sofa", (2.2, 0.9), facing(-4.75, -3.0, 90)),
        *table("coffee table", (1.1, 0.6), facing(-6.1, -3.0, 90), 0.45),
        *sofa("armchair", (0.9, 0.85), facing(-6.3, -4.4), "blue"),
        *block("bookshelf", (0.3, 1.4), facing(-3.76, -0.9), 1.2, "purple"),
        *post("floor lamp", 0.14, facing(-4.0, -4.6), 1.2, "grey"),
        *block("sideboard", (1.4, 0.4), facing(-6.6, 1.38), 0.8, "purple"),
        *post("palm", 0.2, facing(-7.7, 1.3), 1.1, "green"),
        *post("fern", 0.18, facing(-7.7, -4.65), 0.7, "green"),
    ]


def _kitchen() -> list[Obstacle]:
    counter = ((-8.0, 2.6), (-7.4, 2.6), (-7.4, 4.4), (-5.1, 4.4), (-5.1, 5.0), (-8.0, 5.0))
    return [
        *corner("counter", counter, 0.9, "grey"),
        *block("fridge", (0.65, 0.65), facing(-4.7, 4.66), 1.2, "sky"),
        *block("kitchen island", (1.3, 0.6), facing(-5.7, 3.4), 0.9, "orange"),
        *post("bar stool 1", 0.16, facing(-6.0, 2.85), 0.65, "sky"),
        *post("bar stool 2", 0.16, facing(-5.4, 2.85), 0.65, "sky"),
        *post("bin", 0.16, facing(-7.75, 2.0), 0.5, "vermilion"),
    ]


def _dining_room() -> list[Obstacle]:
    seats = [
        (-1.75, 2.95, 90),
        (-0.85, 2.95, 90),
        (-1.75, 4.25, -90),
        (-0.85, 4.25, -90),
        (-2.55, 3.6, 0),
        (-0.05, 3.6, 180),
    ]
    return [
        *table("dining table", (1.9, 0.9), facing(-1.3, 3.6)),
        *(each for i, seat in enumerate(seats, 1) for each in chair(f"dining chair {i}", facing(*seat))),
        *block("china cabinet", (1.5, 0.4), facing(0.75, 4.78), 1.2, "purple"),
        *post("ficus", 0.2, facing(1.3, 2.05), 1.0, "green"),
    ]


def _bathroom() -> list[Obstacle]:
    return [
        *block("bathtub", (1.6, 0.75), facing(2.575, 4.61), 0.55, "sky"),
        *block("toilet", (0.65, 0.4), facing(2.09, 3.55), 0.75, "sky"),
        *block("washbasin", (0.45, 0.6), facing(3.17, 3.55), 0.85, "sky"),
        *block("washing machine", (0.55, 0.55), facing(3.12, 2.75), 0.85, "grey"),
    ]


def _child_s_room() -> list[Obstacle]:
    ball = Obstacle("ball", Sphere(0.11), (-1.7, -2.4, 0.0), 0.22, "vermilion", 0.4)
    return [
        *bed("bunk bed", (2.0, 1.0), facing(-2.94, -3.97, 90)),
        *desk("child's desk", (1.2, 0.6), facing(-0.41, -3.1, 90)),
        *chair("child's chair", facing(-0.95, -3.0, 0)),
        *block("wardrobe", (1.3, 0.55), facing(-1.5, -4.72), 1.2, "purple"),
        *block("toy shelf", (0.3, 1.1), facing(-3.29, -1.5), 0.7, "orange"),
        *block("toy box", (0.4, 0.3), facing(-2.5, -2.1, 20), 0.3, "vermilion", mass=2.0),
        ball,
    ]


def _study() -> list[Obstacle]:
    return [
        *desk("writing desk", (1.6, 0.75), facing(1.9, -2.6)),
        *chair("office chair", facing(2.05, -3.2, 90)),
        *block("bookcase west", (0.32, 2.4), facing(0.22, -3.4), 1.2, "purple"),
        *block("bookcase south", (2.0, 0.32), facing(2.1, -4.83), 1.2, "purple"),
        *sofa("reading chair", (0.85, 0.8), facing(2.95, -0.75, 180), "blue"),
        *post("lamp", 0.14, facing(3.2, -1.5), 1.2, "grey"),
        *post("rubber plant", 0.2, facing(0.35, -0.5), 0.9, "green"),
    ]


def _bedroom() -> list[Obstacle]:
    return [
        *bed("double bed", (2.1, 1.8), facing(6.94, -3.3, 180)),
        *block("nightstand 1", (0.42, 0.42), facing(7.77, -4.5), 0.5, "orange"),
        *block("nightstand 2", (0.42, 0.42), facing(7.77, -2.1), 0.5, "orange"),
        *block("bench", (0.4, 1.4), facing(5.6, -3.3), 0.45, "orange"),
        *block("large wardrobe", (0.6, 2.6), facing(3.87, -3.4), 1.2, "purple"),
        *block("dresser", (1.3, 0.45), facing(7.0, 1.36), 0.8, "purple"),
        *sofa("easy chair", (0.85, 0.8), facing(4.05, -0.9, -90), "blue"),
        *post("orchid", 0.18, facing(7.7, 0.5), 0.8, "green"),
    ]


def _hobby_room() -> list[Obstacle]:
    return [
        *desk("workbench", (2.2, 0.65), facing(6.5, 4.65), "orange"),
        *block("tool shelf", (0.4, 1.6), facing(7.78, 2.9), 1.2, "purple"),
        *round_table("round table", 0.5, facing(4.4, 3.9)),
        *post("stool 1", 0.16, facing(5.1, 3.9), 0.45, "sky"),
        *post("stool 2", 0.16, facing(4.1, 3.2), 0.45, "sky"),
        *block("crate 1", (0.4, 0.3), facing(6.6, 2.6, 15), 0.3, "vermilion", mass=2.5),
        *block("crate 2", (0.35, 0.35), facing(6.2, 3.3, 40), 0.3, "vermilion", mass=1.5),
        *post("umbrella stand", 0.13, facing(3.75, 2.0), 0.6, "grey"),
    ]
