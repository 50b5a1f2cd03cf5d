"""The class kit: one archive from which students install rosmini and read the book without a network.

`uv run python -m book.tools.kit FOLDER` writes `FOLDER/rosmini-kit.zip`: our wheel, the wheels of all packages that the
notebooks need, the notebooks, the built book, and a `README.txt` with the commands. The wheels are chosen for each
platform and version of Python by uv, since pip would evaluate conditions such as `sys_platform == 'win32'` for the
computer that it runs on.
"""

from __future__ import annotations

import argparse
import os
import re
import shutil
import subprocess
import sys
import tempfile
import tomllib
import zipfile
from pathlib import Path

from book.tools.build import build_book
from rosmini.core.errors import RosminiError
from rosmini.tools.checkout import find_checkout

NAME = "rosmini-kit"
PYTHONS = ("3.11", "3.12", "3.13")
PLATFORMS = {
    "linux": (
        "x86_64-manylinux_2_28",
        [f"manylinux_2_{minor}_x86_64" for minor in range(28, 4, -1)] + ["manylinux2014_x86_64", "manylinux1_x86_64"],
    ),
    "macos": ("aarch64-apple-darwin", ["macosx_13_0_arm64"]),
    "windows": ("x86_64-pc-windows-msvc", ["win_amd64"]),
}
"""What uv and pip call the platforms: Linux on x86-64, macOS 13 on Apple's processors, Windows on x86-64."""

BUILDERS = re.compile(r"jupyter-book|sphinx|myst-nb|latex2mathml")
"""What the extra `book` contains for building the pages, which students get built."""

README = """rosmini: ROS 1 that you can read, run and test. This kit needs no network.

It is for Python {pythons} on {platforms}. Open a terminal in this folder (on Windows: PowerShell).

Linux and macOS:

    python3 -m venv env
    env/bin/python -m pip install --no-index --find-links wheels -r requirements.txt
    env/bin/python -m jupyterlab notebooks

Windows:

    py -m venv env
    env\\Scripts\\python -m pip install --no-index --find-links wheels -r requirements.txt
    env\\Scripts\\python -m jupyterlab notebooks

Begin with 1_start/10_first_steps.ipynb. Stored figures show once their cells have run.
To read without running anything, open book/index.html in a browser.
"""


class KitError(RosminiError):
    """The class kit could not be made."""


def requirements(checkout: Path) -> list[str]:
    """What the notebooks need besides rosmini, without what only builds the book."""
    project = tomllib.loads((checkout / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    extras = project["optional-dependencies"]
    return [each for name in ("book", "mcap", "lab") for each in extras[name] if not BUILDERS.match(each)]


def add_wheels(checkout: Path, wheels: Path, platform: str, python: str) -> None:
    """Download into `wheels` what rosmini and the notebooks need. Raises `KitError` that names what has no wheel."""
    for_uv, for_pip = PLATFORMS[platform]
    settings = tomllib.loads((checkout / "pyproject.toml").read_text(encoding="utf-8"))
    needed = "\n".join([*settings["project"]["dependencies"], *requirements(checkout)])
    target = ["--python-platform", for_uv, "--python-version", python, "--only-binary", ":all:"]
    pip = ["run", "-q", "--no-project", "--with", "pip", "python", "-m", "pip", "--disable-pip-version-check"]
    tags = [word for tag in for_pip for word in ("--platform", tag)]
    # In the checkout, uv would leave out a package that our environments do without, and that pip asks for.
    with tempfile.TemporaryDirectory() as folder:
        pins, chosen = Path(folder, "pins.txt"), Path(folder, "chosen.txt")
        pins.write_text("\n".join(settings["tool"]["uv"]["constraint-dependencies"]), encoding="utf-8")
        listed = _uv(folder, "pip", "compile", "-q", "--no-annotate", "-c", pins, *target, "-", given=needed)
        chosen.write_text(listed, encoding="utf-8")
        where = [*tags, "--python-version", python, "-d", str(wheels.resolve()), "-r", str(chosen)]
        _uv(folder, *pip, "download", "-q", "--no-deps", "--only-binary", ":all:", *where)


def _uv(folder: Path | str, *arguments: str | Path, given: str = "") -> str:
    """Run uv in a folder; return what it prints. Raises `KitError` if it fails."""
    uv = os.environ.get("UV") or shutil.which("uv")
    if uv is None:
        raise KitError("uv is not installed; it chooses the wheels. Install it, for instance with `pip install uv`")
    done = subprocess.run([uv, *arguments], cwd=folder, input=given, check=False, capture_output=True, encoding="utf-8")
    if done.returncode:
        raise KitError(f"the wheels could not be collected:\n{done.stderr.strip()}")
    return done.stdout


def write_kit(target: Path, wheels: Path, notebooks: Path, pages: Path, texts: dict[str, str]) -> Path:
    """Write the archive `target` of these folders and of `texts`, by the name of the file; return it."""
    target.parent.mkdir(parents=True, exist_ok=True)
    folders = {"wheels": (wheels, "*.whl"), "notebooks": (notebooks, "*.ipynb"), "book": (pages, "*")}
    with zipfile.ZipFile(target, "w", zipfile.ZIP_DEFLATED) as kit:
        for name, text in texts.items():
            kit.writestr(f"{NAME}/{name}", text)
        for name, (folder, pattern) in folders.items():
            for path in sorted(path for path in folder.rglob(pattern) if path.is_file()):
                packed = zipfile.ZIP_STORED if path.suffix == ".whl" else None
                kit.write(path, f"{NAME}/{name}/{path.relative_to(folder).as_posix()}", packed)
    return target


def main(arguments: list[str] | None = None) -> int:
    """Make the kit, and print where it is and its size. Raises `RosminiError` if a part of it cannot be made."""
    parser = argparse.ArgumentParser("python -m book.tools.kit", description="Make a class kit that needs no network.")
    parser.add_argument("folder", type=Path, help="where to write rosmini-kit.zip")
    parser.add_argument("--platform", nargs="+", choices=PLATFORMS, default=list(PLATFORMS), help="default: all three")
    parser.add_argument("--python", nargs="+", choices=PYTHONS, default=["3.12"], help="default: 3.12")
    parser.add_argument("--notebooks", type=Path, help="other notebooks, for instance without solutions")
    parser.add_argument("--pages", type=Path, help="the built book (default: build it)")
    args = parser.parse_args(arguments)
    checkout = find_checkout()
    with tempfile.TemporaryDirectory() as folder:
        wheels = Path(folder, "wheels")
        _uv(checkout, "build", "-q", "--wheel", "--out-dir", wheels)
        for platform in args.platform:
            for python in args.python:
                print(f"Collecting wheels for {platform}, Python {python} ...", flush=True)
                add_wheels(checkout, wheels, platform, python)
        pages = args.pages or build_book(checkout, Path(folder)).parent
        texts = {
            "README.txt": README.format(pythons=" or ".join(args.python), platforms=", ".join(args.platform)),
            "requirements.txt": "\n".join(["rosmini-ros", *requirements(checkout)]) + "\n",
        }
        kit = write_kit(args.folder / f"{NAME}.zip", wheels, args.notebooks or checkout / "notebooks", pages, texts)
    print(f"The class kit is {kit} ({kit.stat().st_size / 1e6:.0f} MB)")
    return 0


if __name__ == "__main__":
    try:
        sys.exit(main())
    except RosminiError as error:
        sys.exit(f"kit: {error}")
