"""Interfaces of a script for the importer and the shims."""

# ruff: noqa: D102 - `ScriptContext` says what each method does

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Protocol

from rosmini.core.graph.lanes import LaneContext

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence
    from contextlib import AbstractContextManager
    from pathlib import Path
    from types import ModuleType

    from rosmini.core.graph.lanes import Waiter
    from rosmini.core.graph.scheduler import Scheduler


class ScriptImporter(Protocol):
    """The importer of a script."""

    private: dict[str, ModuleType]

    def import_name(
        self,
        name: str,
        globals: Mapping[str, Any] | None = None,
        locals: Mapping[str, Any] | None = None,
        fromlist: Sequence[str] | None = (),
        level: int = 0,
    ) -> ModuleType:
        """Import like ``builtins.__import__``."""

    def load(self, name: str) -> ModuleType:
        """Import like ``importlib.import_module``."""


class Script(LaneContext, Protocol):
    """Interface of :class:`~rosmini.ros.scripts.context.ScriptContext`, where each member is documented."""

    name: str
    seed: str
    node: Any
    process: Any
    package: Path | None
    ended: bool
    builtins: dict[str, Any]
    builtins_module: ModuleType
    library_builtins: dict[str, Any]
    exit_calls: list[tuple[Callable[..., Any], tuple[Any, ...], dict[str, Any]]]
    handlers: dict[int, Any]
    threads: Any
    thread_classes: dict[str, Any]

    @property
    def scheduler(self) -> Scheduler: ...
    @property
    def importer(self) -> ScriptImporter: ...
    def get_own(self, name: str) -> Any: ...
    def set_own(self, name: str, value: Any) -> None: ...
    def put_aside(self) -> AbstractContextManager[None]: ...
    def after_import(self, name: str) -> None: ...
    def module_added(self, name: str, module: ModuleType) -> None: ...
    def module_removed(self, name: str) -> None: ...
    def local_folders(self) -> tuple[str, ...]: ...
    def pause(self, reason: str, timeout_ns: int | None) -> bool: ...
    def block(self, waiter: Waiter, timeout_ns: int | None = None) -> bool: ...
    def outside(self, function: Callable[[], Any]) -> Any: ...
    def keep_pace(self, condition: Callable[[], bool]) -> None: ...
    def deliver(self, signum: int, *, in_place: bool = False) -> bool: ...
    def await_signal(self) -> None: ...
    def raise_signal(self, signum: int, /) -> None: ...
    def leave_process(self, returncode: int) -> None: ...
    def run_exit_calls(self) -> None: ...
    def lane_failed(self, error: BaseException) -> None: ...
    def thread_ended(self) -> None: ...
    def thread_class(self) -> Any: ...
    def event_class(self) -> Any: ...
