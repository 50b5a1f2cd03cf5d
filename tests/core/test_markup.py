import contextlib

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rosmini.core.errors import DefinitionError, RosminiError
from rosmini.core.markup import MAX_DEPTH, Element, MarkupError, parse, parse_file

TEXT = """<?xml version="1.0"?>
<robot name="r" xmlns:xacro="http://ros.org/wiki/xacro">
  <!-- a comment -->
  <link name="a"/>
  <link name="b">
    <mass value="1.5"/> words &amp; <origin xyz="0 1 -2e-1"/> more
  </link>
  <xacro:thing/>
</robot>
"""


class Broken(MarkupError):
    pass


def test_a_tree_knows_tags_attributes_texts_and_lines():
    root = parse(TEXT, "r.urdf")
    assert (root.tag, root.line, root.path, root.get("name")) == ("robot", 2, "r.urdf", "r")
    assert [(child.tag, child.line) for child in root] == [("link", 4), ("link", 5), ("xacro:thing", 8)]
    assert root.all("link")[1].text == "words &  more"
    assert root.find("link/mass") is None  # the first link has none
    b = root.all("link")[1]
    assert b.need("mass").number("value") == 1.5
    assert b.need("origin").numbers("xyz", 3) == (0.0, 1.0, -0.2)
    assert [element.tag for element in root.walk()] == ["robot", "link", "link", "mass", "origin", "xacro:thing"]
    assert repr(b) == "<link> at r.urdf:5"


def test_words_and_flags():
    root = parse("<a><b> yes </b><c>true</c><d/></a>")
    assert (root.word("b"), root.word("d", "none"), root.word("e", "none")) == ("yes", "none", "none")
    assert root.flag(root.word("c"))
    assert not root.flag("0")
    with pytest.raises(MarkupError, match=r"<text>:1: static is true or false, not 'maybe'"):
        root.flag("maybe", "static")


@pytest.mark.parametrize(
    ("ask", "message"),
    [
        (lambda e: e.attribute("nme"), r'x.xml:2: nme="..." is missing in <b>; did you mean name\?'),
        (lambda e: e.attribute("empty"), r'x.xml:2: empty="..." is empty in <b>'),
        (lambda e: e.need("cc"), "x.xml:2: <b> has no <cc>"),
        (lambda e: e.number("word"), r"x.xml:2: 'one' in word of <b> is not a number"),
        (lambda e: e.number("inf"), r"x.xml:2: 'inf' in inf of <b> is not finite"),
        (lambda e: e.number("nan"), r"x.xml:2: 'nan' in nan of <b> is not finite"),
        (lambda e: e.numbers("two", 3), r"x.xml:2: two takes 3 numbers, not 2: '1 2'"),
        (lambda e: e.floats("1 2", 1), r"x.xml:2: <b> takes 1 number, not 2: '1 2'"),
    ],
)
def test_errors_name_file_line_and_element(ask, message):
    text = '<a>\n<b name="n" empty="" word="one" inf="inf" nan="nan" two="1 2"/>\n</a>'
    with pytest.raises(MarkupError, match=message):
        ask(parse(text, "x.xml").children[0])


def test_defaults_stand_in_for_what_is_missing_but_not_for_what_is_wrong():
    element = parse('<a x="q"/>')
    assert element.number("y", 2.0) == 2.0
    assert element.numbers("z", 3, (0.0, 0.0, 1.0)) == (0.0, 0.0, 1.0)
    with pytest.raises(MarkupError, match="'q'"):
        element.number("x", 2.0)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "f:1: this is empty"),
        ("  \n", "f:1: this is empty|f:2: this is empty"),
        ("<a>\n<b>\n</a>", "f:3: this closes another element than <b>, which was opened in line 2"),
        ("<a>\n<b>\n", "f:3: the file ends, but <b> of line 2 is still open"),
        ("\n<?xml version='1.0'?><a/>", "very first thing"),
        ("hello", "f:1: this is not XML"),
        ("<a x=1/>", "f:1: this is not XML: not well-formed"),
        ("<a/><b/>", "f:1: this is not XML: junk after document element"),
        (b"<?xml version='1.0' encoding='klingon'?><a/>", "f:1: this is not XML"),
        (b"<a>\xff</a>", "f:1: this is not XML"),
    ],
)
def test_what_is_not_xml(text, message):
    with pytest.raises(MarkupError, match=message):
        parse(text, "f")


@pytest.mark.parametrize(
    "text",
    [
        '<!DOCTYPE a [\n<!ENTITY x "ha">\n<!ENTITY y "&x;&x;&x;">]>\n<a>&y;</a>',
        '<!DOCTYPE a [<!ENTITY x SYSTEM "file:///etc/passwd">]><a>&x;</a>',
        '<!DOCTYPE a SYSTEM "http://127.0.0.1/a.dtd"><a/>',
    ],
)
def test_entities_and_other_files_are_refused(text):
    with pytest.raises(MarkupError, match=r"f:[12]: an XML file from outside may not"):
        parse(text, "f")


def test_depth_has_an_end():
    deep = "<a>" * MAX_DEPTH + "</a>" * MAX_DEPTH
    assert len(list(parse(deep).walk())) == MAX_DEPTH
    with pytest.raises(MarkupError, match="nested deeper"):
        parse("<a>" * 100000)


def test_a_document_has_its_own_kind_of_error():
    with pytest.raises(Broken):
        parse("<a>", failure=Broken)
    error = parse("<a>\n<b/></a>", "f", Broken).children[0].error("no")
    assert isinstance(error, Broken)
    assert isinstance(error, DefinitionError)
    assert isinstance(error, RosminiError)
    assert (error.file, error.line, str(error)) == ("f", 2, "f:2: no")


def test_files(tmp_path):
    path = tmp_path / "a.xml"
    path.write_bytes("<?xml version='1.0' encoding='latin-1'?><a b='\xe9'/>".encode("latin-1"))
    assert parse_file(path).get("b") == "\xe9"
    with pytest.raises(MarkupError, match=r"none.xml: cannot be read: No such file"):
        parse_file(tmp_path / "none.xml")


def test_a_text_that_says_another_encoding_is_read_as_the_text_it_is():
    assert parse("<?xml version='1.0' encoding='latin-1'?><a b='\xe9\u2603'/>").get("b") == "\xe9\u2603"


words = st.text(
    st.characters(codec="utf-8", exclude_categories=["Cc", "Cs"], exclude_characters="\ufffe\uffff"), max_size=8
)
names = st.from_regex(r"[a-z_][a-z0-9_:.-]{0,6}", fullmatch=True)
elements = st.recursive(
    st.builds(Element, names, st.dictionaries(names, words, max_size=3), words.map(str.strip)),
    lambda inner: st.builds(
        Element, names, st.dictionaries(names, words, max_size=2), st.just(""), st.lists(inner, max_size=3)
    ),
    max_leaves=8,
)


def same(a, b):
    return (
        (a.tag, a.attributes, a.text) == (b.tag, b.attributes, b.text)
        and len(a.children) == len(b.children)
        and all(map(same, a.children, b.children))
    )


@given(elements)
def test_source_is_read_back_as_the_same(element):
    assert same(parse(element.source()), element)


@given(st.binary(max_size=60) | st.text(max_size=60))
def test_anything_is_read_or_refused(text):
    with contextlib.suppress(MarkupError):
        parse(text)
