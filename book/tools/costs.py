"""What the chapters cost: processor time, memory and size, as `pytest notebooks --costs FILE` measures them on Linux.

The committed measurement is `assets/benchmarks/chapters.json`; the page *What the chapters cost* shows it.
"""

from __future__ import annotations

import json
import os
import platform
import re
import subprocess
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

CHECKOUT = Path(__file__).resolve().parents[2]
FILE = CHECKOUT / "assets" / "benchmarks" / "chapters.json"
IN_BROWSER = FILE.with_name("in_browser.json")
"""The manual run of chapters in a browser."""
PROC = Path("/proc")


def of_process(pid: int) -> dict[str, float]:
    """Return what a process has used: `cpu` [s], with the children that have ended, and `memory` [MB] at its peak.

    Empty where there is no such process, or no `/proc`.
    """
    try:
        stat = (PROC / str(pid) / "stat").read_text(encoding="utf-8")
        status = (PROC / str(pid) / "status").read_text(encoding="utf-8")
    except OSError:
        return {}
    ticks = map(int, stat.rpartition(")")[2].split()[11:15])
    peak = int(re.findall(r"^VmHWM:\s+(\d+) kB$", status, re.MULTILINE)[0])
    return {"cpu": round(sum(ticks) / os.sysconf("SC_CLK_TCK"), 1), "memory": round(peak * 1024 / 1e6)}


def of_files(root: Path, name: str) -> dict[str, float]:
    """Return the number of code `cells` of a chapter, and the size of its `notebook` and of its `page` [kB].

    `name` is the notebook's path below `root` without the ending. A page that is not built has no size.
    """
    notebook = root / f"{name}.ipynb"
    files = {"notebook": notebook, "page": root / os.environ.get("ROSMINI_BOOK", "book/_build/html") / f"{name}.html"}
    cells = json.loads(notebook.read_text(encoding="utf-8"))["cells"]
    sizes = {kind: round(path.stat().st_size / 1000) for kind, path in files.items() if path.is_file()}
    return {"cells": sum(cell["cell_type"] == "code" for cell in cells), **sizes}


def machine() -> str:
    """Describe this computer: processor, system and Python."""
    info = PROC / "cpuinfo"
    models = re.findall(r"model name\s*: (.*)", info.read_text(encoding="utf-8")) if info.is_file() else []
    processor = models[0] if models else platform.machine()
    return f"{os.cpu_count()} processors ({processor}), {platform.system()}, Python {platform.python_version()}"


def write(path: Path, chapters: dict[str, dict[str, float]]) -> None:
    """Write a measurement, with the date, the commit and the machine, one chapter a line."""
    command = ["git", "rev-parse", "--short", "HEAD"]
    done = subprocess.run(command, cwd=CHECKOUT, capture_output=True, encoding="utf-8", check=False)
    run = {"date": datetime.now(UTC).date().isoformat(), "commit": done.stdout.strip(), "machine": machine()}
    lines = ",\n".join(f"{json.dumps(name)}: {json.dumps(cost)}" for name, cost in sorted(chapters.items()))
    text = f'{{"run": {json.dumps(run, ensure_ascii=False)},\n"chapters": {{\n{lines}\n}}}}\n'
    path.write_text(text, encoding="utf-8", newline="\n")


def read(path: Path = FILE) -> tuple[dict[str, str], dict[str, dict[str, Any]]]:
    """Return the `date`, `commit` and `machine` of a measurement, and the costs of each chapter."""
    stored = json.loads(path.read_text(encoding="utf-8"))
    return stored["run"], stored["chapters"]


def largest() -> dict[str, Any]:
    """Return the costs of the chapter that needs the most memory, with its `chapter`."""
    _, chapters = read()
    name = max(chapters, key=lambda each: float(chapters[each]["memory"]))
    return {"chapter": name, **chapters[name]}
