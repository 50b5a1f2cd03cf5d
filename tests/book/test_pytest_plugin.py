"""Notebooks run with the display form of the book, whoever runs them; other tests do not."""

from __future__ import annotations

import os
import sys

import nbformat

from book.tools import notebooks

from ..processes import run

CELL = "import os; print(os.environ.get('ROSMINI_DISPLAY'))"


def make(folder, name, printed):
    stored = [nbformat.v4.new_output("stream", name="stdout", text=f"{printed}\n")]
    cell = nbformat.v4.new_code_cell(CELL, execution_count=1, outputs=stored)
    notebook = nbformat.v4.new_notebook(cells=[cell])
    nbformat.write(notebook, folder / f"{name}.ipynb")
    return notebook


def test_nbval_runs_notebooks_in_the_form_of_the_book_and_leaves_other_tests_alone(tmp_path):
    make(tmp_path, "a", "book")
    (tmp_path / "test_b.py").write_text(
        "import os\ndef test(): assert os.environ.get('ROSMINI_DISPLAY') == 'before'\n", encoding="utf-8"
    )
    command = [sys.executable, "-m", "pytest", "-q", "--nbval", "--nbval-current-env", "-p", "no:cacheprovider"]
    environment = os.environ | {"ROSMINI_DISPLAY": "before"}
    done = {
        plugin: run([*command, *plugin, tmp_path], env=environment, cwd=tmp_path)
        for plugin in [("-p", "book.tools.pytest_plugin"), ()]
    }
    with_plugin, without = done.values()
    assert "2 passed" in with_plugin.stdout, with_plugin.stdout
    assert "1 failed, 1 passed" in without.stdout


def test_nothing_sees_the_ros_of_the_user_and_compiled_modules_stay_out_of_the_checkout(tmp_path):
    (tmp_path / "module.py").touch()
    (tmp_path / "test_a.py").write_text(
        "import os, pathlib, module\n"
        "def test():\n"
        "    assert not {'ROS_MASTER_URI', 'TURTLEBOT3_MODEL'} & set(os.environ)\n"
        "    assert pathlib.Path(module.__cached__).is_file()\n",
        encoding="utf-8",
    )
    of_user = {"ROS_MASTER_URI": "http://robot:11311", "TURTLEBOT3_MODEL": "waffle"}
    environment = os.environ | of_user | {"PYTHONDONTWRITEBYTECODE": "1"}
    cache = ["-o", f"cache_dir={tmp_path}/cache"]
    command = [sys.executable, "-m", "pytest", "-q", "-p", "book.tools.pytest_plugin", *cache]
    done = run([*command, tmp_path], env=environment, cwd=tmp_path)
    assert "1 passed" in done.stdout, done.stdout
    assert not (tmp_path / "__pycache__").exists()


def test_the_project_loads_the_plugin(pytestconfig):
    assert pytestconfig.pluginmanager.has_plugin("book.tools.pytest_plugin")


def test_execute_runs_a_notebook_in_the_form_of_the_book(tmp_path, monkeypatch):
    monkeypatch.delenv("ROSMINI_DISPLAY", raising=False)
    notebook = make(tmp_path, "a", "")
    notebooks.execute(notebook, tmp_path)
    assert notebook.cells[0].outputs[0].text == "book\n"
    assert "ROSMINI_DISPLAY" not in os.environ
