"""Colours of SDF materials: four numbers, or the name of one of Gazebo's materials."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

from rosmini.core.markup import Element

GAZEBO: Mapping[str, str] = MappingProxyType(
    {
        # Plain colours: the diffuse values of Gazebo's materials, written as browsers write them.
        "Grey": "#b3b3b3", "Gray": "#b3b3b3", "DarkGrey": "#2d2d2d", "DarkGray": "#2d2d2d", "White": "#ffffff",
        "FlatBlack": "#1a1a1a", "Black": "#000000", "Red": "#ff0000", "RedBright": "#de4212", "Green": "#00ff00",
        "Blue": "#0000ff", "SkyBlue": "#2170b3", "Yellow": "#ffff00", "ZincYellow": "#f8f335", "DarkYellow": "#b3b300",
        "Purple": "#ff00ff",
        "Turquoise": "#00ffff", "Orange": "#ff820c", "Indigo": "#540080", "Gold": "#cca51f",
        # Glowing materials, in their colour.
        "WhiteGlow": "#ffffff", "RedGlow": "#ff0000", "GreenGlow": "#00ff00", "BlueGlow": "#0000ff",
        "YellowGlow": "#ffff00",
        "PurpleGlow": "#ff00ff", "TurquoiseGlow": "#00ffff",
        # Images: about their average colour.
        "Wood": "#a9784a", "WoodFloor": "#b98a5a", "WoodPallet": "#b9935f", "CeilingTiled": "#d9d7d0",
        "PaintedWall": "#cfc9bd",
        "Bricks": "#9c5a45", "CloudySky": "#9fb4c8", "Grass": "#5f8a3f", "Road": "#5a5a5a", "Residential": "#b0a596",
        "Asphalt": "#4a4a4a", "Runway": "#606060", "PioneerBody": "#a01818", "Pedestrian": "#6a5f55", "Tile": "#c9c4ba",
    }
)  # fmt: skip
"""Materials of `gazebo.material` by name, without `Gazebo/` in front."""

HOUSE: Mapping[str, str] = MappingProxyType(
    {
        "#1b2733": "wall", "#9aa5af": "grey", "#0072b2": "blue", "#d97f00": "orange",
        "#00865f": "green", "#d55e00": "vermilion", "#b85c93": "purple", "#3a9bd9": "sky",
    }
)  # fmt: skip
"""The colours of the house style: in a file they mean the named colour, which dark pages change."""


def colour_of(material: Element | None) -> str | None:
    """Return the colour of a `<material>` as #rrggbb: its diffuse colour, or its script's; None if neither is known.

    As in Gazebo, colours in the file take precedence over the script. Raises `SdfError` for an invalid colour.
    """
    if material is None:
        return None
    for tag in ("diffuse", "ambient"):
        found = material.find(tag)
        if found is not None and (tag == "diffuse" or material.find("script") is None):
            return _hex(found)
    return GAZEBO.get(material.word("script/name").removeprefix("Gazebo/"))


def _hex(element: Element) -> str:
    numbers = element.floats(element.text)
    if len(numbers) not in (3, 4) or not all(0 <= number <= 1 for number in numbers):
        raise element.error(f"a colour is red, green, blue and opacity between 0 and 1, not {element.text!r}")
    return "#" + "".join(f"{round(number * 255):02x}" for number in numbers[:3])
