"""The state machine of `move_base`, which turns events into decisions, without nodes, topics or clocks.

It has three states (http://wiki.ros.org/move_base): PLANNING, until there is a plan; CONTROLLING, while the local
planner finds commands; CLEARING, while a recovery behaviour tries to free the robot. The trigger, which is the reason
for CLEARING, determines when the list of behaviours restarts and which message is sent when the last one has not
helped.

Times are in seconds on any clock, positions in metres in any frame. `TRANSITIONS` lists all possible state changes,
and `StateMachine.history` those that have happened.
"""

from __future__ import annotations

import math
from collections import deque
from enum import Enum
from typing import NamedTuple

from .parameters import MoveBaseConfig

HISTORY = 1000
"""Number of latest state changes that are stored."""


class State(Enum):
    """The activity of `move_base`."""

    PLANNING = "planning"
    CONTROLLING = "controlling"
    CLEARING = "clearing"


class Trigger(Enum):
    """The reason for recovery behaviours; its value is the text of the aborted goal if none of them helps."""

    PLANNING = "Failed to find a valid plan. Even after executing recovery behaviors."
    CONTROLLING = "Failed to find a valid control. Even after executing recovery behaviors."
    OSCILLATION = "Robot is oscillating. Even after executing recovery behaviors."


ABORT_LOG = {
    Trigger.PLANNING: "Aborting because a valid plan could not be found. Even after executing all recovery behaviors",
    Trigger.CONTROLLING: "Aborting because a valid control could not be found. Even after executing all recovery "
    "behaviors",
    Trigger.OSCILLATION: "Aborting because the robot appears to be oscillating over and over. Even after executing "
    "all recovery behaviors",
}
"""The log message for each trigger when a goal is aborted."""


class Event(Enum):
    """A cause of a state change; its value describes it in histories and figures."""

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
"""All state changes: from, event, to. With `planner_frequency` a plan can also arrive while CLEARING."""


class Transition(NamedTuple):
    """A state change that happened at `time` [s]."""

    time: float
    before: State
    event: Event
    after: State


class Plan(NamedTuple):
    """Decision: run the planner; send no command in this cycle."""


class Follow(NamedTuple):
    """Decision: ask the local planner whether the goal is reached, and then for a command."""


class Recover(NamedTuple):
    """Decision: run the recovery behaviour with this index."""

    number: int


class Abort(NamedTuple):
    """Decision: abort the goal with this text, and log this message."""

    text: str
    log: str


Decision = Plan | Follow | Recover | Abort


class StateMachine:
    """The state of `move_base`; `step` returns the decision for each control cycle.

    `recoveries` is the number of recovery behaviours; `config` may be replaced at any time.
    """

    def __init__(self, config: MoveBaseConfig, recoveries: int) -> None:
        self.config = config
        self.recoveries = recoveries
        self.state = State.PLANNING
        self.trigger = Trigger.PLANNING
        self.recovery_index = 0
        self.wants_plan = False
        """True if the planner should run (`runPlanner_` in the original)."""
        self.retries = 0
        """Number of failed attempts to plan since the last plan, command or recovery."""
        self.last_plan = self.last_command = self.last_progress = 0.0
        self._progress_at: tuple[float, float] | None = None
        self.history: deque[Transition] = deque(maxlen=HISTORY)

    def _enter(self, now: float, event: Event, after: State) -> None:
        if after is not self.state:
            self.history.append(Transition(now, self.state, event, after))
        self.state = after

    def _restart_patience(self, now: float) -> None:
        """Restart the planner's patience."""
        self.last_plan = now
        self.retries = 0

    # -- events --------------------------------------------------------------------------------------------------

    def start_goal(self, now: float) -> None:
        """Handle a new goal, which may preempt another: plan, with full patience and all recoveries available."""
        self._enter(now, Event.NEW_GOAL, State.PLANNING)
        self.recovery_index = 0
        self.wants_plan = True
        self.last_command = self.last_progress = now
        self._restart_patience(now)

    def end_goal(self, now: float) -> None:
        """Handle the end of a goal, for any reason (`resetState` in the original)."""
        self._enter(now, Event.OVER, State.PLANNING)
        self.wants_plan = False
        self.recovery_index = 0
        self.trigger = Trigger.PLANNING

    def plan_found(self, now: float) -> None:
        """Handle a new plan, which the next cycle passes to the local planner."""
        self._restart_patience(now)
        if self.wants_plan:
            self._enter(now, Event.PLAN_FOUND, State.CONTROLLING)
        if self.config.planner_frequency <= 0:
            self.wants_plan = False

    def plan_failed(self, now: float) -> bool:
        """Handle a failure to plan; return whether patience has run out, so that the robot has to stop.

        A robot that is following an older plan continues to do so.
        """
        if self.state is not State.PLANNING:
            return False
        self.retries += 1
        too_often = 0 <= self.config.max_planning_retries < self.retries
        if not self.wants_plan or not (now > self.last_plan + self.config.planner_patience or too_often):
            return False
        self._enter(now, Event.NO_PLAN, State.CLEARING)
        self.wants_plan = False
        self.trigger = Trigger.PLANNING
        return True

    def plan_taken(self) -> None:
        """Handle the local planner's acceptance of a plan: after failed planning, recoveries restart with the first."""
        if self.trigger is Trigger.PLANNING:
            self.recovery_index = 0

    def robot_at(self, now: float, x: float, y: float) -> None:
        """Handle a new position of the robot [m]: a move of `oscillation_distance` counts as progress."""
        if self._progress_at is not None and math.dist(self._progress_at, (x, y)) < self.config.oscillation_distance:
            return
        self._progress_at, self.last_progress = (x, y), now
        if self.trigger is Trigger.OSCILLATION:
            self.recovery_index = 0

    def step(self) -> Decision:
        """Return the decision for this control cycle."""
        if self.state is State.PLANNING:
            self.wants_plan = True
            return Plan()
        if self.state is State.CONTROLLING:
            return Follow()
        if self.config.recovery_behavior_enabled and self.recovery_index < self.recoveries:
            return Recover(self.recovery_index)
        self.wants_plan = False
        return Abort(self.trigger.value, ABORT_LOG[self.trigger])

    def check_oscillation(self, now: float) -> bool:
        """Enter CLEARING and return True if the robot has made no progress for too long. Call while CONTROLLING."""
        timeout = self.config.oscillation_timeout
        if not (timeout > 0 and self.last_progress + timeout < now):
            return False
        self._enter(now, Event.OSCILLATING, State.CLEARING)
        self.trigger = Trigger.OSCILLATION
        return True

    def command_found(self, now: float) -> None:
        """Handle a valid command from the local planner."""
        self.last_command = now
        if self.trigger is Trigger.CONTROLLING:
            self.recovery_index = 0

    def command_failed(self, now: float) -> None:
        """Handle the lack of a command, when the robot has to stop: replan, or recover after `controller_patience`."""
        if now > self.last_command + self.config.controller_patience:
            self._enter(now, Event.NO_COMMAND_AT_ALL, State.CLEARING)
            self.trigger = Trigger.CONTROLLING
            return
        self._restart_patience(now)
        self._enter(now, Event.NO_COMMAND, State.PLANNING)
        self.wants_plan = True

    def recovered(self, now: float) -> None:
        """Handle the end of a recovery behaviour: plan again; the next recovery will run the next behaviour."""
        self.last_progress = now
        self._restart_patience(now)
        self.recovery_index += 1
        self._enter(now, Event.RECOVERED, State.PLANNING)
