"""Estimate the width of a text without opening a font.

The table contains advance widths in thousandths of the font size for a wide sans-serif face (DejaVu Sans), so a text
in any font of the house style is at most this wide, and the result is the same on every machine.
"""

from __future__ import annotations

from unicodedata import east_asian_width

_WIDTHS = {
    280: "'ijl",
    300: "IJ",
    320: " ,.",
    340: "/:;\\|",
    360: "f-",
    390: "()[]t",
    410: "!r",
    460: '"',
    500: "*_`",
    530: "sz?",
    560: "cL",
    580: "Fk",
    600: "vxyP",
    615: "TYaoe",
    635: "ESbdghnpqu$0123456789{}",
    660: "K",
    690: "AVBRXZ",
    710: "C",
    750: "UHN",
    780: "DG&",
    790: "OQ",
    840: "w#+<=>^~",
    870: "M",
    980: "%m",
    1000: "W@",
}
_ADVANCE = {character: width for width, characters in _WIDTHS.items() for character in characters}
_OTHER = 700
_WIDE = 1050


def text_width(text: str, size: float) -> float:
    """Return the width of a line of sans-serif text, in the unit of `size`; rather too large than too small."""
    total = 0
    for character in text:
        advance = _ADVANCE.get(character)
        if advance is None:
            advance = _WIDE if east_asian_width(character) in "WF" else _OTHER
        total += advance
    return total * size / 1000
