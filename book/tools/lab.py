"""`rosmini lab`: open the notebooks in JupyterLab."""

from __future__ import annotations

import argparse
import os
import shutil
import subprocess
import sys
from importlib.util import find_spec
from pathlib import Path
from typing import Any

from rosmini.book.checks import PROGRESS
from rosmini.core.errors import RosminiError
from rosmini.tools.checkout import find_checkout

from . import notebooks as stored
from .build import has_display

INSTALLING = "ROSMINI_INSTALLS_LAB"
"""Set for the second run of the command, which installs nothing more."""

FIRST = "1_start/10_first_steps.ipynb"
"""What opens first."""

SOLVED = "rosmini-progress.json"
"""The file beside the notebooks in which their checks note solved exercises."""

OWN_SETTINGS = Path(__file__).with_name("jupyter")
"""Defaults of the user interface: no question about news."""


def port_number(text: str) -> int:
    """The TCP port that `text` names; raises `ArgumentTypeError` if there is no such port."""
    if not text.isdecimal() or not 0 < int(text) < 65536:
        raise argparse.ArgumentTypeError(f"{text!r} is not a port: give a number from 1 to 65535")
    return int(text)


def add_parser(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Add the parser of `rosmini lab`."""
    parser = subparsers.add_parser(
        "lab",
        help="open the notebooks in JupyterLab",
        description="Open the notebooks in JupyterLab, served on 127.0.0.1 only. Ctrl-C ends it.",
    )
    parser.add_argument("--no-open", action="store_true", help="start the server, and open no browser")
    parser.add_argument(
        "--port", type=port_number, default=8888, help="the port to serve on (default: %(default)s, or the next free)"
    )
    parser.add_argument(
        "--copy",
        type=Path,
        metavar="FOLDER",
        help="work on a copy of the notebooks in FOLDER, so that running them leaves the book's own unchanged; "
        "notebooks that are already there are kept",
    )


def lab_arguments(args: argparse.Namespace, notebooks: str) -> list[str]:
    """The command line of JupyterLab that `args` asks for."""
    arguments = [
        f"--ServerApp.root_dir={notebooks}",
        f"--LabApp.default_url=/lab/tree/{FIRST}",
        "--ServerApp.ip=127.0.0.1",
        f"--ServerApp.port={args.port}",
        "--ServerApp.kernel_spec_manager_class=book.tools.kernels.Kernels",
        "--FileContentsManager.pre_save_hook=book.tools.notebooks.before_save",
    ]
    # No news, no confirmation at Ctrl-C.
    arguments += ["--LabApp.news_url=None", "--LabApp.check_for_updates_class=jupyterlab.NeverCheckForUpdate"]
    arguments += ["--ServerApp.answer_yes=True"]
    # In a container everybody is root, and the server listens to this machine only.
    if getattr(os, "geteuid", lambda: 1)() == 0:
        arguments.append("--allow-root")
    return arguments + (["--no-browser"] if args.no_open or not has_display() else [])


def unchanged(folder: Path) -> list[Path]:
    """The notebooks in `folder` that are as in the current commit of its git repository; none without git."""

    def ask(*command: str) -> set[str]:
        done = subprocess.run(["git", "-C", str(folder), *command], capture_output=True, check=True, encoding="utf-8")
        return {name for name in done.stdout.split("\0") if name.endswith(".ipynb")}

    try:
        committed = ask("ls-tree", "-r", "-z", "--name-only", "HEAD", "--", ".")
        changed = ask("diff", "-z", "--name-only", "--relative", "HEAD", "--", ".")
    except (OSError, subprocess.CalledProcessError):
        return []
    return [folder / name for name in sorted(committed - changed)]


def trust(folder: Path) -> int:
    """Let Jupyter show the stored figures of the book's notebooks in `folder`; return how many notebooks that are.

    Only unchanged ones are signed: a figure can run scripts in the reader's browser. What readers change and run
    themselves Jupyter signs when it saves.
    """
    from nbformat.sign import NotebookNotary

    notary: Any = NotebookNotary()  # type: ignore[no-untyped-call]
    own = unchanged(folder)
    for path in own:
        notary.sign(stored.read(path))
    return len(own)


def with_jupyterlab(checkout: Path) -> int:
    """Have uv install JupyterLab, and run the same command again; return its exit status.

    Raises `RosminiError` without uv, and if JupyterLab is still missing afterwards.
    """
    uv = os.environ.get("UV") or shutil.which("uv")
    if uv is None or os.environ.get(INSTALLING):
        raise RosminiError(
            "JupyterLab is not installed in this environment; run `uv run --extra lab rosmini lab` in the checkout, "
            "or `pip install -e '.[book,lab]'` first"
        )
    print("Installing JupyterLab (once) ...", flush=True)
    command = [uv, "run", "--project", str(checkout), "--extra", "lab", "rosmini", *sys.argv[1:]]
    return subprocess.run(command, env=os.environ | {INSTALLING: "1"}, check=False).returncode


def copy_notebooks(source: Path, target: Path) -> Path:
    """Copy the notebooks of `source` that `target` does not have yet; return `target`.

    Raises `RosminiError` if the folder cannot be written to.
    """
    try:
        for path in sorted(source.rglob("*.ipynb")):
            copied = target / path.relative_to(source)
            copied.parent.mkdir(parents=True, exist_ok=True)
            if not copied.exists():
                shutil.copyfile(path, copied)
    except OSError as error:
        raise RosminiError(f"the notebooks cannot be copied to {target}: {error.strerror}") from error
    return target


def prefer_own_settings() -> None:
    """Put `OWN_SETTINGS` before the folders in which this process's Jupyter looks for settings.

    They are defaults: JupyterLab prefers what the reader has chosen in it.
    """
    others = os.environ.get("JUPYTER_CONFIG_PATH")
    os.environ["JUPYTER_CONFIG_PATH"] = os.pathsep.join([str(OWN_SETTINGS), *([others] if others else [])])


def main(args: argparse.Namespace) -> int:
    """Serve until Ctrl-C. Raises `RosminiError` if JupyterLab is not installed and uv cannot install it."""
    notebooks = find_checkout() / "notebooks"
    if find_spec("jupyterlab") is None:
        return with_jupyterlab(notebooks.parent)
    from jupyterlab.labapp import LabApp

    prefer_own_settings()
    if not trust(notebooks):
        print(
            "The stored figures show once their cells have run: without git's history of this folder "
            "it is not known whether its notebooks are the book's."
        )
    served = copy_notebooks(notebooks, args.copy.resolve()) if args.copy else notebooks
    os.environ[PROGRESS] = str(served / SOLVED)
    LabApp.launch_instance(lab_arguments(args, str(served)))
    return 0
