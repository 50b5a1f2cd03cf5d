"""`rosmini book`: build the book and open it."""

from __future__ import annotations

import argparse
import shutil
import webbrowser
from pathlib import Path
from tempfile import TemporaryDirectory

from rosmini.tools.checkout import find_checkout

from . import notebooks
from .build import build_book, find_chromium, has_display
from .solutions import without_solutions


def add_parser(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Add the parser of `rosmini book`."""
    parser = subparsers.add_parser(
        "book",
        help="build the book from the stored outputs and open it",
        description="Build the book as static HTML in book/_build/html, from the stored outputs, and open it.",
    )
    parser.add_argument("--no-open", action="store_true", help="only build it, and print where it is")
    parser.add_argument("--output", type=Path, metavar="FOLDER", help="write FOLDER/_build/html instead")
    parser.add_argument("--pdf", action="store_true", help="also print _build/rosmini.pdf, by Chromium or Chrome")
    parser.add_argument("--paper", choices=("a4", "letter"), default="a4", help="the paper of the PDF (default: a4)")
    parser.add_argument("--epub", action="store_true", help="also write _build/rosmini.epub, for e-readers")
    parser.add_argument(
        "--without-solutions",
        action="store_true",
        help="leave the solutions out, and write the notebooks without them to the folder `notebooks` next to `html`; "
        "the default output is then book/_build/without_solutions",
    )
    parser.add_argument("--verbose", action="store_true", help="show what Jupyter Book says")


def main(args: argparse.Namespace) -> int:
    """Build, print where the book is, and open what was made last unless told not to or nobody would see it."""
    checkout = find_checkout()
    if args.pdf:
        find_chromium()  # an error now, not after the build
    print(f"Building the book in {checkout} ...", flush=True)
    output = args.output.resolve() if args.output else None
    if args.without_solutions:
        apart = output or checkout / "book" / "_build" / "without_solutions"
        first = build_without_solutions(checkout, apart, quiet=not args.verbose)
        print(f"The notebooks are in {first.parents[1] / 'notebooks'}")
    else:
        first = build_book(checkout, output, quiet=not args.verbose)
    made = [first]
    if args.pdf or args.epub:
        made += _on_paper(checkout, first.parent, args)
    for path in made:
        print(f"The book is at {path}")
    if args.no_open:
        return 0
    if not has_display():
        print("No display here: open that file in a browser.")
    elif not webbrowser.open(made[-1].as_uri()):
        print("No browser was found: open that file yourself.")
    return 0


def _on_paper(checkout: Path, site: Path, args: argparse.Namespace) -> list[Path]:
    """Make the EPUB and the PDF from the built pages."""
    from . import epub, paper, pdf  # what they import comes with Jupyter Book

    sheets = paper.read_sheets(site, paper.listed_pages(checkout))
    made = []
    if args.epub:
        made.append(epub.make_epub(site, sheets, site.with_name("rosmini.epub")))
    if args.pdf:
        made.append(pdf.make_pdf(site, sheets, site.with_name("rosmini.pdf"), size=args.paper))
    return made


def build_without_solutions(checkout: Path, output: Path, *, quiet: bool) -> Path:
    """Build the book from a copy of its sources without solutions, and add those notebooks; the path of its first page.

    Raises `BookError` as `build_book`.
    """
    with TemporaryDirectory() as folder:
        source = Path(folder)
        shutil.copytree(checkout / "book", source / "book", ignore=shutil.ignore_patterns("_build", "__pycache__"))
        for path in sorted((checkout / "notebooks").rglob("[!.]*.ipynb")):
            stripped = source / path.relative_to(checkout)
            stripped.parent.mkdir(parents=True, exist_ok=True)
            notebooks.write(without_solutions(notebooks.read(path)), stripped)
        first = build_book(source, output, quiet=quiet)
        exported = first.parents[1] / "notebooks"
        shutil.rmtree(exported, ignore_errors=True)
        shutil.copytree(source / "notebooks", exported)
        return first
