"""Runs the notebooks whole, each in a kernel of its own, with short values in place of those of their parameters."""

import ast
import base64
import importlib.util
import io
import json
import os
import pathlib
import sys
import tempfile
import unittest

from places import PROGRAM, ROOT, DataFolder

NOTEBOOKS = ROOT / "python/notebooks"

#: For each notebook what its cell `parameters` says here.
SHORT: dict[str, dict[str, object]] = {
    "force_law": {
        "reaming_s": 6.0,
        "thrusts_n": [30.0, 60.0],
        "models": ["edge", "thesis"],
        "start_depth_mm": 0.05,
        "hold_s": 0.2,
        "cortical_g_cc": [1.52],
        "cancellous_g_cc": [0.55],
        "protocol_s": 0.1,
        "own_law_s": 0.8,
        "voxel_mm": 1.0,
    },
    "compare_two_surgeons": {"max_time_s": 4.0},
    "learning_curve": {"learners": 2, "sessions": 3, "resamples": 20, "max_time_s": 2.0},
    "ct_to_fe": {
        "voxel_mm": 1.2,
        "upsample": 1,
        "plan_depth_mm": 0.3,
        "push_n": 90.0,
        "max_time_s": 2.5,
        "crop_mm": 8.0,
        "solve_upsample": [1],
    },
    "make_a_dataset": {
        "count": 2,
        "picture_width": 64,
        "picture_height": 48,
        "picture_s": 0.5,
        "max_time_s": 2.0,
    },
    "control_a_robot": {
        "episodes": 1,
        "compared": ["random"],
        "damping_n_s_mm": [4.0, 8.0],
        "tuning_episodes": 1,
        "max_time_s": 2.5,
    },
}

NEEDED = {
    "nbformat": "python3-nbformat",
    "nbclient": "python3-nbclient",
    "ipykernel": "python3-ipykernel",
    "matplotlib": "python3-matplotlib",
    "h5py": "python3-h5py",
}
MISSING = [package for module, package in NEEDED.items() if importlib.util.find_spec(module) is None]

#: What may stand on standard error: what the program says of a case or a session.
PROGRAM_WARNS = r"^\d{4}-\d\d-\d\d [\d:.]+ \+00:00 warning "

#: Fails in the notebook when a figure has axes that show nothing.
WATCH = """
import matplotlib.pyplot as _pyplot
import numpy as _numpy
def _shows_something(axis):
    lines = [line.get_xydata() for line in axis.lines]
    others = [part.get_array() for part in [*axis.images, *axis.collections]]
    drawn = [_numpy.ma.filled(_numpy.ma.asarray(part, float), _numpy.nan) for part in [*lines, *others] if part is not None]
    return any(_numpy.isfinite(part).any() for part in drawn) or bool(axis.patches)
def _show(shown=_pyplot.show):
    for axis in _pyplot.gcf().axes:
        assert _shows_something(axis), f"nothing is drawn over {axis.get_xlabel()!r}, {axis.get_ylabel()!r}"
    shown()
_pyplot.show = _show
"""


def given(source: str) -> dict[str, object]:
    """What a cell `parameters` sets: names and plain values, and nothing else."""
    values = {}
    for statement in ast.parse(source).body:
        if not (isinstance(statement, ast.Assign) and len(statement.targets) == 1):
            raise AssertionError(f"not a name and its value: {ast.unparse(statement)}")
        target = statement.targets[0]
        if not isinstance(target, ast.Name):
            raise AssertionError(f"not one name: {ast.unparse(statement)}")
        values[target.id] = ast.literal_eval(statement.value)
    return values


@unittest.skipIf(MISSING, "the notebooks need " + ", ".join(MISSING))
class NotebooksTest(DataFolder):
    @classmethod
    def setUpClass(cls) -> None:
        super().setUpClass()
        kernels = cls.folder / "jupyter/kernels/ream-test"
        kernels.mkdir(parents=True)
        command = [sys.executable, "-m", "ipykernel_launcher", "-f", "{connection_file}"]
        kernel = {"argv": command, "display_name": "ream", "language": "python"}
        (kernels / "kernel.json").write_text(json.dumps(kernel))
        for name, folder in (
            ("JUPYTER_DATA_DIR", "jupyter"),
            ("JUPYTER_RUNTIME_DIR", "runtime"),
            ("JUPYTER_CONFIG_DIR", "jupyter-config"),
            ("IPYTHONDIR", "ipython"),
            ("MPLCONFIGDIR", "matplotlib"),
        ):
            (cls.folder / folder).mkdir(exist_ok=True)
            before = os.environ.get(name)
            os.environ[name] = str(cls.folder / folder)
            cls.addClassCleanup(cls.put_back, name, before)

    @staticmethod
    def put_back(name: str, before: str | None) -> None:
        if before is None:
            del os.environ[name]
        else:
            os.environ[name] = before

    def read(self, name: str):
        import nbformat

        notebook = nbformat.read(NOTEBOOKS / f"{name}.ipynb", as_version=4)
        nbformat.validate(notebook)
        return notebook

    def parameters(self, notebook):
        """The cell `parameters`, the first of all code cells."""
        tagged = [cell for cell in notebook.cells if "parameters" in cell.metadata.get("tags", [])]
        first = next(cell for cell in notebook.cells if cell.cell_type == "code")
        self.assertEqual([first], tagged)
        return first

    def run_whole(self, name: str):
        """The notebook after it has run in a folder of its own, in a kernel that only this machine reaches."""
        import nbformat
        from jupyter_client.manager import AsyncKernelManager
        from nbclient import NotebookClient

        notebook = self.read(name)
        cell = self.parameters(notebook)
        unknown = set(SHORT[name]) - set(given(cell.source))
        self.assertFalse(unknown, f"{name} has no such parameters")
        cell.source += "".join(f"\n{key} = {value!r}" for key, value in SHORT[name].items())
        notebook.cells.insert(0, nbformat.v4.new_code_cell(WATCH))
        kernel = AsyncKernelManager(kernel_name="ream-test", ip="127.0.0.1")
        with tempfile.TemporaryDirectory(dir=self.folder) as folder:
            client = NotebookClient(notebook, km=kernel, timeout=None, resources={"metadata": {"path": folder}})
            path = f"{PROGRAM.parent}{os.pathsep}{os.environ['PATH']}"
            client.execute(env={**os.environ, "PATH": path, "PYDEVD_DISABLE_FILE_VALIDATION": "1"}, cleanup_kc=True)
        self.assertFalse(kernel.has_kernel, "the kernel is still there")
        return notebook

    def check(self, name: str) -> str:
        """Runs the notebook and looks at what it made; gives what it printed."""
        from matplotlib.image import imread

        notebook = self.run_whole(name)
        printed = ""
        for cell in notebook.cells:
            if cell.cell_type != "code":
                continue
            pictures = [output.data["image/png"] for output in cell.outputs if "image/png" in output.get("data", {})]
            self.assertEqual(len(pictures), cell.source.count("plt.show()"), cell.source)
            for picture in pictures:
                pixels = imread(io.BytesIO(base64.b64decode(picture)))
                self.assertGreater(min(pixels.shape[:2]), 200)
                self.assertGreater(pixels[..., :3].std(), 0.01, cell.source)
            for output in cell.outputs:
                if output.output_type == "stream" and output.name == "stdout":
                    printed += output.text
                elif output.output_type == "stream":
                    for line in output.text.strip().splitlines():
                        self.assertRegex(line, PROGRAM_WARNS)
        self.assertNotIn("nan", printed.split())
        return printed

    def test_force_law(self) -> None:
        printed = self.check("force_law")
        self.assertIn("off a straight line through 0", printed)

    def test_compare_two_surgeons(self) -> None:
        printed = self.check("compare_two_surgeons")
        self.assertIn("depth_error_mm", printed)

    def test_learning_curve(self) -> None:
        printed = self.check("learning_curve")
        self.assertIn("learner 2:", printed)

    def test_ct_to_fe(self) -> None:
        printed = self.check("ct_to_fe")
        self.assertIn("of Voigt's bound", printed)

    def test_make_a_dataset(self) -> None:
        printed = self.check("make_a_dataset")
        self.assertEqual(printed.count("the same\n"), 2)
        self.assertNotIn("NOT", printed)

    def test_control_a_robot(self) -> None:
        printed = self.check("control_a_robot")
        self.assertIn("admittance", printed)

    def test_committed_without_what_they_made(self) -> None:
        self.assertEqual(sorted(path.stem for path in NOTEBOOKS.glob("*.ipynb")), sorted(SHORT))
        guide = (ROOT / "docs/python.md").read_text()
        for name in SHORT:
            self.assertIn(f"`{name}.ipynb`", guide)
            notebook = self.read(name)
            self.assertEqual(given(self.parameters(notebook).source).keys() - {"folder"} >= SHORT[name].keys(), True, name)
            self.assertTrue(notebook.cells[0].source.startswith("# "), name)
            for cell in notebook.cells:
                if cell.cell_type == "code":
                    self.assertEqual((cell.outputs, cell.execution_count), ([], None), f"{name}: clear its outputs")

    def test_every_test_runs_its_notebook(self) -> None:
        for name in SHORT:
            self.assertTrue(hasattr(self, f"test_{name}"), name)


if __name__ == "__main__":
    unittest.main()
