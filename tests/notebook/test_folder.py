"""A temporary folder is gone after its process, also where that was killed."""

import sys
from pathlib import Path

from rosmini.notebook.package import TemporaryFolder

from ..processes import kill, start

HOLD = """
import sys
from rosmini.notebook.package import TemporaryFolder
folder = TemporaryFolder()
print(folder.path, flush=True)
sys.stdin.read()
"""


def test_a_folder_is_made_and_removed(tmp_path, monkeypatch):
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))
    folder, other = TemporaryFolder(), TemporaryFolder()
    (folder.path / "below").mkdir()
    assert folder.path.is_dir()
    assert other.path.is_dir()
    folder.remove()
    folder.remove()
    assert list(tmp_path.resolve().iterdir()) == [other.path]
    other.remove()


def test_a_folder_stays_where_every_lock_is_granted(tmp_path, monkeypatch):
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))
    monkeypatch.setattr("sys.platform", "emscripten")
    monkeypatch.setattr("rosmini.notebook.package._take", lambda file: None)
    folder, other = TemporaryFolder(), TemporaryFolder()
    assert folder.path.is_dir()
    assert other.path.is_dir()
    folder.remove()
    other.remove()


def test_what_a_killed_process_left_is_removed_by_the_next(tmp_path, monkeypatch):
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))
    (tmp_path / "rosmini-of-somebody-else").mkdir()
    with start(
        [sys.executable, "-c", HOLD], env={"TMPDIR": str(tmp_path), "TEMP": str(tmp_path)}, stdin=-1, stdout=-1
    ) as process:
        left = Path(process.stdout.readline().strip())
        first = TemporaryFolder()
        assert left.is_dir()  # it is in use
        kill(process)
        process.wait()
        second = TemporaryFolder()
    assert not left.exists()
    assert first.path.is_dir()
    assert (tmp_path / "rosmini-of-somebody-else").is_dir()
    first.remove()
    second.remove()
