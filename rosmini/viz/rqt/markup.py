"""The parts of a panel as HTML with form controls, which work in a live notebook and are disabled in a page."""

from __future__ import annotations

import re
from collections.abc import Iterable
from functools import partial

from rosmini.viz.style import themed, variable
from rosmini.viz.svg import element, escape

from .parts import Bar, Box, Cell, Control, Drawing, Part, Row, Rows, Words, number_text

NAME, TABLE = "rosmini-rqt", "rosmini-rqt-table"
INKS = {"DEBUG": "muted", "INFO": "ink", "WARN": "label", "ERROR": "bad-line", "FATAL": "bad-line"}
"""The colour of each level of a log message."""
COLOURS = ["page", "ink", "muted", "blue", "label", "bad-line", "group-fill", "group-line", "topic-fill"]


def page(title: str, parts: Iterable[Part], *, live: bool) -> str:
    """Return the panel; without a kernel (``live`` is False) its controls are disabled."""
    head = element("header", element("strong", escape(title)))
    note = "" if live else element("p", "In a live notebook this form works.", class_="rq-note")
    form = markup(parts)
    # Each control by itself: in a disabled fieldset, the keyboard would not reach the tables that scroll either.
    body = element("fieldset", form if live else CONTROL.sub(r"<\1 disabled", form))
    return element(
        "div", f"<style>{CSS}</style>{head}{body}{note}", class_=NAME, role="group", aria_label=title,
        data_lm_suppress_shortcuts="true",
    )  # fmt: skip


CONTROL = re.compile(r"<(button|input|select|textarea)(?=[ >])")


def markup(parts: Iterable[Part]) -> str:
    """Return the parts, one below the other."""
    return "".join(map(_part, parts))


def _part(part: Part) -> str:
    match part:
        case Bar():
            return element("div", "".join(_in_bar(cell) for cell in part.cells), class_="rq-bar")
        case Rows():
            return table(part)
        case Drawing():
            return _drawing(part)
        case Words():
            kind = "rq-words rq-bad" if part.is_bad else "rq-words"
            return element("p", escape(part.text).replace("\n", "<br>"), class_=kind, role="status")
        case Box():
            close = "" if part.close is None else _control(part.close)
            head = element("header", element("strong", escape(part.title)) + close)
            return element("section", head + markup(part.parts), class_="rq-box", aria_label=part.title)


def _drawing(part: Drawing) -> str:
    hand = part.pointer
    touched = {} if hand is None else {"data_points": hand.key, "tabindex": "0", "aria_label": hand.label}
    return element("div", part.markup, class_="rq-drawing", data_picks=part.key or None, **touched)


def _in_bar(cell: Cell) -> str:
    if isinstance(cell, str):
        return element("span", escape(cell))
    if cell.kind == "button":
        return _control(cell)
    name = element("span", escape(cell.label))
    return element("label", _control(cell) + name if cell.kind == "check" else name + _control(cell))


def table(part: Rows) -> str:
    """Return a table, which scrolls in a narrow page."""
    body = "".join(_row(part.columns, row) for row in part.rows)
    if not part.rows:
        body = element("tr", element("td", escape(part.empty), colspan=len(part.columns)))
    head = element("tr", "".join(_heading(title) for title in part.columns))
    whole = element("table", element("thead", head) + element("tbody", body))
    return element("div", whole, class_=TABLE, role="group", aria_label=part.label, tabindex="0")


def _heading(title: str) -> str:
    return element("th", escape(title), scope="col") if title else element("td", "")


def _row(columns: Iterable[str], row: Row) -> str:
    indent = f"padding-left:{0.5 + 1.2 * row.depth:.1f}em" if row.depth else None
    cells = "".join(
        element(
            "td",
            _breakable(cell) if isinstance(cell, str) else _control(cell),
            style=None if number else indent,
            class_=f"rq-{column.lower()}" if row.level else None,
        )
        for number, (column, cell) in enumerate(zip(columns, row.cells, strict=True))
    )
    return element("tr", cells, class_=f"{row.level}{' marked' * row.is_marked}".strip() or None)


def _breakable(text: str) -> str:
    """Return a text whose long ROS names a narrow page can break between their words."""
    return re.sub(r"(?<=\w)([/_])(?=\w)", r"\1<wbr>", escape(text))


def _control(control: Control) -> str:
    common = {"data_key": control.key, "aria_label": control.label, "aria_invalid": "true" if control.problem else None}
    match control.kind:
        case "button":
            pressed = str(control.value).lower() if isinstance(control.value, bool) else None
            return element("button", escape(control.label), type="button", data_key=control.key, aria_pressed=pressed)
        case "choice":
            options = "".join(
                element("option", escape(one) or " ", value=one, selected="" if one == control.value else None)
                for one in control.choices
            )
            made = element("select", options or " ", **common)
        case "check":
            made = element("input", type="checkbox", checked="" if control.value else None, **common)
        case "text":
            made = element("input", type="text", value=str(control.value), spellcheck="false", **common)
        case _:
            made = _number(control, common)
    problem = element("span", escape(control.problem), class_="rq-problem") if control.problem else ""
    return made + problem


def _number(control: Control, common: dict[str, str | None]) -> str:
    low, high = (None if end is None else number_text(end) for end in (control.minimum, control.maximum))
    step = "1" if control.whole else "any"
    kind = "number"
    if control.kind == "slider":
        kind, span = "range", (control.maximum or 0) - (control.minimum or 0)
        step = "1" if control.whole else f"{span / 1000:g}"
    value = number_text(control.value) if isinstance(control.value, float) else str(control.value)
    return element("input", type=kind, value=value, min=low, max=high, step=step, **common)


def _rule(selector: str, _scope: str = NAME, **properties: str) -> str:
    scoped = ",".join(f".{_scope} {part}".rstrip() for part in selector.split(","))
    return f"{scoped}{{{''.join(f'{n}:{v};' for n, v in properties.items()).replace('_', '-')}}}"


_LINE = f"1px solid {variable('group-line')}"
_BOX = {"border": _LINE, "border_radius": "6px", "background": variable("page"), "color": "inherit", "font": "inherit"}

_rule_of_table = partial(_rule, _scope=TABLE)

TABLE_CSS = (
    f".{TABLE}{{overflow:auto;color:{variable('ink')};}}"
    + _rule_of_table("table", border_collapse="collapse", margin="0", width="100%", font_size="0.93em", border="none")
    + _rule_of_table("tr,tbody tr:nth-child(odd),tbody tr:hover", background="none")
    + _rule_of_table("th,td", text_align="left", vertical_align="baseline", padding="3px 10px 3px 0.5em", border="none",
                     border_bottom=_LINE, color="inherit", white_space="pre-wrap")
    + _rule_of_table("th", background=variable("group-fill"), font_weight="600", position="sticky", top="0")
    + _rule_of_table("tr.marked td", background=variable("topic-fill"))
    + _rule_of_table("td.rq-stamp", font_variant_numeric="tabular-nums")
    + _rule_of_table("td.rq-message", min_width="11em", max_width="44em")
    + _rule_of_table("td.rq-location", color=variable("muted"), white_space="nowrap")
    + _rule_of_table("tr.FATAL td.rq-severity,tr.FATAL td.rq-message", font_weight="700")
    + "".join(_rule_of_table(f"tr.{level} td.rq-severity,tr.{level} td.rq-message", color=variable(ink))
              for level, ink in INKS.items())
    + themed(f".{TABLE}", ["ink", "muted", "label", "bad-line", "group-fill", "group-line", "topic-fill"])
)  # fmt: skip

CSS = TABLE_CSS + (
    f".{NAME}{{background:{variable('page')};color:{variable('ink')};border:{_LINE};border-radius:10px;"
    "font:14px/1.45 var(--rosmini-font,sans-serif);max-width:960px;overflow:hidden;text-align:left}"
    + _rule("fieldset", border="0", margin="0", padding="0", min_width="0")
    + _rule("header", background=variable("group-fill"), border_bottom=_LINE, padding="6px 12px", display="flex",
            justify_content="space-between", align_items="center", gap="8px")
    + _rule(".rq-bar", display="flex", flex_wrap="wrap", gap="6px 14px", align_items="center", padding="8px 12px")
    + _rule("label", display="inline-flex", gap="6px", align_items="center", margin="0", color="inherit")
    + _rule("input,select,button", **_BOX, padding="3px 8px", min_height="28px", margin="0", max_width="22em")
    + f".{NAME} *{{box-sizing:border-box}}"
    + _rule("input[type=checkbox]", min_height="16px", width="16px", height="16px", accent_color=variable("blue"))
    + _rule("input[type=range]", padding="0", border="0", min_width="9em", accent_color=variable("blue"))
    + _rule("input[type=number]", width="7.5em")
    + _rule("button", cursor="pointer")
    + _rule("button:hover:enabled", border_color=variable("blue"))
    + _rule("button[aria-pressed=true]", border_color=variable("blue"), background=variable("topic-fill"))
    + _rule("[data-points]", touch_action="pan-y", cursor="crosshair")
    + _rule("[data-points] svg", width="100%")
    + _rule("[data-points]:focus-visible", outline=f"2px solid {variable('blue')}", outline_offset="-2px")
    + _rule("input:focus-visible,select:focus-visible,button:focus-visible,.rosmini-rqt-table:focus-visible",
            outline=f"2px solid {variable('blue')}", outline_offset="1px")
    + _rule("[aria-invalid=true]", border_color=variable("bad-line"))
    + _rule(".rq-problem", color=variable("bad-line"), margin_left="6px")
    + _rule(f".{TABLE}", max_height="420px")
    + _rule(".rq-drawing", overflow_x="auto", padding="8px 12px")
    + _rule(".rq-drawing svg", max_width="100%", height="auto")
    + _rule(".rq-drawing[data-picks] .rm-node", cursor="pointer")
    + _rule(".rq-words,.rq-note", margin="0", padding="6px 12px")
    + _rule(".rq-note", color=variable("muted"), border_top=_LINE, font_size="0.9em")
    + _rule(".rq-bad", color=variable("bad-line"), border_left=f"4px solid {variable('bad-line')}")
    + _rule(".rq-box", border_top=_LINE)
    + _rule(".rq-box .rq-box", border=_LINE, border_radius="8px", margin="8px 12px")
    + themed(f".{NAME}", COLOURS)
)  # fmt: skip
