import json
import math
import pathlib
import shutil
import subprocess
import unittest

import h5py
import numpy as np
import ream
from places import PROGRAM, SHORT_SCRIPT, DataFolder

FLAGS = {"spindle_on", "paused", "hand_weakened", "stalled", "irrigating"}


class ExportTest(DataFolder):
    """h5py is not ours: it reads what `ream export` wrote."""

    recording: ream.Recording
    file: h5py.File

    @classmethod
    def setUpClass(cls) -> None:
        super().setUpClass()
        cls.recording = ream.open(cls.simulated())
        cls.file = h5py.File(cls.exported("result.h5"))
        cls.addClassCleanup(cls.file.close)

    @classmethod
    def exported(cls, name: str, *words: object) -> pathlib.Path:
        cls.ream("export", cls.simulated(), "--out", cls.folder / name, *words)
        return cls.folder / name

    def test_every_column_is_that_of_the_recording(self) -> None:
        table = self.recording.table()
        ticks = self.file["ticks"]
        self.assertEqual(set(ticks), set(table))
        for name, column in table.items():
            self.assertTrue(np.array_equal(ticks[name][:], column), name)
            wanted = np.uint8 if name in FLAGS else np.int64 if name == "engaged_points" else np.float64
            self.assertEqual(ticks[name].dtype, wanted, name)

    def test_columns_have_unit_and_meaning_of_the_codebook(self) -> None:
        book = json.loads(self.ream("codebook", "trace", "--json"))
        self.assertGreater(len(book), 40)
        for row in book:
            attributes = self.file["ticks"][row["column"]].attrs
            self.assertEqual((attributes["unit"], attributes["meaning"]), (row["unit"] or "", row["meaning"]))

    def test_the_bone_is_that_of_the_recording(self) -> None:
        bone = self.file["bone"]
        simulation = ream.Simulation("demo", script=SHORT_SCRIPT)
        self.assertTrue(np.array_equal(bone["coverage"], ream.volume(self.recording.coverage())))
        self.assertTrue(np.array_equal(bone["coverage_before"], ream.volume(self.recording.coverage(0))))
        self.assertTrue(np.array_equal(bone["density"], ream.volume(simulation.density)))
        self.assertTrue((bone["coverage"][:] != bone["coverage_before"][:]).any())
        world_from_grid = np.array(bone.attrs["world_from_grid"])
        self.assertTrue(np.allclose(world_from_grid, simulation.world_from_grid))
        for name in ("coverage", "coverage_before", "density"):
            volume = bone[name]
            self.assertEqual(volume.compression, "gzip")
            self.assertEqual(volume.chunks, (32, 32, 32))
            self.assertTrue(np.array_equal(volume.attrs["spacing_mm"], simulation.spacing_mm))
            # As an image: from the centre of the first voxel along the columns of the direction.
            index = np.array([3.0, 5.0, 7.0])
            centre = volume.attrs["origin_mm"] + volume.attrs["direction"] @ (index * volume.attrs["spacing_mm"])
            in_grid = np.append((index + 0.5) * simulation.spacing_mm, 1.0)
            self.assertTrue(np.allclose(centre, (world_from_grid @ in_grid)[:3]))

    def test_plan_header_and_notes_are_there(self) -> None:
        self.assertTrue(np.allclose(self.file["plan"].attrs["world_from_plan"], self.recording.world_from_plan))
        self.assertEqual(self.file["plan"].attrs["depth_mm"], self.recording.header["plan"]["depth_mm"])
        about = self.file["recording"].attrs
        for name in ("settings", "grid", "anatomy"):
            self.assertEqual(json.loads(about[name]), self.recording.header[name])
        self.assertEqual(json.loads(self.file["plan"].attrs["json"]), self.recording.header["plan"])
        self.assertEqual(about["random_seed"], self.recording.header["random_seed"])
        self.assertEqual(about["end_state"], "finished")
        self.assertEqual(len(json.loads(about["segments"])), 1)
        root = self.file.attrs
        self.assertEqual(root["schema_version"], 1)
        self.assertEqual(root["simulated_by"], self.recording.header["build"])
        self.assertEqual(root["side"], self.recording.header["anatomy"]["side"])
        self.assertEqual(root["case"], "demo")

    def test_metrics_and_score_are_those_of_the_run(self) -> None:
        metrics = json.loads((self.simulated() / "metrics.json").read_text())
        group = self.file["metrics"]
        self.assertEqual(json.loads(group.attrs["json"]), metrics)
        missing = set()
        for name, number in group.items():
            if math.isnan(number[()]):
                self.assertEqual(number.attrs["missing"], metrics["missing"][name])
                missing.add(name)
            else:
                self.assertEqual(number[()], metrics[name], name)
            self.assertTrue(number.attrs["meaning"])
        self.assertEqual(group["removed_volume_mm3"].attrs["unit"], "mm3")
        self.assertEqual(missing, set(metrics["missing"]) & set(group))
        score = json.loads(self.ream("score", self.simulated(), "--json"))["score"]
        self.assertEqual(json.loads(self.file["score"].attrs["json"]), score)
        self.assertEqual(self.file["score"].attrs["points"], score["points"])
        self.assertEqual(self.file["score"].attrs["outcome"], score["outcome"])

    def test_the_same_recording_makes_the_same_bytes(self) -> None:
        for name in ("again.h5", "again.parquet"):
            self.assertEqual(self.exported(name).read_bytes(), self.exported(f"other-{name}").read_bytes())

    def test_without_its_case_it_says_so_and_has_the_rest(self) -> None:
        case = pathlib.Path(self.data) / "cases/demo"
        elsewhere = self.folder / "elsewhere"
        case.rename(elsewhere)
        self.addCleanup(lambda: (shutil.rmtree(case, ignore_errors=True), elsewhere.rename(case)))
        case.mkdir()
        (case / "case.json").write_text("{}")
        with h5py.File(self.exported("boneless.h5")) as file:
            self.assertEqual(list(file["bone"]), [])
            self.assertIn("case", file["bone"].attrs["missing"])
            self.assertEqual(len(file["ticks/t_s"]), len(self.recording))
            self.assertTrue(math.isnan(file["metrics/depth_error_mm"][()]))
        with h5py.File(self.exported("there.h5", "--case", elsewhere)) as file:
            self.assertTrue(np.array_equal(file["bone/coverage"], self.file["bone/coverage"]))

    def test_wrong_words_get_one_line_and_no_file(self) -> None:
        out = self.folder / "wrong.h5"
        words = {
            ("--case", self.folder / "nowhere"): (1, "nowhere"),
            ("--rubric", "standard"): (2, "for reports"),
            ("--format", "hdf"): (2, "hdf5"),
        }
        for more, (code, said) in words.items():
            command = [PROGRAM, "export", self.simulated(), "--out", out, *more]
            told = subprocess.run(command, capture_output=True, text=True, cwd=self.folder)
            self.assertEqual(told.returncode, code, told.stderr)
            self.assertIn(said, told.stderr)
            self.assertEqual(told.stderr.count("\n"), 1, told.stderr)
            self.assertFalse(list(self.folder.glob("wrong.h5*")))


if __name__ == "__main__":
    unittest.main()
