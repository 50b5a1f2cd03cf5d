"""What the TurtleBot3 looks like: bases, tyres and sensors, made from their published measures, in metres.

Every mesh stands in the frame in which the description shows it: a base with its centre in the origin and z = 0 at the
height of base_link; a tyre around its axle, which is y; the laser around base_scan; a camera around camera_link.

Sources: the e-manual (https://emanual.robotis.com/docs/en/platform/turtlebot3/features/) for sizes and parts,
`turtlebot3_description` for the places of sensors and wheels, data sheets for the sizes of sensors. The thickness of
plates and the places of boards on them are drawn after photographs.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from itertools import pairwise

import numpy as np

from rosmini.sim.urdf.meshes.surface import Floats

from . import collada_writer
from .shapes import Shape, box, join, lathe, polygon, prism, rod

PLATE, HOLE = "#454e57", "#181c20"
METAL, BRASS = "#c3cad1", "#b99a5b"
RUBBER, RIM = "#1b1f23", "#5b6670"
SERVO, BATTERY, LABEL = "#2b3138", "#2456a6", "#e8ecf0"
BOARD, PI_BOARD, CHIP = "#1d4f8f", "#1f7a4d", "#0f1316"
LASER, WINDOW = "#171b1f", "#7a1f2b"
LENS, GLASS = "#0b1a2b", "#2f6fb0"

THICKNESS = 0.0045
"""Of a plate."""
PITCH = 0.0125
"""Of its holes."""


# ---- what all have ----


def rounded(length: float, width: float, radius: float, steps: int = 4) -> Floats:
    """The outline (n, 2) of a rectangle with round corners around the origin."""
    points = []
    for quarter, (a, b) in enumerate(((1, 1), (-1, 1), (-1, -1), (1, -1))):
        for step in range(steps):
            angle = (quarter + step / (steps - 1)) * math.pi / 2
            points.append(
                (
                    a * (length / 2 - radius) + radius * math.cos(angle),
                    b * (width / 2 - radius) + radius * math.sin(angle),
                )
            )
    return np.array(points)


def holes(
    half_length: float, half_width: float, tops: Sequence[float], inside: Callable[[float, float], bool], deep: int = 1
) -> Shape:
    """The dark square holes of the plates: all on the highest, and only the `deep` outer rows, which show, below it."""
    size = 0.0036
    tile = np.array([(-size, -size, 0), (size, -size, 0), (size, size, 0), (-size, size, 0)])
    rows, columns = int((half_length - 0.006) / PITCH), int((half_width - 0.006) / PITCH)
    found = []
    for top in tops:
        for i in range(-rows, rows + 1):
            for j in range(-columns, columns + 1):
                edge = abs(i) > rows - deep or abs(j) > columns - deep
                if (top == tops[-1] or edge) and inside(i * PITCH, j * PITCH):
                    found.append(polygon(tile + np.array([i * PITCH, j * PITCH, top + 0.0003])))
    return join(found, HOLE, "holes")


def pillars(places: Sequence[tuple[float, float]], floors: Sequence[float]) -> Shape:
    """Brass supports between plates."""
    return join(
        [rod(0.003, low + THICKNESS, high, 6).at(x, y) for low, high in pairwise(floors) for x, y in places],
        METAL,
        "pillars",
    )


def board(x: float, y: float, z: float, length: float, width: float, colour: str, name: str) -> Shape:
    """A circuit board, on its z."""
    return join(box((x, y, z + 0.0008), (length, width, 0.0016)), colour, name)


def tyre() -> list[Shape]:
    """A wheel with its tyre: 66 mm across and 18 mm wide, with 20 treads; the hub looks to the left."""
    radius, half = 0.033, 0.009
    core = radius - 0.0016
    profile = [
        (0.021, -half), (core - 0.002, -half), (core, -half + 0.002),
        (core, half - 0.002), (core - 0.002, half), (0.021, half),
    ]  # fmt: skip
    treads = [each for i in range(20) for each in _tread(2 * math.pi * i / 20, core - 0.0004, radius, half - 0.0012)]
    spokes = [
        each.moved(_about_y(2 * math.pi * i / 5))
        for i in range(5)
        for each in box((0.0135, 0.0074, 0.0), (0.016, 0.0036, 0.0052))
    ]
    rim = lathe([(0.0215, -half), (0.0215, half), (0.0185, half), (0.0185, -half)], 24, "y")
    return [
        join([lathe(profile, 30, "y"), *treads], RUBBER, "tyre"),
        join([rim, *spokes], RIM, "rim"),
        join([rod(0.0185, 0.0, 0.0065, 20, "y")], SERVO, "inside"),
        join([rod(0.0065, 0.0, 0.0095, 12, "y")], METAL, "hub"),
    ]


def _tread(angle: float, low: float, high: float, half: float) -> Iterator[Shape]:
    """A bar across the tyre: its outer side, its flanks and its ends."""
    edges = [(low, angle - 0.095), (high, angle - 0.07), (high, angle + 0.07), (low, angle + 0.095)]
    ring = [(r * math.sin(a), r * math.cos(a)) for r, a in edges]
    for (x1, z1), (x2, z2) in pairwise(ring):
        yield polygon([(x1, half, z1), (x1, -half, z1), (x2, -half, z2), (x2, half, z2)])
    yield polygon([(x, half, z) for x, z in ring])
    yield polygon([(x, -half, z) for x, z in reversed(ring)])


def _about_y(angle: float) -> Floats:
    c, s = math.cos(angle), math.sin(angle)
    return np.array([[c, 0, s, 0], [0, 1.0, 0, 0], [-s, 0, c, 0], [0, 0, 0, 1]])


def lds() -> list[Shape]:
    """LDS-01, 95.5 x 69.5 x 39.5 mm: a foot, the motor in front, and the turret; the scan plane is z = 0."""
    foot = rounded(0.0955, 0.0695, 0.033, 6) + np.array([0.013, 0.0])
    bottom, top = -0.030, 0.0095
    turret = [(0.0, -0.012), (0.033, -0.012), (0.0345, -0.0045), (0.0345, -0.0045)]
    head = [(0.0345, 0.0045), (0.0345, 0.0075), (0.0325, top), (0.0, top)]
    legs = [rod(0.004, -0.0305, -0.026, 6).at(x, y) for x in (-0.018, 0.044) for y in (-0.024, 0.024)]
    return [
        join([*prism(foot, bottom + 0.003, -0.0125), *legs], "#23292f", "foot"),
        join([lathe(turret[:3], 28), lathe(head, 28)], LASER, "turret"),
        join([lathe([(0.0338, -0.0045), (0.0338, 0.0045)], 28)], WINDOW, "window"),
        join(
            [
                lathe([(0.017, top), (0.017, top + 0.0002), (0.0, top + 0.0002)], 20),
                rod(0.0075, -0.0125, -0.010, 14).at(0.050),
            ],
            RIM,
            "cap",
        ),
    ]


def r200() -> list[Shape]:
    """RealSense R200: a bar of 130 mm with three eyes that look along x; its right end is in the origin."""
    middle = (0.003, 0.065, 0.010)
    outline = rounded(0.130, 0.020, 0.0095, 5)
    turned = np.array([[0, 0, 1.0, middle[0]], [1, 0, 0, middle[1]], [0, 1, 0, middle[2]], [0, 0, 0, 1]])
    body = [each.moved(turned) for each in prism(outline, -0.0045, 0.0045)]
    front = [each.moved(turned) for each in prism(rounded(0.110, 0.014, 0.0065, 4), 0.0045, 0.0052, floor=False)]
    eyes = [rod(0.0042, 0.0, 0.0009, 14, "x").at(middle[0] + 0.0052, y, middle[2]) for y in (0.020, 0.083, 0.110)]
    foot = box((0.000, 0.065, -0.002), (0.012, 0.030, 0.006))
    return [join(body, METAL, "body"), join(front, CHIP, "front"), join(eyes, GLASS, "eyes"), join(foot, SERVO, "foot")]


def pi_camera() -> list[Shape]:
    """Raspberry Pi camera v2.1: a board of 25 x 24 mm that stands upright in a holder and looks along x."""
    x, y, z = 0.005, 0.011, 0.013
    return [
        join(
            [*box((x - 0.004, y, z), (0.004, 0.030, 0.027)), *box((x - 0.001, y, 0.001), (0.015, 0.030, 0.003))],
            SERVO,
            "holder",
        ),
        join(box((x - 0.0012, y, z + 0.0005), (0.0016, 0.025, 0.024)), PI_BOARD, "board"),
        join(box((x + 0.002, y, z), (0.005, 0.0085, 0.0085)), CHIP, "sensor"),
        join([rod(0.0032, 0.0, 0.0014, 12, "x").at(x + 0.0045, y, z)], GLASS, "lens"),
    ]


# ---- the burger ----


def burger_base() -> list[Shape]:
    """Four plates of 138 x 138 mm with motors, battery, OpenCR and Raspberry Pi between; the laser is on top."""
    half, floors = 0.069, [0.006, 0.050, 0.092, 0.1365]
    outline = np.array(
        [
            (0.069, -0.046),
            (0.069, 0.046),
            (0.046, 0.0645),
            (-0.046, 0.0645),
            (-0.069, 0.046),
            (-0.069, -0.046),
            (-0.046, -0.0645),
            (0.046, -0.0645),
        ]
    )
    plates = [each for z in floors for each in prism(outline, z, z + THICKNESS)]
    corners = [(x, y) for x in (-0.050, 0.050) for y in (-0.047, 0.047)]
    motors = [each for side in (-1, 1) for each in box((0.032, side * 0.0405, 0.0275), (0.0285, 0.043, 0.034))]
    horns = [rod(0.0085, -0.0045, 0.0045, 12, "y").at(0.032, side * 0.0665, 0.023) for side in (-1, 1)]
    z1, z2 = floors[1] + THICKNESS, floors[2] + THICKNESS
    return [
        join(plates, PLATE, "plates"),
        holes(half, 0.0645, [z + THICKNESS for z in floors], lambda x, y: abs(x) + abs(y) < 0.100),
        pillars(corners, floors),
        join(motors, SERVO, "motors"),
        join([*horns, _caster(-0.049)], METAL, "horns"),
        *_battery(-0.028, 0.0105, 0.088, 0.030),
        board(0.0, 0.0, z1 + 0.010, 0.105, 0.075, BOARD, "opencr"),
        board(-0.006, 0.0, z2 + 0.010, 0.085, 0.056, PI_BOARD, "raspberry_pi"),
        *_parts_on_boards(z1 + 0.0116, z2 + 0.0116),
        _spacers([(0.0, 0.0, z1, 0.105, 0.075), (-0.006, 0.0, z2, 0.085, 0.056)]),
    ]


def _caster(x: float, y: float = 0.0) -> Shape:
    """The ball that carries the back: its lowest point is on the ground, 10 mm below base_link."""
    radius = 0.008
    steps = [math.pi * (i / 6 - 0.5) for i in range(7)]
    ball = [(radius * max(0.0, math.cos(a)), -0.010 + radius + radius * math.sin(a)) for a in steps]
    ball[0], ball[-1] = (0.0, ball[0][1]), (0.0, ball[-1][1])
    return lathe(ball, 12).at(x, y)


def _battery(x: float, z: float, width: float, length: float) -> list[Shape]:
    height = 0.026
    case = box((x, 0.0, z + height / 2), (length, width, height))
    label = box((x, 0.0, z + height / 2), (length + 0.0006, width * 0.5, height * 0.45))
    return [join(case, BATTERY, "battery"), join(label, LABEL, "label")]


def _parts_on_boards(z1: float, z2: float, x1: float = 0.0, x2: float = -0.006) -> list[Shape]:
    """Chips and sockets of OpenCR and of the computer."""
    chips = [
        *box((x1 + 0.005, 0.004, z1 + 0.001), (0.016, 0.016, 0.002)),
        *box((x1 - 0.030, -0.022, z1 + 0.003), (0.014, 0.020, 0.006)),
        *box((x2 + 0.010, 0.006, z2 + 0.001), (0.015, 0.015, 0.002)),
        *box((x2 - 0.014, -0.008, z2 + 0.001), (0.012, 0.012, 0.002)),
        *box((x2, 0.0245, z2 + 0.004), (0.051, 0.005, 0.008)),
    ]
    sockets = [each for y in (-0.019, 0.0, 0.019) for each in box((x2 - 0.037, y, z2 + 0.007), (0.017, 0.0145, 0.014))]
    sockets += [each for y in (-0.025, -0.010) for each in box((x1 + 0.047, y, z1 + 0.004), (0.012, 0.011, 0.008))]
    return [join(chips, CHIP, "chips"), join(sockets, METAL, "sockets")]


def _spacers(boards: Sequence[tuple[float, float, float, float, float]]) -> Shape:
    return join(
        [
            rod(0.002, z, z + 0.010, 5).at(x + a * (length / 2 - 0.004), y + b * (width / 2 - 0.004))
            for x, y, z, length, width in boards
            for a in (-1, 1)
            for b in (-1, 1)
        ],
        BRASS,
        "spacers",
    )


# ---- the waffles ----


WAFFLE_FLOORS = (0.006, 0.046, 0.0885)
ON_SECOND = WAFFLE_FLOORS[1] + THICKNESS


def waffle_base() -> list[Shape]:
    """What both Waffles share: three plates of 266 x 266 mm with cut corners, motors in front, two casters, OpenCR."""
    half, cut, floors = 0.133, 0.046, WAFFLE_FLOORS
    ring = [(half, half - cut), (half - cut, half)]
    quarters = ((1, 1, 1), (-1, 1, -1), (-1, -1, 1), (1, -1, -1))
    outline = np.array([(a * x, b * y) for a, b, order in quarters for x, y in ring[::order]])
    plates = [each for z in floors for each in prism(outline, z, z + THICKNESS)]
    places = [(0.118 * x, 0.060 * y) for x in (-1, 1) for y in (-1, 1)] + [(0.0, 0.120), (0.0, -0.120)]
    motors = [each for side in (-1, 1) for each in box((0.053, side * 0.104, 0.027), (0.0465, 0.036, 0.0285))]
    horns = [rod(0.0085, -0.0075, 0.0075, 12, "y").at(0.064, side * 0.1285, 0.023) for side in (-1, 1)]
    chips = [
        *box((0.067, 0.004, ON_SECOND + 0.0126), (0.016, 0.016, 0.002)),
        *box((0.092, -0.030, ON_SECOND + 0.0146), (0.014, 0.020, 0.006)),
    ]
    tops = [z + THICKNESS for z in floors]
    return [
        join(plates, PLATE, "plates"),
        holes(half, half, tops, lambda x, y: abs(x) + abs(y) < 2 * half - cut - 0.008, 2),
        pillars(places, floors),
        join(motors, SERVO, "motors"),
        join([*horns, _caster(-0.113, 0.064), _caster(-0.113, -0.064)], METAL, "horns"),
        *_battery(-0.030, tops[0], 0.088, 0.046),
        board(0.072, 0.0, ON_SECOND + 0.010, 0.075, 0.105, BOARD, "opencr"),
        join(chips, CHIP, "chips"),
        _spacers([(0.072, 0.0, ON_SECOND, 0.075, 0.105)]),
    ]


def joule() -> list[Shape]:
    """The Waffle's computer: an Intel Joule on its board, with fins to cool it."""
    x, z = -0.070, ON_SECOND + 0.010
    fins = [each for i in range(7) for each in box((x + (i - 3) * 0.005, 0.0, z + 0.011), (0.0018, 0.040, 0.012))]
    return [
        board(x, 0.0, z, 0.070, 0.085, PI_BOARD, "joule"),
        join([*box((x, 0.0, z + 0.0035), (0.040, 0.042, 0.004)), *fins], METAL, "cooler"),
        _spacers([(x, 0.0, ON_SECOND, 0.070, 0.085)]),
    ]


def raspberry_pi() -> list[Shape]:
    """The Waffle Pi's computer."""
    x, z = -0.070, ON_SECOND + 0.010
    sockets = [each for y in (-0.019, 0.0, 0.019) for each in box((x - 0.037, y, z + 0.0086), (0.017, 0.0145, 0.014))]
    chips = [
        *box((x + 0.010, 0.006, z + 0.0026), (0.015, 0.015, 0.002)),
        *box((x, 0.0245, z + 0.0056), (0.051, 0.005, 0.008)),
    ]
    return [
        board(x, 0.0, z, 0.085, 0.056, PI_BOARD, "raspberry_pi"),
        join(sockets, METAL, "sockets"),
        join(chips, CHIP, "pi_chips"),
        _spacers([(x, 0.0, ON_SECOND, 0.085, 0.056)]),
    ]


MESHES: dict[str, Callable[[], list[Shape]]] = {
    "bases/burger_base.dae": burger_base,
    "bases/waffle_base.dae": waffle_base,
    "bases/waffle_joule.dae": joule,
    "bases/waffle_raspberry_pi.dae": raspberry_pi,
    "sensors/lds.dae": lds,
    "sensors/pi_camera.dae": pi_camera,
    "sensors/r200.dae": r200,
    "wheels/tire.dae": tyre,
}


def files() -> dict[str, str]:
    """The text of every mesh file, by its path below `meshes`."""
    return {name: collada_writer.write(make()) for name, make in MESHES.items()}
