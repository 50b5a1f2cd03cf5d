"""`rosmini world`: what it lists, what it says about files, how it ends."""

import pytest

import rosmini.tools.main as cli
from rosmini.core.packages import assets_dir
from rosmini.sim.worlds import names


def run(capsys, *arguments):
    status = cli.main(["world", *(str(each) for each in arguments)])
    done = capsys.readouterr()
    return status, done.out, done.err


def test_list_names_every_world_and_what_it_is(capsys):
    status, out, _ = run(capsys, "list")
    assert status == 0
    assert [line.split()[0] for line in out.splitlines()] == names()
    assert "A house of seven rooms" in out


def test_check_says_what_a_sound_file_is(capsys):
    package = assets_dir() / "ros"
    status, out, err = run(
        capsys, "check", "house", "arena", "floor", package / "turtlebot3_gazebo/models/sun/model.sdf"
    )
    assert (status, err) == (0, "")
    lines = out.splitlines()
    assert (
        "turtlebot3_house.world: sound: SDF 1.7: the world 'default': 152 obstacles, 7 starts, 16.4 m by 10.4 m"
        in lines[0]
    )
    for part in ("arena: ", "4 obstacles", "4 starts", "4.2 m by 4.2 m"):
        assert part in lines[1]
    assert "250 x 170 cells of 0.05 m" in lines[2]
    assert lines[-1].startswith("  ")
    assert lines[-1].endswith("model.sdf:3: a light: left out, the light is the same everywhere")


def test_check_knows_stage_worlds_and_models(capsys, tmp_path):
    (tmp_path / "m.sdf").write_text(
        "<!-- <world> --><sdf version='1.7'><model name='m'><static>1</static><link name='l'/></model></sdf>",
        encoding="utf-8",
    )
    (tmp_path / "s.world").write_text(
        'define floorplan model ( boundary 1 )\nfloorplan ( name "f" size [4 4 1] )\n', encoding="utf-8"
    )
    status, out, _ = run(capsys, "check", tmp_path / "m.sdf", tmp_path / "s.world")
    assert status == 0
    lines = [line for line in out.splitlines() if not line.startswith(" ")]
    assert "SDF 1.7: the model 'm': 1 link, 0 obstacles" in lines[0]
    assert "Stage: " in lines[1]


def test_the_verdict_names_what_is_left_out(capsys, tmp_path):
    (tmp_path / "s.world").write_text(
        "model( fiducial( ) fiducial( ) )\nposition( camera( range [0 0] ) )\nmodel( siez [1 1 1] )", encoding="utf-8"
    )
    (tmp_path / "w.world").write_text(
        "<sdf version='1.7'><world name='w'><include><uri>model://nowhere_to_be_found</uri></include></world></sdf>",
        encoding="utf-8",
    )
    status, out, _ = run(capsys, "check", tmp_path / "s.world", tmp_path / "w.world")
    assert status == 0
    lines = [line for line in out.splitlines() if not line.startswith(" ")]
    assert "read without a fiducial (2 times), a camera and the property siez: Stage" in lines[0]
    assert "w.world: read without a model: SDF 1.7" in lines[1]


def test_check_names_file_and_line_of_what_is_wrong(capsys, tmp_path):
    (tmp_path / "bad.yaml").write_text("image: a.png\nresolution: x\n", encoding="utf-8")
    (tmp_path / "bad.urdf").write_text("<robot name='r'></robot>", encoding="utf-8")
    (tmp_path / "stage.world").write_text("window ( size [ 1 2 )", encoding="utf-8")
    files = ["bad.yaml", "bad.urdf", "stage.world", "none.world"]
    status, out, err = run(capsys, "check", "pillars", *(tmp_path / file for file in files))
    assert status == 1
    assert "turtlebot3_world.world: sound" in out
    lines = err.splitlines()
    for file, line in zip(files, lines, strict=True):
        assert file in line


def test_check_warns_of_a_start_that_is_not_free(capsys, tmp_path):
    (tmp_path / "w.world").write_text(
        "<sdf version='1.7'><world name='w'><model name='rock'><static>1</static><link name='l'><collision "
        "name='c'><geometry><sphere><radius>1</radius></sphere></geometry></collision></link></model></world></sdf>",
        encoding="utf-8",
    )
    status, out, _ = run(capsys, "check", tmp_path / "w.world")
    assert status == 0
    assert "w.world:1: start 1 at (0.00, 0.00) is not free: the obstacle 'rock' is there" in out


@pytest.mark.parametrize(
    ("arguments", "status", "said"),
    [
        ((), 0, "usage: rosmini world"),
        (("check",), 2, "usage: rosmini world check"),
        (("chekc",), 2, "did you mean check?"),
        (("list", "x"), 2, "unrecognized arguments: x"),
    ],
)
def test_without_a_verb_or_a_file_it_says_how_it_is_used(arguments, status, said, capsys):
    assert cli.main(["world", *arguments]) == status
    done = capsys.readouterr()
    assert said in (done.err if status else done.out)
