"""ruff and mypy read the scripts of chapters, which are no code to them in a notebook."""

from __future__ import annotations

import sys
import tomllib
from collections.abc import Callable
from pathlib import Path

import pytest

from book.tools import notebooks
from book.tools.scripts import scripts
from rosmini.tools.stubs import stub_files, write

from ..conftest import tool
from ..processes import run

Mypy = Callable[..., tuple[str, str, int]]

ROOT = Path(__file__).resolve().parents[2]
CHAPTERS = sorted((ROOT / "notebooks").rglob("*.ipynb"))
MYPY = """[mypy]
mypy_path = typings
check_untyped_defs = True
follow_imports = silent
strict_optional = False
disable_error_code = var-annotated
[mypy-notebook.*,courier.*]
ignore_missing_imports = True
"""
"""The packages are those that cells make."""


def ruffs(folder: Path) -> str:
    """What ruff says of the scripts in a folder, with the rules for notebooks."""
    tool("ruff")
    settings = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))
    ignored = settings["tool"]["ruff"]["lint"]["per-file-ignores"]["notebooks/**"]
    words = ["check", "--no-cache", "--config", ROOT / "pyproject.toml", "--extend-ignore", ",".join([*ignored, "EXE"])]
    return run([sys.executable, "-m", "ruff", *words, "--output-format", "concise", "."], cwd=folder).stdout


def mypys(folder: Path, monkeypatch: pytest.MonkeyPatch, mypy: Mypy) -> str:
    """What mypy says of them."""
    monkeypatch.chdir(folder)
    write(folder / "typings", stub_files()[0])
    (folder / "mypy.ini").write_text(MYPY, encoding="utf-8")
    words = ["--config-file", "mypy.ini", "--explicit-package-bases", *map(str, sorted(folder.glob("c*/*.py")))]
    return "".join(line + "\n" for line in mypy(words)[0].splitlines() if ": error: " in line)


def put(folder: Path, chapter: str, name: str, text: str) -> None:
    path = folder / chapter / name
    path.parent.mkdir(exist_ok=True)
    path.write_text(text, encoding="utf-8")


@pytest.mark.nightly
def test_the_scripts_of_all_chapters_pass_and_a_wrong_one_does_not(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, mypy: Mypy
) -> None:
    for chapter in CHAPTERS:
        for name, text in scripts(notebooks.read(chapter)).items():
            put(tmp_path, f"c{chapter.stem}", name, text)
    wrong = "import os\nfrom std_msgs.msg import String\n\nString(dat='x')\nprint(unknown)\n"
    put(tmp_path, "c", "wrong.py", wrong)
    linted = [line for line in ruffs(tmp_path).replace("\\", "/").splitlines() if ".py:" in line]
    assert {line.partition(":")[0] for line in linted} == {"c/wrong.py"}
    assert {"1:8: F401", "5:7: F821"} <= {line.partition(":")[2][:9] for line in linted}
    typed = mypys(tmp_path, monkeypatch, mypy).replace("\\", "/").splitlines()
    assert {line.partition(": error")[0] for line in typed} == {"c/wrong.py:4", "c/wrong.py:5"}
