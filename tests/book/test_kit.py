"""The class kit: what its archive contains, and what it says if a wheel is missing. Nothing is downloaded."""

import subprocess
import sys
import zipfile
from pathlib import Path

import pytest

from book.tools import kit

CHECKOUT = Path(__file__).resolve().parents[2]


@pytest.fixture
def parts(tmp_path):
    """A folder with wheels, notebooks and pages, one file each and one that does not belong there."""
    for name in ("wheels/a-1-py3-none-any.whl", "wheels/log", "nb/1_start/10.ipynb", "nb/x.py", "pages/book/a.html"):
        path = tmp_path / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(name, encoding="utf-8")
    return tmp_path


def test_the_archive_contains_wheels_notebooks_and_the_book(parts):
    target = parts / "out" / "kit.zip"
    kit.write_kit(target, parts / "wheels", parts / "nb", parts / "pages", {"README.txt": "Hello"})
    with zipfile.ZipFile(target) as archive:
        assert {name.removeprefix("rosmini-kit/") for name in archive.namelist()} == {
            "README.txt",
            "wheels/a-1-py3-none-any.whl",
            "notebooks/1_start/10.ipynb",
            "book/book/a.html",
        }


def test_students_need_jupyterlab_and_no_sphinx():
    needed = " ".join(kit.requirements(CHECKOUT))
    assert "jupyterlab" in needed and "numba" in needed
    assert "sphinx" not in needed and "jupyter-book" not in needed


@pytest.fixture
def fake_uv(tmp_path, monkeypatch):
    """A uv that finds no wheel."""
    script = tmp_path / "uv.py"
    script.write_text("import sys; sys.exit('lz4 has no usable wheels')", encoding="utf-8")
    run = subprocess.run
    monkeypatch.setenv("UV", "uv")
    monkeypatch.setattr(kit.subprocess, "run", lambda command, **named: run([sys.executable, script], **named))


@pytest.mark.usefixtures("fake_uv")
@pytest.mark.parametrize("platform", kit.PLATFORMS)
def test_a_missing_wheel_is_named(tmp_path, platform):
    with pytest.raises(kit.KitError, match="lz4"):
        kit.add_wheels(CHECKOUT, tmp_path, platform, "3.12")
