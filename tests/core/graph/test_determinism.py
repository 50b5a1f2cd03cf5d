"""The same program gives the same sequence of events: in two processes, and twice in one."""

from __future__ import annotations

import json
import os
import sys
from pathlib import Path
from typing import Any

import pytest

from ...processes import run
from .ten_nodes import record

PROGRAM = Path(__file__).with_name("ten_nodes.py")


def test_two_runs_in_one_process_are_equal(capsys: pytest.CaptureFixture[str]) -> None:
    first, second = record(), record()
    capsys.readouterr()
    assert first == second
    kinds = {event[1] for event in first if len(event) == 3}
    assert kinds == {"names", "out", "log"}
    assert len(first) > 1000
    times = [event[0] for event in first]
    assert times == sorted(times)


def in_a_process(hash_seed: str) -> Any:
    """Return what a fresh interpreter records."""
    done = run([sys.executable, str(PROGRAM)], env={**os.environ, "PYTHONHASHSEED": hash_seed}, check=True)
    return json.loads(done.stdout)


def test_two_processes_with_different_hash_seeds_are_equal(capsys: pytest.CaptureFixture[str]) -> None:
    here = json.loads(json.dumps(record()))
    capsys.readouterr()
    assert in_a_process("1") == here
    assert in_a_process("4711") == here


def test_another_seed_gives_other_numbers_and_each_name_its_own() -> None:
    from rosmini.core.graph import Graph

    def draw(seed: int, name: str) -> list[int]:
        with Graph(seed=seed) as graph:
            return list(graph.rng(name).integers(1 << 30, size=4).tolist())

    assert draw(1, "/a") == draw(1, "/a")
    assert draw(1, "/a") != draw(1, "/b")
    assert draw(1, "/a") != draw(2, "/a")
