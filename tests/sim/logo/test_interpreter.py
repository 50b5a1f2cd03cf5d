"""Programs, what they print, and their errors."""

import contextlib

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rosmini.sim.logo import Limits, Logo, LogoError, LogoStopped
from rosmini.sim.logo.interpreter import PRIMITIVES

SMALL = Limits(steps=2000, moves=200, depth=500, lines=100)


def printed(program, limits=None):
    lines = []
    Logo(say=lines.append, limits=limits).run(program)
    return lines


def refused(program, limits=None):
    with pytest.raises(LogoError) as error:
        printed(program, limits)
    return str(error.value)


@pytest.mark.parametrize(
    ("expression", "value"),
    [
        ("1 + 2 * 3", "7"),
        ("(1 + 2) * 3", "9"),
        ("10 - 4 - 3", "3"),
        ("3-2", "1"),
        ("sum 3 -2", "1"),
        ("sum 3 - 2 1", "2"),
        ("2 * -(1 + 2)", "-6"),
        ("0.1 + 0.2", "0.3"),
        ("7 / 2", "3.5"),
        ("6 / 2", "3"),
        ("remainder -7 3", "-1"),
        ("int -2.7", "-2"),
        ("round -2.5", "-3"),
        ("sqrt 16 + 9", "5"),
        ("sin 30 + 60", "1"),
        ("3 <= 2", "false"),
        ("5 = 5.0", "true"),
        ("2 <> 3", "true"),
        ('"Red = "rED', "true"),
        ("[a [1]] = [A [1.0]]", "true"),
        ("and 1 = 1 2 = 3", "false"),
        ("or 1 = 1 not 2 = 2", "true"),
        ("first [[a b] c]", "a b"),
        ('last "logo', "o"),
        ("butfirst [a b c]", "b c"),
        ('bl "logo', "log"),
        ("item 2 [a b c]", "b"),
        ("count [a [b c]]", "2"),
        ('count "logo', "4"),
        ("emptyp []", "true"),
        ('word "lo "go', "logo"),
        ("sentence [a b] [c [d]]", "a b c [d]"),
        ("list 1 [2]", "1 [2]"),
        ("fput 1 [2 3]", "1 2 3"),
        ("lput 1 [2 3]", "2 3 1"),
        ("ifelse 1 = 1 [3] [4]", "3"),
        ("run [1 + 1]", "2"),
        ("[1 + 1]", "1 + 1"),
        ("towards [10 10]", "45"),
        ("distance [3 4]", "5"),
    ],
)
def test_expressions(expression, value):
    assert printed(f"print {expression}") == [value]


def test_comments_continued_lines_and_lists_over_several_lines():
    assert printed("print ~\n 3 ; three\nrepeat 2 [\n  print 1\n  show [2]\n]\nprint (1 + 2)") == [
        *("3", "1", "[2]", "1", "[2]", "3")
    ]


def test_procedures_may_be_defined_after_their_use_and_case_is_ignored():
    assert printed("Print TWICE 4\nTO Twice :N\nOUTPUT 2 * :n\nEND") == ["8"]


def test_loops():
    assert printed("repeat 2 [repeat 2 [print repcount]]") == ["1", "2", "1", "2"]
    assert printed('make "n 2 while [:n > 0] [print :n make "n :n - 1]') == ["2", "1"]
    assert printed("foreach [a b] [print ?] repeat 0 [print 1]") == ["a", "b"]
    assert printed("to f\nforever [stop]\nend\nf print 1") == ["1"]


def test_names_are_bound_dynamically():
    program = 'to outer :x\ninner\nend\nto inner\nprint :x\nend\nmake "x 1 outer 2 print :x'
    assert printed(program) == ["2", "1"]


def test_an_error_or_an_interrupt_restores_names_and_turtles():
    lines = []

    def say(line):
        if line == "now":
            raise KeyboardInterrupt
        lines.append(line)

    logo = Logo(say=say)
    logo.run('make "x 1 newturtle "ann')
    with pytest.raises(LogoError):
        logo.run('to f :x\nask "ann [print first []]\nend\nf 2')
    with pytest.raises(KeyboardInterrupt):
        logo.run('to g :x\nask "ann [print "now]\nend\ng 3')
    logo.run("print :x")
    assert lines == ["1"]
    assert [turtle.name for turtle in logo.flock.active] == ["turtle1"]


def test_output_leaves_loops_and_keeps_pending_values():
    program = "to find :x :l\nforeach :l [if ? = :x [output 7]]\noutput 0\nend\n"
    assert printed(program + "print 1 + find 2 [1 2 3] print find 9 [1]") == ["8", "0"]


def test_recursion_may_be_deeper_than_pythons():
    program = "to sum.to :n\nif :n = 0 [output 0]\noutput :n + sum.to :n - 1\nend\nprint sum.to 9000"
    assert printed(program) == ["40504500"]


def test_a_last_call_may_go_on_for_ever():
    down = "to down :n\nif :n = 0 [stop]\ndown :n - 1\nend\ndown 3000 print 1"
    assert printed(down, Limits(depth=20)) == ["1"]
    assert "what to do with 3" in refused("to f\ng\nend\nto g\noutput 3\nend\nf")


def test_random_numbers_are_the_same_in_each_run():
    program = "repeat 100 [print random 3]"
    assert printed(program) == printed(program)
    assert set(printed(program)) == {"0", "1", "2"}


@pytest.mark.parametrize(
    ("program", "parts"),
    [
        ("print 1\nfrwd 50", ["line 2:", "frwd", "forward"]),
        ("to sq :steps\nfd :step\nend\n\nsq 3", ["line 2, in sq:", "step", ":steps"]),
        ("forward", ["line 1:", "forward distance"]),
        ("fd rt 90", ["line 1:", "fd", "forward distance", "rt"]),
        ("print 1 + (rt 90)", ["+", "rt"]),
        ('print 1\nforward "ten', ["line 2:", "forward", "ten"]),
        ("repeat -1 []", ["repeat", "-1"]),
        ("repeat 2 3", ["repeat", "3"]),
        ("if 3 [fd 1]", ["if", "3", "true or false"]),
        ("repeat 2 [3]", ["line 1:", "3"]),
        ("to f\nend\nprint f", ["line 3:", "f", "print"]),
        ("print 1 +", ["+"]),
        ("print * 2", ["*"]),
        ("print 1\nrepeat 4 [fd 1\nrt 90\n", ["line 2:", "["]),
        ("to f\nrepeat 2 [fd 1\nend\nf", ["line 2:", "["]),
        ("print 1\n\nfd 1 ]", ["line 3:", "]"]),
        ("print (1 + 2", ["line 1:", "("]),
        ("print 1)", ["line 1:", ")"]),
        ("print (1 2)", ["("]),
        ("print ()", [")"]),
        ("to f\nprint 1", ["line 1:", "to f"]),
        ("to f\nto g\nend", ["line 1:", "to f", "line 2"]),
        ("end", ["line 1:", "end"]),
        ("to f\nend\nto f\nend", ["line 3:", "f", "line 1"]),
        ("to forward\nend", ["line 1:", "forward"]),
        ("to", ["to"]),
        ("to 3\nend", ["3"]),
        ("to f x\nend", ["to f"]),
        ("to f :x :X\nend", [":X"]),
        ("repeat 2 [to f]", ["to"]),
        ("stop", ["stop"]),
        ("print item 3 [a b]", ["item", "3", "from 1 to 2"]),
        ("print 1 / 0", ["zero"]),
        ("print 1e308 * 10", ["large"]),
        ("print 1e999", ["1e999"]),
        ("print sqrt -1", ["sqrt", "-1"]),
        ("print random 0", ["random", "0"]),
        ("setpencolor 16", ["setpencolor", "16"]),
        ('setpencolor "reed', ["setpencolor", "red"]),
        ("setpensize 0", ["setpensize", "0"]),
        ("setpos [1]", ["setpos", "[1]"]),
        ('tell "bob', ["bob", "newturtle"]),
        ('newturtle "turtle1', ["turtle1"]),
        ("fd 1e10", ["out of bounds", "turtle1"]),
    ],
)
def test_errors_name_the_line_and_the_word(program, parts):
    message = refused(program)
    assert [part for part in parts if part not in message] == []


def test_nothing_runs_if_a_line_is_invalid():
    logo = Logo()
    with pytest.raises(LogoError):
        logo.run("fd 10\nfrwd 10")
    assert logo.drawing.strokes == ()


@pytest.mark.parametrize(
    "program",
    [
        'while ["true] []',
        "forever []",
        "forever [fd 1]",
        "forever [print 1]",
        "to f\nf\nend\nf",
        "to f\nf print 1\nend\nf",
        'make "l [run :l print 1] run :l',
        'make "l [a] forever [make "l se :l :l]',
        'make "l [a] forever [make "l fput 1 :l]',
        'make "l [a] repeat 9 [make "l se :l :l] forever [make "e equalp :l butfirst fput 1 :l]',
        'make "w "ab forever [make "w word :w :w]',
    ],
)
def test_endless_programs_are_stopped(program):
    with pytest.raises(LogoStopped):
        printed(program, SMALL)


def test_values_have_a_maximum_size():
    assert "1000000" in refused('make "w "ab forever [make "w word :w :w]')
    assert "100" in refused('make "l [a] forever [make "l list :l "a]')
    assert "1000000" in refused(" " * 1_000_001)


@pytest.mark.parametrize(
    "program",
    [
        "[" * 5000,
        "print " + "(" * 5000 + "1" + ")" * 5000,
        "print " + "first " * 5000 + "1",
        "print " + "- " * 5000 + "1",
    ],
)
def test_deep_nesting_is_refused(program):
    assert "100" in refused(program)


def test_a_long_expression_is_not_nested():
    assert printed("print " + "1 + " * 1000 + "1") == ["1001"]


def test_closed_figures_close_and_the_return_home_is_no_line():
    logo = Logo()
    logo.run("repeat 12 [repeat 4 [forward 90 right 90] right 30] home")
    assert logo.drawing.turtles == {"turtle1": (0, 0, 0)}
    assert len(logo.drawing.lines) == 48
    assert logo.drawing.length == pytest.approx(48 * 90)


def test_help_shows_usage_and_short_forms():
    (line,) = printed('help "fd')
    assert line.startswith("forward distance (short: fd): ")
    assert all(primitive.help for primitive in PRIMITIVES.values())


SYMBOLS = ["to", "end", "f", ":x", '"a', "1", "2.5", "-3", *"[]()+-*/=<\n"]
WORDS = st.sampled_from([*PRIMITIVES, *SYMBOLS])


@given(st.one_of(st.text(max_size=200), st.lists(WORDS, max_size=40).map(" ".join)))
def test_any_text_raises_only_logo_errors(program):
    with contextlib.suppress(LogoError):
        printed(program, SMALL)
