"""`rosmini lab`: open the notebooks in JupyterLab."""

from __future__ import annotations

import argparse
import os
from importlib.util import find_spec

from rosmini.cli.checkout import find_checkout
from rosmini.errors import RosminiError

from .build import has_display


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
        "--port",
        type=port_number,
        default=8888,
        help="the port to serve on (default: %(default)s, or the next free)",
    )


def lab_arguments(args: argparse.Namespace, notebooks: str) -> list[str]:
    """The command line of JupyterLab that `args` asks for."""
    arguments = [
        f"--ServerApp.root_dir={notebooks}",
        "--ServerApp.ip=127.0.0.1",
        f"--ServerApp.port={args.port}",
    ]
    # No question about news, no confirmation at Ctrl-C.
    arguments += ["--LabApp.news_url=None", "--LabApp.check_for_updates_class=jupyterlab.NeverCheckForUpdate"]
    arguments += ["--ServerApp.answer_yes=True"]
    # In a container everybody is root, and the server listens to this machine only.
    if getattr(os, "geteuid", lambda: 1)() == 0:
        arguments.append("--allow-root")
    return arguments + (["--no-browser"] if args.no_open or not has_display() else [])


def main(args: argparse.Namespace) -> int:
    """Serve until Ctrl-C. Raises `RosminiError` if JupyterLab is not installed."""
    notebooks = find_checkout() / "notebooks"
    if find_spec("jupyterlab") is None:
        raise RosminiError(
            "JupyterLab is not installed in this environment; run `uv run rosmini lab` in the checkout, "
            "or `pip install -e '.[book]'` first"
        )
    from jupyterlab.labapp import LabApp

    LabApp.launch_instance(lab_arguments(args, str(notebooks)))
    return 0
