"""Programs, what they print, and what they are refused with."""

from __future__ import annotations

import contextlib
import math
import re

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from rosmini.logo import Limits, Logo, LogoError, LogoStopped, values
from rosmini.logo.primitives import PRIMITIVES
from rosmini.logo.reader import read_list
from rosmini.logo.values import LogoList, show

SMALL = Limits(steps=2000, moves=200, depth=50, lines=100)


def printed(program: str, limits: Limits | None = None) -> list[str]:
    lines: list[str] = []
    Logo(say=lines.append, limits=limits).run(program)
    return lines


def refused(program: str, limits: Limits | None = None) -> str:
    with pytest.raises(LogoError) as error:
        printed(program, limits)
    return str(error.value)


@pytest.mark.parametrize(
    ("expression", "value"),
    [
        ("1 + 2 * 3", "7"),
        ("(1 + 2) * 3", "9"),
        ("10 - 4 - 3", "3"),
        ("12 / 6 / 2", "1"),
        ("3-2", "1"),
        ("sum 3 -2", "1"),
        ("sum 3 - 2 1", "2"),
        ("- 3 + 5", "2"),
        ("-3 * -2", "6"),
        ("2 * -(1 + 2)", "-6"),
        ("sum 1 2 * 3", "7"),
        ("(sum 1 2 3 4)", "10"),
        ("(sum)", "0"),
        ("1 / 3", "0.333333333333333"),
        ("0.1 + 0.2", "0.3"),
        ("7 / 2", "3.5"),
        ("quotient 6 3", "2"),
        ("remainder -7 3", "-1"),
        ("modulo -7 3", "2"),
        ("power 2 10", "1024"),
        ("power 2 -1", "0.5"),
        ("int -2.7", "-2"),
        ("round 2.5", "3"),
        ("round -2.5", "-3"),
        ("sqrt 16 + 9", "5"),
        ("sin 30 + 60", "1"),
        ("cos 180", "-1"),
        ("tan 45", "1"),
        ("arctan 1", "45"),
        ("(arctan 0 1)", "90"),
        ("exp 0", "1"),
        ("log10 1000", "3"),
        ('"3 + "4', "7"),
        ("1 + 1 = 2", "true"),
        ("3 <= 2", "false"),
        ("2 <> 3", "true"),
        ("5 = 5.0", "true"),
        ('"Red = "rED', "true"),
        ("[a [1]] = [A [1.0]]", "true"),
        ("[a] = [a b]", "false"),
        ("[1] = 1", "false"),
        ("and 1 = 1 2 = 3", "false"),
        ("or 1 = 1 2 = 3", "true"),
        ("not 1 = 1", "false"),
        ('beforep "a "B', "true"),
        ("first [[a b] c]", "a b"),
        ('first "logo', "l"),
        ("butfirst [a b c]", "b c"),
        ('bf "logo', "ogo"),
        ('bl "logo', "log"),
        ("last [a b c]", "c"),
        ("item 2 [a b c]", "b"),
        ("item 1 123", "1"),
        ("count [a [b c]]", "2"),
        ('count "logo', "4"),
        ("count []", "0"),
        ('word "lo "go', "logo"),
        ('(word "a "b 3)', "ab3"),
        ("sentence [a b] [c [d]]", "a b c [d]"),
        ("fput 1 [2 3]", "1 2 3"),
        ("lput 1 [2 3]", "2 3 1"),
        ("reverse [1 2 3]", "3 2 1"),
        ("memberp 2 [1 2.0 3]", "true"),
        ("emptyp []", "true"),
        ('emptyp "', "true"),
        ("wordp 3", "true"),
        ("listp 3", "false"),
        ('numberp "3e2', "true"),
        ("numberp [3]", "false"),
        ('uppercase "logo', "LOGO"),
        ("ifelse 1 = 1 [3] [4]", "3"),
        ("(if 1 = 2 [3] [4])", "4"),
        ("run [1 + 1]", "2"),
        ("[1 + 1]", "1 + 1"),
        ('[1.50 :x "y]', '1.50 :x "y'),
        ("(xcor + 3) * 2", "6"),
        ("(2)", "2"),
    ],
)
def test_expressions(expression, value):
    assert printed(f"print {expression}") == [value]


def test_print_show_and_type():
    assert printed("print [a [b]]\nshow [a [b]] (print 1 [2 3])") == ["a [b]", "[a [b]]", "1 2 3"]
    assert printed('type "a type [b c]\nprint "d\ntype "e') == ["ab cd", "e"]


def test_comments_continued_lines_and_lists_over_several_lines():
    assert printed("print ~\n 3 ; three\nrepeat 2 [\n  print 1\n  print 2\n]\nprint (sum 1\n 2)") == [
        *("3", "1", "2", "1", "2", "3")
    ]


def test_words_are_the_same_in_capitals():
    assert printed("TO Twice :N\nOUTPUT 2 * :n\nEND\nPrint TWICE 4") == ["8"]


def test_procedures_may_be_defined_after_they_are_used():
    assert printed("print twice 4\nto twice :n\noutput 2 * :n\nend") == ["8"]


def test_loops():
    assert printed("repeat 3 [print repcount * 10]") == ["10", "20", "30"]
    assert printed("repeat 2 [repeat 2 [type repcount] type repcount]") == ["121122"]
    assert printed("for [i 1 7 3] [print :i]") == ["1", "4", "7"]
    assert printed("for [i 3 1] [type :i]") == ["321"]
    assert printed("for [i 1 + 1 2 * 2] [type :i]") == ["234"]
    assert printed("for [i 1 0 1] [type :i] print 1") == ["1"]
    assert printed('make "n 3 while [:n > 0] [type :n make "n :n - 1]') == ["321"]
    assert printed('make "n 3 until [:n = 0] [type :n make "n :n - 1]') == ["321"]
    assert printed("foreach [a b] [type ? type 1]") == ["a1b1"]
    assert printed("repeat 0 [print 1]") == []


def test_what_counts_is_forgotten_and_what_was_there_comes_back():
    assert printed('make "i 9 for [i 1 2] [] print :i') == ["9"]
    assert "i has no value" in refused("for [i 1 2] [] print :i")


def test_names_are_bound_dynamically():
    assert printed('to outer :x\ninner\nend\nto inner\nprint :x\nend\nmake "x 1 outer 2 print :x') == [
        "2",
        "1",
    ]
    assert printed('to f\nlocal "x\nmake "x 2\nend\nmake "x 1 f print :x') == ["1"]
    assert printed('to f\nlocalmake "x 2 print :x\nend\nf print namep "x') == ["2", "false"]
    assert printed('make "a "b make :a 3 print :b print thing "b') == ["3", "3"]


def test_names_come_back_after_an_error_too():
    lines: list[str] = []
    logo = Logo(say=lines.append)
    logo.run('make "x 1')
    with pytest.raises(LogoError):
        logo.run("to f :x\nprint first []\nend\nf 2")
    logo.run("print :x")
    assert lines == ["1"]


def test_output_leaves_loops():
    program = (
        "to find :x :l\nforeach :l [if ? = :x [output repeated]]\noutput 0\nend\nto repeated\noutput 7\nend\n"
    )
    assert printed(program + "print (find 2 [1 2 3]) + find 9 [1]") == ["7"]
    assert printed("to f\nforever [stop]\nend\nf print 1") == ["1"]


def test_pending_values_survive_an_output_from_a_list():
    assert printed("to f :n\noutput 1 + ifelse :n = 0 [output 5] [2]\nend\nprint (f 0) print f 1") == [
        "5",
        "3",
    ]


def test_recursion_deeper_than_pythons():
    assert printed(
        "to sum.to :n\nif :n = 0 [output 0]\noutput :n + sum.to :n - 1\nend\nprint sum.to 9000"
    ) == ["40504500"]


def test_a_last_call_takes_no_room():
    down = "to down :n\nif :n = 0 [stop]\ndown :n - 1\nend\n"
    assert printed(down + "down 3000 print 1", Limits(depth=5)) == ["1"]
    even = (
        'to even :n\noutput ifelse :n = 0 ["true] [odd :n - 1]\nend\n'
        'to odd :n\nif :n = 0 [output "false]\noutput even :n - 1\nend\n'
    )
    assert printed(even + "print even 3001", Limits(depth=5)) == ["false"]


def test_a_last_call_that_gives_a_value_is_refused_as_any_other():
    assert "what to do with 3" in refused("to f\ng\nend\nto g\noutput 3\nend\nf")
    assert "didn't output" in refused("to f\noutput g\nend\nto g\nend\nprint f")
    assert "what to do with 3" in refused("to f\ng\nend\nto g\noutput 3\nend\nto h\noutput f\nend\nprint h")


def test_the_same_chance_on_each_run():
    program = 'repeat 5 [type random 1000]\nprint "\nrerandom repeat 5 [type random 1000]'
    first, second = printed(program)
    assert first == second
    assert printed(program) == [first, second]
    values = [int(line) for line in printed("repeat 300 [print (random 3 5)]")]
    assert set(values) == {3, 4, 5}
    assert set(map(int, printed("repeat 300 [print random 3]"))) == {0, 1, 2}


@pytest.mark.parametrize(
    ("program", "message"),
    [
        ("print 1\nfrwd 50", "line 2: I don't know how to frwd; did you mean forward?"),
        ("to sq :size\nfd :sise\nend\n\nsq 3", "line 2, in sq: sise has no value; did you mean :size?"),
        ("forward", "line 1: not enough inputs to forward (forward distance)"),
        ("fd rt 90", "line 1: not enough inputs to fd (forward distance): rt, which comes next, is a command"),
        ("print (fd 3)", "is a command and gives no value"),
        ("fd 3 + 4 = (rt 90)", "is a command and gives no value"),
        ('forward "ten', "line 1: forward doesn't like ten as input: it needs a number"),
        ("forward []", "forward doesn't like [] as input"),
        ("repeat -1 []", "repeat doesn't like -1 as input"),
        ("repeat 2 3", "repeat doesn't like 3 as input"),
        ("if 3 [fd 1]", "if doesn't like 3 as input: it needs true or false"),
        ("3", "you don't say what to do with 3"),
        ("repeat 2 [3]", "you don't say what to do with 3"),
        ("sum 1 2", "you don't say what to do with 3"),
        ("to f\nend\nprint f", "line 3: f didn't output to print"),
        ("print 1 + run []", "run didn't output to +"),
        ("print 1 +", "not enough inputs to +"),
        ("print * 2", "a value is missing before *"),
        ("print 1\nrepeat 4 [fd 1\nrt 90\n", "line 2: this [ is never closed"),
        ("to f\nrepeat 2 [fd 1\nend\nf", "line 2: this [ is never closed before end in line 3"),
        ("print 1\n\nfd 1 ]", "line 3: a ] without a [ before it"),
        ("print (1 + 2", "line 1: this ( is never closed"),
        ("print 1)", "line 1: a ) without a ( before it"),
        ("(fd 1 2)", "too much inside ()"),
        ("print (1 2)", "too much inside ()"),
        ("print ()", "a value is missing before )"),
        ("to f\nprint 1", "line 1: to f has no end"),
        ("to f\nto g\nend", "line 1: to f has no end before the next to, in line 2"),
        ("end", "line 1: end without a to before it"),
        ("to f\nend\nto f\nend", "line 3: f is already defined, in line 1"),
        ("to forward\nend", "line 1: forward is a word of Logo already"),
        ("to", "to needs a name"),
        ("to 3\nend", "3 cannot be the name of a procedure"),
        ("to f x\nend", "come only inputs"),
        ("to f :x :X\nend", "the input :X is there twice"),
        ("to f fd 3 end", "come only inputs"),
        ("repeat 2 [to f]", "to stands only at the start of a line"),
        ("stop", "stop works only inside a procedure"),
        ("output 3", "output works only inside a procedure"),
        ("print first []", "first doesn't like [] as input"),
        ("print item 3 [a b]", "item doesn't like 3 as input: it needs a whole number from 1 to 2"),
        ("print 1 / 0", "divided by zero"),
        ("print modulo 3 0", "divided by zero"),
        ("print power 0 -1", "divided by zero"),
        ("print power -8 1/3", "power doesn't like"),
        ("print power 10 400", "too large"),
        ("print exp 1000", "too large"),
        ("print 1e308 * 10", "too large"),
        ("print 1e999", "1e999 is too large for a number"),
        ("print sqrt -1", "sqrt doesn't like -1 as input"),
        ("print ln 0", "ln doesn't like 0 as input"),
        ("print tan 90", "tan doesn't like 90 as input"),
        ("print random 0", "random doesn't like 0"),
        ("print (random 3 1)", "random doesn't like 1"),
        ("for [i] []", "for doesn't like [i] as input"),
        ("for [i 1 a] []", "I don't know how to a"),
        ('for [i 1 "a] []', "for doesn't like a"),
        ("while [] []", "the condition gives no value"),
        ("print ?", "? stands for something inside foreach, map and filter only"),
        ("setpencolor 16", "setpencolor doesn't like 16"),
        ('setpencolor "orenge', "did you mean orange?"),
        ("setpencolor [1 2]", "setpencolor doesn't like [1 2]"),
        ("setpensize 0", "setpensize doesn't like 0"),
        ('tell "turtle2', "there is no turtle turtle2; did you mean turtle1?"),
        ("tell []", "tell doesn't like []"),
        ("newturtle 1", "there is a turtle turtle1 already"),
        ("ask 7 [fd 1]", "there is no turtle turtle7"),
        ("print :", "after the colon comes a word"),
        ("fd 1e10", "turtle out of bounds"),
        ("wait -1", "wait doesn't like -1"),
    ],
)  # fmt: skip
def test_errors_say_where_and_what(program, message):
    assert message in refused(program)


def test_what_is_not_understood_moves_nothing():
    logo = Logo()
    with pytest.raises(LogoError):
        logo.run("forward 10\nfrwd 10")
    assert logo.drawing.strokes == ()


@pytest.mark.parametrize(
    ("program", "message"),
    [
        ('while ["true] []', "stopped after 2000 steps"),
        ("forever []", "stopped after 2000 steps"),
        ("forever [fd 1]", "stopped after 200 movements"),
        ("forever [print 1]", "stopped after 100 lines"),
        ("to f\nf\nend\nf", "stopped after 2000 steps"),
        ("to f\nf print 1\nend\nf", "line 2, in f: stopped: 50 procedures wait for one another"),
        ('make "l [run :l print 1] run :l', "more than 500 lists run"),
        ('make "l [a] forever [make "l se :l :l]', "stopped after 2000 steps"),
    ],
)
def test_what_never_ends_is_stopped(program, message):
    with pytest.raises((LogoStopped, LogoError), match=message):
        printed(program, SMALL)


def test_nothing_grows_without_bounds():
    assert "more than 1000000 letters" in refused('make "w "ab forever [make "w word :w :w]')
    assert "nested more than 100 deep" in refused('make "l [a] forever [make "l list :l "a]')


@pytest.mark.parametrize(
    "program",
    [
        "[" * 5000,
        "print " + "(" * 5000 + "1" + ")" * 5000,
        "print " + "first " * 5000 + "1",
        "print " + "- " * 5000 + "1",
        "print " + "1 + " * 1000 + "1",
    ],
)
def test_deep_nesting_is_no_error_of_python(program):
    try:
        printed(program)
    except LogoError as error:
        message = str(error)
    else:
        message = "nested"
    assert re.search("nested|never closed", message)


def test_the_noise_of_sines_is_no_line():
    logo = Logo()
    logo.run("repeat 12 [repeat 4 [forward 90 right 90] right 30] home")
    assert logo.drawing.turtles[0].pose == (0, 0, 0)
    assert len(logo.drawing.lines) == 48
    assert logo.drawing.length == pytest.approx(48 * 90)


def test_it_can_be_run_step_by_step():
    logo = Logo()
    logo.start("repeat 3 [fd 10]")
    turns = 1
    while logo.advance(1):
        turns += 1
    assert logo.machine.steps == turns > 6
    assert len(logo.drawing.strokes) == 3


def test_an_interrupt_leaves_the_interpreter_usable():
    class Interrupted(KeyboardInterrupt):
        pass

    def say(line):
        if line == "stop":
            raise Interrupted

    logo = Logo(say=say)
    with pytest.raises(Interrupted):
        logo.run('to f :x\nprint "stop\nend\nf 1')
    logo.run('if namep "x [print "stop]')
    assert logo.machine.frames == []


def test_help_and_the_table():
    assert printed('help "fd') == ["forward distance (short: fd): goes straight ahead, so many steps"]
    assert {"fd", "bk", "rt", "lt", "pu", "pd", "setpc", "cs", "ht", "bf", "se", "op", "pr"} <= set(
        PRIMITIVES
    )
    assert all(primitive.help for primitive in PRIMITIVES.values())


# -- properties ------------------------------------------------------------------------------------------------------

WORDS = st.sampled_from(
    [
        *PRIMITIVES,
        "to",
        "end",
        "f",
        ":x",
        '"a',
        "1",
        "2.5",
        "-3",
        "[",
        "]",
        "(",
        ")",
        "+",
        "-",
        "*",
        "/",
        "=",
        "<",
        "\n",
    ]
)


@settings(deadline=None, max_examples=200)
@given(st.one_of(st.text(max_size=200), st.lists(WORDS, max_size=40).map(" ".join)))
def test_whatever_is_typed_raises_nothing_but_errors_of_logo(program):
    with contextlib.suppress(LogoError):
        printed(program, SMALL)


NUMBERS = st.integers(-1000, 1000) | st.floats(-1e6, 1e6).map(lambda value: float(f"{value:.6f}"))


def sums(children):
    return st.tuples(children, st.sampled_from(["+", "-", "*", "/"]), children).map(
        lambda parts: f"({parts[0]} {parts[1]} {parts[2]})"
    ) | st.tuples(children, st.sampled_from([" + ", " - ", "*", "/"]), children).map("".join)


@settings(deadline=None, max_examples=200)
@given(
    st.recursive(
        NUMBERS.map(lambda value: f"{value:.6f}" if isinstance(value, float) else str(value)),
        sums,
        max_leaves=8,
    )
)
def test_arithmetic_is_that_of_python(expression):
    try:
        expected = eval(expression)
    except ZeroDivisionError:
        assert "divided by zero" in refused(f"print {expression}")
        return
    if not math.isfinite(expected):
        return
    (line,) = printed(f"print {expression}")
    assert float(line) == pytest.approx(expected, rel=1e-9, abs=1e-9)


PLAIN = st.text(
    st.characters(codec="ascii", exclude_characters="[];~ \t\n\r\x0b\x0c\x1c\x1d\x1e\x1f\x85"),
    min_size=1,
    max_size=8,
)
LISTS = st.recursive(PLAIN, lambda inner: st.lists(inner, max_size=5).map(LogoList), max_leaves=20)


@settings(deadline=None, max_examples=200)
@given(st.lists(LISTS, max_size=5).map(LogoList))
def test_what_show_prints_reads_back(value):
    text = show(value)
    found = read_list(text)
    assert show(found) == f"[{text}]"


@pytest.mark.parametrize(
    ("expression", "value"),
    [
        ("map [? * ?] [1 2 3]", "[1 4 9]"),
        ('map "uppercase "abc', "ABC"),
        ("map [list ? ?] []", "[]"),
        ("map [map [? + 1] ?] [[1 2] [3]]", "[[2 3] [4]]"),
        ("filter [? > 2] [1 2 3 4]", "[3 4]"),
        ('filter [memberp ? "aeiou] "education', "euaio"),
        ('filter "numberp [1 a 2]', "[1 2]"),
        ('catch "found [foreach [3 8 5] [if ? > 4 [(throw "found ?)]]]', "8"),
        ('catch "out [catch "in [(throw "out 1)] 2]', "1"),
    ],
)
def test_templates_and_catch_give_values(expression: str, value: str) -> None:
    assert printed(f"show {expression}") == [value]


def test_throw_leaves_procedures_and_restores_what_they_changed() -> None:
    program = (
        'to f :n\nif :n > 3 [throw "done]\nprint :n\nf :n + 1\nend\nmake "n "old\ncatch "done [f 1]\nprint :n'
    )
    assert printed(program) == ["1", "2", "3", "old"]


def test_a_test_belongs_to_its_procedure() -> None:
    program = 'to f\ntest 1 = 2\niffalse [print "inner]\nend\ntest 1 = 1\nf\niftrue [print "outer]\nift [print "still]'
    assert printed(program) == ["inner", "outer", "still"]


@pytest.mark.parametrize(
    ("program", "value"),
    [
        ("to g\nfor [i 1 3] [output f]\nend\nto f\noutput :i\nend\nprint g", "1"),
        ("to g\nforeach [5 6] [output f]\nend\nto f\noutput ?\nend\nprint g", "5"),
        (
            'newturtle "b\nask "b [setxy 7 7]\nto g\nask "b [output f]\nend\nto f\noutput xcor\nend\nprint g',
            "7",
        ),
        ('to g\ncatch "t [output f]\noutput 2\nend\nto f\nthrow "t\nend\nprint g', "2"),
    ],
)
def test_what_is_called_last_still_has_what_surrounds_it(program: str, value: str) -> None:
    assert printed(program) == [value]


@pytest.mark.parametrize(
    ("program", "words"),
    [
        ("map [forward 1] [1]", "line 1: map needs a value for each member"),
        ("filter [5] [1]", "filter doesn't like 5 as input: it needs true or false"),
        ('throw "away', "throw away: no catch of this tag is waiting; nothing catches here"),
        ("iftrue [fd 1]", "iftrue needs a test before it"),
        ('make "a array 3', "I don't know how to array; there are no arrays here: keep a list"),
        ("do.while [fd 1] [1 = 1]", "take while or until"),
        ("to poly :n [:size 50]\nend", "to poly: inputs that may be left out are not here"),
        ("fd10", "a space is missing: fd 10"),
        ("repeat 4 {fd 10}", "lists stand in [ ]"),
        ('print "hello world"', "more words are a list: [hello world]"),
        ("print 2^3", "take power: power 2 3"),
    ],
)  # fmt: skip
def test_what_other_logos_have_is_answered(program: str, words: str) -> None:
    assert words in refused(program)


@pytest.mark.parametrize(
    "loop",
    [
        'forever [make "l fput 1 :l]',
        'forever [make "l lput 1 :l]',
        'forever [make "l sentence :l [a b]]',
        'repeat 5000 [make "l fput 1 :l] forever [make "m butfirst :l]',
        'repeat 5000 [make "l fput 1 :l] forever [make "m butlast :l]',
        'repeat 2000 [make "l fput 1 :l] make "m butfirst fput 1 :l forever [make "e equalp :l :m]',
        'repeat 2000 [make "l fput 1 :l] forever [make "e memberp 2 :l]',
    ],
)
def test_what_large_lists_cost_counts_as_steps(loop, monkeypatch):
    """The members that Logo looks at, beyond the steps, are no more than a few for each step."""
    looks = 0
    known = values.weight

    def counted(value):
        nonlocal looks
        looks += 1
        return known(value)

    monkeypatch.setattr(values, "weight", counted)
    with pytest.raises(LogoStopped, match="stopped after 200000 steps"):
        Logo(limits=Limits(steps=200_000)).run(f'make "l []\n{loop}')
    assert looks < 400_000


def test_lists_know_their_depth_and_weight_however_they_were_made():
    nested = read_list("a [b [c]] d")
    for made in (nested + nested, nested.without(0), nested.without(0).without(0), nested.without(-1)):
        again = values.LogoList(made.items)
        assert (made.depth, made.weight) == (again.depth, again.weight)
    deep = values.LogoList()
    with pytest.raises(LogoError, match="nested more than 100 deep"):
        for _ in range(200):
            deep = values.LogoList() + values.LogoList((deep,))
