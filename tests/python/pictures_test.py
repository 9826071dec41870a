import math
import unittest

import numpy as np
import ream
from places import SHORT_SCRIPT, DataFolder

WIDTH, HEIGHT, VIEW_RAD = 64, 48, 0.6
EYE = np.array([15.0, 20.0, -80.0])


def ray_through(column: int, row: int) -> tuple[np.ndarray, np.ndarray]:
    """The ray of a pixel in the plan frame, and where the camera looks: written anew for the tests."""
    forward = -EYE / np.linalg.norm(EYE)
    right = np.cross(forward, [0.0, 1.0, 0.0])
    right /= np.linalg.norm(right)
    up = np.cross(right, forward)
    edge = math.tan(VIEW_RAD / 2)
    x = (2 * (column + 0.5) / WIDTH - 1) * edge * WIDTH / HEIGHT
    y = (1 - 2 * (row + 0.5) / HEIGHT) * edge
    ray = forward + x * right + y * up
    return ray / np.linalg.norm(ray), forward


def nearest_mm(origin: np.ndarray, ray: np.ndarray, corners: np.ndarray) -> float:
    """To the first of the triangles (n, 3, 3), after Moeller and Trumbore; infinite without one."""
    first, second = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    across = np.cross(ray, second)
    determinant = np.einsum("ij,ij->i", first, across)
    with np.errstate(divide="ignore", invalid="ignore"):
        from_corner = origin - corners[:, 0]
        u = np.einsum("ij,ij->i", from_corner, across) / determinant
        turned = np.cross(from_corner, first)
        v = turned @ ray / determinant
        away = np.einsum("ij,ij->i", second, turned) / determinant
    hit = (u >= 0) & (v >= 0) & (u + v <= 1) & (away > 0)
    return float(away[hit].min()) if hit.any() else math.inf


class PicturesTest(DataFolder):
    @classmethod
    def setUpClass(cls) -> None:
        super().setUpClass()
        cls.simulation = ream.Simulation("demo", script=SHORT_SCRIPT)
        cls.untouched = cls.picture()
        cls.start = cls.simulation.coverage.copy()
        cls.simulation.run_script()
        cls.reamed = cls.picture()
        cls.bare = cls.picture(reamer=False)

    @classmethod
    def picture(cls, **options: object) -> ream.Picture:
        return cls.simulation.picture(
            WIDTH, HEIGHT, eye_mm=EYE, up=(0, 1, 0), field_of_view_rad=VIEW_RAD, **options
        )

    def corners(self) -> np.ndarray:
        vertices, triangles = self.simulation.surface()
        plan_from_world = np.linalg.inv(self.simulation.world_from_plan)
        return (vertices @ plan_from_world[:3, :3].T + plan_from_world[:3, 3])[triangles].astype(float)

    def test_depth_is_that_of_the_surface(self) -> None:
        corners = self.corners()
        compared, missed = [], 0
        for row in range(1, HEIGHT, 6):
            for column in range(1, WIDTH, 6):
                ray, forward = ray_through(column, row)
                expected = nearest_mm(EYE, ray, corners) * (ray @ forward)
                found = float(self.bare.depth_mm[row, column])
                if math.isinf(expected) or math.isinf(found):
                    missed += math.isinf(expected) != math.isinf(found)
                else:
                    compared.append(abs(found - expected))
        self.assertGreater(len(compared), 15)
        self.assertLessEqual(missed, 2)  # at an outline
        self.assertLess(np.median(compared), 0.02)
        self.assertLess(np.quantile(compared, 0.9), 0.1)

    def test_a_reamer_hides_what_is_behind_it(self) -> None:
        reamer = self.reamed.labels == ream.Label.REAMER
        self.assertGreater(reamer.mean(), 0.05)
        self.assertFalse((self.bare.labels == ream.Label.REAMER).any())
        self.assertTrue((self.reamed.depth_mm[reamer] < self.bare.depth_mm[reamer]).all())
        for name in ("rgb", "depth_mm", "labels", "cut"):
            self.assertTrue(np.array_equal(getattr(self.reamed, name)[~reamer], getattr(self.bare, name)[~reamer]))

    def test_only_bone_that_is_gone_was_cut(self) -> None:
        self.assertFalse(self.untouched.cut.any())
        self.assertGreater(self.bare.cut.sum(), 10)
        changed = self.bare.depth_mm > self.untouched.depth_mm + 0.2
        self.assertGreater(changed.sum(), 10)
        self.assertGreater(self.bare.cut[changed].mean(), 0.9)
        far = self.bare.depth_mm == self.untouched.depth_mm
        self.assertFalse(self.bare.cut[far].any())

    def test_labels_are_the_densities(self) -> None:
        coverage, density = ream.volume(self.simulation.coverage), ream.volume(self.simulation.density)
        grid_from_plan = np.linalg.inv(self.simulation.world_from_grid) @ self.simulation.world_from_plan
        seen = {label: 0 for label in ream.Label}
        wrong = 0
        for row in range(HEIGHT):
            for column in range(WIDTH):
                label = ream.Label(self.bare.labels[row, column])
                seen[label] += 1
                if label == ream.Label.NOTHING:
                    self.assertTrue(math.isinf(self.bare.depth_mm[row, column]))
                    continue
                ray, forward = ray_through(column, row)
                point = EYE + ray * (self.bare.depth_mm[row, column] / (ray @ forward))
                x, y, z = (grid_from_plan[:3, :3] @ point + grid_from_plan[:3, 3]) / self.simulation.spacing_mm
                near = tuple(slice(max(int(at) - 1, 0), int(at) + 2) for at in (z, y, x))
                codes = density[near][coverage[near] > 0]
                kinds = {3 if code == 255 else 2 if code >= 107 else 1 for code in codes}
                wrong += int(label) not in kinds
        self.assertGreater(seen[ream.Label.CARTILAGE] + seen[ream.Label.CORTICAL], 100)
        self.assertEqual(wrong, 0)

    def test_there_is_no_reamer_before_the_first_step(self) -> None:
        self.assertFalse((self.untouched.labels == ream.Label.REAMER).any())

    def test_the_usual_camera_sees_the_glenoid(self) -> None:
        picture = self.simulation.picture(reamer=False)
        self.assertEqual(picture.rgb.shape, (240, 320, 3))
        self.assertEqual(picture.depth_mm.dtype, np.float32)
        self.assertEqual(picture.cut.dtype, np.bool_)
        middle = picture.depth_mm[110:130, 150:170]
        self.assertTrue(np.isfinite(middle).all())
        self.assertLess(abs(np.median(middle) - 105.0), 15.0)
        self.assertTrue(all(np.array_equal(a, b) for a, b in zip(picture, self.simulation.picture(reamer=False))))

    def test_cameras_that_cannot_be_are_refused(self) -> None:
        wrong = [
            {"width": 0},
            {"height": 5000},
            {"eye_mm": (0, 0, 0)},
            {"eye_mm": (0, math.nan, 0)},
            {"eye_mm": (0, 0, -50), "field_of_view_rad": 0.0},
            {"eye_mm": (0, 0, -50), "field_of_view_rad": 4.0},
            {"eye_mm": (0, 0, -50), "target_mm": (math.inf, 0, 0)},
        ]
        for options in wrong:
            with self.subTest(**options), self.assertRaises(ream.Error):
                self.simulation.picture(**options)

    def test_from_within_bone_and_along_an_axis(self) -> None:
        for eye in ((0.0, 0.0, 5.0), (0.0, 0.0, -60.0)):
            picture = self.simulation.picture(32, 24, eye_mm=eye, target_mm=(0, 0, 30))
            self.assertTrue(np.isfinite(picture.depth_mm[12, 16]))


if __name__ == "__main__":
    unittest.main()
