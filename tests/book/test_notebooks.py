"""Notebook hygiene: each rule refuses what it is there to refuse, and a clean notebook passes."""

from __future__ import annotations

import json

import nbformat
import pytest
from nbformat.v4 import new_code_cell, new_markdown_cell, new_notebook, new_output

from book.tools import notebooks


def stream(text: str):
    return new_output("stream", name="stdout", text=text)


def notebook(*cells, **metadata):
    metadata = {"kernelspec": dict(notebooks.KERNELSPEC), "language_info": dict(notebooks.LANGUAGE)} | metadata
    return new_notebook(cells=list(cells), metadata=metadata)


def code(source: str, count: int | None = 1, *outputs, **metadata):
    return new_code_cell(source, execution_count=count, outputs=list(outputs), metadata=metadata)


ONE_SIDED = "folded in the book or in JupyterLab only: the tag hide-input and jupyter.source_hidden go together"
FOLDED = {"tags": ["hide-input"], "jupyter": {"source_hidden": True}}


def test_a_clean_notebook_has_no_problems():
    nb = notebook(new_markdown_cell("# T"), code("1 + 1", 1), code("print(2)", 2, stream("2\n"), **FOLDED))
    assert list(notebooks.problems(nb)) == []


@pytest.mark.parametrize(
    ("cell", "problem"),
    [
        (code("x = 1", None), "cell 1 was not executed: 'x = 1'"),
        (code("x = 1", 7), "cell 1 was executed as number 7, not 1: run all, from the top: 'x = 1'"),
        (code("x", tags=["nbval-skip"]), "cell 1 has the tag nbval-skip and gives no reason: 'x'"),
        (code("x", tags=["raises-exception"]), "cell 1 has the tag raises-exception and gives no reason: 'x'"),
        (
            code("# NBVAL_IGNORE_OUTPUT\nx"),
            "cell 1 has the comment NBVAL_IGNORE_OUTPUT and gives no reason: '# NBVAL_IGNORE_OUTPUT'",
        ),
        (code("x", execution={"iopub.status.busy": "2026"}), "cell 1 has metadata of a tool or a run (execution): 'x'"),
        (code("", None), "cell 1 is empty: ''"),
        *((code("x", **{key: FOLDED[key]}), f"cell 1 is {ONE_SIDED}: 'x'") for key in FOLDED),
        (code("clear_output()"), "cell 1 uses clear_output, whose output nbval cannot compare: 'clear_output()'"),
        (
            code("save('a');"),
            "cell 1 hides its value with a semicolon, which nbval does not see: assign it: \"save('a');\"",
        ),
        (code("x", 1, stream("A=/opt/ros/x")), "cell 1 printed a path of this machine ('/opt/r'): 'x'"),
        (code("x", 1, stream("<f at 0x7f00deadbeef>")), "cell 1 printed a memory address ('0x7f00deadbeef'): 'x'"),
        (code("x", 1, stream("in /home/me/x.py")), "cell 1 printed a path of this machine ('/home/m'): 'x'"),
        (code("x", 1, stream("http://127.0.0.1:7000")), "cell 1 printed a local address ('127.0.0.1'): 'x'"),
        (
            code("x", 1, stream("<script>const book = false, packed = {}</script>")),
            "cell 1 holds a moving picture in its live form: `execute` stores the small one that the book shows: 'x'",
        ),
    ],
)
def test_what_is_refused(cell, problem):
    assert list(notebooks.problems(notebook(cell))) == [problem]


@pytest.mark.parametrize(
    "cell",
    [
        code("# reason: it prints the time\nx", tags=["nbval-ignore-output"]),
        code("x", tags=["nbval-skip"], reason="it needs a camera"),
        code("# NBVAL_IGNORE_OUTPUT: it prints the time\nx"),
        code("x", 1, stream("the topic /rosout, the type geometry_msgs/Twist, http://localhost:11311/")),
    ],
)
def test_what_is_accepted(cell):
    assert list(notebooks.problems(notebook(cell))) == []


@pytest.mark.parametrize("fence", ["> ```console", "> ~~~console", "~~~yaml", "> > ```"])
def test_a_fence_that_jupyterlab_shows_wrongly_is_refused(fence):
    problem, *others = notebooks.problems(notebook(new_markdown_cell(f"> **On a real robot.**\n>\n{fence}\n")))
    assert fence in problem
    assert others == []


def test_a_fence_at_the_start_of_a_line_is_accepted():
    box = "<blockquote>\n\n**On a real robot.**\n\n```console\n$ rosnode list\n```\n\n</blockquote>"
    assert list(notebooks.problems(notebook(new_markdown_cell(box)))) == []


@pytest.mark.parametrize("info", [{"name": "python"}, notebooks.LANGUAGE | {"version": "3.11.7"}])
def test_the_metadata_of_the_notebook(info):
    nb = notebook(code("x"), language_info=info, widgets={})
    widgets, language = notebooks.problems(nb)
    assert "widgets" in widgets and "language_info" in language
    notebooks.clean(nb)
    assert list(notebooks.problems(nb)) == []


def test_saving_in_jupyterlab_changes_no_metadata():
    stored = notebook(code("x"))
    notebooks.clean(stored)
    model = {"type": "notebook", "content": json.loads(json.dumps(stored))}
    model["content"]["metadata"]["language_info"]["version"] = "3.13.0"
    model["content"]["cells"][-1]["metadata"]["execution"] = {"iopub.status.busy": "now"}
    notebooks.before_save(model=model, path="a.ipynb", contents_manager=None)
    assert model["content"] == stored
    notebooks.before_save(model={"type": "file", "content": "text"})


def test_execute_stores_outputs_that_pass_and_are_the_same_bytes(tmp_path):
    path = tmp_path / "a.ipynb"
    nbformat.write(notebook(code("print(1)\nprint(2)", None), code("40 + 2", None)), path)
    assert notebooks.main(["check", str(path)]) == 1
    assert notebooks.main(["execute", str(path)]) == 0
    once = path.read_bytes()
    stored = notebooks.read(path)
    assert stored.cells[0].outputs[0].text == "1\n2\n"
    assert stored.cells[1].outputs[0].data == {"text/plain": "42"}
    assert notebooks.main(["execute", str(path)]) == 0
    assert path.read_bytes() == once


def test_nbconvert_writes_a_python_script():
    exporter = pytest.importorskip("nbconvert").exporters.ScriptExporter()
    _, resources = exporter.from_notebook_node(notebook(code("print(1)")))
    assert resources["output_extension"] == ".py"
