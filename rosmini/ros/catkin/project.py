"""Declarations to catkin in the ``CMakeLists.txt`` and the ``setup.py`` of a package, which are read, not run."""

from __future__ import annotations

import ast
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from pathlib import Path

from rosmini.core import files

from .cmake import MAX_FILE_LENGTH, CMakeError, Command, Variables, Word, parse
from .findings import Finding, warning

CMAKE = "CMakeLists.txt"

KINDS = {"add_message_files": "msg", "add_service_files": "srv", "add_action_files": "action"}
EARLY = {"generate_messages", "generate_dynamic_reconfigure_options", "catkin_python_setup"}
"""Commands that come before ``catkin_package``."""

DECLARATIONS = {*KINDS, *EARLY, "catkin_install_python"}
"""Commands that generate something; one that cannot be followed is reported."""

MAX_SETUP_BYTES = 1_000_000
"""Maximum size of a ``setup.py`` [bytes]."""

COMPILING = ("add_executable", "add_library", "nodelet_add_library", "cuda_add_executable", "cuda_add_library")
CATKIN_VARIABLES = {
    "CATKIN_PACKAGE_BIN_DESTINATION": "lib/{name}",
    "CATKIN_PACKAGE_LIB_DESTINATION": "lib",
    "CATKIN_PACKAGE_INCLUDE_DESTINATION": "include/{name}",
    "CATKIN_PACKAGE_SHARE_DESTINATION": "share/{name}",
    "CATKIN_PACKAGE_PYTHON_DESTINATION": "lib/python3/dist-packages/{name}",
    "CATKIN_GLOBAL_BIN_DESTINATION": "bin",
    "CATKIN_GLOBAL_LIB_DESTINATION": "lib",
    "CATKIN_GLOBAL_INCLUDE_DESTINATION": "include",
    "CATKIN_GLOBAL_SHARE_DESTINATION": "share",
    "CATKIN_GLOBAL_PYTHON_DESTINATION": "lib/python3/dist-packages",
}


@dataclass(frozen=True)
class Definition:
    """A message, service or action file to generate; ``path`` is relative to the package."""

    kind: str
    path: str
    line: int

    @property
    def name(self) -> str:
        """Name of the type, without its package."""
        return Path(self.path).stem


@dataclass
class Project:
    """Declarations of a ``CMakeLists.txt``; the line of a missing declaration is None."""

    path: Path
    name: Word | None = None
    finds_catkin: int | None = None
    components: list[Word] = field(default_factory=list)
    definitions: list[Definition] = field(default_factory=list)
    generates: int | None = None
    message_packages: list[Word] = field(default_factory=list)
    exports: int | None = None
    """Line of ``catkin_package``."""
    exported: list[Word] = field(default_factory=list)
    """Its ``CATKIN_DEPENDS``."""
    python_setup: int | None = None
    scripts: list[tuple[Word, str]] = field(default_factory=list)
    """Each Python script to install, and its destination."""
    programs: list[Word] = field(default_factory=list)
    """Other programs to install."""
    reconfigurable: list[Word] = field(default_factory=list)
    """The ``.cfg`` files."""
    compiled: list[Word] = field(default_factory=list)
    is_metapackage: bool = False
    findings: list[Finding] = field(default_factory=list)

    @property
    def folder(self) -> Path:
        """Folder of the package."""
        return self.path.parent


def read_project(folder: Path) -> Project:
    """Return the project in a folder. Raises `CMakeError` with the invalid line."""
    path = folder / CMAKE
    try:
        data = files.read(path, MAX_FILE_LENGTH)
        text = data.decode("utf-8")
    except OSError as error:
        raise CMakeError(f"cannot be read: {error.strerror}", path) from error
    except UnicodeDecodeError as error:
        line = error.object[: error.start].count(b"\n") + 1
        raise CMakeError("the file is not UTF-8 text", path, line) from error
    sources = ("CMAKE_CURRENT_SOURCE_DIR", "CMAKE_CURRENT_LIST_DIR", "PROJECT_SOURCE_DIR")
    variables = Variables(path, dict.fromkeys(sources, folder.as_posix()) | _destinations(folder.name))
    project = Project(path)
    for command in parse(text, path):
        if command.block is None:
            _declare(project, command, variables)
        elif command.name in DECLARATIONS:
            block = f"{command.block.name}() of line {command.block.line}"
            message = f"{command.name}() is ignored, because rosmini does not evaluate {block}"
            project.findings.append(warning(message, path, command.line))
    return project


def _destinations(name: str) -> dict[str, str]:
    """Return the variables of catkin that hold a project's installation paths."""
    return {key: value.format(name=name) for key, value in CATKIN_VARIABLES.items()}


def _declare(project: Project, command: Command, variables: Variables) -> None:
    """Record the declarations of one command."""
    words, line = variables.words(command), command.line
    name = command.name
    if variables.unknown and name in DECLARATIONS:
        message = (
            f"{variables.unknown[0]} has no value, because rosmini only follows set() and list(APPEND) outside "
            f"of blocks; write what {name}() needs without it"
        )
        project.findings.append(warning(message, project.path, line))
    if name in EARLY and project.exports is not None:
        message = f"{name}() comes after catkin_package(); move it before"
        project.findings.append(Finding(message, project.path, line))
    if name == "project" and words:
        project.name = words[0]
        variables.values.update(_destinations(words[0].text))
    elif name == "find_package" and words and words[0].text == "catkin":
        project.finds_catkin = line
        project.components += _after(words, ("COMPONENTS", "OPTIONAL_COMPONENTS"), ("REQUIRED", "QUIET"))
    elif name in KINDS:
        _add_definitions(project, command, words)
    elif name == "generate_messages":
        project.generates = line
        project.message_packages += _after(words, ("DEPENDENCIES",), ("LANGS",))
    elif name == "generate_dynamic_reconfigure_options":
        project.reconfigurable += words
    elif name == "catkin_package":
        project.exports = line
        others = (
            "INCLUDE_DIRS",
            "LIBRARIES",
            "DEPENDS",
            "CFG_EXTRAS",
            "EXPORTED_TARGETS",
            "SKIP_CMAKE_CONFIG_GENERATION",
        )
        project.exported += _after(words, ("CATKIN_DEPENDS", "CATKIN-DEPENDS"), others)
    elif name == "catkin_metapackage":
        project.is_metapackage = True
    elif name == "catkin_python_setup":
        project.python_setup = line
    elif name == "catkin_install_python":
        _install(project, words, scripts=True)
    elif name == "install":
        _install(project, words, scripts=False)
    elif name in COMPILING and words:
        project.compiled.append(Word(words[0].text, line))


def _add_definitions(project: Project, command: Command, words: Sequence[Word]) -> None:
    """``add_message_files([DIRECTORY folder] [FILES names...])``; without names, every file of the folder."""
    kind = KINDS[command.name]
    folder = next(iter(_after(words, ("DIRECTORY",), ("FILES",))), Word(kind, command.line)).text
    names = _after(words, ("FILES",), ("DIRECTORY", "PACKAGE", "NOINSTALL"))
    loose = [word for word in words if word.text.endswith(f".{kind}") and word not in names]
    for word in loose:
        message = f"{word.text} is ignored, because FILES is missing before it in {command.name}()"
        project.findings.append(Finding(message, project.path, word.line))
    if project.generates is not None:
        message = f"{command.name}() comes after generate_messages(); move it before"
        project.findings.append(Finding(message, project.path, command.line))
    if not any(word.text == "FILES" for word in words) and not loose:
        found = files.names_in(project.folder / folder)
        names = [Word(name, command.line) for name in found if name.endswith(f".{kind}")]
    for word in names:
        path = word.text if Path(word.text).is_absolute() else f"{folder}/{word.text}"
        project.definitions.append(Definition(kind, path, word.line))


def _install(project: Project, words: Sequence[Word], *, scripts: bool) -> None:
    """``install(PROGRAMS|FILES|DIRECTORY what... DESTINATION where ...)``."""
    stops = ("DESTINATION", "PERMISSIONS", "PATTERN", "FILES_MATCHING", "USE_SOURCE_PERMISSIONS", "RENAME", "OPTIONAL")
    where = next(iter(_after(words, ("DESTINATION",), stops)), None)
    if not words or words[0].text not in ("PROGRAMS", "FILES", "DIRECTORY"):
        return
    if where is None:
        project.findings.append(Finding("DESTINATION is missing in this install", project.path, words[0].line))
        return
    what = _after(words, (words[0].text,), stops)
    if scripts:
        project.scripts += [(word, where.text) for word in what]
    elif words[0].text == "PROGRAMS":
        project.programs += what


def _after(words: Iterable[Word], starts: Sequence[str], others: Sequence[str]) -> list[Word]:
    """Return the words after one of ``starts``, up to another keyword."""
    found: list[Word] = []
    inside = False
    for word in words:
        if word.text in starts or word.text in others:
            inside = word.text in starts
        elif inside:
            found.append(word)
    return found


def python_packages(folder: Path) -> tuple[dict[str, Path], list[Finding]]:
    """Return the folder of each Python package declared in a ROS package's ``setup.py``, and the problems found.

    It must be written as in the tutorials: ``packages=[...]`` and ``package_dir={...}`` with literal names.
    """
    path = folder / "setup.py"
    if not files.is_file(path):
        return {}, [Finding("catkin_python_setup() needs a setup.py, and there is none", folder / "CMakeLists.txt")]
    try:
        tree = ast.parse(files.read(path, MAX_SETUP_BYTES), str(path))
    except (OSError, SyntaxError, ValueError, RecursionError, MemoryError) as error:
        line = error.lineno if isinstance(error, SyntaxError) else None
        return {}, [Finding(f"cannot be read: {error}", path, line)]
    given = {
        keyword.arg: keyword.value
        for node in ast.walk(tree)
        if isinstance(node, ast.Call)
        for keyword in node.keywords
        if keyword.arg in ("packages", "package_dir")
    }
    if "packages" not in given:
        return {}, [warning("no packages=[...] is found here, so scripts cannot import any", path)]
    try:
        names = ast.literal_eval(given["packages"])
        folders = ast.literal_eval(given["package_dir"]) if "package_dir" in given else {}
        found = {str(name): folder / _folder_of(str(name), dict(folders)) for name in list(names)}
    except (ValueError, TypeError, SyntaxError, RecursionError, MemoryError):
        line = given["packages"].lineno
        return {}, [warning("packages and package_dir are not names themselves, and setup.py is not run", path, line)]
    findings = []
    top = folder.resolve()
    for name, where in sorted(found.items()):
        inside = where.resolve().is_relative_to(top)
        if not name.isidentifier() or not inside or not files.is_file(where / "__init__.py"):
            message = f"the Python package {name!r} is not there: no {where / '__init__.py'}"
            findings.append(Finding(message, path, given["packages"].lineno))
    bad = {each.message.split("'")[1] for each in findings}
    return {name: where for name, where in found.items() if name not in bad}, findings


def _folder_of(name: str, folders: dict[str, str]) -> str:
    """Return the folder of a package as distutils does: its entry in ``package_dir``, or one below that of ""."""
    if name in folders:
        return folders[name]
    return str(Path(folders.get("", ""), *name.split(".")))
