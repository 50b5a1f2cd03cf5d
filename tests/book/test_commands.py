"""`rosmini book` and `rosmini lab`: where they find the sources, what they open, and what they say when they cannot."""

from __future__ import annotations

import json
import os
import re
import shutil
import subprocess
import sys
import urllib.error
import urllib.request
from pathlib import Path

import nbformat
import pytest
from nbformat.sign import NotebookNotary

from book.tools import book, build, lab, notebooks
from book.tools.build import BookError, build_book, has_display
from rosmini.book.checks import PROGRESS
from rosmini.tools import checkout, main
from rosmini.tools.checkout import NoCheckout, find_checkout

from ..conftest import tool
from ..processes import PATIENCE, free_port, listens, run, start, wait_until

ROOT = Path(__file__).resolve().parents[2]


def test_the_checkout_is_found_from_below(monkeypatch):
    monkeypatch.chdir(ROOT / "book" / "static")
    assert find_checkout() == ROOT


def test_outside_of_a_checkout_the_command_says_where_it_looked(monkeypatch, tmp_path, capsys):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(checkout, "__file__", str(tmp_path / "site-packages" / "rosmini" / "tools" / "checkout.py"))
    with pytest.raises(NoCheckout):
        find_checkout()
    assert main.main(["book"]) == 1
    said = capsys.readouterr().err
    assert str(tmp_path) in said
    assert "clone the repository" in said


@pytest.fixture
def built(monkeypatch, tmp_path):
    """A build that takes no time, and the addresses that a browser was told to open."""
    opened: list[str] = []
    first = tmp_path / "index.html"
    monkeypatch.setattr(book, "build_book", lambda *args, **options: first)
    monkeypatch.setattr(book.webbrowser, "open", lambda address: opened.append(address) or True)
    return first, opened


def test_the_book_is_opened_where_there_is_a_display(built, monkeypatch, capsys):
    first, opened = built
    monkeypatch.setattr(book, "has_display", lambda: True)
    assert main.main(["book"]) == 0
    assert opened == [first.as_uri()]
    assert f"The book is at {first}" in capsys.readouterr().out


def test_it_is_not_opened_without_a_display_or_against_the_reader_s_will(built, monkeypatch, capsys):
    first, opened = built
    monkeypatch.setattr(book, "has_display", lambda: False)
    assert main.main(["book"]) == 0
    assert "No display here" in capsys.readouterr().out
    monkeypatch.setattr(book, "has_display", lambda: True)
    assert main.main(["book", "--no-open"]) == 0
    assert f"The book is at {first}" in capsys.readouterr().out
    assert opened == []


def test_without_solutions_neither_pages_nor_exported_notebooks_have_them(monkeypatch, tmp_path):
    seen = []

    def build_book(source, output, *, quiet):
        assert quiet
        seen.extend(sorted((source / "notebooks").rglob("*.ipynb")))
        assert seen
        assert not any("<summary>Solution</summary>" in path.read_text(encoding="utf-8") for path in seen)
        assert (source / "book" / "_toc.yml").is_file()
        return output / "_build" / "html" / "index.html"

    monkeypatch.setattr(book, "build_book", build_book)
    assert main.main(["book", "--no-open", "--without-solutions", "--output", str(tmp_path)]) == 0
    exported = list((tmp_path / "_build" / "notebooks").rglob("*.ipynb"))
    assert len(exported) == len(seen)
    assert not any("<summary>Solution</summary>" in path.read_text(encoding="utf-8") for path in exported)


@pytest.mark.parametrize(
    ("platform", "environment", "seen"),
    [
        ("linux", {}, False),
        ("linux", {"DISPLAY": ":0"}, True),
        ("linux", {"WAYLAND_DISPLAY": "wayland-0"}, True),
        ("linux", {"DISPLAY": ":0", "CI": "true"}, False),
        ("win32", {}, True),
        ("darwin", {}, True),
    ],
)
def test_what_counts_as_a_display(platform, environment, seen, monkeypatch):
    for name in ("DISPLAY", "WAYLAND_DISPLAY", "CI"):
        monkeypatch.delenv(name, raising=False)
    for name, value in environment.items():
        monkeypatch.setenv(name, value)
    monkeypatch.setattr(build.sys, "platform", platform)
    assert has_display() is seen


def small_book(folder: Path, page: str) -> Path:
    """A checkout with one page."""
    (folder / "book").mkdir(parents=True)
    (folder / "notebooks").mkdir()
    (folder / "book" / "_toc.yml").write_text("format: jb-book\nroot: book/intro\n", encoding="utf-8")
    (folder / "book" / "_config.yml").write_text(
        "title: t\nauthor: a\nonly_build_toc_files: true\nsphinx:\n  config: {html_context: {default_mode: auto}}\n",
        encoding="utf-8",
    )
    (folder / "book" / "intro.md").write_text(page, encoding="utf-8")
    return folder


def test_a_warning_stops_the_build_and_is_shown(tmp_path, capfd):
    folder = small_book(tmp_path / "checkout", "# T\n\nSee {ref}`nowhere`.\n")
    with pytest.raises(BookError, match="the book was not built"):
        build_book(folder, tmp_path / "out")
    assert "undefined label: 'nowhere'" in capfd.readouterr().err


def test_a_build_leaves_nothing_of_the_one_before_and_touches_nothing_else(tmp_path):
    folder = small_book(tmp_path / "checkout", "# T\n\nText.\n")
    html = tmp_path / "out" / "_build" / "html"
    html.mkdir(parents=True)
    (html / "stale.html").touch()
    (html.parent / "mine.txt").touch()
    assert build_book(folder, tmp_path / "out") == html / "index.html"
    assert not (html / "stale.html").exists()
    assert (html.parent / "mine.txt").exists()
    assert sorted(path.name for path in (folder / "book").iterdir()) == ["_config.yml", "_toc.yml", "intro.md"]


def test_the_error_without_jupyter_book(monkeypatch, tmp_path):
    monkeypatch.setattr(build, "_has_jupyter_book", lambda: False)
    with pytest.raises(BookError, match="Jupyter Book is not installed"):
        build_book(tmp_path)


@pytest.mark.parametrize("port", ["x", "0", "65536", "-1", "8888.5"])
def test_a_bad_port_is_refused(port, capsys):
    with pytest.raises(SystemExit) as end:
        main.main(["lab", f"--port={port}"])
    assert end.value.code == 2
    assert "is not a port" in capsys.readouterr().err


def test_lab_names_the_file_in_which_checks_note_solved_exercises(monkeypatch, tmp_path):
    tool("jupyterlab")
    launched = []
    monkeypatch.setenv(PROGRESS, "")
    monkeypatch.setenv("JUPYTER_CONFIG_PATH", "")
    monkeypatch.setattr(lab, "trust", lambda folder: 1)
    monkeypatch.setattr("jupyterlab.labapp.LabApp.launch_instance", launched.append)
    assert main.main(["lab", "--no-open", "--copy", str(tmp_path)]) == 0
    assert f"--ServerApp.root_dir={tmp_path}" in launched[0]
    assert os.environ[PROGRESS] == str(tmp_path / "rosmini-progress.json")


def ask(address: str) -> dict:
    """What the server answers."""
    request = urllib.request.Request(address, headers={"Authorization": "token t0ken"})
    with urllib.request.urlopen(request, timeout=PATIENCE) as reply:
        return json.load(reply)


def listening_addresses(port: int) -> set[str]:
    """The local addresses (in the kernel's notation) at which something listens on `port`."""
    rows = [
        row.split()
        for table in ("tcp", "tcp6")
        for row in Path(f"/proc/net/{table}").read_text(encoding="utf-8").splitlines()[1:]
    ]
    return {row[1].partition(":")[0] for row in rows if row[3] == "0A" and int(row[1].partition(":")[2], 16) == port}


@pytest.mark.skipif(sys.platform != "linux", reason="reads /proc to see who listens")
def test_lab_serves_the_notebooks_on_this_machine_only(tmp_path):
    tool("jupyterlab")
    port = free_port()
    environment = os.environ | {"HOME": str(tmp_path), "JUPYTER_TOKEN": "t0ken", "PYTHONUNBUFFERED": "1"}
    command = [sys.executable, "-m", "rosmini", "lab", "--no-open", "--port", port]
    with start(command, cwd=ROOT, env=environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT) as server:
        for line in server.stdout:
            if re.search(rf"http://127\.0\.0\.1:{port}/lab", line):
                break
        else:
            pytest.fail("JupyterLab ended before it served")
        # It tells its address a moment before it listens.
        wait_until(lambda: listens(port), "JupyterLab", server)
        names = {entry["name"] for entry in ask(f"http://127.0.0.1:{port}/api/contents")["content"]}
        assert names == {path.name for path in (ROOT / "notebooks").iterdir() if not path.name.startswith(".")}
        assert listening_addresses(port) == {"0100007F"}
        plugin = "@jupyterlab/apputils-extension:notification"
        settings = ask(f"http://127.0.0.1:{port}/lab/api/settings/{plugin}")
        assert settings["schema"]["properties"]["fetchNews"]["default"] == "false"  # "none": it asks
        python = ask(f"http://127.0.0.1:{port}/api/kernelspecs/python3")["spec"]
        assert any("rosmini.notebook.unknown_magics" in argument for argument in python["argv"])
        server.terminate()  # it would ask before it ends, if there were somebody to answer
        server.communicate(timeout=PATIENCE)


def test_lab_opens_no_browser_unless_it_can(monkeypatch):
    monkeypatch.setattr(lab, "has_display", lambda: True)
    parser = main.build_parser({"lab": lab})
    assert "--no-browser" not in lab.lab_arguments(parser.parse_args(["lab"]), "n")
    assert "--no-browser" in lab.lab_arguments(parser.parse_args(["lab", "--no-open"]), "n")
    monkeypatch.setattr(lab, "has_display", lambda: False)
    assert "--no-browser" in lab.lab_arguments(parser.parse_args(["lab"]), "n")


@pytest.fixture
def copy(tmp_path, monkeypatch):
    """A git repository with two chapters, and Jupyter's signatures in a folder of its own."""
    monkeypatch.setenv("JUPYTER_DATA_DIR", str(tmp_path / "data"))
    folder = tmp_path / "repository" / "notebooks"
    folder.mkdir(parents=True)
    (folder / "part").mkdir()
    for name in ("part/a.ipynb", "b.ipynb"):
        output = nbformat.v4.new_output("display_data", {"text/html": f"<svg></svg>{name}"})
        cell = nbformat.v4.new_code_cell("1", execution_count=1, outputs=[output])
        notebooks.write(nbformat.v4.new_notebook(cells=[cell]), folder / name)
    for command in (
        ["init", "-q"],
        ["add", "."],
        ["-c", "user.name=a", "-c", "user.email=a@b", "commit", "-qm", "All"],
    ):
        run(["git", "-C", str(folder.parent), *command], check=True)
    return folder


def is_trusted(path):
    return NotebookNotary().check_signature(notebooks.read(path))


@pytest.mark.skipif(shutil.which("git") is None, reason="needs git")
def test_lab_trusts_the_notebooks_that_are_the_repositorys(copy):
    assert not is_trusted(copy / "part/a.ipynb")
    changed = (copy / "b.ipynb").read_text(encoding="utf-8").replace("<svg>", "<svg onload='1'>")
    (copy / "b.ipynb").write_text(changed, encoding="utf-8")
    (copy / "c.ipynb").write_text(changed.replace("'1'", "'2'"), encoding="utf-8")
    assert lab.trust(copy) == 1
    assert [is_trusted(copy / name) for name in ("part/a.ipynb", "b.ipynb", "c.ipynb")] == [True, False, False]


@pytest.mark.skipif(shutil.which("git") is None, reason="needs git")
def test_lab_opens_the_first_steps_and_a_copy_keeps_what_is_in_it(tmp_path):
    arguments = lab.lab_arguments(main.build_parser({"lab": lab}).parse_args(["lab"]), "n")
    assert "--LabApp.default_url=/lab/tree/1_start/10_first_steps.ipynb" in arguments
    source, target = tmp_path / "source", tmp_path / "target"
    for folder, name, text in ((source, "steps", "new"), (target, "steps", "mine"), (source, "more", "new")):
        (folder / "1_start").mkdir(parents=True, exist_ok=True)
        (folder / "1_start" / f"{name}.ipynb").write_text(text, encoding="utf-8")
    assert lab.copy_notebooks(source, target) == target
    copied = [(target / "1_start" / f"{name}.ipynb").read_text(encoding="utf-8") for name in ("steps", "more")]
    assert copied == ["mine", "new"]


def test_lab_trusts_no_notebook_without_a_history(copy):
    shutil.rmtree(copy.parent / ".git")
    assert lab.trust(copy) == 0
    assert not is_trusted(copy / "part/a.ipynb")
