"""The machine that runs Logo: instructions, a stack of values, and a stack of frames that is not Python's.

So a program can be stopped after any step, recursion may be deeper than Python's, and a procedure that calls another
one as its last act (a tail call) leaves its frame to it: such a recursion may go on for ever.

Names are bound dynamically, as in all Logos: a procedure sees the inputs and locals of those that called it. What a
name stands for is in one dictionary, and frames remember what it stood for before.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from .compiler import Code, Op, Procedure, Words, compile_block, compile_body, described
from .errors import BadInput, LogoError, LogoStopped, suggestion
from .values import LogoList, Value, weight

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from .compiler import Primitive
    from .turtles import Flock


@dataclass(frozen=True)
class Limits:
    """When a program is stopped."""

    steps: int = 2_000_000
    """So many instructions; making a large list counts as several."""

    moves: int = 20_000
    """So many movements of turtles."""

    depth: int = 10_000
    """So many procedures that wait for one another."""

    lines: int = 2_000
    """So many lines printed: as many as a cell shows of what nodes print."""


FRAMES_A_CALL = 10
"""So many lists may be open for each procedure that may."""


class Frame:
    """Instructions that are under way; this one, the outermost, leaves nothing behind."""

    __slots__ = ("code", "pc")

    def __init__(self, code: Code) -> None:
        self.code = code
        self.pc = 0

    def at_end(self, machine: Machine) -> None:
        """Go on once all instructions are done: leave the frame, or begin another turn."""
        machine.pop()

    def leave(self, machine: Machine) -> None:
        """Restore what the frame has changed; called however it is left."""


class Block(Frame):
    """A list that is run once; its value, or None, stays on the stack."""

    __slots__ = ()


class Call(Frame):
    """A procedure that runs: what names stood for before, and what its caller asks of it."""

    __slots__ = ("base", "mode", "name", "saved")

    def __init__(self, code: Code, name: str, base: int) -> None:
        super().__init__(code)
        self.name = name
        self.base = base
        self.mode = "anything"
        """Or "value" or "nothing", where its caller has left its frame to it and can no longer see to that."""
        self.saved: dict[str, Value | None] = {}

    def become(self, code: Code, name: str, mode: str) -> None:
        """Go on as another procedure; the names of this one stay what they are, as a procedure's callers' do."""
        self.code, self.pc, self.name, self.mode = code, 0, name, mode

    def at_end(self, machine: Machine) -> None:
        """End without a value."""
        machine.pop()
        self.give(machine, None)

    def leave(self, machine: Machine) -> None:
        """Restore names."""
        machine.depth -= 1
        machine.restore(self.saved)

    def give(self, machine: Machine, value: Value | None) -> None:
        """Hand the value on, or None. Raises ``LogoError`` where it is not what is asked."""
        if self.mode == "nothing":
            unused(value)
        elif self.mode == "value" and value is None:
            raise LogoError(f"{self.name} didn't output anything")
        del machine.stack[self.base :]
        machine.stack.append(value)


class Machine:
    """Runs what a program consists of; its procedures and its variables outlast the program.

    ``say`` is given each line that is printed, ``pause`` is called with seconds to wait.
    """

    def __init__(
        self,
        primitives: Mapping[str, Primitive],
        flock: Flock,
        *,
        say: Callable[[str], object],
        pause: Callable[[float], object],
        seed: int,
        limits: Limits,
    ) -> None:
        self.words = Words(primitives, {})
        self.flock = flock
        self.say = say
        self.pause = pause
        self.limits = limits
        self.variables: dict[str, Value] = {}
        self.seed = seed
        self.random = np.random.default_rng(seed)
        self.frames: list[Frame] = []
        self.stack: list[Value | None] = []
        self.steps = self.moves = self.depth = self.lines = 0
        self.line = 0
        self.typed = ""
        """What `type` has begun to write: the start of the next line."""

    # -- programs ------------------------------------------------------------------------------------------------

    def define(self, procedures: Mapping[str, Procedure]) -> None:
        """Add procedures, or replace them. Raises ``LogoError`` for the name of a primitive."""
        for procedure in procedures.values():
            if procedure.name in self.words.primitives:
                raise LogoError(
                    f"{procedure.name} is a word of Logo already; choose another name", procedure.line
                )
        self.words = Words(self.words.primitives, {**self.words.procedures, **procedures})

    def start(self, body: tuple[LogoList, ...]) -> None:
        """Prepare to run lines, all of which must be understood. Raises ``LogoError``."""
        self.halt()
        self.steps = self.moves = self.lines = 0
        self.frames.append(Frame(compile_body(body, self.words)))

    def advance(self, steps: int) -> bool:
        """Run so many instructions at most; return whether there are more. Raises ``LogoError``."""
        stop = self.steps + steps
        frames = self.frames
        try:
            while frames and self.steps < stop:
                frame = frames[-1]
                pc = frame.pc
                if pc == len(frame.code):
                    frame.at_end(self)
                    self.steps += 1
                    continue
                self.line = frame.code[pc][3] or self.line
                frame.pc = pc + 1
                self.steps += 1
                self._do(frame.code[pc])
                if self.steps > self.limits.steps:
                    raise LogoStopped(
                        f"stopped after {self.limits.steps} steps: is there a loop that never ends, or a procedure "
                        "that calls itself without an end?"
                    )
        except LogoError as error:
            error.locate(self.line, self.procedure)
            raise
        return bool(frames)

    def halt(self) -> None:
        """Leave everything that runs, and restore what names stood for."""
        while self.frames:
            self.pop()
        self.stack.clear()
        self.flock.reset()
        if self.typed:
            self.write("")

    def _do(self, instruction: tuple[Op, Any, Any, int]) -> None:
        op, what, count, _ = instruction
        stack = self.stack
        if op is Op.PUSH:
            stack.append(what)
        elif op is Op.LOAD:
            value = self.variables.get(what)
            if value is None:
                raise self.no_value(what)
            stack.append(value)
        elif op is Op.CALL:
            self._call(what, count)
        elif op is Op.DISCARD:
            unused(stack.pop())
        elif op is Op.NEED:
            if stack[-1] is None:
                raise LogoError(
                    f"{what} didn't output to {count}" if count else f"{what} didn't output anything"
                )
        else:
            inputs = stack[len(stack) - count :]
            del stack[len(stack) - count :]
            try:
                result = what.act(self, *inputs)
            except BadInput as error:
                error.name_word(what.name)
                raise
            if op is Op.REPORT:
                stack.append(result)

    # -- frames --------------------------------------------------------------------------------------------------

    @property
    def procedure(self) -> str | None:
        """The name of the procedure that runs."""
        return next((frame.name for frame in reversed(self.frames) if isinstance(frame, Call)), None)

    def push(self, frame: Frame) -> None:
        """Enter a frame. Raises ``LogoStopped`` for one too many."""
        if len(self.frames) >= FRAMES_A_CALL * self.limits.depth:
            raise LogoStopped(f"more than {FRAMES_A_CALL * self.limits.depth} lists run inside one another")
        self.frames.append(frame)

    def pop(self) -> Frame:
        """Leave the innermost frame."""
        frame = self.frames.pop()
        frame.leave(self)
        return frame

    def enter(self, block: Value | LogoList) -> None:
        """Run a list; its value, or None, will be on the stack."""
        self.push(Block(self.code_of(block)))

    def code_of(self, block: Value) -> Code:
        """The instructions of a list, or of a word as a list of one. Raises ``LogoError``."""
        if not isinstance(block, LogoList):
            block = LogoList([block])
        if block.cache is None or block.cache[0] is not self.words:
            block.cache = (self.words, compile_block(block, self.words))
        code: Code = block.cache[1]
        return code

    def bind(self, saved: dict[str, Value | None], name: str, value: Value | None) -> None:
        """Let a name stand for a value (None: for nothing) until the frame that saves the old one is left."""
        if name not in saved:
            saved[name] = self.variables.get(name)
        if value is None:
            self.variables.pop(name, None)
        else:
            self.variables[name] = value

    def restore(self, saved: dict[str, Value | None]) -> None:
        """Undo `bind`."""
        for name, value in saved.items():
            if value is None:
                self.variables.pop(name, None)
            else:
                self.variables[name] = value

    def local(self, name: str, value: Value | None) -> None:
        """Make a name local to the procedure that runs; outside of procedures it is global."""
        frame = next((frame for frame in reversed(self.frames) if isinstance(frame, Call)), None)
        self.bind({} if frame is None else frame.saved, name, value)

    def output(self, value: Value | None, word: str) -> None:
        """Leave the procedure that runs, with a value or without one. Raises ``LogoError`` outside of procedures."""
        if self.procedure is None:
            raise LogoError(f"{word} works only inside a procedure")
        while True:
            frame = self.pop()
            if isinstance(frame, Call):
                frame.give(self, value)
                return

    def _call(self, name: str, count: int) -> None:
        procedure = self.words.procedures[name]
        stack = self.stack
        values = stack[len(stack) - count :]
        del stack[len(stack) - count :]
        mode = self._leave_for_tail_call()
        frame = self.frames[-1]
        if mode is not None and isinstance(frame, Call):
            frame.become(self._body(procedure), name, mode)
        else:
            if self.depth >= self.limits.depth:
                raise LogoStopped(
                    f"stopped: {self.limits.depth} procedures wait for one another. Does {name} have a condition "
                    "under which it does not call itself?"
                )
            frame = Call(self._body(procedure), name, len(stack))
            self.depth += 1
            self.push(frame)
        for input_, value in zip(procedure.inputs, values, strict=True):
            self.bind(frame.saved, input_, value)

    def _body(self, procedure: Procedure) -> Code:
        if procedure.cache is None or procedure.cache[0] is not self.words:
            try:
                procedure.cache = (self.words, compile_body(procedure.body, self.words))
            except LogoError as error:
                error.procedure = procedure.name
                raise
        code: Code = procedure.cache[1]
        return code

    def _leave_for_tail_call(self) -> str | None:
        """Leave the frames that have nothing more to do, down to that of the procedure; return what is asked of it.

        None: something remains to be done, and nothing was left.
        """
        frames = self.frames
        at = len(frames) - 1
        while at >= 0 and type(frames[at]) is Block and frames[at].pc == len(frames[at].code):
            at -= 1
        frame = frames[at] if at >= 0 else None
        if frame is None or frame.pc >= len(frame.code):
            return None
        op, what, _, _ = frame.code[frame.pc]
        is_output = op is Op.CONTROL and what.name == "output"
        is_last = op is Op.DISCARD and frame.pc + 1 == len(frame.code) and isinstance(frame, Call)
        if not is_output and not is_last:
            return None
        call = frames[at]
        while not isinstance(call, Call) and at > 0:
            if type(call).leave is not Frame.leave:  # what is called still needs what would be restored
                return None
            at -= 1
            call = frames[at]
        if not isinstance(call, Call) or call.mode == ("nothing" if is_output else "value"):
            return None
        while len(frames) > at + 1:
            self.pop()
        del self.stack[call.base :]
        return "value" if is_output else "nothing"

    # -- what primitives use -------------------------------------------------------------------------------------

    def moved(self, count: int = 1) -> None:
        """Count movements of turtles. Raises ``LogoStopped`` for too many."""
        self.moves += count
        if self.moves > self.limits.moves:
            raise LogoStopped(
                f"stopped after {self.limits.moves} movements of turtles: is there a loop that never ends?"
            )

    def made(self, value: Value) -> Value:
        """Count the making of a large value as several steps."""
        self.steps += weight(value) // 32
        return value

    def no_value(self, name: str) -> LogoError:
        """The error for a name that stands for nothing."""
        guess = suggestion(name, list(self.variables))
        return LogoError(f"{name} has no value{guess.replace('did you mean ', 'did you mean :')}")

    def write(self, text: str) -> None:
        """Print a line. Raises ``LogoStopped`` for too many."""
        self.lines += 1
        if self.lines > self.limits.lines:
            raise LogoStopped(f"stopped after {self.limits.lines} lines: is there a loop that never ends?")
        self.say(self.typed + text)
        self.typed = ""


def unused(value: Value | None) -> None:
    """Raises ``LogoError`` for what is left of an instruction."""
    if value is not None:
        raise LogoError(f"you don't say what to do with {described(value)}")
