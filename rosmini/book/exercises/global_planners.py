"""Checks of the exercises in the chapter Global planners."""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import cache
from heapq import heappop, heappush
from itertools import pairwise
from typing import Any

import numpy as np

from rosmini.book.checks import Script, exercise, expect, expect_number, expect_type
from rosmini.book.trials import TurtleTrial
from rosmini.core.maps import load_map
from rosmini.core.packages import assets_dir
from rosmini.msgs.geometry_msgs.msg import PoseStamped
from rosmini.msgs.nav_msgs.srv import GetPlan
from rosmini.msgs.std_msgs.msg import Float64
from rosmini.navigation.costmap_2d.costmap import Costmap2D
from rosmini.navigation.costmap_2d.inflation import cell_distance, cost_table, inflate
from rosmini.navigation.costmap_2d.layer import Window
from rosmini.navigation.global_planner import GlobalDijkstra

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

BEGIN, SOFA = (-2.98, 1.02), (-4.48, -4.48)
ROOM = (140, 130)
"""Rows and columns of the part of the house used for planning."""
NEUTRAL = 100
HIGHEST, AVERAGE = 135, 45.0
INSCRIBED, RADIUS, SCALING = 0.0511, 0.6, 5.0
"""Values for a Burger's costmap in `turtlebot3_navigation`."""


@cache
def house() -> Costmap2D:
    """Return the global costmap of the house, without laser data."""
    found = load_map(assets_dir() / "ros/rosmini_sim/maps/house.yaml")
    costs = np.where(found.occupied, 254, np.where(found.free, 0, 255)).astype(np.uint8)
    made = Costmap2D.of(costs, found.resolution, found.origin[:2])
    radius = cell_distance(RADIUS, found.resolution)
    table = cost_table(radius, found.resolution, INSCRIBED, SCALING)
    inflate(made.costs, Window(0, 0, made.width, made.height), radius, table)
    return made


@exercise("tuned", praise="The costs differ wherever the planner has a choice.")
def tuned(answer: Any) -> None:
    """A factor that keeps the plan away from the sofa and below the highest costs."""
    factor = expect_number(answer, "factor")
    expect(0.01 <= factor <= 5.0, f"cost_factor is {factor:g}.", "it must be from 0.01 to 5.0")
    grid = house()
    plan = GlobalDijkstra(
        grid.costs[: ROOM[0], : ROOM[1]],
        grid.world_to_map_clamped(*BEGIN),
        grid.world_to_map_clamped(*SOFA),
        neutral_cost=NEUTRAL,
        cost_factor=factor,
    )
    columns, rows = np.floor(plan.path() + 0.5).astype(int).T
    costs = grid.costs[rows, columns]
    ceiling = (252 - NEUTRAL) / factor
    said = f"The plan crosses cells with costs of {costs.mean():.0f} on average and {costs.max()} at most"
    expect(costs.mean() <= AVERAGE, f"{said}: it keeps too close to obstacles.", _advice(ceiling))
    expect(costs.max() <= HIGHEST, f"{said}: at one point it is too close to an obstacle.", _advice(ceiling))


def _advice(ceiling: float) -> str:
    if ceiling > 252:
        return "give the costmap more weight"
    return f"above a cost of {ceiling:.0f} all cells cost the same: give the costmap less weight"


# ---- far: how far is it ----

QUESTIONS: tuple[tuple[Cell, list[tuple[float, float]]], ...] = (
    ((3, 4), [(0, 0), (0, 1), (0.5, 1), (3, 1), (3, 4)]),
    ((9, 9), []),
    ((-2, 0), [(0, 0), (-0.3, 0.4), (-2, 0.4), (-2, 0)]),
)
"""Goals, and the plans to them."""


@exercise("far", praise="Your node reports the distance of each delivery before the robot starts.")
def far(answer: Script) -> None:
    """A node that requests plans and publishes their lengths."""
    asked: list[Any] = []
    told: list[Any] = []
    with TurtleTrial(None) as trial:
        mover = trial.graph.node("move_base")
        mover.service("~make_plan", GetPlan, _server(asked))
        office = trial.graph.node("office")
        office.subscriber("distance", Float64, told.append)
        question = office.publisher("question", PoseStamped, queue_size=5)
        trial.start(answer)
        trial.run(1.0)
        for place, points in QUESTIONS:
            asked.clear()
            told.clear()
            question.publish(_pose(place))
            trial.run(0.5)
            where = f"For the goal {place}"
            expect(asked, f"{where} you did not call move_base/make_plan.", "make_plan(start, goal, tolerance)")
            request = asked[-1]
            expect(
                not request.start.header.frame_id,
                f"{where} you requested a plan from a fixed start.",
                "an empty PoseStamped() means the robot's position",
            )
            expect(
                (request.goal.pose.position.x, request.goal.pose.position.y) == place
                and request.goal.header.frame_id == "map",
                f"{where} you requested a different goal.",
                "pass on the pose that you received",
            )
            expect(
                math.isclose(request.tolerance, 0.5, abs_tol=1e-6),
                f"{where} the tolerance was {request.tolerance:g} m, not 0.5.",
            )
            expect(
                len(told) == 1,
                f"{where} there were {len(told)} messages on distance, not 1.",
                "publish once for each goal",
            )
            wanted = sum(math.dist(a, b) for a, b in pairwise(points)) if points else -1.0
            expect(
                abs(told[0].data - wanted) < 0.01,
                f"{where} you published {told[0].data:.2f}, not {wanted:.2f}."
                + ("" if points else " There is no plan to it."),
                "add up the distances from each pose to the next; publish -1 for an empty plan",
            )


def _server(asked: list[Any]) -> Callable[[Any], Any]:
    plans = dict(QUESTIONS)

    def handle(request: Any) -> Any:
        asked.append(request)
        position = request.goal.pose.position
        response = GetPlan._response_class()
        response.plan.poses = [_pose(each) for each in plans.get((int(position.x), int(position.y)), [])]
        return response

    return handle


def _pose(point: tuple[float, float]) -> Any:
    made = PoseStamped()
    made.header.frame_id = "map"
    made.pose.position.x, made.pose.position.y = map(float, point)
    made.pose.orientation.w = 1.0
    return made
