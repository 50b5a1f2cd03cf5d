import os
import struct

import numpy as np
import pytest

from assets.generate.meshes import collada_writer
from assets.generate.meshes.shapes import box, join, lathe
from rosmini.sim.urdf.meshes import MeshError, read

CUBE = join(box((1, 2, 3), (2, 4, 6)), "#ff8000", "cube")


def volume(surfaces):
    """By the divergence theorem: right only for a closed surface that looks outwards everywhere."""
    corners = np.vstack([surface.triangles for surface in surfaces])
    return float(np.einsum("ij,ij->i", corners[:, 0], np.cross(corners[:, 1], corners[:, 2])).sum()) / 6


def test_collada_is_read_back(tmp_path):
    wheel = join([lathe([(0, 0), (0.5, 0), (0.5, 1), (0, 1)], 16)], "#336699", "wheel")
    path = tmp_path / "a.dae"
    path.write_text(collada_writer.write([CUBE, wheel]), encoding="utf-8")
    one, two = read(path)
    assert one.colour == (1.0, 0.502, 0.0, 1.0)
    assert volume([one]) == pytest.approx(48, rel=1e-3)
    assert volume([two]) == pytest.approx(volume([wheel]), rel=1e-3)
    assert len(two.vertices) == len(
        {tuple(row) for row in np.hstack([wheel.vertices, wheel.normals])[wheel.faces.ravel()].round(3).tolist()}
    )


DAE = """<COLLADA><asset><unit meter="0.01"/><up_axis>Y_UP</up_axis></asset>
<library_effects><effect id="e"><profile_COMMON><technique><lambert>
<diffuse><color>0 1 0 1</color></diffuse></lambert></technique></profile_COMMON></effect></library_effects>
<library_materials><material id="m"><instance_effect url="#e"/></material></library_materials>
<library_geometries><geometry id="g"><mesh>
<source id="p"><float_array>0 0 0 100 0 0 100 100 0 0 100 0</float_array></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<polylist material="s"><input semantic="VERTEX" source="#v" offset="0"/><vcount>4</vcount><p>0 1 2 3</p></polylist>
</mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="vs"><node><translate>0 0 50</translate><rotate>0 0 1 90</rotate><node>
<matrix>2 0 0 0 0 2 0 0 0 0 2 0 0 0 0 1</matrix>
<instance_geometry url="#g"><bind_material><technique_common>
<instance_material symbol="s" target="#m"/></technique_common></bind_material></instance_geometry>
</node></node></visual_scene></library_visual_scenes><scene><instance_visual_scene url="#vs"/></scene></COLLADA>"""


@pytest.mark.parametrize("up", ["X_UP", "Y_UP", "Z_UP", "nonsense"])
def test_collada_of_others_units_nodes_and_polygons(tmp_path, up):
    """Which axis points up is passed over, as Gazebo and RViz do."""
    path = tmp_path / "a.dae"
    path.write_text(DAE.replace("Y_UP", up), encoding="utf-8")
    (surface,) = read(path)
    assert surface.colour == (0, 1, 0, 1)
    assert len(surface.faces) == 2
    low, high = surface.bounds
    # 1 m square, doubled, turned about z to the left, 0.5 m along its z.
    assert low == pytest.approx([-2, 0, 0.5])
    assert high == pytest.approx([0, 2, 0.5])


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ('url="#g"', 'url="#h"', "there is nothing with the id 'h'"),
        ("<p>0 1 2 3</p>", "<p>0 1 2 4</p>", "<p> counts to 4, but there are 4"),
        ("<p>0 1 2 3</p>", "<p>0 1 2</p>", "<polylist> has polygons of 4 vertices, but <p> has 3"),
        ("<p>0 1 2 3</p>", "<p>0 1 2 x</p>", "<p> holds whole numbers"),
        ("0 100 0</float_array>", "0 nan 0</float_array>", "is not finite"),
        ("100 0</float_array>", "100</float_array>", "are not rows of 3"),
        ('meter="0.01"', 'meter="-1"', "the unit of a mesh is more than 0 m, not -1"),
        ('offset="0"', 'offset="1e9"', "an offset is a whole number from 0 to 99"),
        ('offset="0"', 'offset="-1"', "an offset is a whole number from 0 to 99"),
        ("<p>0 1 2 3</p>", "<p>0 1 2 99999999999999999999</p>", "<p> holds whole numbers"),
        ("<matrix>2 0", "<matrix>1e300 1e300", "is too large"),
        ("<node><translate>", "<node><scale>1e9 1 1</scale><scale>1e9 1 1</scale><translate>", "infinitely large"),
        ("<node><translate>", "<node id='n'><instance_node url='#n'/><translate>", "without end"),
        ('semantic="VERTEX"', 'semantic="NORMAL"', "has no input VERTEX"),
        ("<COLLADA>", "<COLADA>", "closes another element"),
    ],
)
def test_broken_collada(tmp_path, old, new, message):
    path = tmp_path / "a.dae"
    path.write_text(DAE.replace(old, new, 1), encoding="utf-8")
    with pytest.raises(MeshError, match=r"a.dae:\d+: ") as caught:
        read(path)
    assert message in str(caught.value)


def test_a_scene_that_fans_out_ends(tmp_path):
    ways = [2 * f"<instance_node url='#n{i + 1}'/>" for i in range(40)]
    nodes = "".join(f"<node id='n{i}'>{way}</node>" for i, way in enumerate(ways))
    path = tmp_path / "a.dae"
    path.write_text(
        DAE.replace('<visual_scene id="vs">', f"<visual_scene id='vs'>{nodes}<node id='n40'/>"), encoding="utf-8"
    )
    with pytest.raises(MeshError, match="without end"):
        read(path)


@pytest.mark.parametrize(
    ("name", "data", "message"),
    [
        ("a.stl", b"", "this is not an STL file"),
        ("a.stl", b"x" * 34, "this is not an STL file"),
        ("a.stl", b"x" * 84, "this is not an STL file: 2021161080 triangles would be"),
        ("a.stl", b"\0" * 80 + b"\xff" * 4, "4294967295 triangles would be"),
        ("a.stl", b"\0" * 80 + struct.pack("<I", 2) + bytes(50), "2 triangles would be 184 bytes, not 134"),
        ("a.stl", b"solid\nvertex 1 2\n", "a corner has three numbers"),
        ("a.stl", b"solid\nvertex 1 2 3\n", "1 corners are not triangles"),
        ("a.stl", b"solid\n" + 3 * b"vertex 1 2 nan\n", "a corner is not finite"),
        ("a.stl", b"solid\n", "there is no triangle in it"),
        ("a.dae", b"", "there is no XML in it"),
        ("a.dae", b"<COLLADA/>", "there is no triangle in it"),
        ("a.dae", b"<collada/>", "begins with <COLLADA>"),
        ("a.obj", b"f 1 2 3\n", "there are 0 vertices"),
        ("a.obj", b"v 0 0 0\nf 1 2 3\n", "the face '1 2 3' is invalid"),
        ("a.obj", b"v 0 zero 0\n", "a corner has three numbers"),
        ("a", b"", "not one without an ending"),
        ("a.obj", b"v 0 0 0\n" * 3 + b"f 1 2 " + b"9" * 5000, "there are 3 vertices"),
        ("a.png", b"", "a mesh is a .dae, .stl or .obj file"),
    ],
)  # fmt: skip
def test_what_is_no_mesh_is_told_with_its_file(tmp_path, name, data, message):
    (tmp_path / name).write_bytes(data)
    with pytest.raises(MeshError, match=rf"{name}.*: .*{message}"):
        read(tmp_path / name)


@pytest.mark.parametrize("name", ["none.stl", "a\0b.stl", "x" * 5000 + ".stl", "folder.stl"])
def test_a_path_that_leads_to_no_file_is_an_error(tmp_path, name):
    (tmp_path / "folder.stl").mkdir()
    with pytest.raises(MeshError, match="cannot be read"):
        read(tmp_path / name)


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="pipes with names are a matter of POSIX")
def test_a_pipe_is_refused_before_it_is_read(tmp_path):
    os.mkfifo(tmp_path / "a.stl")
    with pytest.raises(MeshError, match="it is a pipe"):
        read(tmp_path / "a.stl")


def test_stl_binary_and_text(tmp_path):
    triangles = [[(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 0, 0), (0, 1, 0), (0, 0, 1)]]
    binary = tmp_path / "b.STL"
    rows = b"".join(struct.pack("<12fH", 0, 0, 0, *sum(each, ()), 0) for each in triangles)
    binary.write_bytes(b"solid that is none".ljust(80) + struct.pack("<I", 2) + rows)
    text = tmp_path / "t.stl"
    faces = "".join(
        "facet normal 0 0 0\nouter loop\n"
        + "".join(f"vertex {x} {y} {z}\n" for x, y, z in each)
        + "endloop\nendfacet\n"
        for each in triangles
    )
    text.write_text(f"solid x\n{faces}endsolid x\n", encoding="utf-8")
    for path in (binary, text):
        (surface,) = read(path)
        assert surface.triangles.tolist() == np.array(triangles, dtype=float).tolist()
        assert surface.colour is None


def _binary(name, count, triangles):
    return name.ljust(80) + struct.pack("<I", count) + bytes(50 * triangles)


@pytest.mark.parametrize(
    "data",
    [
        b"solid a facet normal 0 0 1 outer loop vertex 0 0 0 vertex 1 0 0 vertex 0 1 0 endloop endfacet endsolid a",
        b"SOLID a\nFACET NORMAL 0 0 1\nOUTER LOOP\nVERTEX 0 0 0\nVERTEX 1 0 0\nVERTEX 0 1 0\nENDLOOP\nENDFACET\n",
        _binary(b"solid a", 1, 1) + b"\r\n",
        _binary(b"a", 1, 1) + b"\0",
    ],
)
def test_unusual_forms_of_stl(tmp_path, data):
    (tmp_path / "a.stl").write_bytes(data)
    (surface,) = read(tmp_path / "a.stl")
    assert len(surface.faces) == 1


@pytest.mark.parametrize(
    ("old", "new"),
    [
        (("polylist", "<vcount>4</vcount>", "0 1 2 3"), ("trifans", "", "0 1 2 3")),
        (("polylist", "<vcount>4</vcount>", "0 1 2 3"), ("tristrips", "", "0 1 3 2")),
        (('id="vs"><node>',), ('id="vs"><node id="vs">',)),  # as exported by 3ds Max
        (('id="vs">',), ('id="vs"><node><scale>0 0 0</scale></node>',)),  # as exported by SketchUp
    ],
)
def test_forms_of_collada_that_programs_export(tmp_path, old, new):
    text = DAE
    for before, after in zip(old, new, strict=True):
        text = text.replace(before, after)
    (tmp_path / "a.dae").write_text(DAE, encoding="utf-8")
    (tmp_path / "b.dae").write_text(text, encoding="utf-8")
    (expected,), (found,) = read(tmp_path / "a.dae"), read(tmp_path / "b.dae")
    assert len(found.faces) == 2
    assert volume([found]) == volume([expected])
    assert (found.vertices.min(axis=0) == expected.vertices.min(axis=0)).all()
    assert (found.vertices.max(axis=0) == expected.vertices.max(axis=0)).all()


def test_obj(tmp_path):
    path = tmp_path / "a.obj"
    path.write_text("# quad\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1/1/1 2/2/1 3//1 -1\n", encoding="utf-8")
    (surface,) = read(path)
    assert surface.triangles.tolist() == [[[0, 0, 0], [1, 0, 0], [1, 1, 0]], [[0, 0, 0], [1, 1, 0], [0, 1, 0]]]


def test_one_part_of_a_mesh(tmp_path):
    corners = "v 0 0 0\nv 1 0 0\nv 0 1 {0}\n"
    obj = f"o one\n{corners.format(0)}f 1 2 3\no two\n{corners.format(7)}f 4 5 6\n"
    (tmp_path / "a.obj").write_text(obj, encoding="utf-8")
    (surface,) = read(tmp_path / "a.obj", "two")
    assert surface.triangles.max() == 7
    (tmp_path / "a.dae").write_text(DAE.replace("<node><translate>", '<node name="n"><translate>'), encoding="utf-8")
    assert len(read(tmp_path / "a.dae", "n")) == 1
    with pytest.raises(MeshError, match="called 'other'"):
        read(tmp_path / "a.dae", "other")
