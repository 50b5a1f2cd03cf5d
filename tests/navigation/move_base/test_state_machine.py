import pytest
from hypothesis import given
from hypothesis import strategies as st

from rosmini.navigation.move_base.parameters import MoveBaseConfig
from rosmini.navigation.move_base.state_machine import (
    TRANSITIONS,
    Abort,
    Event,
    Follow,
    Plan,
    Recover,
    State,
    StateMachine,
    Trigger,
)


def machine(recoveries=2, **config):
    made = StateMachine(MoveBaseConfig(**config), recoveries)
    made.start_goal(0.0)
    return made


def test_from_goal_to_goal():
    it = machine()
    assert it.step() == Plan() and it.wants_plan
    it.plan_found(0.1)
    assert it.state is State.CONTROLLING and not it.wants_plan
    it.plan_taken()
    assert it.step() == Follow()
    it.command_found(0.1)
    it.end_goal(9.0)
    assert it.state is State.PLANNING and not it.wants_plan
    assert [(each.event, each.after) for each in it.history] == [
        (Event.PLAN_FOUND, State.CONTROLLING),
        (Event.OVER, State.PLANNING),
    ]


def test_with_a_planner_frequency_it_goes_on_planning():
    it = machine(planner_frequency=5.0)
    it.plan_found(0.1)
    assert it.wants_plan
    assert not it.plan_failed(99.0), "it follows the plan that it has"
    assert it.state is State.CONTROLLING


def test_without_a_plan_patience_ends_and_recoveries_run_in_order():
    it = machine(planner_patience=5.0)
    assert not it.plan_failed(5.0)
    assert it.plan_failed(5.1), "the robot has to stop"
    for index in (0, 1):
        assert it.step() == Recover(index)
        it.recovered(10.0 * index + 6)
        assert it.step() == Plan()
        assert not it.plan_failed(10.0 * index + 11)
        assert it.plan_failed(10.0 * index + 11.1)
    last = it.step()
    assert isinstance(last, Abort)
    assert last.text == "Failed to find a valid plan. Even after executing recovery behaviors."


@pytest.mark.parametrize(("retries", "attempts"), [(0, 1), (3, 4)])
def test_planning_retries(retries, attempts):
    it = machine(max_planning_retries=retries)
    assert [it.plan_failed(0.1) for _ in range(attempts)] == [False] * (attempts - 1) + [True]


def test_a_plan_after_a_recovery_for_want_of_one_begins_the_list_again():
    it = machine(max_planning_retries=0)
    it.plan_failed(0.1)
    assert it.step() == Recover(0)
    it.recovered(1.0)
    it.plan_found(1.1)
    it.plan_taken()
    assert it.recovery_index == 0


def test_no_command_plans_again_until_patience_ends():
    it = machine(controller_patience=15.0)
    it.plan_found(0.0)
    it.command_failed(15.0)
    assert it.step() == Plan()
    it.plan_found(15.1)
    it.plan_taken()
    it.command_failed(15.2)
    assert it.step() == Recover(0)
    it.recovered(16.0)
    it.plan_found(16.0)
    it.plan_taken()
    assert it.recovery_index == 1, "a plan does not say that there is a command"
    it.command_failed(16.1)
    assert it.step() == Recover(1), "it has had no command for longer than its patience, still"
    it.recovered(17.0)
    it.plan_found(17.0)
    it.command_found(17.1)
    assert it.recovery_index == 0


def test_oscillation():
    it = machine(oscillation_timeout=10.0, oscillation_distance=0.5, recoveries=1)
    it.robot_at(0.0, 1.0, 1.0)
    it.plan_found(0.1)
    it.robot_at(5.0, 1.4, 1.0)
    assert not it.check_oscillation(10.0)
    assert it.check_oscillation(10.1)
    assert it.step() == Recover(0)
    it.recovered(11.0)
    assert it.recovery_index == 1
    it.robot_at(12.0, 1.6, 1.0)
    assert it.recovery_index == 0, "it got on"
    it.plan_found(12.0)
    assert it.check_oscillation(22.1)
    it.recovered(22.2)
    it.plan_found(22.3)
    assert it.check_oscillation(32.3)
    assert it.step().text == Trigger.OSCILLATION.value


steps = st.lists(
    st.tuples(
        st.sampled_from(["plan", "no plan", "command", "no command", "oscillates", "goal", "end", "cycle"]),
        st.floats(0, 8),
    ),
    max_size=60,
)


@given(steps, st.sampled_from([0.0, 5.0]), st.integers(-1, 3), st.integers(0, 4))
def test_whatever_happens_the_changes_are_those_of_the_table(events, frequency, retries, recoveries):
    it = machine(recoveries, planner_frequency=frequency, max_planning_retries=retries, oscillation_timeout=7.0)
    now = 0.0
    for what, later in events:
        now += later
        if what == "plan":
            it.plan_found(now)
        elif what == "no plan":
            it.plan_failed(now)
        elif what == "goal":
            it.start_goal(now)
        elif what == "end":
            it.end_goal(now)
        elif what == "cycle":
            decision = it.step()
            if isinstance(decision, Recover):
                assert decision.number < recoveries
                it.recovered(now)
            elif isinstance(decision, Abort):
                it.end_goal(now)
        elif it.state is State.CONTROLLING:
            if what == "oscillates":
                it.check_oscillation(now)
            elif what == "command":
                it.command_found(now)
            else:
                it.command_failed(now)
    assert {(each.before, each.event, each.after) for each in it.history} <= set(TRANSITIONS)
