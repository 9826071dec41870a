import json
import unittest

import ream
import ream.program
from places import SHORT_SCRIPT, DataFolder


class ProgramTest(DataFolder):
    def test_runs_the_program(self) -> None:
        script = self.folder / "short.json"
        script.write_text(json.dumps(SHORT_SCRIPT))
        out = self.folder / "result"
        metrics = ream.program.simulate("demo", script, out, backend="cpu", random_seed=2)
        self.assertEqual(metrics, {**json.loads((out / "metrics.json").read_text()), "out": str(out)})
        score = ream.program.score(out, rubric="standard")
        simulation = ream.Simulation("demo", script=SHORT_SCRIPT, seed=2)
        simulation.run_script()
        mine = simulation.score()
        for key in ("points", "outcome", "reasons", "criteria"):
            self.assertEqual(mine[key], score["score"][key] if "score" in score else score[key], key)
        table = ream.program.export(out, self.folder / "trace.csv")
        self.assertEqual(table.read_text().count("\n"), len(ream.open(out)) + 1)
        mesh = ream.program.femesh(out, self.folder / "bone.inp", threshold=1.2, modulus=(0, 1000))
        self.assertGreater(mesh["elements"], 1000)
        picture = ream.program.render("demo", self.folder / "demo.png")
        self.assertEqual(picture.read_bytes()[:4], b"\x89PNG")

    def test_makes_cases_and_plans(self) -> None:
        cases = ream.program.run("list", "cases")
        self.assertIsInstance(cases, list)
        told = ream.program.plan("demo")
        self.assertIn("depth_mm", json.dumps(told))

    def test_errors_are_exceptions(self) -> None:
        with self.assertRaisesRegex(ream.Error, "nowhere"):
            ream.program.plan("nowhere")
        with self.assertRaises(ream.Error) as raised:
            ream.program.plan("demo", colour="red")
        self.assertEqual(raised.exception.kind, "usage")
        self.assertIn("colour", str(raised.exception))
        # What looks like an option is a file.
        with self.assertRaisesRegex(ream.Error, "--help"):
            ream.program.import_ct("--help", out="case")
        with self.assertRaises(ream.Error):
            ream.program.import_ct(self.folder / "no-ct", out="case", roi="glenoid", cartilage_mm=1.0)

    def test_a_program_that_is_not_there_is_said(self) -> None:
        ream.program.program = self.folder / "no-such-program"
        self.addCleanup(setattr, ream.program, "program", None)
        with self.assertRaisesRegex(ream.Error, "no-such-program"):
            ream.program.plan("demo")


if __name__ == "__main__":
    unittest.main()
