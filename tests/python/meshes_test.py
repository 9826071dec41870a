import unittest

import numpy as np
import ream
from places import ROOT, DataFolder

#: A cube of 10 mm from (1, 2, 3).
CORNERS = np.array([[x, y, z] for z in (3, 13) for y in (2, 12) for x in (1, 11)], float)
FACES = np.array(
    [
        [0, 2, 1], [1, 2, 3], [4, 5, 6], [5, 7, 6], [0, 1, 4], [1, 5, 4],
        [2, 6, 3], [3, 6, 7], [0, 4, 2], [2, 4, 6], [1, 3, 5], [3, 7, 5],
    ]
)  # fmt: skip


class MeshesTest(DataFolder):
    def test_a_cube_has_the_voxels_that_it_has(self) -> None:
        voxels = ream.voxelize(CORNERS, FACES, 1.0, origin_mm=(0, 0, 0), solid=True, surface=False)
        self.assertEqual(int(voxels.marked.sum()), 1000)
        first = np.argwhere(voxels.marked).min(axis=0)[::-1] + voxels.origin_mm
        last = np.argwhere(voxels.marked).max(axis=0)[::-1] + voxels.origin_mm
        self.assertEqual((tuple(first), tuple(last)), ((1, 2, 3), (10, 11, 12)))

    def test_edges_of_three_lengths(self) -> None:
        voxels = ream.voxelize(CORNERS, FACES, (1.0, 2.0, 5.0), origin_mm=(1, 2, 3), solid=True, surface=False)
        self.assertEqual(int(voxels.marked.sum()), 10 * 5 * 2)
        self.assertEqual(voxels.size_mm, (1.0, 2.0, 5.0))

    def test_reads_a_file(self) -> None:
        path = self.folder / "cube.obj"
        lines = [f"v {x} {y} {z}" for x, y, z in CORNERS] + [f"f {a + 1} {b + 1} {c + 1}" for a, b, c in FACES]
        path.write_text("\n".join(lines) + "\n")
        vertices, triangles = ream.load_mesh(path)
        self.assertEqual((len(vertices), len(triangles)), (8, 12))
        self.assertTrue(np.allclose(np.sort(vertices, axis=0), np.sort(CORNERS, axis=0)))

    def test_what_is_refused(self) -> None:
        refused = (
            ("closed", lambda: ream.voxelize(CORNERS, FACES[:-1], 1.0, solid=True)),
            ("(n, 3)", lambda: ream.voxelize(CORNERS[:, :2], FACES, 1.0)),
            ("", lambda: ream.voxelize(CORNERS, FACES + 1, 1.0)),
            ("", lambda: ream.voxelize(CORNERS * np.nan, FACES, 1.0)),
            ("4e9", lambda: ream.voxelize(CORNERS, FACES, 0.005)),
            ("", lambda: ream.voxelize(CORNERS, FACES, 0.0)),
            ("README.md", lambda: ream.load_mesh(ROOT / "README.md")),
        )
        for words, call in refused:
            with self.assertRaises(ream.Error) as raised:
                call()
            self.assertEqual(raised.exception.kind, "invalid_input")
            self.assertIn(words, str(raised.exception))
        for faces in (FACES + 0.5, FACES - 1, FACES + 2**32, []):
            with self.assertRaises(ream.Error):
                ream.voxelize(CORNERS, faces, 1.0)
        with self.assertRaises(ream.Error) as raised:
            ream.load_mesh("nothing.stl")
        self.assertEqual(raised.exception.kind, "not_found")


if __name__ == "__main__":
    unittest.main()
