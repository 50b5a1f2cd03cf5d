from hypothesis import given
from hypothesis import strategies as st

from rosmini.navigation.move_base.parameters import MoveBaseConfig
from rosmini.navigation.move_base.planning import PlannerLane, offsets_within
from rosmini.navigation.move_base.state_machine import State, StateMachine


def test_offsets_as_the_original_tries_them():
    found = [(round(x, 3), round(y, 3)) for x, y in offsets_within(0.3, 0.05)]
    assert found[:8] == [
        *[(-0.15, 0.0), (0.15, 0.0)],
        *[(0.0, -0.15), (0.0, 0.15)],
        *[(-0.15, -0.15), (0.15, -0.15), (-0.15, 0.15), (0.15, 0.15)],
    ]
    assert len(found) == 24
    assert len(set(found)) == 24


@given(st.floats(0, 1), st.sampled_from([0.02, 0.05, 0.1]))
def test_no_offset_is_farther_than_the_tolerance(tolerance, resolution):
    found = list(offsets_within(tolerance, resolution))
    assert all(max(abs(x), abs(y)) <= tolerance + 1e-6 for x, y in found)
    assert len(found) == len(set(found))


class Rig:
    """A planner's lane, and what it did."""

    def __init__(self, node, plan, **config):
        self.node = node
        self.machine = StateMachine(MoveBaseConfig(**config), 2)
        self.goals, self.stops = [], 0
        self._plan = plan
        self.lane = PlannerLane(node, self.machine, self.plan, self.stop)
        node.graph.run(0.01)

    def plan(self, goal):
        self.goals.append((round(self.node.now().to_sec() - 1000, 2), goal))
        return self._plan(goal)

    def stop(self):
        self.stops += 1

    def go(self, goal):
        self.lane.goal = goal
        self.machine.start_goal(self.node.now().to_sec())
        self.lane.wake()


def test_without_a_frequency_it_plans_once(node):
    rig = Rig(node, lambda goal: [goal])
    rig.go("A")
    node.graph.run(3.0)
    assert rig.goals == [(0.01, "A")]
    assert rig.lane.take() == ["A"]
    assert rig.lane.take() is None
    assert rig.machine.state is State.CONTROLLING


def test_with_one_it_goes_on(node):
    rig = Rig(node, lambda goal: [goal], planner_frequency=2.0)
    rig.go("A")
    node.graph.run(1.2)
    assert [when for when, _ in rig.goals] == [0.01, 0.51, 1.01]
    rig.machine.end_goal(2.0)
    node.graph.run(3.0)
    assert len(rig.goals) == 3


def test_failing_it_tries_again_when_it_is_woken_until_patience_ends(node):
    rig = Rig(node, lambda _: (), planner_patience=0.25)
    rig.go("A")
    for _ in range(5):
        node.graph.run(0.1)
        rig.lane.wake()
    assert [when for when, _ in rig.goals] == [0.01, 0.11, 0.21, 0.31]
    assert (rig.stops, rig.machine.state) == (1, State.CLEARING)


def test_a_plan_for_a_goal_that_was_preempted_is_not_taken(node):
    def slow(goal):
        node.sleep(0.3)
        return [goal]

    rig = Rig(node, slow)
    rig.go("A")
    node.graph.run(0.1)
    rig.go("B")
    node.graph.run(1.0)
    assert rig.lane.take() == ["B"]
    assert [goal for _, goal in rig.goals] == ["A", "B"]
