import json
import math
import os
import pathlib
import subprocess
import sys
import unittest

import numpy as np
import ream
from places import DataFolder
from ream._gymnasium import Box
from ream.controllers import Random, Reference, Varied, find_controller, run_episode
from ream.environments import OBSERVED, TASKS, FreeHand, PushToDepth

EPISODE = """
import json, sys
from ream.controllers import Varied, run_episode
from ream.environments import TASKS
environment = TASKS[sys.argv[1]]("demo", max_time_s=4)
run_episode(environment, Varied, 4)
episode = run_episode(environment, Varied, 3)
print(json.dumps([environment.simulation.session_hash, environment.simulation.grid_hash, episode["return"]]))
"""


class EnvironmentsTest(DataFolder):
    @classmethod
    def setUpClass(cls) -> None:
        super().setUpClass()
        cls.tasks = {name: task("demo") for name, task in TASKS.items()}
        cls.push, cls.free = cls.tasks["push-to-depth"], cls.tasks["free-hand"]

    def seen(self, observation: np.ndarray, name: str) -> float:
        return float(observation[OBSERVED.index(name)])

    def test_is_what_gymnasium_asks_for(self) -> None:
        for name, environment in self.tasks.items():
            with self.subTest(name):
                reply = environment.reset(seed=5)
                self.assertIsInstance(reply, tuple)
                observation, info = reply
                self.assertTrue(environment.observation_space.contains(observation))
                self.assertEqual(observation.dtype, np.float32)
                self.assertIsInstance(info, dict)
                action = environment.action_space.sample()
                self.assertTrue(environment.action_space.contains(action))
                observation, reward, terminated, truncated, info = environment.step(action)
                self.assertTrue(environment.observation_space.contains(observation))
                self.assertIs(type(reward), float)
                self.assertIs(type(terminated), bool)
                self.assertIs(type(truncated), bool)
                self.assertIsInstance(info, dict)
                self.assertEqual(environment.simulation.tick, 21)
                self.assertIs(environment.unwrapped, environment)
                self.assertIsNone(environment.render())
                environment.close()

    def test_renders_when_it_is_made_for_it(self) -> None:
        environment = PushToDepth("demo", render_mode="rgb_array")
        environment.reset(seed=1)
        self.assertEqual(environment.render().shape, (240, 320, 3))
        with self.assertRaises(ream.Error):
            PushToDepth("demo", render_mode="human")

    def test_is_an_environment_of_gymnasium_where_that_is_installed(self) -> None:
        fakes = pathlib.Path(__file__).parent / "fakes"
        told = subprocess.run(
            [sys.executable, "-c", "import ream.environments as e, gymnasium as g, json;"
             "print(json.dumps([g.registered, issubclass(e.FreeHand, g.Env), e.Box is g.spaces.Box]))"],
            env={**os.environ, "PYTHONPATH": f"{fakes}:{os.environ['PYTHONPATH']}"},
            check=True, capture_output=True, text=True,
        )
        registered, inherits, spaces = json.loads(told.stdout)
        self.assertEqual(set(registered), {"ream/PushToDepth-v0", "ream/FreeHand-v0"})
        for entry_point in registered.values():
            module, _, name = entry_point.partition(":")
            self.assertTrue(hasattr(sys.modules[module], name), entry_point)
        self.assertTrue(inherits)
        self.assertTrue(spaces)

    def test_a_seed_is_an_episode(self) -> None:
        for environment in self.tasks.values():
            runs = []
            for seed in (7, 8, 7):
                first, _ = environment.reset(seed=seed)
                observations = [first]
                for _ in range(20):
                    observations.append(environment.step(environment.action_space.high)[0])
                runs.append(np.stack(observations))
            self.assertTrue(np.array_equal(runs[0], runs[2]))
            self.assertFalse(np.array_equal(runs[0], runs[1]))
            self.assertFalse(np.array_equal(environment.reset()[0], environment.reset()[0]))

    def test_other_processes_get_the_same_bits(self) -> None:
        for name, environment in self.tasks.items():
            told = subprocess.run([sys.executable, "-c", EPISODE, name], check=True, capture_output=True, text=True)
            shorter = type(environment)("demo", max_time_s=4)
            episode = run_episode(shorter, Varied, 3)
            simulation = shorter.simulation
            mine = [simulation.session_hash, simulation.grid_hash, episode["return"]]
            self.assertEqual(json.loads(told.stdout), mine)

    def test_begins_where_it_is_asked_to(self) -> None:
        asked = {"x_mm": 1.5, "y_mm": -0.5, "tilt_x_rad": 0.05, "tilt_y_rad": -0.03, "height_mm": 9.0}
        observation, _ = self.free.reset(seed=1, options=asked)
        self.assertAlmostEqual(self.seen(observation, "depth_mm"), -9.0, delta=0.01)
        for name in ("x_mm", "y_mm", "tilt_x_rad", "tilt_y_rad"):
            self.assertAlmostEqual(self.seen(observation, name), asked[name], delta=0.002)
        with self.assertRaisesRegex(ream.Error, "height_mm"):
            self.free.reset(options={"high": 1})

    def test_begins_further_away_where_there_is_bone(self) -> None:
        observation, _ = self.push.reset(seed=1, options={"height_mm": -4.0})
        self.assertLess(self.seen(observation, "depth_mm"), 0.0)
        self.assertEqual(self.seen(observation, "engaged"), 0.0)

    def test_the_hand_moves_as_it_is_told(self) -> None:
        self.free.reset(seed=1, options={"x_mm": 0, "y_mm": 0, "tilt_x_rad": 0, "tilt_y_rad": 0, "height_mm": 20})
        for _ in range(25):
            observation = self.free.step(np.array([0, 1, -0.5, 0.2, -0.4, 0], np.float32))[0]
        for name, expected in (("x_mm", 5.0), ("y_mm", -2.5), ("tilt_x_rad", 0.05), ("tilt_y_rad", -0.1)):
            self.assertAlmostEqual(self.seen(observation, name), expected, delta=0.1 if "mm" in name else 0.01)
        self.assertAlmostEqual(self.seen(observation, "depth_mm"), -20.0, delta=1.0)

    def test_pushes_with_the_force_it_is_told(self) -> None:
        self.push.reset(seed=2, options={"x_mm": 0, "y_mm": 0, "tilt_x_rad": 0, "tilt_y_rad": 0})
        thrusts = []
        for _ in range(80):
            observation = self.push.step(np.array([0.4, 0.0], np.float32))[0]
            if self.seen(observation, "engaged"):
                thrusts.append(self.seen(observation, "thrust_n"))
        self.assertGreater(len(thrusts), 30)
        self.assertAlmostEqual(float(np.mean(thrusts[10:])), 40.0, delta=4.0)

    def test_reference_controllers_pass_and_chance_does_not(self) -> None:
        for name, environment in self.tasks.items():
            episode = run_episode(environment, Reference, 11)
            chance = [run_episode(environment, Random, seed)["score"] for seed in (1, 3)]
            points = episode["score"]["points"]
            with self.subTest(name):
                self.assertEqual(episode["score"]["outcome"], "pass")
                self.assertGreater(episode["return"], points / 100)
                self.assertGreater(points, 80.0)
                self.assertGreater(points, max(score["points"] or 0.0 for score in chance))
                self.assertNotIn("pass", [score["outcome"] for score in chance])

    def test_rewards_add_up(self) -> None:
        environment = FreeHand("demo", max_time_s=3)
        environment.reset(seed=11)
        at_first = environment.closeness()
        episode = run_episode(environment, Varied, 11)
        # Time was up: there are no points.
        self.assertAlmostEqual(episode["return"], environment.closeness() - at_first, places=9)
        self.assertEqual(episode["metrics"], environment.simulation.metrics())

    def test_coming_nearer_is_rewarded_from_everywhere(self) -> None:
        for seed in range(8):
            observation, _ = self.free.reset(seed=seed)
            x_mm = self.seen(observation, "x_mm")
            action = np.array([0, -np.sign(x_mm), 0, 0, 0, 0], np.float32)
            gained = sum(self.free.step(action)[1] for _ in range(min(4, int(abs(x_mm) / 0.2))))
            self.assertGreaterEqual(gained, 0.0)
            self.assertTrue(abs(x_mm) < 0.5 or gained > 0.001, (seed, x_mm, gained))

    def test_a_start_that_cannot_be_is_refused(self) -> None:
        for options in ({"x_mm": math.nan}, {"height_mm": 5000}, {"tilt_x_rad": math.inf}):
            with self.assertRaisesRegex(ream.Error, next(iter(options))):
                self.push.reset(seed=1, options=options)
            with self.assertRaisesRegex(ream.Error, "reset"):
                self.push.step(np.zeros(2, np.float32))

    def test_ends_where_it_is_too_deep(self) -> None:
        observation, _ = self.push.reset(seed=1)
        ended = False
        while not ended:
            observation, _, terminated, truncated, info = self.push.step(np.array([1, 1], np.float32))
            ended = terminated or truncated
        self.assertIs(terminated, True)
        self.assertGreater(self.seen(observation, "depth_mm"), self.push.planned_depth_mm + 3.0)
        self.assertEqual(info["score"]["outcome"], "fail")
        with self.assertRaisesRegex(ream.Error, "reset"):
            self.push.step(np.array([0, 0], np.float32))

    def test_ends_when_its_time_is_up(self) -> None:
        environment = PushToDepth("demo", max_time_s=0.1)
        environment.reset(seed=1)
        ends = [environment.step(np.array([0, 0], np.float32))[2:4] for _ in range(5)]
        self.assertEqual(ends, [(False, False)] * 4 + [(False, True)])

    def test_what_is_no_action_is_refused(self) -> None:
        self.free.reset(seed=1)
        for wrong in ([0.0], np.zeros(5), np.full(6, math.nan), "push"):
            with self.assertRaises((ream.Error, ValueError)):
                self.free.step(wrong)
        # More than all is all.
        self.free.step(np.full(6, 7.0))

    def test_controllers_have_names(self) -> None:
        self.assertIs(find_controller("varied"), Varied)
        self.assertIs(find_controller("ream.controllers:Random"), Random)
        for wrong in ("nobody", "ream.controllers:Nobody", "no_such_module:Name"):
            with self.assertRaises(ream.Error):
                find_controller(wrong)

    def test_the_command_prints_a_table(self) -> None:
        words = ["-m", "ream.controllers", "--task", "push-to-depth", "--episodes", "2"]
        told = subprocess.run([sys.executable, *words], check=True, capture_output=True, text=True)
        self.assertIn("points: mean", told.stdout)
        self.assertEqual(told.stdout.count(" pass "), 2)
        wrong = subprocess.run([sys.executable, "-m", "ream.controllers", "--case", "nowhere"], capture_output=True, text=True)
        self.assertEqual(wrong.returncode, 1)
        self.assertEqual(wrong.stderr.count("\n"), 1)


class SpacesTest(unittest.TestCase):
    def test_a_box_has_bounds(self) -> None:
        box = Box(-1.0, 1.0, (3,), np.float32)
        box.seed(1)
        first = box.sample()
        self.assertTrue(box.contains(first))
        self.assertFalse(box.contains(np.full(3, 2.0, np.float32)))
        self.assertFalse(box.contains(np.zeros(2, np.float32)))
        self.assertFalse(box.contains([0.0, 0.0, 0.0]))
        box.seed(1)
        self.assertTrue(np.array_equal(first, box.sample()))


if __name__ == "__main__":
    unittest.main()
