import json
import os
import pathlib
import signal
import subprocess
import sys
import time
import unittest

import h5py
import numpy as np
import ream
from places import DataFolder
from ream.controllers import Varied, run_episode
from ream.dataset import Settings, make_dataset
from ream.environments import OBSERVED, PushToDepth

SMALL = Settings(picture_width=40, picture_height=30, picture_s=0.5, seed=3, max_time_s=2.6)
COUNT = 3


def contents(folder: pathlib.Path) -> dict[str, bytes]:
    return {path.name: path.read_bytes() for path in sorted(folder.iterdir())}


class DatasetTest(DataFolder):
    made: pathlib.Path

    @classmethod
    def setUpClass(cls) -> None:
        super().setUpClass()
        cls.made = cls.folder / "made"
        make_dataset(cls.made, COUNT, SMALL)

    def command(self, *words: object) -> list[str]:
        size = f"{SMALL.picture_width}x{SMALL.picture_height}"
        usual = ["--seed", SMALL.seed, "--picture-size", size, "--picture-s", SMALL.picture_s, "--max-time-s", SMALL.max_time_s]
        return [sys.executable, "-m", "ream.dataset", *map(str, [*words, *usual])]

    def test_has_a_file_for_each_reaming(self) -> None:
        self.assertEqual(
            list(contents(self.made)),
            ["DATASHEET.md", "case.h5", "dataset.json", "index.h5"] + [f"reaming-00000{i}.h5" for i in range(COUNT)],
        )

    def test_more_processes_make_the_same_bytes(self) -> None:
        other = self.folder / "other"
        subprocess.run(self.command(other, "--count", COUNT, "--jobs", 2), check=True, capture_output=True)
        self.assertEqual(contents(other), contents(self.made))

    def test_goes_on_where_it_was_stopped(self) -> None:
        folder = self.folder / "stopped"
        process = subprocess.Popen(self.command(folder, "--count", 40, "--jobs", 2), stderr=subprocess.PIPE, text=True)
        while not (before := list(folder.glob("reaming-*.h5"))):
            self.assertIsNone(process.poll())
            time.sleep(0.02)
        process.send_signal(signal.SIGINT)
        said = process.communicate(timeout=60)[1]
        self.assertEqual(process.returncode, 130)
        self.assertIn("the same command goes on", said)
        self.assertNotIn("Traceback", said)
        # In the middle of a reaming, but each process may have been about to write one.
        self.assertLessEqual(len(list(folder.glob("reaming-*.h5"))), len(before) + 2)
        # As after the death of a process that nobody could warn.
        (folder / "reaming-000001.h5.123.tmp").write_text("left by a crash")
        there = {path.name: path.stat().st_mtime_ns for path in folder.glob("reaming-*.h5")}
        make_dataset(folder, COUNT, SMALL)
        for name, time_ns in there.items():
            self.assertEqual((folder / name).stat().st_mtime_ns, time_ns)
        for index in range(COUNT):
            name = f"reaming-00000{index}.h5"
            self.assertEqual((folder / name).read_bytes(), (self.made / name).read_bytes())
        self.assertFalse(list(folder.glob("*.tmp")))

    def test_a_folder_that_is_refused_is_left_as_it_was(self) -> None:
        folder = self.folder / "of_somebody"
        folder.mkdir()
        for name in ("notes.tmp", "reaming-000001.h5.123.tmp", "a.txt"):
            (folder / name).write_text("precious")
        with self.assertRaisesRegex(ream.Error, "something else in it"):
            make_dataset(folder, 1, SMALL)
        self.assertEqual(sorted(path.name for path in folder.iterdir()), ["a.txt", "notes.tmp", "reaming-000001.h5.123.tmp"])

    def test_two_do_not_share_a_folder_and_none_stays_behind(self) -> None:
        folder = self.folder / "shared"
        process = subprocess.Popen(self.command(folder, "--count", 40, "--jobs", 2), stderr=subprocess.PIPE, text=True)
        while not (folder / "dataset.json").exists():
            self.assertIsNone(process.poll())
            time.sleep(0.02)
        with self.assertRaisesRegex(ream.Error, "another process"):
            make_dataset(folder, 1, SMALL)
        children = pathlib.Path(f"/proc/{process.pid}/task/{process.pid}/children")
        while len(workers := children.read_text().split()) < 2:
            time.sleep(0.02)
        process.kill()
        process.communicate(timeout=60)
        until = time.monotonic() + 30
        while any(pathlib.Path(f"/proc/{worker}/exe").exists() for worker in workers):
            self.assertLess(time.monotonic(), until, "workers outlive their parent")
            time.sleep(0.05)

    def test_a_full_disk_is_said(self) -> None:
        folder = self.folder / "full"
        limited = ["bash", "-c", 'trap "" XFSZ; ulimit -f 40; exec "$@"', "bash"]
        told = subprocess.run(limited + self.command(folder, "--count", 1), capture_output=True, text=True)
        self.assertEqual(told.returncode, 1, told.stderr)
        self.assertIn("ream.dataset: ", told.stderr)
        self.assertNotIn("Traceback", told.stderr)
        self.assertFalse([path for path in folder.iterdir() if path.suffix == ".tmp"])
        make_dataset(folder, 1, SMALL)
        self.assertEqual((folder / "case.h5").read_bytes(), (self.made / "case.h5").read_bytes())

    def test_another_bone_is_another_data_set(self) -> None:
        path = self.made / "dataset.json"
        told = path.read_text()
        self.addCleanup(path.write_text, told)
        path.write_text(told.replace('"bone": "', '"bone": "0'))
        with self.assertRaisesRegex(ream.Error, "made with bone"):
            make_dataset(self.made, COUNT, SMALL)

    def test_holds_what_was_reamed(self) -> None:
        environment = PushToDepth("demo", max_time_s=SMALL.max_time_s)
        whole = ream.volume(environment.simulation.coverage)
        episode = run_episode(environment, Varied, 3 * 1_000_000 + 1)
        simulation = environment.simulation
        with h5py.File(self.made / "reaming-000001.h5") as file, h5py.File(self.made / "case.h5") as case:
            self.assertEqual(file.attrs["session_hash"], simulation.session_hash)
            self.assertEqual(json.loads(file.attrs["score"]), episode["score"])
            self.assertEqual(json.loads(file.attrs["metrics"]), episode["metrics"])
            ticks = simulation.tick
            self.assertEqual(len(file["ticks/t_s"]), ticks)
            self.assertEqual(len(file["ticks"]), len(simulation.table(environment.last_ticks)))
            steps = file["steps"]
            self.assertEqual(steps["observations"].shape, (episode["steps"] + 1, len(OBSERVED)))
            self.assertEqual(steps["actions"].shape, (episode["steps"], 2))
            self.assertAlmostEqual(steps["rewards"][:].sum(), episode["return"])
            self.assertTrue(np.array_equal(case["coverage"], whole))
            self.assertTrue(np.array_equal(whole - file["bone/removed"][:], ream.volume(simulation.coverage)))
            pictures = file["pictures"]
            last = simulation.picture(SMALL.picture_width, SMALL.picture_height)
            for name in ("rgb", "depth_mm", "labels", "cut"):
                self.assertTrue(np.array_equal(pictures[name][-1], getattr(last, name)), name)
            self.assertEqual(pictures["tick"][-1], ticks)
            self.assertEqual(pictures["tick"][1] - pictures["tick"][0], 500)

    def test_has_an_index(self) -> None:
        with h5py.File(self.made / "index.h5") as index:
            self.assertEqual(len(index["reamings"]), COUNT)
            self.assertEqual(list(index["seed"]), [3_000_000, 3_000_001, 3_000_002])
            for i in range(COUNT):
                linked = index[f"reamings/{i:06}"]
                self.assertEqual(json.loads(linked.attrs["score"])["points"], index["points"][i])
                self.assertEqual(json.loads(linked.attrs["metrics"])["depth_error_mm"], index["depth_error_mm"][i])
        sheet = (self.made / "DATASHEET.md").read_text()
        self.assertIn(f"{COUNT} simulated reamings of case `demo`", sheet)
        self.assertNotIn("{", sheet)

    def test_keeps_apart_what_is_of_other_settings(self) -> None:
        before = contents(self.made)
        with self.assertRaisesRegex(ream.Error, "seed 3, not 4"):
            make_dataset(self.made, COUNT, SMALL._replace(seed=4))
        other = self.folder / "occupied"
        other.mkdir()
        (other / "thesis.txt").write_text("mine")
        with self.assertRaisesRegex(ream.Error, "something else"):
            make_dataset(other, 1, SMALL)
        (other / "dataset.json").write_text("[")
        with self.assertRaisesRegex(ream.Error, "cannot be read"):
            make_dataset(other, 1, SMALL)
        self.assertEqual(contents(self.made), before)

    def test_wrong_words_get_one_line(self) -> None:
        wrong = [
            ["--count", "0"],
            ["--task", "juggle"],
            ["--controller", "nobody"],
            ["--picture-size", "big"],
            ["--picture-size", "0x10"],
            ["--picture-s", "-1"],
            ["--picture-s", "inf"],
            ["--max-time-s", "0"],
            ["--max-time-s", "nan"],
            ["--picture-s", "0.005"],
            ["--case", "nowhere"],
        ]
        for words in wrong:
            with self.subTest(words=words):
                folder = self.folder / "wrong"
                told = subprocess.run(
                    [sys.executable, "-m", "ream.dataset", str(folder), *words], capture_output=True, text=True
                )
                self.assertEqual(told.returncode, 1)
                self.assertTrue(told.stderr.startswith("ream.dataset: "), told.stderr)
                self.assertEqual(told.stderr.count("\n"), 1, told.stderr)
                self.assertFalse(folder.exists() and os.listdir(folder), words)


if __name__ == "__main__":
    unittest.main()
