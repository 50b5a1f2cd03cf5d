"""`tests/` mirrors `rosmini/`: whoever looks for the tests of a folder finds them in the folder of the same name."""

from __future__ import annotations

from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
# What tests more than one folder of the library, or none.
ACROSS = {"assets", "benchmarks", "browser", "data", "gates", "interop", "jupyter", "report"}


def modules_of_tests() -> list[Path]:
    found = sorted((ROOT / "tests").rglob("test_*.py"))
    return [path for path in found if path.relative_to(ROOT / "tests").parts[0] not in ACROSS]


def test_each_folder_of_tests_has_its_folder_in_the_library():
    folders = {path.parent.relative_to(ROOT / "tests") for path in modules_of_tests()}
    assert [str(folder) for folder in sorted(folders) if not (ROOT / "rosmini" / folder).is_dir()] == []


def test_a_test_of_a_module_lies_at_its_depth():
    """`tests/sim/test_rasters.py` would be refused while the module is `rosmini/sim/worlds/rasters.py`."""
    astray = []
    for path in modules_of_tests():
        name, folder = (path.stem.removeprefix("test_"), ROOT / "rosmini" / path.parent.relative_to(ROOT / "tests"))
        if (folder / f"{name}.py").is_file() or path.parent == ROOT / "tests":
            continue
        deeper = [*folder.glob(f"*/**/{name}.py"), *(each for each in folder.glob(f"**/{name}") if each.is_dir())]
        astray += [f"{path.relative_to(ROOT)} tests {found.relative_to(ROOT)}: move it there" for found in deeper]
    assert astray == []
