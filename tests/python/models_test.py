import math
import subprocess
import sys
import threading
import unittest

import numpy as np
import ream
from places import DataFolder
from ream.environments import PushToDepth
from ream.models import EngagedBone
from simulation_test import press, same

SCRIPT = {"device": "hand", "duration_s": 9, "vibration": {"source": "off"}, "hand": {"start_mm": [0, 0, -1], "force_profile": [
    {"t_s": 0, "force_n": 30}, {"t_s": 0.3, "force_n": 60}]}}

ENDS_EARLY = """
import threading, time, ream
class Model:
    def load(self, bone, thrust_n):
        time.sleep(0.0005)
        return 1000.0
def ream_on():
    simulation = ream.Simulation("demo", feed_model=Model())
    while True:
        simulation.reset()
        simulation.run_script()
threads = [threading.Thread(target=ream_on, daemon=True) for _ in range(2)]
for thread in threads: thread.start()
for thread in threads: thread.join(1.5)
"""


class Constant:
    def __init__(self, *load: float) -> None:
        self.given = load
        self.seen: list[tuple[EngagedBone, float]] = []

    def load(self, bone: EngagedBone, thrust_n: float) -> object:
        self.seen.append((bone, thrust_n))
        return self.given


class Wrong:
    """Right at first."""

    def __init__(self, after: int, what: object) -> None:
        self.left, self.what = after, what

    def load(self, bone: EngagedBone, thrust_n: float) -> object:
        self.left -= 1
        if self.left >= 0:
            return 500.0
        if isinstance(self.what, Exception):
            raise self.what
        return self.what


class ModelsTest(DataFolder):
    def reamed(self, model: object, ticks: int = 3000) -> tuple[ream.Simulation, np.ndarray]:
        simulation = ream.Simulation("demo", script=SCRIPT, feed_model=model)
        return simulation, simulation.run_script(ticks)

    def test_bone_resists_as_the_model_says(self) -> None:
        for resistance in (300.0, 1500.0):
            model = Constant(resistance, 4.0)
            simulation, ticks = self.reamed(model)
            cutting = ticks[2000:]
            cutting = cutting[(cutting["flags"] & ream.Flag.CUTTING) != 0]
            self.assertGreater(len(cutting), 500)
            ratio = cutting["thrust_n"] / cutting["feed_rate_mm_s"]
            self.assertAlmostEqual(float(np.median(ratio)) / resistance, 1.0, delta=0.04)
            arm = cutting["spindle_torque_n_mm"] / cutting["thrust_n"]
            self.assertAlmostEqual(float(np.median(arm)), 4.0, delta=0.1)
            bone, thrust_n = model.seen[-1]
            self.assertIsInstance(bone, EngagedBone)
            self.assertAlmostEqual(sum(bone.share), 1.0)
            self.assertAlmostEqual(bone.mean_density_g_cc, float(ticks[-1]["density_g_cc"]), places=5)
            self.assertAlmostEqual(thrust_n, float(ticks[-2]["thrust_n"]), places=3)
            self.assertTrue(bone.area_mm2 > 0 and bone.edge_mm > 0)

    def test_half_the_resistance_is_twice_the_depth(self) -> None:
        depths = []
        for resistance in (800.0, 400.0):
            simulation, ticks = self.reamed((lambda r: type("Model", (), {"load": lambda *_: r})())(resistance))
            z = simulation.plan_from_tool(ticks)[:, 2, 3]
            depths.append(z[2999] - z[1500])
        self.assertAlmostEqual(depths[1] / depths[0], 2.0, delta=0.05)

    def test_reset_and_restore_give_the_same_bits(self) -> None:
        simulation, ticks = self.reamed(Constant(900.0))
        simulation.reset()
        self.assertTrue(same(simulation.run_script(3000), ticks))
        simulation.reset()
        simulation.run(press(300))
        snapshot = simulation.snapshot()
        first = simulation.run(press(600)[300:])
        simulation.restore(snapshot)
        self.assertTrue(same(simulation.run(press(600)[300:]), first))

    def test_what_a_model_raises_comes_out(self) -> None:
        simulation = ream.Simulation("demo", script=SCRIPT, feed_model=Wrong(20, ZeroDivisionError("by my law")))
        with self.assertRaisesRegex(ZeroDivisionError, "by my law"):
            simulation.run_script()
        self.assertGreater(simulation.tick, 20)
        with self.assertRaises(ream.Error) as raised:
            simulation.run_script()
        self.assertEqual(raised.exception.kind, "conflict")
        simulation.reset()
        self.assertEqual(len(simulation.run_script(10)), 10)

    def test_what_a_model_raises_comes_out_while_the_spindle_stands(self) -> None:
        simulation = ream.Simulation("demo", script=SCRIPT, feed_model=Wrong(3, ValueError("by my law")))
        with self.assertRaisesRegex(ValueError, "by my law"):
            simulation.run(press(600), 0.0)
        self.assertLess(simulation.tick, 599)
        simulation.reset()
        simulation.run(press(30), 0.0)

    def test_what_is_no_load_is_refused(self) -> None:
        for wrong in (math.nan, 0.0, -3.0, math.inf, (), (1.0, 2.0, 3.0, 4.0), (500.0, -1.0), (500.0, 1.0, math.nan)):
            with self.subTest(wrong=wrong), self.assertRaisesRegex(ream.Error, "feed model"):
                self.reamed(Wrong(5, wrong))
        for wrong in ("soft", None, (500.0, "arm")):
            with self.subTest(wrong=wrong), self.assertRaises(TypeError):
                self.reamed(Wrong(5, wrong))
        with self.assertRaises(AttributeError):
            ream.Simulation("demo", feed_model=object())
        with self.assertRaises(ream.Error):
            ream.Simulation("demo", feed_model=type("Model", (), {"load": 3})())
        with self.assertRaises(ream.Error):
            ream.Simulation("demo", feed_model="soft")

    def test_is_not_saved_as_if_it_were_the_programs(self) -> None:
        simulation, _ = self.reamed(Constant(900.0), 500)
        with self.assertRaisesRegex(ream.Error, "of your own"):
            simulation.save(self.folder / "own")
        self.assertFalse((self.folder / "own").exists())

    def test_threads_have_models_of_their_own(self) -> None:
        expected = {resistance: self.reamed(Constant(resistance), 1500)[1] for resistance in (600.0, 1200.0)}
        found: dict[float, np.ndarray] = {}

        def work(resistance: float) -> None:
            found[resistance] = self.reamed(Constant(resistance), 1500)[1]

        threads = [threading.Thread(target=work, args=(resistance,)) for resistance in expected]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join(60)
        for resistance, ticks in expected.items():
            self.assertTrue(same(found[resistance], ticks))

    def test_python_may_end_meanwhile(self) -> None:
        for _ in range(3):
            ended = subprocess.run([sys.executable, "-c", ENDS_EARLY], timeout=60, capture_output=True, text=True)
            self.assertEqual((ended.returncode, ended.stderr), (0, ""))

    def test_a_device_moves_the_handle(self) -> None:
        class Hand:
            def __init__(self) -> None:
                self.poses = list(press(500))
                self.felt: list[float] = []

            def read(self) -> tuple[np.ndarray, float] | None:
                return (self.poses.pop(0), 0.8) if self.poses else None

            def write(self, tick: np.void) -> None:
                self.felt.append(float(tick["thrust_n"]))

        simulation = ream.Simulation("demo", script=SCRIPT)
        hand = Hand()
        part = simulation.run_device(hand, 100)
        rest = simulation.run_device(hand)
        simulation.reset()
        ticks = simulation.run(press(500), 0.8)
        self.assertTrue(same(np.concatenate([part, rest]), ticks))
        self.assertEqual(hand.felt, list(ticks["thrust_n"]))

    def test_a_task_is_judged_by_a_function(self) -> None:
        task = PushToDepth("demo", max_time_s=0.04, rubric=lambda metrics: 10.0 + metrics["removed_volume_mm3"])
        task.reset(seed=1)
        task.step([0, 0])
        _, reward, _, truncated, info = task.step([0, 0])
        self.assertTrue(truncated)
        self.assertEqual(info["score"]["points"], 10.0)
        self.assertLess(reward, 0.1)


if __name__ == "__main__":
    unittest.main()
