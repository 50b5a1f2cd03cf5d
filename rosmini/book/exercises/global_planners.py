"""Checks of the exercises in the chapter Global planners."""

from __future__ import annotations

import math
from heapq import heappop, heappush
from typing import Any

from rosmini.book.checks import Script, exercise, expect, expect_number, expect_type
from rosmini.book.drives import Drive, courier, navigation
from rosmini.core.time import Time
from rosmini.msgs.geometry_msgs.msg import PoseArray, PoseStamped
from rosmini.msgs.nav_msgs.msg import Path as PlannedPath
from rosmini.navigation.nav_core import pose_stamped

Cell = tuple[int, int]

# ---- guess: a guess for eight directions ----


@exercise("guess", praise="This is the largest guess with which A* still finds the cheapest path.")
def guess(answer: Any) -> None:
    """The cost of the cheapest path on an empty floor with steps in eight directions."""
    pairs = [((3, 5), (9, 5)), ((3, 5), (3, 1)), ((2, 2), (7, 4)), ((8, 1), (4, 7)), ((6, 6), (1, 1)), ((4, 4), (4, 4))]
    for cheapest in (1, 2.5):
        for cell, goal in pairs:
            found = expect_number(answer(cell, goal, cheapest), "cost")
            dx, dy = abs(goal[0] - cell[0]), abs(goal[1] - cell[1])
            cost = cheapest * (max(dx, dy) + (math.sqrt(2) - 1) * min(dx, dy))
            where = f"From {cell} to {goal}, where each cell costs {cheapest}, the path costs {cost:.2f}"
            expect(
                found <= cost * 1.001 + 1e-9,
                f"{where}, but you guess {found:.2f}: this is too high, so A* may miss the cheapest path.",
                "how many of the steps can be diagonal?",
            )
            expect(
                found >= cost * 0.999 - 1e-9,
                f"{where}, but you guess {found:.2f}: this is never too high, but it could be higher.",
                "the number of diagonal steps is the smaller of columns and rows; the other steps are straight",
            )


# ---- trap: a trap for the greedy ----

LARGEST = (30, 12)
"""Largest number of columns and rows of a floor."""
PRICES = {".": 1, ":": 4, "S": 1, "G": 1}


def search(price: dict[Cell, int], start: Cell, goal: Cell, trust: float) -> float:
    """Run the chapter's search with a guess of (columns + rows) * `trust`; return the cost of its path."""

    def ahead(cell: Cell) -> float:
        return trust * (abs(goal[0] - cell[0]) + abs(goal[1] - cell[1]))

    cost: dict[Cell, float] = {start: 0}
    queue, taken = [(ahead(start), start)], set()
    while queue and goal not in taken:
        cell = heappop(queue)[1]
        taken.add(cell)
        x, y = cell
        for near in ((x + 1, y), (x, y + 1), (x - 1, y), (x, y - 1)):
            new = cost[cell] + price.get(near, math.inf)
            if new < cost.get(near, math.inf):
                cost[near] = new
                heappush(queue, (new + ahead(near), near))
    return cost.get(goal, math.inf)


@exercise("trap", praise="The greedy search ran towards the goal and ignored the cost of its steps.")
def trap(answer: Any) -> None:
    """A floor on which the greedy search pays at least twice the lowest cost."""
    expect_type(answer, str, "The floor is", "a string")
    rows = answer.split()
    width, height = LARGEST
    expect(
        rows and len(rows) <= height and max(map(len, rows)) <= width,
        f"The floor has {len(rows)} rows of up to {max(map(len, rows), default=0)} letters.",
        f"write 1 to {height} rows of at most {width} letters",
    )
    strange = sorted(set("".join(rows)) - {*PRICES, "#"})
    expect(not strange, f"The floor contains the letter {strange and strange[0]!r}.", "use only # . : S G")
    letters = {(x, y): letter for y, row in enumerate(reversed(rows)) for x, letter in enumerate(row)}
    places = {each: [cell for cell, letter in letters.items() if letter == each] for each in "SG"}
    for each, cells in places.items():
        expect(len(cells) == 1, f"There are {len(cells)} letters {each} on the floor.", "use one S and one G")
    price = {cell: PRICES[letter] for cell, letter in letters.items() if letter != "#"}
    (start,), (goal,) = places["S"], places["G"]
    least, greedy = (search(price, start, goal, trust) for trust in (0, 1000))
    expect(least < math.inf, "No path leads from S to G.", "leave a path around the walls")
    expect(
        greedy >= 2 * least,
        f"The greedy search pays {greedy:g}; the cheapest path costs {least:g}.",
        "make it pay twice as much: put carpet on the straight line, and bare floor beside it",
    )


# ---- tuned: tune it ----

HALL, SOFA = (-2.98, 1.02, 0.0), (-4.48, -4.48, 0.0)
NEUTRAL = 100
HIGHEST, AVERAGE = 135, 45.0
PLANNER = "global_planner/GlobalPlanner"


@exercise("tuned", praise="The costs differ wherever the planner has a choice.")
def tuned(answer: Any) -> Any:
    """Settings that keep the plan away from the sofa and below the highest costs, and a drive."""
    drive, settings = courier(answer, "settings", HALL)
    with drive:
        expect(
            settings.get("base_global_planner") == PLANNER and isinstance(settings.get("GlobalPlanner"), dict),
            f"The planner is not {PLANNER}, or has no settings.",
            "change only cost_factor",
        )
        own = settings["GlobalPlanner"]
        expect(own.get("neutral_cost") == NEUTRAL, "neutral_cost has changed.", f"it must stay {NEUTRAL}")
        factor = expect_number(own.get("cost_factor"), "cost_factor")
        expect(0.01 <= factor <= 5.0, f"cost_factor is {factor:g}.", "it must be from 0.01 to 5.0")
        grid = drive.graph.nodes["/move_base"].program.global_costmap.grid
        costs: list[int] = []

        def look(plan: Any) -> None:
            """Look up the costs of the first plan while the costmap is still the one that it was made for."""
            points = [] if costs else [each.pose.position for each in plan.poses]
            costs.extend(grid.cost(*grid.world_to_map(point.x, point.y)) for point in points)

        drive.graph.node("watch").subscriber("/move_base/GlobalPlanner/plan", PlannedPath, look)
        off = drive.go(SOFA, 90.0)
        average = sum(costs) / len(costs)
        said = f"The plan crosses cells with costs of {average:.0f} on average and {max(costs)} at most"
        ceiling = (252 - NEUTRAL) / factor
        expect(average <= AVERAGE, f"{said}: it keeps too close to obstacles.", _advice(ceiling))
        expect(max(costs) <= HIGHEST, f"{said}: at one point it is too close to an obstacle.", _advice(ceiling))
        expect(off < 0.25, f"After at most 90 s the robot is {off:.1f} m from its goal.")
        return drive.view()


def _advice(ceiling: float) -> str:
    if ceiling > 252:
        return "give the costmap more weight"
    return f"above a cost of {ceiling:.0f} all cells cost the same: give the costmap less weight"


# ---- first_delivery: the nearest recipient ----

Point = tuple[float, float]
START = (-3.0, 1.0, 0.0)
BED = (6.02, -3.48)
DELIVERIES: tuple[tuple[tuple[Point, ...], Point | None], ...] = (
    ((BED, (9.0, 0.0)), None),
    (((-2.6, -1.0), (0.3, 0.8), (1.2, -0.9)), (0.3, 0.8)),
    ((BED, (-5.0, 0.5), (0.3, 0.8)), (-5.0, 0.5)),
)
"""Recipients, and the one with the shortest plan: one on a bed and one outside, one behind a wall, and one on a bed."""


@exercise("first_delivery", praise="The node compares plans, not straight lines.")
def first_delivery(answer: Script) -> Any:
    """A node that sends the robot to the recipient with the shortest plan."""
    for places, wanted in DELIVERIES:
        with Drive(navigation(START, {})) as drive:
            goals: list[Any] = []
            desk = drive.graph.node("office")
            desk.subscriber("/move_base_simple/goal", PoseStamped, goals.append)
            recipients = desk.publisher("recipients", PoseArray, queue_size=1)
            drive.start(answer)
            drive.run(1.0)
            recipients.publish(_recipients(places))
            drive.run(1.0)
            where = f"For the recipients {', '.join(map(str, places))}"
            if wanted is None:
                expect(
                    not goals,
                    f"{where} you sent a goal, but none of them has a plan.",
                    "publish the goal only if its plan is not empty",
                )
                continue
            expect(len(goals) == 1, f"{where} you sent {len(goals)} goals.", "publish one goal for each message")
            position = goals[0].pose.position
            expect(
                math.dist((position.x, position.y), wanted) < 0.01,
                f"{where} you sent the robot to ({position.x:g}, {position.y:g}), and {wanted} has the shortest plan.",
                "add up the distances from each pose of a plan to the next; an empty plan is no plan",
            )
            expect(
                goals[0].header.frame_id == "map", f"{where} the goal has no frame.", "take the header of the message"
            )
            drive.finish(30.0)
            off = math.dist(drive.robot.truth()[:2], wanted)
            expect(off < 0.25, f"{where} the robot is {off:.1f} m from its goal after 30 s.")
            view = drive.view()
    return view


def _recipients(places: tuple[Point, ...]) -> Any:
    message = PoseArray()
    message.header.frame_id = "map"
    message.poses = [pose_stamped("map", Time(), (x, y, 0.0)).pose for x, y in places]
    return message
