"""The widgets of ipywidgets where nobody can use them, as in the book: a form whose controls are disabled.

In a live notebook ipywidgets shows them itself. Its output refers to the kernel by a new number in each run, so the
book and a page of nbconvert cannot show it, and a stored output would differ each time.
"""

from __future__ import annotations

from typing import Any

from rosmini.viz.rqt.markup import page
from rosmini.viz.rqt.parts import Bar, Cell, Control, Part, Words, controls

KINDS = {"Button": "button", "FloatSlider": "slider", "IntSlider": "slider", "Checkbox": "check", "Text": "text"}
"""The kinds of control that take the place of widgets, by class."""


def register(shell: Any) -> None:
    """Show widgets as forms from now on. Does not import ipywidgets."""
    shell.display_formatter.mimebundle_formatter.for_type_by_name("ipywidgets.widgets.widget", "Widget", bundle)
    shell.events.register("pre_run_cell", _before_cell)


def _before_cell(info: Any) -> None:
    """Replace the widgets that ``interact`` makes, before a cell that imports ipywidgets runs."""
    if "ipywidgets" not in info.raw_cell:
        return
    from IPython.core.display_functions import display
    from ipywidgets import HBox, interact, interactive

    show: Any = display

    class StillInteractive(interactive):  # type: ignore[misc]
        """A form, and the output of the function for the first values; a widget for output would be empty."""

        def update(self, *_: Any) -> None:
            """Do nothing before the form is shown."""

        def _ipython_display_(self) -> None:
            show(bundle(HBox(self.children[:-1])), raw=True)  # the last one is the output
            result = self.f(**{each._kwarg: each.get_interact_value() for each in self.kwargs_widgets})  # noqa: SLF001
            if result is not None:
                show(result)

    interact.cls = StillInteractive


def bundle(widget: Any) -> dict[str, str]:
    """Return the text and the page of a widget."""
    parts = list(_parts(widget))
    labels = [each.label for each in controls(parts)] or [type(widget).__name__]
    return {"text/plain": f"ipywidgets: {', '.join(labels)}", "text/html": page("ipywidgets", parts, live=False)}


def _parts(widget: Any) -> list[Part]:
    if type(widget).__name__ == "VBox":
        return [part for child in widget.children for part in _parts(child)]
    children = getattr(widget, "children", [widget])
    cells = [_cell(child) for child in children]
    known = tuple(cell for cell in cells if cell is not None)
    return [Bar(known)] if len(known) == len(cells) else [Words(f"In a live notebook: {type(widget).__name__}")]


def _cell(widget: Any) -> Cell | None:
    name = type(widget).__name__
    if name == "Label":
        return str(widget.value)
    label = str(getattr(widget, "description", ""))
    match KINDS.get(name):
        case "button":
            return Control(label, label, "button")
        case "slider":
            return Control(label, label, "slider", float(widget.value), minimum=widget.min, maximum=widget.max)
        case "check":
            return Control(label, label, "check", bool(widget.value))
        case "text":
            return Control(label, label, "text", str(widget.value))
        case _:
            return None
