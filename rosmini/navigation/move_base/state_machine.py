"""The state machine of `move_base`: events in, decisions out; no node, no topic, no clock.

Three states (http://wiki.ros.org/move_base): PLANNING, until there is a plan; CONTROLLING, while the local planner
finds commands; CLEARING, while a recovery behaviour tries to free the robot. What sent the robot there, the trigger,
decides when the list of behaviours starts from its first again, and with which text the goal is given up after the
last.

Times are seconds on any one clock, positions metres in any one frame. `TRANSITIONS` lists every change that can happen,
and `StateMachine.history` those that did.
"""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Sequence
from copy import deepcopy
from dataclasses import dataclass
from enum import Enum
from typing import NamedTuple

HISTORY = 1000
"""The number of the latest changes that are kept."""


class State(Enum):
    """What `move_base` is about."""

    PLANNING = "planning"
    CONTROLLING = "controlling"
    CLEARING = "clearing"


class Trigger(Enum):
    """Why recovery behaviours run; the value is the text with which a goal is aborted when none has helped."""

    PLANNING = "Failed to find a valid plan. Even after executing recovery behaviors."
    CONTROLLING = "Failed to find a valid control. Even after executing recovery behaviors."
    OSCILLATION = "Robot is oscillating. Even after executing recovery behaviors."


GIVEN_UP = {
    Trigger.PLANNING: "Aborting because a valid plan could not be found. Even after executing all recovery behaviors",
    Trigger.CONTROLLING: "Aborting because a valid control could not be found. Even after executing all recovery "
    "behaviors",
    Trigger.OSCILLATION: "Aborting because the robot appears to be oscillating over and over. Even after executing "
    "all recovery behaviors",
}
"""What the log says then."""


class Event(Enum):
    """What changes the state; the value says it in words, for histories and figures."""

    NEW_GOAL = "new goal"
    PLAN_FOUND = "plan found"
    NO_PLAN = "no plan for planner_patience, or max_planning_retries"
    NO_COMMAND = "no valid command: plan again"
    NO_COMMAND_AT_ALL = "no valid command for controller_patience"
    OSCILLATING = "no progress of oscillation_distance for oscillation_timeout"
    RECOVERED = "recovery behavior done"
    OVER = "goal reached, given up or cancelled"


TRANSITIONS: tuple[tuple[State, Event, State], ...] = (
    (State.PLANNING, Event.PLAN_FOUND, State.CONTROLLING),
    (State.PLANNING, Event.NO_PLAN, State.CLEARING),
    (State.CONTROLLING, Event.NEW_GOAL, State.PLANNING),
    (State.CONTROLLING, Event.NO_COMMAND, State.PLANNING),
    (State.CONTROLLING, Event.NO_COMMAND_AT_ALL, State.CLEARING),
    (State.CONTROLLING, Event.OSCILLATING, State.CLEARING),
    (State.CONTROLLING, Event.OVER, State.PLANNING),
    (State.CLEARING, Event.RECOVERED, State.PLANNING),
    (State.CLEARING, Event.PLAN_FOUND, State.CONTROLLING),
    (State.CLEARING, Event.NEW_GOAL, State.PLANNING),
    (State.CLEARING, Event.OVER, State.PLANNING),
)
"""Every change of state: from, why, to. With `planner_frequency` a plan may come while the robot is CLEARING."""


class Transition(NamedTuple):
    """A change of state that happened, at `time` [s]."""

    time: float
    before: State
    event: Event
    after: State


@dataclass(frozen=True)
class Limits:
    """The parameters that decide; see `rosmini.navigation.move_base.parameters`."""

    planner_frequency: float = 0.0
    planner_patience: float = 5.0
    controller_patience: float = 15.0
    max_planning_retries: int = -1
    oscillation_timeout: float = 0.0
    oscillation_distance: float = 0.5
    recovery_behavior_enabled: bool = True


class Plan(NamedTuple):
    """Decision: nothing to command in this cycle, the planner is to run."""


class Follow(NamedTuple):
    """Decision: ask the local planner, first whether the goal is reached, then for a command."""


class Recover(NamedTuple):
    """Decision: run the recovery behaviour with this number, from 0."""

    number: int


class Abort(NamedTuple):
    """Decision: give the goal up, with this text, and this line for the log."""

    text: str
    log: str


Decision = Plan | Follow | Recover | Abort


class StateMachine:
    """Where `move_base` is, and what it does next.

    `recoveries` is the number of recovery behaviours; `limits` may be replaced at any time.
    """

    def __init__(self, limits: Limits, recoveries: int) -> None:
        self.limits = limits
        self.recoveries = recoveries
        self.state = State.PLANNING
        self.trigger = Trigger.PLANNING
        self.recovery_index = 0
        self.wants_plan = False
        """Whether the planner is to run (`runPlanner_` of the original)."""
        self.retries = 0
        """How often planning failed since there was a plan, a command or a recovery."""
        self.last_plan = self.last_command = self.last_progress = 0.0
        self._progress_at: tuple[float, float] | None = None
        self.history: deque[Transition] = deque(maxlen=HISTORY)

    def _enter(self, now: float, event: Event, after: State) -> None:
        if after is not self.state:
            self.history.append(Transition(now, self.state, event, after))
        self.state = after

    def _patience(self, now: float) -> None:
        """Start all patience from now."""
        self.last_plan = now
        self.retries = 0

    # -- events --------------------------------------------------------------------------------------------------

    def begin(self, now: float) -> None:
        """A goal, also one that preempts another: plan for it, with all patience and from the first recovery."""
        self._enter(now, Event.NEW_GOAL, State.PLANNING)
        self.recovery_index = 0
        self.wants_plan = True
        self.last_command = self.last_progress = now
        self._patience(now)

    def end(self, now: float) -> None:
        """The goal is over, however it ended (`resetState` of the original)."""
        self._enter(now, Event.OVER, State.PLANNING)
        self.wants_plan = False
        self.recovery_index = 0
        self.trigger = Trigger.PLANNING

    def plan_found(self, now: float) -> None:
        """The planner has a plan, which the next cycle hands to the local planner."""
        self._patience(now)
        if self.wants_plan:
            self._enter(now, Event.PLAN_FOUND, State.CONTROLLING)
        if self.limits.planner_frequency <= 0:
            self.wants_plan = False

    def plan_failed(self, now: float) -> bool:
        """The planner has found none. Return whether patience is at an end: then the robot has to stop.

        While the robot follows an older plan it goes on following it.
        """
        if self.state is not State.PLANNING:
            return False
        self.retries += 1
        too_often = 0 <= self.limits.max_planning_retries < self.retries
        if not self.wants_plan or not (now > self.last_plan + self.limits.planner_patience or too_often):
            return False
        self._enter(now, Event.NO_PLAN, State.CLEARING)
        self.wants_plan = False
        self.trigger = Trigger.PLANNING
        return True

    def plan_taken(self) -> None:
        """The local planner has the new plan: if recoveries ran for want of one, the list starts from its first."""
        if self.trigger is Trigger.PLANNING:
            self.recovery_index = 0

    def at(self, now: float, x: float, y: float) -> None:
        """The robot is there: after `oscillation_distance` it counts as getting on."""
        if (
            self._progress_at is not None
            and math.dist(self._progress_at, (x, y)) < self.limits.oscillation_distance
        ):
            return
        self._progress_at, self.last_progress = (x, y), now
        if self.trigger is Trigger.OSCILLATION:
            self.recovery_index = 0

    def step(self) -> Decision:
        """What this cycle of control has to do."""
        if self.state is State.PLANNING:
            self.wants_plan = True
            return Plan()
        if self.state is State.CONTROLLING:
            return Follow()
        if self.limits.recovery_behavior_enabled and self.recovery_index < self.recoveries:
            return Recover(self.recovery_index)
        self.wants_plan = False
        return Abort(self.trigger.value, GIVEN_UP[self.trigger])

    def oscillates(self, now: float) -> bool:
        """Ask, while CONTROLLING, whether the robot has not got on for too long. If so it has to stop: CLEARING."""
        timeout = self.limits.oscillation_timeout
        if not (timeout > 0 and self.last_progress + timeout < now):
            return False
        self._enter(now, Event.OSCILLATING, State.CLEARING)
        self.trigger = Trigger.OSCILLATION
        return True

    def command_found(self, now: float) -> None:
        """The local planner has a command."""
        self.last_command = now
        if self.trigger is Trigger.CONTROLLING:
            self.recovery_index = 0

    def command_failed(self, now: float) -> None:
        """The local planner has none; the robot has to stop. Plan again, or after `controller_patience` recover."""
        if now > self.last_command + self.limits.controller_patience:
            self._enter(now, Event.NO_COMMAND_AT_ALL, State.CLEARING)
            self.trigger = Trigger.CONTROLLING
            return
        self._patience(now)
        self._enter(now, Event.NO_COMMAND, State.PLANNING)
        self.wants_plan = True

    def recovered(self, now: float) -> None:
        """The recovery behaviour has run: plan again; the next time it is the next one's turn."""
        self.last_progress = now
        self._patience(now)
        self.recovery_index += 1
        self._enter(now, Event.RECOVERED, State.PLANNING)


def recovery_steps(names: Sequence[str]) -> list[tuple[str, str, str]]:
    """What becomes of a robot that cannot plan: (from, what happens, to), with recovery behaviours of these names.

    The machine itself is run for that: without any plan until it gives up, and after each behaviour with one.
    """
    machine, limits = StateMachine(Limits(), len(names)), Limits()
    found: list[tuple[str, str, str]] = []
    before, now = "navigate", 0.0
    machine.begin(now)
    while True:
        now += 2 * limits.planner_patience
        machine.plan_failed(now)
        decision = machine.step()
        if not isinstance(decision, Recover):
            return [*found, (before, "stuck", "abort")]
        row = f"{decision.number + 1}. {names[decision.number]}"
        found.append((before, "stuck", row))
        machine.recovered(now)
        machine.step()  # asks for a plan
        freed = deepcopy(machine)
        freed.plan_found(now)
        freed.plan_taken()
        if isinstance(freed.step(), Follow):
            found.append((row, "free", "navigate"))
        before = row
