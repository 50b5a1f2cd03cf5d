"""What differs from machine to machine has one form in the book."""

from rosmini.core.packages.folders import assets_dir
from rosmini.notebook.places import Places, book_text


def test_paths_and_numbers(notebook):
    home = notebook.session.package.workspace.parent
    text = f"{home}/catkin_ws/src/notebook {assets_dir()}/ros/tf Pid: 17 pid [18] 17"
    assert book_text(text, Places(home)) == (
        "~/catkin_ws/src/notebook /opt/ros/noetic/share/tf Pid: 4242 pid [4242] 17"
    )


def test_cells_print_the_books_form_where_the_book_is_made(notebook, monkeypatch):
    workspace = str(notebook.session.package.workspace)
    bad = "%%node bad.py\n1 / 0"
    assert workspace in notebook.ok(bad)
    assert workspace in notebook.ok("%rospack find notebook")
    monkeypatch.setenv("ROSMINI_DISPLAY", "book")
    assert 'File "~/catkin_ws/src/notebook/scripts/bad.py", line 2' in notebook.ok(bad)
    assert notebook.ok("%rospack find notebook") == "~/catkin_ws/src/notebook\n"
    assert notebook.ok("%rospack find rosmini_sim") == "/opt/ros/noetic/share/rosmini_sim\n"
    assert "Pid: 4242" in notebook.ok("%rosnode info /rosout")
    notebook.ok('%%launch far.launch\n<launch><node pkg="rosmini_sim" type="square.py" name="far" ns="amy"/></launch>')
    said = notebook.ok("%roslaunch --args=/amy/far notebook far.launch")
    assert said == 'ROS_NAMESPACE="/amy" rosrun rosmini_sim square.py __name:=far\n'


def test_so_do_the_errors_of_cells(notebook, monkeypatch):
    notebook.session.package.write("launch", "bad.launch", "<launch>\n<node/>\n</launch>")
    folder = str(notebook.session.package.folder)
    lines = ("%rosrun notebook nope.py", "%roslaunch notebook bad.launch", "%rosrun nope nope")
    for line in lines:
        assert folder.removesuffix("/notebook") in notebook.fails(line)
    monkeypatch.setenv("ROSMINI_DISPLAY", "book")
    for line, shown in zip(lines, ("/src/notebook", "/src/notebook/launch/bad.launch:2", "/src"), strict=True):
        written = notebook.fails(line)
        assert f"~/catkin_ws{shown}" in written
        assert folder not in written
