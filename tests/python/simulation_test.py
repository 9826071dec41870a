import ctypes
import json
import os
import pathlib
import signal
import subprocess
import sys
import threading
import unittest

import numpy as np
import ream
from places import SHORT_SCRIPT, DataFolder


ADMITTANCE = {"device": "hand", "duration_s": 1, "device_profile": "hapticmaster", "hand": SHORT_SCRIPT["hand"]}


def same(a: np.ndarray, b: np.ndarray) -> bool:
    """Field by field: what lies between the fields of a row is nothing."""
    if a.dtype.names is None:
        return np.array_equal(a, b)
    return a.shape == b.shape and all(same(a[name], b[name]) for name in a.dtype.names)


def press(ticks: int) -> np.ndarray:
    """Down along the plan's axis, 20 mm/s, to a millimetre within the bone."""
    z = np.minimum(-2.0 + 0.02 * np.arange(ticks), 1.0)
    return np.stack([np.zeros(ticks), np.zeros(ticks), z], axis=1)


class SimulationTest(DataFolder):
    @classmethod
    def setUpClass(cls) -> None:
        super().setUpClass()
        cls.simulation = ream.Simulation("demo", script=SHORT_SCRIPT)

    def setUp(self) -> None:
        self.simulation.reset()

    def test_computes_what_the_program_computes(self) -> None:
        folder = self.simulated()
        recorded = ream.open(folder).ticks()
        ticks = self.simulation.run_script()
        self.assertGreater(len(ticks), 2500)
        self.assertGreater(ticks["changed_bricks"].sum(), 100)
        self.assertTrue(same(ticks, recorded))
        metrics = json.loads((folder / "metrics.json").read_text())
        self.assertEqual(self.simulation.metrics(), metrics)
        self.assertEqual(self.simulation.grid_hash, metrics["grid_hash"])
        self.assertEqual(self.simulation.session_hash, metrics["session_hash"])
        self.assertEqual(int(self.simulation.session_hash, 16), int(ticks[-1]["session_hash"]))

    def test_steps_and_runs_are_the_same(self) -> None:
        poses = press(600)
        run = self.simulation.run(poses)
        self.assertGreater(run["removed_cortical"].sum() + run["removed_cartilage"].sum(), 0)
        self.simulation.reset()
        steps = np.array([self.simulation.step(pose) for pose in poses], dtype=ream.TICK)
        self.assertTrue(same(run, steps))

    def test_what_is_saved_is_what_was_stepped(self) -> None:
        self.simulation.run(press(300))
        snapshot = self.simulation.snapshot()
        self.simulation.run(press(1200)[300:600], 0.5, irrigating=True)
        self.simulation.restore(snapshot)
        ticks = [self.simulation.run(press(300)), self.simulation.run(press(1500)[300:], 0.8)]
        self.simulation.restore(snapshot)
        self.assertEqual(self.simulation.tick, 300)
        ticks = self.simulation.run(press(2600)[300:], 0.7)
        out = self.folder / "saved"
        self.simulation.save(out)
        recording = ream.open(out)
        self.assertEqual(len(recording), 2600)
        self.assertTrue(same(recording.ticks(300), ticks))
        self.assertTrue(recording.verify()["same"])
        metrics = json.loads((out / "metrics.json").read_text())
        self.assertEqual(metrics, self.simulation.metrics())
        self.assertGreater(metrics["removed_volume_mm3"], 1.0)
        score = json.loads((out / "score.json").read_text())
        self.assertEqual(score["score"]["points"], self.simulation.score()["points"])
        self.assertTrue((out / "trace.csv").exists())
        self.assertEqual(self.simulation.tick, 2600)
        with self.assertRaises(ream.Error):
            self.simulation.save(out)
        self.simulation.reset()
        with self.assertRaises(ream.Error) as raised:
            self.simulation.save(self.folder / "nothing")
        self.assertEqual(raised.exception.kind, "conflict")
        self.assertFalse((self.folder / "nothing").exists())

    def test_a_saved_script_is_the_programs_own(self) -> None:
        folder = self.simulated()
        self.simulation.run_script()
        out = self.folder / "saved-script"
        self.simulation.save(out, pictures=True)
        self.assertTrue(same(ream.open(out).ticks(), ream.open(folder).ticks()))
        self.assertEqual((out / "trace.csv").read_bytes(), (folder / "trace.csv").read_bytes())
        self.assertTrue((out / "snapshot.png").exists() and (out / "reamed.ply").exists())

    def test_is_scored_by_rubrics(self) -> None:
        self.simulation.run_script()
        score = self.simulation.score()
        self.assertIn(score["outcome"], ("pass", "fail", "undecided"))
        rubric = self.folder / "own.json"
        rubric.write_text(json.dumps({"name": "Own", "version": 1, "criteria": [
            {"metric": "removed_volume_mm3", "curve": [{"at": 0, "points": 0}, {"at": 1000, "points": 100}]}]}))
        own = self.simulation.score(rubric)
        expected = self.simulation.metrics()["removed_volume_mm3"] / 10
        self.assertAlmostEqual(own["points"], expected, delta=0.1)
        with self.assertRaises(ream.Error) as raised:
            self.simulation.score("nobody")
        self.assertEqual(raised.exception.kind, "not_found")

    def test_reset_begins_again(self) -> None:
        coverage = self.simulation.coverage.copy()
        first = self.simulation.run(press(400))
        self.assertFalse(np.array_equal(coverage, self.simulation.coverage))
        self.simulation.reset()
        self.assertEqual(self.simulation.tick, 0)
        self.assertTrue(np.array_equal(coverage, self.simulation.coverage))
        self.assertTrue(same(first, self.simulation.run(press(400))))

    def test_a_snapshot_goes_on_as_it_did(self) -> None:
        poses = press(900)
        self.simulation.run(poses[:450])
        snapshot = self.simulation.snapshot()
        self.assertEqual(snapshot.tick, 450)
        first = self.simulation.run(poses[450:])
        metrics = self.simulation.metrics()
        for _ in range(2):
            self.simulation.restore(snapshot)
            self.assertEqual(self.simulation.tick, 450)
            self.assertTrue(same(first, self.simulation.run(poses[450:])))
            self.assertEqual(self.simulation.metrics(), metrics)

    def test_a_snapshot_holds_what_is_not_bone(self) -> None:
        """Vibration, warm bone, a mount that gives way and a drive at speed go on, too."""
        script = {
            **SHORT_SCRIPT,
            "vibration": {"source": "synthesized"},
            "mount": {
                "stiffness_n_mm": [30, 30, 30],
                "damping_n_s_mm": [0.1, 0.1, 0.1],
                "angular_stiffness_n_mm_rad": [20000, 20000, 20000],
                "angular_damping_n_mm_s_rad": [100, 100, 100],
            },
        }
        simulation = ream.Simulation("demo", script=script)
        poses = press(700)
        simulation.run(poses[:350])
        snapshot = simulation.snapshot()
        first = simulation.run(poses[350:])
        self.assertGreater(np.abs(first["vibration_g"]).max(), 0)
        self.assertGreater(first["surface_temperature_c"].max(), 35.5)
        self.assertGreater(np.abs(ream.matrices(first["world_from_bone_rest"])[:, :3, 3]).max(), 1e-3)
        simulation.restore(snapshot)
        self.assertTrue(same(first, simulation.run(poses[350:])))

    def test_a_snapshot_of_another_simulation_is_refused(self) -> None:
        other = ream.Simulation("demo", script=SHORT_SCRIPT)
        with self.assertRaises(ream.Error) as raised:
            other.restore(self.simulation.snapshot())
        self.assertEqual(raised.exception.kind, "conflict")

    def test_coverage_is_seen_without_a_copy(self) -> None:
        view = self.simulation.coverage
        self.assertTrue(np.shares_memory(view, self.simulation.coverage))
        self.assertFalse(view.flags.writeable)
        before = int(view.astype(np.int64).sum())
        ticks = self.simulation.run(press(500))
        removed = sum(int(ticks[f"removed_{kind}"].sum()) for kind in ("cancellous", "cortical", "cartilage"))
        self.assertGreater(removed, 0)
        self.assertEqual(before - int(view.astype(np.int64).sum()), removed)
        self.assertEqual(view.shape, self.simulation.density.shape)

    def test_a_view_outlives_its_simulation(self) -> None:
        view = ream.Simulation("demo", script=SHORT_SCRIPT).coverage
        self.assertTrue(np.array_equal(view, self.simulation.coverage))

    def test_volume_has_the_voxels_where_they_are(self) -> None:
        volume = ream.volume(self.simulation.coverage)
        spacing = np.array(self.simulation.spacing_mm)
        grid_from_plan = np.linalg.inv(self.simulation.world_from_grid) @ self.simulation.world_from_plan

        def voxel(x_mm: float, z_mm: float) -> int:
            x, y, z = ((grid_from_plan @ [x_mm, 0, z_mm, 1])[:3] / spacing).astype(int)
            return int(volume[z, y, x])

        self.assertEqual(voxel(6.0, -6.0), 0)
        self.assertEqual(voxel(6.0, 4.0), 255)
        self.assertEqual(voxel(0.0, 4.0), 0)  # the pilot hole

    def test_the_surface_lies_where_coverage_is_half(self) -> None:
        vertices, triangles = self.simulation.surface(2)
        self.assertLess(triangles.max(), len(vertices))
        plan_from_world = np.linalg.inv(self.simulation.world_from_plan)
        in_plan = vertices @ plan_from_world[:3, :3].T + plan_from_world[:3, 3]
        beside_the_hole = in_plan[np.hypot(in_plan[:, 0] - 6.0, in_plan[:, 1]) < 1.0]
        self.assertLess(np.abs(beside_the_hole[:, 2]).min(), 1.5)

    def test_where_the_tool_is(self) -> None:
        ticks = self.simulation.run(press(50))
        plan_from_tool = self.simulation.plan_from_tool(ticks)
        self.assertTrue(np.allclose(plan_from_tool[:, :3, 3], press(50), atol=1e-5))
        self.assertTrue(np.allclose(self.simulation.plan_from_tool(ticks[7]), plan_from_tool[7]))
        table = self.simulation.table(ticks)
        self.assertTrue(np.allclose(table["tool_depth_mm"], press(50)[:, 2], atol=1e-5))

    def test_the_depth_is_in_the_bone_also_where_that_moves(self) -> None:
        mount = {
            "stiffness_n_mm": [10, 10, 10],
            "damping_n_s_mm": [0.1, 0.1, 0.1],
            "angular_stiffness_n_mm_rad": [20000, 20000, 20000],
            "angular_damping_n_mm_s_rad": [100, 100, 100],
        }
        simulation = ream.Simulation("demo", script={**SHORT_SCRIPT, "mount": mount})
        ticks = simulation.run(press(600), 0.0)
        moved = np.linalg.norm(ream.matrices(ticks["world_from_bone_rest"])[:, :3, 3], axis=1)
        self.assertGreater(moved.max(), 0.3)
        depth = simulation.plan_from_tool(ticks)[:, 2, 3]
        self.assertTrue(np.allclose(simulation.table(ticks)["tool_depth_mm"], depth, atol=1e-5))
        in_the_world = np.linalg.inv(simulation.world_from_plan) @ ream.matrices(ticks["world_from_handle"])
        self.assertLess(depth[-1], in_the_world[-1, 2, 3] - 0.3)

    def test_a_turned_handle(self) -> None:
        half = np.radians(10) / 2
        tick = self.simulation.step([0, 0, -10, np.cos(half), np.sin(half), 0, 0])
        handle = ream.matrices(tick["world_from_handle"])
        axis = np.linalg.inv(self.simulation.world_from_plan)[:3, :3] @ handle[:3, 2]
        self.assertAlmostEqual(np.degrees(np.arccos(axis[2])), 10.0, places=5)

    def test_a_spindle_that_stands_cuts_nothing(self) -> None:
        ticks = self.simulation.run(press(400), 0.0)
        self.assertEqual(int(ticks["changed_bricks"].sum()), 0)
        self.assertGreater(ticks["thrust_n"].max(), 1.0)
        self.assertTrue((ticks["flags"] & ream.Flag.SPINDLE_ON == 0).all())

    def test_tells_what_was_asked_of_the_drive(self) -> None:
        asked = np.linspace(0, 1, 52)
        ticks = self.simulation.run(press(52), asked, irrigating=True, reversed=True)
        self.assertTrue(np.allclose(ream.trigger(ticks), asked, atol=0.5 / 255))
        both = ream.Flag.REVERSED | ream.Flag.IRRIGATING
        self.assertTrue((ticks["flags"] & both == both).all())

    def test_a_table_for_pandas(self) -> None:
        ticks = self.simulation.run(press(400))
        table = self.simulation.table(ticks)
        self.assertEqual(list(table["t_s"][:2]), [0.0, 0.001])
        self.assertTrue(all(column.shape == (400,) for column in table.values()))
        removed = self.simulation.metrics()["removed_volume_mm3"]
        self.assertGreater(removed, 0)
        self.assertAlmostEqual(table["removed_volume_mm3"][-1], removed, places=9)
        self.refuse("invalid_input", "TICK", lambda: self.simulation.table(np.zeros(3)))
        self.refuse("invalid_input", "TICK", lambda: self.simulation.table(5))
        self.assertEqual(len(self.simulation.table([])["t_s"]), 0)

    def test_says_what_it_is(self) -> None:
        self.assertIn("'demo'", repr(self.simulation))
        self.assertEqual(self.simulation.plan["reamer"], "ellipse 18.25,9")
        self.assertGreater(self.simulation.plan["depth_mm"], 0)
        self.assertEqual(self.simulation.stiffness_n_mm, 100.0)

    def test_the_spring_is_as_stiff_as_it_says(self) -> None:
        ticks = self.simulation.run(press(200), 0.0)
        handle = np.linalg.inv(self.simulation.world_from_plan) @ ream.matrices(ticks["world_from_handle"])
        gap = handle[-1, 2, 3] - self.simulation.plan_from_tool(ticks)[-1, 2, 3]
        self.assertGreater(gap, 0.1)
        self.assertAlmostEqual(ticks["thrust_n"][-1] / gap / self.simulation.stiffness_n_mm, 1.0, delta=0.1)

    def test_a_reamer_that_begins_in_bone_is_refused(self) -> None:
        self.refuse("invalid_input", "outside", lambda: self.simulation.step([0, 0, 5]))
        self.assertEqual(self.simulation.tick, 0)
        self.refuse("invalid_input", "outside", lambda: self.simulation.run([[0, 0, 5], [0, 0, -3]]))
        self.simulation.step([0, 0, -3])

    def test_a_snapshot_of_the_beginning_is_a_reset(self) -> None:
        beginning = self.simulation.snapshot()
        first = self.simulation.run_script(700)
        self.simulation.restore(beginning)
        self.assertTrue(same(first, self.simulation.run_script(700)))

    def test_other_libraries_do_not_change_how_numbers_are_rounded(self) -> None:
        libm = ctypes.CDLL("libm.so.6")
        upward = 0x800  # FE_UPWARD of x86-64
        turned = np.hstack([press(300), np.tile([0.99, 0.1, 0.02, 0.03], (300, 1))])
        turned[:, 2] -= 1.5  # a tilted rim touches sooner
        expected = self.simulation.run(turned)
        self.assertGreater(int(expected["changed_bricks"].sum()), 0)
        table = self.simulation.table(expected)
        self.simulation.reset()
        try:
            libm.fesetround(upward)
            ticks = self.simulation.run(turned)
            upward_table = self.simulation.table(ticks)
            self.assertEqual(libm.fegetround(), upward)
        finally:
            libm.fesetround(0)
        self.assertTrue(same(expected, ticks))
        self.assertTrue(all(np.array_equal(column, upward_table[name]) for name, column in table.items()))

    def ends_well(self, program: str, **environment: str) -> None:
        """In a Python of its own, which has to end by itself."""
        command = [sys.executable, "-c", program]
        done = subprocess.run(
            command, env={**os.environ, **environment}, capture_output=True, text=True, timeout=120
        )
        self.assertEqual((done.returncode, done.stderr), (0, ""))

    def test_threads_that_go_on_at_the_end_of_python_do_no_harm(self) -> None:
        for _ in range(8):
            self.ends_well(
                """
import threading, time, ream
simulation = ream.Simulation("demo")
def work():
    while True:
        simulation.step([0, 0, -9])
threading.Thread(target=work, daemon=True).start()
until = time.monotonic() + 0.1
while time.monotonic() < until:
    pass
"""
            )

    def test_what_is_done_at_the_end_of_python_is_done(self) -> None:
        self.ends_well(
            """
import ream
class Last:
    def __init__(self):
        self.simulation = ream.Simulation("demo")
        self.simulation.step([0, 0, -9])
    def __del__(self):
        self.simulation.reset()
last = Last()
"""
        )

    def test_ctrl_c_ends_a_run_and_keeps_what_was_done(self) -> None:
        away = np.tile([0.0, 0.0, -9.0], (300_000, 1))
        previous = signal.signal(signal.SIGALRM, signal.default_int_handler)
        try:
            with self.assertRaises(KeyboardInterrupt):
                signal.setitimer(signal.ITIMER_REAL, 0.2)
                for _ in range(100):
                    self.simulation.run(away)
        finally:
            signal.setitimer(signal.ITIMER_REAL, 0)
            signal.signal(signal.SIGALRM, previous)
        self.assertLess(0, self.simulation.tick)
        self.simulation.step([0, 0, -9])

    def test_two_threads_make_the_demo_case_together(self) -> None:
        program = """
import sys, threading, ream
made = []
threads = [threading.Thread(target=lambda: made.append(ream.Simulation("demo"))) for _ in range(2)]
[thread.start() for thread in threads]
[thread.join() for thread in threads]
sys.exit(len(made) != 2)
"""
        self.ends_well(program, REAM_DATA=str(self.folder / "made by two"))

    def refuse(self, kind: str, words: str, call) -> None:
        with self.assertRaises(ream.Error) as raised:
            call()
        self.assertEqual(raised.exception.kind, kind)
        self.assertIn(words, str(raised.exception))

    def test_what_is_refused(self) -> None:
        self.refuse("not_found", "nobody", lambda: ream.Simulation("nobody"))
        self.refuse("usage", "removal 'melt'", lambda: ream.Simulation("demo", removal="melt"))
        self.refuse("usage", "backend 'auto'", lambda: ream.Simulation("demo", backend="auto"))
        self.refuse("usage", "feed model", lambda: ream.Simulation("demo", feed_model="none"))
        self.refuse("usage", "point_spacing_mm", lambda: ream.Simulation("demo", point_spacing_mm=0))
        for scale in (-1, 0, 1e300, float("nan")):
            self.refuse("usage", "force_scale", lambda scale=scale: ream.Simulation("demo", force_scale=scale))
        self.refuse("io", "", lambda: ream.Simulation("x" * 5000))
        self.refuse("invalid_input", "seed", lambda: ream.Simulation("demo", seed=-1))
        self.refuse("invalid_input", "six", lambda: ream.Simulation("demo", reamer_axis=[1, 2]))
        self.refuse("invalid_input", "nan", lambda: ream.Simulation("demo", script={"duration_s": float("nan")}))
        self.refuse("not_found", "nowhere", lambda: ream.Simulation(pathlib.Path("/nowhere/case")))
        self.refuse("not_found", "nowhere", lambda: ream.Simulation("demo", script=pathlib.Path("/nowhere.json")))
        self.refuse("usage", "takes a force", lambda: ream.Simulation("demo", script=ADMITTANCE))
        self.refuse("invalid_input", "colour", lambda: ream.Simulation("demo", script={**SHORT_SCRIPT, "colour": 1}))
        self.refuse("invalid_input", "pose 1 ", lambda: self.simulation.run([[0, 0, -9], [0, 0, np.nan]]))
        self.refuse("invalid_input", "pose 0 ", lambda: self.simulation.step([0, 0, -9000]))
        self.refuse("invalid_input", "trigger 1 ", lambda: self.simulation.run([[0, 0, -9]] * 2, [1, 2]))
        self.refuse("invalid_input", "one for each", lambda: self.simulation.run([[0, 0, -9]] * 3, [1, 1]))
        self.refuse("invalid_input", "one pose", lambda: self.simulation.step([[0, 0, -9]] * 2))
        self.refuse("invalid_input", "negative", lambda: self.simulation.run_script(-1))
        self.refuse("invalid_input", "shape", lambda: self.simulation.run(np.zeros((2, 4))))
        self.refuse("invalid_input", "quaternion", lambda: self.simulation.step([0, 0, -9, 0, 0, 0, 0]))
        self.refuse("invalid_input", "trigger", lambda: self.simulation.step([0, 0, -9], 1.5))
        self.refuse("invalid_input", "stride", lambda: self.simulation.surface(0))
        self.assertEqual(self.simulation.tick, 0)
        self.simulation.step([0, 0, -9])
        self.refuse("conflict", "reset()", self.simulation.run_script)

    def test_threads_have_simulations_of_their_own(self) -> None:
        poses = press(400)
        expected = self.simulation.run(poses)
        results: list = [None, None]

        def work(which: int) -> None:
            results[which] = ream.Simulation("demo", script=SHORT_SCRIPT).run(poses)

        threads = [threading.Thread(target=work, args=(which,)) for which in range(2)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertTrue(all(same(expected, result) for result in results))

    def test_one_simulation_is_used_by_one_thread_at_a_time(self) -> None:
        refused = []
        begun = threading.Event()

        def disturb() -> None:
            begun.wait()
            while not refused and worker.is_alive():
                try:
                    self.simulation.step([0, 0, -9])
                except ream.Error as error:
                    refused.append(error.kind)

        def work() -> None:
            begun.set()
            for _ in range(20):
                try:
                    self.simulation.run(np.tile([0.0, 0.0, -9.0], (20000, 1)))
                except ream.Error as error:
                    refused.append(error.kind)

        worker, other = threading.Thread(target=work), threading.Thread(target=disturb)
        worker.start()
        other.start()
        other.join()
        worker.join()
        self.assertIn("conflict", refused)


if __name__ == "__main__":
    unittest.main()
