import sys

import pytest

from rosmini.core.packages import PackageIndex, assets_dir
from rosmini.sim.urdf import UrdfError, load
from rosmini.sim.urdf.xacro import expand, main

from ...processes import run

HEAD = '<robot name="r" xmlns:xacro="http://ros.org/wiki/xacro">'


@pytest.fixture
def index(tmp_path):
    package = tmp_path / "my_robot"
    (package / "urdf").mkdir(parents=True)
    (package / "package.xml").write_text("<package format='2'><name>my_robot</name></package>", encoding="utf-8")
    (package / "urdf" / "wheel.xacro").write_text(
        HEAD
        + """
  <xacro:macro name="wheel" params="name radius">
    <link name="${name}_link">
      <visual><geometry><cylinder radius="${radius}" length="${radius / 2}"/></geometry></visual>
    </link>
  </xacro:macro>
</robot>""",
        encoding="utf-8",
    )
    return PackageIndex([tmp_path])


def write(index, text, name="r.urdf.xacro"):
    path = index.path("my_robot") / "urdf" / name
    path.write_text(text if text.startswith("<?") else f"{HEAD}\n{text}\n</robot>", encoding="utf-8")
    return path


def test_macros_properties_arguments_and_packages(index):
    path = write(
        index,
        """<xacro:include filename="$(find my_robot)/urdf/wheel.xacro"/>
<xacro:arg name="radius" default="0.5"/><xacro:arg name="fast" default="false"/>
<xacro:property name="side" value="left"/>
<xacro:wheel name="${side}" radius="$(arg radius)"/>
<xacro:if value="$(arg fast)"><material name="red"><color rgba="1 0 0 1"/></material></xacro:if>""",
    )
    one = load(path, packages=index)
    assert one.link("left_link").visuals[0].geometry.radius == 0.5
    assert one.materials == {}
    other = load("package://my_robot/urdf/r.urdf.xacro", packages=index, mappings={"radius": 2, "fast": True})
    assert other.link("left_link").visuals[0].geometry.length == 1.0
    assert list(other.materials) == ["red"]
    text = expand(path, packages=index)
    assert text.startswith('<?xml version="1.0" ?>\n<robot name="r"')
    assert str(path) not in text


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("\n<link name='${wdith}'/>", "r.urdf.xacro: name 'wdith' is not defined"),
        ("<xacro:macro name='wheel'><link name='a'/></xacro:macro>\n<xacro:weel/>",
         "r.urdf.xacro: unknown macro name: xacro:weel"),
        ("<link name='$(arg side)'/>", "r.urdf.xacro: $(arg side) was not given and has no default: say side:=VALUE"),
        ("\n\n<xacro:include filename='$(find no_robot)/a.xacro'/>",
         "r.urdf.xacro: there is no package 'no_robot'; did you mean my_robot?"),
        ("<xacro:include filename='$(find my_robot)/urdf/none.xacro'/>", "r.urdf.xacro: "),
        ("<xacro:include filename='$(find my_robot)/urdf/none.xacro'/>",
         "none.xacro: cannot be read: No such file or directory"),
        ("\n<xacro:include/>", "r.urdf.xacro: xacro:include: missing attribute 'filename'"),
        ("\n<xacro:include filename='$(fnd my_robot)/a.xacro'/>",
         "r.urdf.xacro: Unknown substitution command [fnd my_robot]. Valid commands are"),
        ("<a>\n<xcro:if value='1'/></a>", "r.urdf.xacro: unbound prefix"),
        ("<xacro:macro name='m' params='x'/>\n<xacro:m x='1'/>\n<xacro:m/>",
         "r.urdf.xacro: Undefined parameters [x] (in the macro m)"),
        ("<xacro:macro name='m' params='x'/>\n<xacro:m x='1'/>\n<xacro:m x='1' y='2'/>",
         'r.urdf.xacro: Invalid parameter "y" (in the macro m)'),
        ("<xacro:macro name='m'><xacro:m/></xacro:macro><xacro:m/>",
         "without end (in the macro m, called by m, called by m, called by m, called by m, called by ...)"),
        ("<xacro:include filename='r.urdf.xacro'/>", "macros call or include one another without end"),
        ("<xacro:macro name='m' params='x'><link name='a'/></xacro:macro>\n<xacro:m/>", "Undefined parameters [x]"),
        ("<xacro:macro name='m'><link name='${y}'/></xacro:macro>\n<xacro:m/>",
         "r.urdf.xacro: name 'y' is not defined when evaluating expression 'y' (in the macro m)"),
        ("<link name='a'>", "r.urdf.xacro:3: this closes another element than <link>, which was opened in line 2"),
        ("<xacro:if value='${1/0}'/>", "r.urdf.xacro: division by zero"),
        ("<link name='${__import__(1)}'/>", "r.urdf.xacro: name '__import__' is not defined"),
        ("<?xml version='1.0'?><!DOCTYPE a [<!ENTITY x 'y'>]><robot name='&x;'/>",
         "r.urdf.xacro:1: an XML file from outside may not"),
    ],
)  # fmt: skip
def test_errors_name_the_file(index, text, message):
    path = write(index, text)
    with pytest.raises(UrdfError) as caught:
        expand(path, packages=index)
    said = " ".join(str(caught.value).split())
    assert " ".join(message.split()) in said
    assert "/my_robot/urdf/" in said


def test_an_error_in_a_macro_names_the_macro(index):
    path = write(index, "<xacro:include filename='wheel.xacro'/>\n<xacro:wheel name='a' radius='x'/>")
    with pytest.raises(UrdfError, match=r"r.urdf.xacro: .*radius / 2.*in the macro wheel"):
        expand(path, packages=index)


def test_what_is_wrong_after_expansion_is_told_of_the_expanded_text(index):
    path = write(index, "<link name='a'/>\n<link name='a'/>")
    with pytest.raises(UrdfError, match=r"r.urdf.xacro \(expanded\):\d+: there are two links 'a'"):
        load(path, packages=index)


def test_one_file_after_another_knows_nothing_of_the_first(index):
    path = write(index, "<xacro:arg name='a' default='1'/><link name='l$(arg a)'/>")
    assert 'name="l7"' in expand(path, {"a": 7}, packages=index)
    assert 'name="l1"' in expand(path, packages=index)
    with pytest.raises(UrdfError):
        expand(write(index, "<xacro:wrong/>", "w.xacro"), packages=index)
    assert 'name="l1"' in expand(path, packages=index)


def test_the_command_prints_or_writes(index, capsys, tmp_path):
    path = write(index, "<xacro:arg name='a' default='1'/><link name='l$(arg a)'/>")
    assert main([str(path), "a:=2", "--inorder"]) == 0
    assert '<link name="l2"/>' in capsys.readouterr().out
    assert main([str(path), "-o", str(tmp_path / "out.urdf")]) == 0
    assert load(tmp_path / "out.urdf").root == "l1"
    assert main([]) == 2
    assert "xacro takes one file" in capsys.readouterr().err
    assert main([str(tmp_path / "none.xacro")]) == 2
    assert "cannot be read" in capsys.readouterr().err


def test_rosrun_xacro_xacro(index):
    path = write(index, "<xacro:arg name='a' default='1'/><link name='l$(arg a)'/>")
    found = PackageIndex().find_executable("xacro", "xacro")
    assert found.path == assets_dir() / "ros" / "xacro" / "scripts" / "xacro"
    done = run([sys.executable, "-m", "rosmini", "run", "xacro/xacro", str(path), "a:=1.5"])
    assert '<link name="l1.5"/>' in done.stdout, done.stderr


# ---- what a description may do ----


@pytest.mark.parametrize(
    "text",
    [
        "<link name='${().__class__.__base__.__subclasses__()}'/>",
        "<link name='${(i for i in [1]).gi_frame}'/>",
        "<link name='${[f for f in [math]][0].sin.real}'/>",
        "<link name='${python.type(1)}'/>",
        "<link name='${python.vars(xacro)}'/>",
        "<link name='${(lambda: 1)()}'/>",
        "<link name='${xacro.load_yaml.__globals__}'/>",
        "<link name='$(eval [].__class__)'/>",
        "<link name='$(eval (lambda: 1)())'/>",
        "<link name='${xacro.load_yaml(\"/etc/passwd\")}'/>",
        "<link name='${load_yaml(\"../../../../../../../../etc/passwd\")}'/>",
        "<link name='${10**10**10}'/>",
        "<link name='${\"a\" * 10**9}'/>",
        "<link name='$(eval 2**10**8)'/>",
        "<xacro:include filename='/*/*/*.xacro'/>",
        "<xacro:property name='a' value='xxxxxxxxxx'/>"
        + "".join(
            f"<xacro:property name='{new}' value='{10 * f'${{{old}}}'}'/>"
            for old, new in zip("abcdefgh", "bcdefghi", strict=True)
        )
        + "<link name='${i}'/>",
        "<xacro:arg name='a' default='xxxxxxxxxx'/>"
        + "".join(
            f"<xacro:arg name='{new}' default='{10 * f'$(arg {old})'}'/>"
            for old, new in zip("abcdefgh", "bcdefghi", strict=True)
        )
        + "<link name='$(arg i)'/>",
        "<xacro:macro name='m0'><link name='a'/></xacro:macro>"
        + "".join(f"<xacro:macro name='m{i + 1}'>{10 * f'<xacro:m{i}/>'}</xacro:macro>" for i in range(9))
        + "<xacro:m9/>",
    ],
)
def test_what_only_python_could_do_is_refused(index, text, monkeypatch):
    monkeypatch.setattr("rosmini.sim.urdf.confined.STEPS", 300_000)
    with pytest.raises(UrdfError, match=r"r\.urdf\.xacro"):
        expand(write(index, text), packages=index)


def test_the_way_out_is_told(index, capsys):
    path = write(index, "\n<link name='${10**10**10}'/>")
    assert main([str(path)]) == 2
    said = capsys.readouterr().err
    assert "r.urdf.xacro: a whole number of more than 4096 bits" in said
    assert "--unconfined" in said


def test_includes_that_fan_out_or_go_in_circles_end(index, monkeypatch):
    monkeypatch.setattr("rosmini.sim.urdf.confined.STEPS", 300_000)
    for i in range(20):
        write(index, 2 * f"<xacro:include filename='f{i + 1}.xacro'/>", f"f{i}.xacro")
    write(index, "", "f20.xacro")
    with pytest.raises(UrdfError, match="too many steps"):
        expand(index.path("my_robot") / "urdf" / "f0.xacro", packages=index)
    write(index, "<xacro:include filename='b.xacro'/>", "a.xacro")
    with pytest.raises(UrdfError, match=r"without end: (a.xacro -> b.xacro -> a.xacro|b.xacro -> a.xacro -> b.xacro)"):
        expand(write(index, "<xacro:include filename='a.xacro'/>", "b.xacro"), packages=index)


def test_a_quote_without_its_partner_in_the_parameters_of_a_macro_does_not_hang(index):
    path = write(index, f"<xacro:macro name='m' params='a:={'x' * 60}&apos; b'/>")
    assert "robot" in expand(path, packages=index)


def test_who_trusts_a_file_lets_it_do_all(index):
    path = write(
        index, "<link name='${xacro.load_yaml.__name__}'/>".replace("xacro.load_yaml.__name__", "python.type(1)")
    )
    assert "int" in expand(path, packages=index, confined=False)
    with pytest.raises(UrdfError):
        load(path, packages=index)
    assert load(path, packages=index, confined=False).root
    assert main([str(path)]) == 2
    assert main(["--unconfined", str(path)]) == 0


def test_what_public_descriptions_write_is_allowed(index):
    (index.path("my_robot") / "urdf" / "limits.yaml").write_text(
        "joints: {arm: {lower: !degrees 90, upper: !radians 2*pi, size: !inches 10, names: [a, b]}}\n", encoding="utf-8"
    )
    text = """
<xacro:property name="config" value="${xacro.load_yaml('$(find my_robot)/urdf/limits.yaml')}"/>
<xacro:property name="arm" value="${config['joints']['arm']}"/>
<xacro:arg name="n" default="3"/>
<xacro:macro name="inertial" params="m r:=${0.5} h:=2 name *origin prefix:=^|left_ flag:=false">
  <link name="${prefix}${name}" mass="${m}" ixx="${m*(3*r*r+h*h)/12}" pi="${pi/2} ${radians(90)} ${sin(0)}">
    <xacro:insert_block name="origin"/></link>
</xacro:macro>
<xacro:inertial m="${2 ** 3}" name="x"><origin xyz="${' '.join([str(i) for i in range(3)])}"/></xacro:inertial>
<a lower="${arm.lower}" upper="${config.joints.arm.upper}" size="${round(arm['size'], 3)}"
  names="${','.join(arm.names)}"/>
<b all="${list(map(float, '1 2'.split()))[1]}" keys="${sorted(arm.keys())[0]}" ev="$(eval n * 2 + n)"
  tok="${xacro.tokenize('a,b;c')[1]}"/>
<xacro:if value="${'ab'.startswith('a') and not python.any([0]) and len(arm.names) == 2}">
<c v="${max(1, 2) if True else None}"/></xacro:if>
<xacro:unless value="${xacro.arg('n') == 4}">
<d e="$(optenv NOTHING_OF_THAT_NAME fallback)" f="$(dirname)"/></xacro:unless>
<xacro:include filename="none.xacro" optional="true"/>
<xacro:include filename="wheel.xacro" ns="w"/><xacro:w.wheel name="w" radius="1"/>"""
    said = expand(write(index, text.replace(' f="$(dirname)"', "")), packages=index)
    for part in (
        'name="left_x"', 'mass="8"', 'ixx="3.1666666666666665"', 'pi="1.5707963267948966 1.5707963267948966 0.0"',
        'xyz="0 1 2"', 'lower="1.57',
        'upper="6.28', 'size="0.254"', 'names="a,b"', 'all="2.0"', 'keys="lower"', 'ev="9"', 'tok="b"', '<c v="2"/>',
        '<d e="fallback"', 'name="w_link"',
    ):  # fmt: skip
        assert part in said, (part, said)


def test_pypis_xacro_finds_packages_by_itself(index, monkeypatch):
    import xacro
    from ament_index_python.packages import PackageNotFoundError, get_package_share_directory

    monkeypatch.setenv("ROS_PACKAGE_PATH", str(index.paths[0]))
    path = write(
        index, "<xacro:include filename='$(find my_robot)/urdf/wheel.xacro'/><xacro:wheel name='w' radius='1'/>"
    )
    assert 'name="w_link"' in xacro.process_file(str(path)).toxml()
    with pytest.raises(PackageNotFoundError, match=r"there is no package 'my_robt'; did you mean my_robot\?"):
        get_package_share_directory("my_robt")


def test_tags_without_the_prefix_are_read_as_until_melodic(index, capsys):
    write(index, '<macro name="leg" params="side"><link name="${side}_leg"/></macro>', "legs.xacro")
    file = write(
        index,
        """<include filename="$(find my_robot)/urdf/legs.xacro"/>
        <arg name="arms" default="1"/>
        <property name="body" value="torso"/>
        <macro name="arm" params="*mount"><link name="arm"><insert_block name="mount"/></link></macro>
        <link name="${body}"/>
        <leg side="left"/>
        <xacro:leg side="right"/>
        <if value="$(arg arms)"><arm><inertial/></arm></if>
        <unless value="$(arg arms)"><link name="no_arm"/></unless>
        <gazebo><plugin><property name="x" value="1"/></plugin></gazebo>""",
    )
    text = expand(file, packages=index)
    for name in ("torso", "left_leg", "right_leg", "arm"):
        assert f'<link name="{name}"' in text
    assert "<inertial/>" in text
    assert "no_arm" not in text
    assert '<property name="x"' in text
    said = capsys.readouterr().err
    assert said.count("r.urdf.xacro: ") == 1
    assert "<macro>" in said
