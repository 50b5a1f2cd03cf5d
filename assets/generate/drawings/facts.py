"""What the drawings show: dates of ROS, as its own pages give them; their sources are cited on the pages of the book.

Distributions of ROS 1 are those of wiki.ros.org/Distributions and REP 3, those of ROS 2 of docs.ros.org (Releases).
"""

from __future__ import annotations

from dataclasses import dataclass
from datetime import date

TODAY = date(2026, 11, 22)
"""When the facts were last looked up."""


@dataclass(frozen=True)
class Distribution:
    """A distribution: its name, of which ROS it is, when it came, and when its support ends; None if nobody says.

    `end` is the last day of the month where only the month is published.
    """

    name: str
    ros: int
    released: date
    end: date | None


@dataclass(frozen=True)
class Event:
    """Something that happened: the year, the month if that is known, and one line about it."""

    year: int
    month: int | None
    what: str


@dataclass(frozen=True)
class Keeper:
    """Who looked after ROS, from one year (with its fraction) to another; `until` is None for those who still do."""

    name: str
    since: float
    until: float | None


DISTRIBUTIONS = (
    Distribution("Box Turtle", 1, date(2010, 3, 2), None),
    Distribution("C Turtle", 1, date(2010, 8, 2), None),
    Distribution("Diamondback", 1, date(2011, 3, 2), None),
    Distribution("Electric Emys", 1, date(2011, 8, 30), None),
    Distribution("Fuerte Turtle", 1, date(2012, 4, 23), None),
    Distribution("Groovy Galapagos", 1, date(2012, 12, 31), date(2014, 7, 31)),
    Distribution("Hydro Medusa", 1, date(2013, 9, 4), date(2015, 5, 31)),
    Distribution("Indigo Igloo", 1, date(2014, 7, 22), date(2019, 4, 30)),
    Distribution("Jade Turtle", 1, date(2015, 5, 23), date(2017, 5, 31)),
    Distribution("Kinetic Kame", 1, date(2016, 5, 23), date(2021, 4, 30)),
    Distribution("Lunar Loggerhead", 1, date(2017, 5, 23), date(2019, 5, 31)),
    Distribution("Melodic Morenia", 1, date(2018, 5, 23), date(2023, 6, 27)),
    Distribution("Noetic Ninjemys", 1, date(2020, 5, 23), date(2025, 5, 31)),
    Distribution("Ardent Apalone", 2, date(2017, 12, 8), date(2018, 12, 31)),
    Distribution("Bouncy Bolson", 2, date(2018, 7, 2), date(2019, 7, 31)),
    Distribution("Crystal Clemmys", 2, date(2018, 12, 14), date(2019, 12, 31)),
    Distribution("Dashing Diademata", 2, date(2019, 5, 31), date(2021, 5, 31)),
    Distribution("Eloquent Elusor", 2, date(2019, 11, 22), date(2020, 11, 30)),
    Distribution("Foxy Fitzroy", 2, date(2020, 6, 5), date(2023, 6, 20)),
    Distribution("Galactic Geochelone", 2, date(2021, 5, 23), date(2022, 12, 9)),
    Distribution("Humble Hawksbill", 2, date(2022, 5, 23), date(2027, 5, 31)),
    Distribution("Iron Irwini", 2, date(2023, 5, 23), date(2024, 12, 4)),
    Distribution("Jazzy Jalisco", 2, date(2024, 5, 23), date(2029, 5, 31)),
    Distribution("Kilted Kaiju", 2, date(2025, 5, 23), date(2026, 12, 31)),
    Distribution("Lyrical Luth", 2, date(2026, 5, 22), date(2031, 5, 31)),
)

EVENTS = (
    Event(2006, None, "Willow Garage is founded"),
    Event(2007, 11, "ROS gets its name and a public repository"),
    Event(2009, 5, "The paper on ROS, at ICRA in Kobe"),
    Event(2010, 1, "ROS 1.0"),
    Event(2010, 3, "Box Turtle, the first distribution"),
    Event(2010, 5, "Eleven PR2 robots for eleven laboratories"),
    Event(2010, 11, "The first TurtleBot is built"),
    Event(2012, 5, "The foundation, OSRF; the first ROSCon"),
    Event(2013, 2, "ROS moves from Willow Garage to OSRF"),
    Event(2013, 8, "Research at Willow Garage ends"),
    Event(2014, 9, "Plans for ROS 2, at ROSCon in Chicago"),
    Event(2015, 8, "ROS 2: first alpha version"),
    Event(2017, 5, "TurtleBot3"),
    Event(2017, 12, "Ardent, the first distribution of ROS 2"),
    Event(2020, 5, "Noetic, the last distribution of ROS 1"),
    Event(2022, 5, "Humble, ROS 2 with five years of support"),
    Event(2022, 12, "Intrinsic buys OSRF's firm, OSRC"),
    Event(2024, 3, "The alliance, OSRA"),
    Event(2025, 5, "Noetic gets its last updates: the end of ROS 1"),
    Event(2026, 5, "Lyrical, the latest of ROS 2"),
)

KEEPERS = (
    Keeper("Stanford", 2006.0, 2007.0),
    Keeper("Willow Garage", 2007.0, 2013.1),
    Keeper("OSRF (Open Robotics)", 2013.1, 2024.2),
    Keeper("OSRF with OSRA", 2024.2, None),
)
