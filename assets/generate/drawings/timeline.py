"""Two pictures of time: what happened to ROS, and which distributions were looked after when."""

from __future__ import annotations

from datetime import date

from rosmini.viz.layout import Rect
from rosmini.viz.style import LABEL_SIZE

from .facts import DISTRIBUTIONS, EVENTS, KEEPERS, TODAY, Distribution, Event
from .sheet import Sheet

MONTHS = ("Jan", "Feb", "Mar", "Apr", "May", "Jun", "Jul", "Aug", "Sep", "Oct", "Nov", "Dec")

YEAR = 27.0
"""The height of a year in the history [CSS px]."""
FIRST, LAST = 2006, 2027
TOP = 10.0
KEEPER = Rect(8, TOP, 116, 0)
AXIS = 166.0
SAID = 206.0
APART = 19.0
"""The least distance of two lines about events [CSS px]."""

ROW = 18.0
LEFT = 150.0
SPAN = (2010, 2032)
PER_YEAR = 19.0


def down(when: float) -> float:
    """Where a moment is in the history [CSS px]; `when` is a year with its fraction."""
    return TOP + (when - FIRST) * YEAR


def spread(places: list[float], apart: float) -> list[float]:
    """Places in order, moved as little as may be, so that each is at least `apart` below the one before."""
    groups: list[list[float]] = []
    for place in places:
        groups.append([place, 1])
        while len(groups) > 1 and groups[-2][0] + (groups[-2][1] + groups[-1][1]) / 2 * apart > groups[-1][0]:
            centre, count = groups.pop()
            other, more = groups[-1]
            groups[-1] = [(centre * count + other * more) / (count + more), count + more]
    return [centre + (at - (count - 1) / 2) * apart for centre, count in groups for at in range(int(count))]


def history() -> str:
    """What happened to ROS, from top to bottom, and who looked after it."""
    return history_sheet().svg("The history of ROS", _history_alt())


def history_sheet() -> Sheet:
    """The drawing of the history."""
    sheet = Sheet(600, down(LAST) + 10)
    for keeper in KEEPERS:
        top, bottom = down(keeper.since), down(keeper.until or _fraction(TODAY))
        first, *rest = keeper.name.split(" (" if "(" in keeper.name else " with ")
        more = tuple(f"({one}" if "(" in keeper.name else f"with {one}" for one in rest)
        sheet.box(
            Rect(KEEPER.x, top + 1, KEEPER.width, bottom - top - 2), "group-fill", "group-line", lines=(first, *more)
        )
    sheet.line((AXIS, down(FIRST)), (AXIS, down(LAST)))
    for year in range(FIRST, LAST + 1):
        sheet.line((AXIS - 4, down(year)), (AXIS + 4, down(year)))
        if year < LAST:
            sheet.words(str(year), AXIS - 8, down(year + 0.5) + 4, size=LABEL_SIZE, colour="muted", anchor="end")
    moments = [down(event.year + ((event.month or 12) - 0.5) / 12) for event in EVENTS]
    for event, moment, place in zip(EVENTS, moments, spread(moments, APART), strict=True):
        colour = "blue" if "ROS 2" in event.what else "orange"
        sheet.line((AXIS, moment), (SAID - 16, place))
        sheet.line((SAID - 16, place), (SAID - 6, place))
        sheet.dot(AXIS, moment, colour)
        sheet.words(_month(event), SAID, place + 4, size=LABEL_SIZE, colour="muted")
        sheet.words(event.what, SAID + 66, place + 4)
    return sheet


def distributions() -> str:
    """Each distribution as a bar from its release to the end of its support."""
    return distributions_sheet().svg("The distributions of ROS", _distributions_alt())


def distributions_sheet() -> Sheet:
    """The drawing of the distributions."""
    height = 42 + ROW * len(DISTRIBUTIONS)
    sheet = Sheet(LEFT + PER_YEAR * (SPAN[1] - SPAN[0]) + 20, height + 22)
    for year in range(SPAN[0], SPAN[1] + 1, 2):
        sheet.line((_across(year), 26), (_across(year), height), "group-line")
        sheet.words(str(year), _across(year), 18, size=LABEL_SIZE, colour="muted", anchor="middle")
    for row, one in enumerate(DISTRIBUTIONS):
        _bar(sheet, one, 32 + ROW * row)
    today = _across(_fraction(TODAY))
    sheet.line((today, 26), (today, height + 2), "vermilion", dashed=True)
    when = f"{TODAY:%B %Y}"
    sheet.words(when, today, height + 16, size=LABEL_SIZE, colour="muted", anchor="middle")
    return sheet


def _bar(sheet: Sheet, one: Distribution, top: float) -> None:
    colour = "topic" if one.ros == 1 else "node"
    sheet.words(one.name, LEFT - 10, top + 12, size=LABEL_SIZE, anchor="end")
    left = _across(_fraction(one.released))
    if one.end is None:
        sheet.dot(left, top + 8, f"{colour}-line")
        return
    right = _across(_fraction(one.end))
    sheet.box(Rect(left, top + 1, right - left, ROW - 5), f"{colour}-fill", f"{colour}-line", corner=3)


def _across(year: float) -> float:
    return LEFT + (year - SPAN[0]) * PER_YEAR


def _fraction(day: date) -> float:
    return day.year + (day.timetuple().tm_yday - 1) / 365.25


def _month(event: Event) -> str:
    return f"{MONTHS[event.month - 1]} {event.year}" if event.month else str(event.year)


def _history_alt() -> str:
    kept = ", ".join(f"{one.name} from {int(one.since)}" for one in KEEPERS)
    told = "; ".join(f"{_month(event)}: {event.what}" for event in EVENTS)
    return f"Timeline from {FIRST} to {LAST - 1}. {told}. Who looked after ROS: {kept}."


def _distributions_alt() -> str:
    def tell(ros: int) -> str:
        return ", ".join(
            f"{one.name} {one.released.year}" + (f" to {one.end.year}" if one.end else "")
            for one in DISTRIBUTIONS
            if one.ros == ros
        )

    return (
        f"Bars from release to end of support. ROS 1: {tell(1)}. ROS 2: {tell(2)}. A line marks {TODAY:%B %Y}: "
        f"{_supported()} are supported."
    )


def _supported() -> str:
    names = [one.name for one in DISTRIBUTIONS if one.end is not None and one.end >= TODAY]
    return ", ".join(names[:-1]) + " and " + names[-1]
