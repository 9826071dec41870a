import unittest

import numpy as np
import ream
from places import SHORT_SCRIPT, DataFolder


class RecordingTest(DataFolder):
    @classmethod
    def setUpClass(cls) -> None:
        super().setUpClass()
        cls.recording = ream.open(cls.simulated())

    def test_says_what_was_simulated(self) -> None:
        self.assertEqual(self.recording.header["case_id"], "demo")
        self.assertEqual(self.recording.header["description"]["backend"], "cpu")
        self.assertEqual(len(self.recording.header["grid"]["dims"]), 3)
        self.assertEqual([segment["reason"] for segment in self.recording.segments], ["start"])
        self.assertEqual(self.recording.end["state"], "finished")
        self.assertEqual(self.recording.end["ticks"], len(self.recording))
        self.assertEqual(self.recording.damage, "")

    def test_every_tick_is_there_and_slices_are_its_parts(self) -> None:
        ticks = self.recording.ticks()
        self.assertEqual(list(ticks["tick"]), list(range(len(self.recording))))
        self.assertTrue(np.array_equal(self.recording.ticks(700, 710)["thrust_n"], ticks["thrust_n"][700:710]))
        self.assertEqual(len(self.recording.ticks(5, 5)), 0)

    def test_agrees_with_the_trace_of_the_program(self) -> None:
        """The CSV is another way out of the program."""
        trace = np.genfromtxt(self.simulated() / "trace.csv", delimiter=",", names=True)
        ticks = self.recording.ticks()
        self.assertEqual(len(trace), len(ticks))
        for name in ("thrust_n", "torque_n_mm", "vibration_g"):
            self.assertTrue(np.allclose(trace[name], ticks[name], rtol=1e-5, atol=1e-6), name)
        table = self.recording.table()
        self.assertEqual(list(table), list(trace.dtype.names))
        for name, column in table.items():
            self.assertTrue(np.array_equal(column, trace[name]), name)
        part = self.recording.table(1500, 1600)
        for name, column in part.items():
            self.assertTrue(np.array_equal(column, trace[name][1500:1600]), name)

    def test_says_where_the_reamer_was(self) -> None:
        depth = self.recording.plan_from_tool(self.recording.ticks())[:, 2, 3]
        self.assertTrue(np.allclose(depth, self.recording.table()["tool_depth_mm"], atol=1e-5))

    def test_moments_that_are_not_there_are_refused(self) -> None:
        for call in (
            lambda: self.recording.ticks(-1),
            lambda: self.recording.ticks(10, 5),
            lambda: self.recording.coverage(-1),
            lambda: self.recording.coverage(len(self.recording) + 1),
        ):
            with self.assertRaises(ream.Error) as raised:
                call()
            self.assertEqual(raised.exception.kind, "invalid_input")

    def test_has_the_bone_of_each_moment(self) -> None:
        simulation = ream.Simulation("demo", script=SHORT_SCRIPT)
        self.assertTrue(np.array_equal(self.recording.coverage(0), simulation.coverage))
        simulation.run_script(1000)
        self.assertTrue(np.array_equal(self.recording.coverage(1000), simulation.coverage))
        simulation.run_script()
        self.assertTrue(np.array_equal(self.recording.coverage(), simulation.coverage))

    def test_is_computed_again(self) -> None:
        told = self.recording.verify()
        self.assertTrue(told["same"], told)
        self.assertEqual(told["ticks"], len(self.recording))
        self.assertEqual(int(told["session_hash"], 16), int(self.recording.ticks()[-1]["session_hash"]))

    def test_tells_what_is_damaged(self) -> None:
        whole = (self.simulated() / "recording.ream").read_bytes()
        damaged = self.folder / "damaged.ream"
        damaged.write_bytes(whole[: len(whole) * 2 // 3])
        recording = ream.open(damaged)
        self.assertNotEqual(recording.damage, "")
        self.assertIsNone(recording.end)
        ticks = recording.ticks()
        self.assertGreater(len(ticks), 0)
        self.assertTrue(np.array_equal(ticks["thrust_n"], self.recording.ticks(0, len(ticks))["thrust_n"]))

    def test_what_is_no_recording_is_refused(self) -> None:
        words = self.folder / "words.ream"
        words.write_text("no recording")
        for name, kind in ((self.folder / "nothing.ream", "not_found"), (words, "invalid_input")):
            with self.assertRaises(ream.Error) as raised:
                ream.open(name)
            self.assertEqual(raised.exception.kind, kind)


if __name__ == "__main__":
    unittest.main()
