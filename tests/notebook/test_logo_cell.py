"""``%%logo``: a cell is a program in Logo."""


def test_a_cell_draws_on_paper_and_the_next_one_knows_its_procedures(notebook):
    written = notebook.ok("%%logo\nto square :side\nrepeat 4 [fd :side rt 90]\nend\nsquare 50 print pos")
    assert written.startswith("0 0\n") and "4 lines, 200 steps" in written
    assert "8 lines, 600 steps" in notebook.ok("%%logo --title 'Figure 1: two squares'\nsquare 100")
    assert notebook.ok("%%logo\nprint 7 * 6") == "42\n"


def test_a_cell_drives_the_turtles_of_turtlesim(notebook):
    notebook.ok("%rosrun turtlesim turtlesim_node")
    notebook.ok("%%logo\nfd 90")
    assert "y: 7.54" in notebook.ok("%rostopic echo -n 1 /turtle1/pose")
    notebook.ok('%%logo turtle1\nnewturtle "bob tell "bob bk 45')
    assert "y: 4.54" in notebook.ok("%rostopic echo -n 1 /bob/pose")


def test_errors_have_the_line_of_the_cell(notebook):
    written = notebook.ok("%%logo\nfd 10\nfrwd 10")
    assert written.startswith("line 3: ") and "frwd" in written and "did you mean forward?" in written
    written = notebook.ok("%%logo\nfd 10\nprint first []")
    assert written.startswith("line 3: first doesn't like [] as input") and "1 line, 10 steps" in written
    assert "no turtle and no robot turtle7" in notebook.fails("%%logo turtle7\nfd 10")
    assert "unknown option '--fast'" in notebook.fails("%%logo --fast\nfd 10")
    assert "takes a caption" in notebook.fails("%%logo --title\nfd 10")
    assert notebook.ok("%%logo\nprint pos") == "0 10\n"


def test_roscore_begins_anew(notebook):
    notebook.ok("%%logo\nto f\nprint 1\nend\nf")
    notebook.ok("%roscore")
    assert "I don't know how to f" in notebook.ok("%%logo\nf")


def test_the_line_magic_runs_a_program_that_comes_along(notebook):
    notebook.ok("%rosrun turtlesim turtlesim_node")
    notebook.ok("%logo star")
    assert "x: 3.8" in notebook.ok("%rostopic echo -n 1 /turtle1/pose")
