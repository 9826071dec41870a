import ast
import contextlib
import io
import os
import re
import unittest

import ream
from places import PROGRAM, ROOT, DataFolder


class GuideTest(DataFolder):
    def test_what_readers_copy_runs(self) -> None:
        self.assertNotRegex((ROOT / "docs/python.md").read_text(), r"\b[A-Z]{4,}_[A-Z]{4,}\b", "a figure is still to come")
        blocks = re.findall(r"^```python\n(.*?)^```", (ROOT / "docs/python.md").read_text(), re.M | re.S)
        self.assertGreater(len(blocks), 8)
        os.environ["PATH"] = f"{PROGRAM.parent}:{os.environ['PATH']}"
        names: dict = {}
        said = io.StringIO()
        with contextlib.chdir(self.folder), contextlib.redirect_stdout(said):
            for block in blocks:
                exec(compile(block, "docs/python.md", "exec"), names)
        self.assertAlmostEqual(names["reamer_z"], 0.5, delta=0.01)
        self.assertAlmostEqual(float(names["tick"]["thrust_n"]), 50.0, delta=2.0)
        self.assertGreater(names["engaged"].sum(), 50)
        self.assertGreater(names["removed"][1.0], names["removed"][0.5])
        self.assertIn("\nTrue\n", said.getvalue())
        self.assertIn("not_found - ", said.getvalue())

    def test_everything_public_says_what_it_is(self) -> None:
        for name in ream.__all__:
            self.assertTrue(hasattr(ream, name), name)
            value = getattr(ream, name)
            if callable(value):
                self.assertTrue(value.__doc__, name)
        for kind in (ream.Simulation, ream.Recording):
            for name, value in vars(kind).items():
                if not name.startswith("_"):
                    self.assertTrue(value.__doc__, f"{kind.__name__}.{name}")

    def test_the_stub_names_what_the_module_has(self) -> None:
        stub = ast.parse((ROOT / "python/ream/_ream.pyi").read_text())
        for node in stub.body:
            if isinstance(node, ast.ClassDef):
                kind = getattr(ream._ream, node.name)
                written = {part.name for part in node.body if isinstance(part, ast.FunctionDef)} - {"__init__"}
                there = {name for name in vars(kind) if not name.startswith("_")}
                if not issubclass(kind, Exception):
                    self.assertEqual(written, there, node.name)
        written = {node.name for node in stub.body if isinstance(node, (ast.ClassDef, ast.FunctionDef))}
        written |= {node.target.id for node in stub.body if isinstance(node, ast.AnnAssign)}
        there = {name for name in vars(ream._ream) if not name.startswith("_")}
        self.assertEqual(there, written)


if __name__ == "__main__":
    unittest.main()
