"""Where the tests of the Python package find things, and what they share."""

import json
import os
import pathlib
import subprocess
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
PROGRAM = pathlib.Path(os.environ["REAM_BIN"])

#: Three seconds: the reamer is pressed on the bone and cuts.
SHORT_SCRIPT = {
    "device": "hand",
    "duration_s": 3,
    "stiffness_n_mm": 100,
    "vibration": {"source": "off"},
    "hand": {"start_mm": [0, 0, -1], "force_profile": [{"t_s": 0, "force_n": 30}, {"t_s": 0.3, "force_n": 60}]},
}


class DataFolder(unittest.TestCase):
    """A data folder for all tests of a class."""

    data: str
    folder: pathlib.Path

    @classmethod
    def setUpClass(cls) -> None:
        temporary = tempfile.TemporaryDirectory(prefix="ream-test-")
        cls.addClassCleanup(temporary.cleanup)
        cls.folder = pathlib.Path(temporary.name)
        cls.data = str(cls.folder / "data")
        os.environ["REAM_DATA"] = cls.data

    @classmethod
    def simulated(cls, name: str = "run") -> pathlib.Path:
        """The folder of a session that the program has simulated with the short script."""
        out = cls.folder / name
        if not out.exists():
            script = cls.folder / "short.json"
            script.write_text(json.dumps(SHORT_SCRIPT))
            cls.ream("simulate", "--case", "demo", "--script", script, "--backend", "cpu", "--out", out)
        return out

    @classmethod
    def ream(cls, *words: object) -> str:
        command = [str(PROGRAM), *map(str, words)]
        return subprocess.run(command, check=True, capture_output=True, text=True, cwd=cls.folder).stdout
