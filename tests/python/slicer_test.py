"""3D Slicer's module Ream without Slicer: its logic, widget and self-test on fakes of Slicer with real VTK, against a real server.

What is in RAS is judged by arithmetic of its own: x and y of LPS change their sign.
"""

import ast
import json
import os
import pathlib
import socket
import struct
import subprocess
import sys
import time
import unittest
import unittest.mock

import numpy as np
from places import PROGRAM
from served import ServedFolder

MODULE = PROGRAM.parent / "slicer/Ream"
FAKES = pathlib.Path(__file__).parent / "fakes/slicer5"

try:
    import vtk
except ImportError:
    raise unittest.SkipTest("python3-vtk9 is not there") from None

sys.path[:0] = [str(FAKES), str(MODULE)]
import qt  # noqa: E402
import Ream  # noqa: E402
import slicer  # noqa: E402
from ReamLib import bench, files, frames, nodes  # noqa: E402
from ReamLib.client import ClientError  # noqa: E402
from slicer.ScriptedLoadableModule import parent  # noqa: E402


def turned(lps: object) -> np.ndarray:
    """LPS to RAS, written out."""
    x, y, z = np.moveaxis(np.asarray(lps, float), -1, 0)
    return np.stack([-x, -y, z], axis=-1)


def volume_mm3(vertices: np.ndarray, triangles: np.ndarray) -> float:
    corners = (vertices - vertices.mean(axis=0))[triangles].astype(float)
    return float(np.linalg.det(corners).sum() / 6)


class SlicerBase(ServedFolder):
    def setUp(self) -> None:
        slicer.mrmlScene.Clear()
        slicer.util.errors.clear()
        slicer.install_openigtlink(False)
        self.logic = Ream.ReamLogic()
        self.logic.connect(self.url, self.token)


class CaseTest(SlicerBase):
    """A case from the CT of a phantom, so that everything there is of a case is there."""

    @classmethod
    def setUpClass(cls) -> None:
        super().setUpClass()
        cls.ream("phantom", "--out", "ct", "--format", "nrrd", "--spacing-mm", "1", "--noise-hu", "0")
        upload = cls.client.upload(cls.folder / "ct/ct.nrrd")
        for job in (
            lambda: cls.client.create_case({"upload_id": upload, "id": "shoulder", "side": "right", "name": "Shoulder"}),
            lambda: cls.client.segment_case("shoulder", {}),
        ):
            cls.client.wait(job()["id"])
        cls.landmarks = json.loads((cls.folder / "ct/landmarks.json").read_text())
        cls.client.set_landmarks("shoulder", cls.landmarks)
        cls.client.wait(cls.client.build_case("shoulder", {"upsample": 1})["id"])
        proposed = cls.client.propose_plan("shoulder", {"version_deg": 0, "depth_mm": 1.5})["plan"]
        cls.plan = {key: value for key, value in proposed.items() if value is not None}
        cls.client.set_plan("shoulder", cls.plan)

    def setUp(self) -> None:
        super().setUp()
        self.volume, self.bone, self.points, self.line = self.logic.loadCase("shoulder")

    def test_nodes_are_of_their_classes_and_named(self) -> None:
        told = [(type(node).__name__, node.GetName()) for node in (self.volume, self.bone, self.points, self.line)]
        self.assertEqual(
            told,
            [
                ("vtkMRMLScalarVolumeNode", "Shoulder CT"),
                ("vtkMRMLModelNode", "Shoulder bone"),
                ("vtkMRMLMarkupsFiducialNode", "Shoulder landmarks"),
                ("vtkMRMLMarkupsLineNode", "Shoulder plan"),
            ],
        )
        self.assertIn(("shoulder", "Shoulder (right)"), self.logic.bench.cases())
        self.assertIsNone(self.volume.GetStorageNode(), "its file is gone")

    def ijk_to_ras(self) -> np.ndarray:
        matrix = vtk.vtkMatrix4x4()
        self.volume.GetIJKToRASMatrix(matrix)
        return np.array([[matrix.GetElement(i, j) for j in range(4)] for i in range(4)])

    def test_the_ct_lies_where_the_server_has_it(self) -> None:
        """Voxel (u, v, w) fills [(u, v, w), (u+1, v+1, w+1)] times the spacing: its middle is half a voxel further."""
        ct = self.client.get_case("shoulder")["ct"]
        frame, spacing = ct["world_from_volume"], np.array(ct["spacing_mm"])
        self.assertEqual(slicer.util.arrayFromVolume(self.volume).shape, tuple(ct["dims"][::-1]))
        for ijk in ((0, 0, 0), (10, 20, 30), np.array(ct["dims"]) - 1):
            lps = np.array(frame["rotation"]) @ ((np.array(ijk) + 0.5) * spacing) + frame["translation_mm"]
            found = self.ijk_to_ras() @ [*ijk, 1]
            np.testing.assert_allclose(found[:3], [-lps[0], -lps[1], lps[2]], atol=1e-3)

    def test_the_bone_is_the_servers_turned_and_not_mirrored(self) -> None:
        raw = files.read_ply(self.client.get_case_mesh("shoulder"))
        points, corners = slicer.polydata_arrays(self.bone)
        np.testing.assert_allclose(points, turned(raw.vertices), atol=1e-4)
        np.testing.assert_array_equal(corners.reshape(-1, 3), raw.triangles)
        self.assertGreater(volume_mm3(points, corners.reshape(-1, 3)), 1000, "counter-clockwise from outside")

    def test_the_bone_lies_in_the_bone_of_the_ct(self) -> None:
        """The CT went another way than the surface: inside the surface it must be brighter than outside."""
        points, corners = slicer.polydata_arrays(self.bone)
        corners = corners.reshape(-1, 3)[::20]
        a, b, c = (points[corners[:, i]].astype(float) for i in range(3))
        normals = np.cross(b - a, c - a)
        size = np.linalg.norm(normals, axis=1)
        normals = normals[size > 1e-6] / size[size > 1e-6, None]
        middles = ((a + b + c) / 3)[size > 1e-6]
        inside, outside = self.hu(middles - 1.0 * normals), self.hu(middles + 2.0 * normals)
        self.assertGreater(len(inside), 500)
        self.assertGreater((inside > outside).mean(), 0.9)
        self.assertGreater(np.median(inside) - np.median(outside), 200)

    def hu(self, ras: np.ndarray) -> np.ndarray:
        array = slicer.util.arrayFromVolume(self.volume)
        ijk = np.linalg.inv(self.ijk_to_ras()) @ np.column_stack([ras, np.ones(len(ras))]).T
        i, j, k = np.rint(ijk[:3]).astype(int)
        top = array.shape
        return array[np.clip(k, 0, top[0] - 1), np.clip(j, 0, top[1] - 1), np.clip(i, 0, top[2] - 1)].astype(float)

    def test_landmarks_go_there_and_back(self) -> None:
        places = nodes.landmarks_of(self.points)
        self.assertEqual(places.keys() - set(bench.LABELS), set())
        x, y, z = self.landmarks["trigonum_mm"]
        np.testing.assert_allclose(places["trigonum"], [-x, -y, z])
        self.assertEqual(self.logic.sendLandmarks("shoulder", self.points), len(places))
        self.assert_same(self.client.get_landmarks("shoulder"), self.landmarks)
        # To the right in RAS is less x in LPS.
        at = list(places).index("trigonum")
        self.points._points[at][0] += (1.0, 2.0, 3.0)
        self.logic.sendLandmarks("shoulder", self.points)
        np.testing.assert_allclose(self.client.get_landmarks("shoulder")["trigonum_mm"], [x - 1, y - 2, z + 3])
        self.client.set_landmarks("shoulder", self.landmarks)

    def assert_same(self, one: object, other: object) -> None:
        if isinstance(one, dict):
            self.assertEqual(one.keys(), other.keys())
            for key in one:
                self.assert_same(one[key], other[key])
        elif isinstance(one, str):
            self.assertEqual(one, other)
        else:
            np.testing.assert_allclose(np.asarray(one, float), np.asarray(other, float), atol=1e-9)

    def test_points_that_make_no_sense_are_refused(self) -> None:
        count = self.points.GetNumberOfControlPoints()
        self.points.SetNthControlPointLabel(0, "F-1")
        with self.assertRaisesRegex(ClientError, "no landmark is called 'F-1'; the labels are: glenoid centre"):
            self.logic.sendLandmarks("shoulder", self.points)
        self.points.UnsetNthControlPointPosition(0)
        self.points.SetNthControlPointLabel(1, self.points.GetNthControlPointLabel(2))
        with self.assertRaisesRegex(ClientError, "two points"):
            self.logic.sendLandmarks("shoulder", self.points)
        self.points.UnsetNthControlPointPosition(1)
        self.assertEqual(len(nodes.landmarks_of(self.points)), count - 2)
        with self.assertRaisesRegex(ClientError, "choose a points list"):
            self.logic.sendLandmarks("shoulder", None)

    def test_the_plan_is_a_line_into_the_bone(self) -> None:
        entry, end = slicer.util.arrayFromMarkupsControlPoints(self.line, world=True)
        stored = self.client.get_plan("shoulder")
        np.testing.assert_allclose(entry, turned(stored["entry_mm"]), atol=1e-9)
        np.testing.assert_allclose(end - entry, 1.5 * turned(stored["axis_direction"]), atol=1e-9)
        centre = slicer.polydata_arrays(self.bone)[0].mean(axis=0)
        self.assertGreater(np.dot(end - entry, centre - entry), 0)

    def test_a_line_becomes_the_plan(self) -> None:
        entry, end = slicer.util.arrayFromMarkupsControlPoints(self.line, world=True)
        moved = entry + (0.5, -0.25, 1.0)
        direction = (end - entry) / 1.5
        slicer.util.updateMarkupsControlPointsFromArray(self.line, np.array([moved, moved + 2.0 * direction]))
        self.logic.sendPlan("shoulder", self.line, "not used")
        stored = self.client.get_plan("shoulder")
        np.testing.assert_allclose(stored["entry_mm"], [-moved[0], -moved[1], moved[2]], atol=1e-6)
        np.testing.assert_allclose(stored["axis_direction"], turned(direction), atol=1e-6)
        self.assertAlmostEqual(stored["depth_mm"], 2.0)
        self.assertEqual(stored["reamer"], self.plan["reamer"])
        self.client.set_plan("shoulder", self.plan)
        short = slicer.mrmlScene.AddNewNodeByClass("vtkMRMLMarkupsLineNode", "drawn")
        with self.assertRaisesRegex(ClientError, "two points"):
            self.logic.sendPlan("shoulder", short, "x")
        slicer.util.updateMarkupsControlPointsFromArray(short, np.array([entry, entry]))
        with self.assertRaisesRegex(ClientError, "depth"):
            self.logic.sendPlan("shoulder", short, "x")
        # A line that was drawn by hand has no settings: the reamer is the one that is chosen.
        slicer.util.updateMarkupsControlPointsFromArray(short, np.array([entry, end]))
        name = self.logic.bench.reamers()[0]
        self.logic.sendPlan("shoulder", short, name)
        np.testing.assert_allclose(self.client.get_plan("shoulder")["entry_mm"], turned(entry), atol=1e-6)
        self.client.set_plan("shoulder", self.plan)

    def test_nothing_is_sent_to_another_case(self) -> None:
        for send in (
            lambda: self.logic.sendPlan("other", self.line, "x"),
            lambda: self.logic.sendLandmarks("other", self.points),
        ):
            with self.assertRaisesRegex(ClientError, "is of case 'shoulder', not of 'other'"):
                send()

    def test_a_suggestion_is_a_line_and_saves_nothing(self) -> None:
        node, warnings = self.logic.suggestPlan("shoulder", {"depth_mm": 2.5})
        self.assertIsInstance(warnings, list)
        entry, end = slicer.util.arrayFromMarkupsControlPoints(node, world=True)
        self.assertAlmostEqual(float(np.linalg.norm(end - entry)), 2.5)
        self.assertAlmostEqual(self.client.get_plan("shoulder")["depth_mm"], 1.5)

    def test_buttons_do_it(self) -> None:
        widget = Ream.ReamWidget(parent())
        widget.setup()
        ui = widget.ui
        self.assertEqual([ui.casesButton.enabled, ui.planButton.enabled, ui.sessionsButton.enabled], [False] * 3)
        ui.urlLineEdit.text, ui.tokenLineEdit.text = self.url, "wrong"
        ui.connectButton.click()
        self.assertEqual(len(slicer.util.errors), 1)
        self.assertNotIn("wrong", slicer.util.errors[0])
        self.assertFalse(ui.casesButton.enabled)
        ui.tokenLineEdit.text = self.token
        ui.connectButton.click()
        self.assertEqual(ui.statusLabel.text, "connected as Anna")
        self.assertEqual(qt.QSettings().value("Ream/url"), self.url)
        self.assertNotIn(self.token, json.dumps(qt.QSettings._kept))
        ui.caseComboBox.choose("shoulder")
        ui.loadCaseButton.click()
        self.assertEqual(ui.landmarksSelector.currentNode().GetName(), "Shoulder landmarks")
        ui.sendLandmarksButton.click()
        self.assertIn("landmarks sent", ui.statusLabel.text)
        ui.suggestPlanButton.click()
        self.assertEqual(ui.planSelector.currentNode().GetName(), "shoulder suggested plan")
        ui.sendPlanButton.click()
        self.assertIn("the plan is saved", ui.statusLabel.text)
        self.assertAlmostEqual(self.client.get_plan("shoulder")["depth_mm"], ui.depthSpinBox.value)
        self.assertEqual(len(slicer.util.errors), 1)
        self.client.set_plan("shoulder", self.plan)
        ui.watchButton.click()
        self.assertIn("SlicerOpenIGTLink", slicer.util.errors[-1])
        self.assertFalse(ui.watchButton.checked)
        widget.cleanup()


class SessionTest(SlicerBase):
    serve_words = ("--openigtlink", "0")

    @classmethod
    def setUpClass(cls) -> None:
        super().setUpClass()
        cls.session = cls.ended_session(title="For Slicer")

    def of(self, kind: str, name: str) -> object:
        found = [
            slicer.mrmlScene.GetNthNodeByClass(i, kind) for i in range(slicer.mrmlScene.GetNumberOfNodesByClass(kind))
        ]
        (node,) = [node for node in found if node.GetName() == f"{self.session} {name}"]
        return node

    def test_a_session_is_there_as_the_server_has_it(self) -> None:
        ((identity, words),) = [one for one in self.logic.bench.sessions() if one[0] == self.session]
        self.assertTrue(words.endswith(" For Slicer"), words)
        missing = self.logic.loadSession(identity)
        surface = self.of("vtkMRMLModelNode", "surface")
        points, corners = slicer.polydata_arrays(surface)
        raw = files.read_ply(self.client.get_session_mesh(self.session))
        np.testing.assert_allclose(points, turned(raw.vertices), atol=1e-4)
        self.assertGreater(volume_mm3(points, corners.reshape(-1, 3)), 1000)
        self.check_deviation(surface, points)
        self.check_path(points)
        self.check_tables()
        components = [i for i in missing if i.startswith("no component")]
        if components:
            self.assertEqual(len(components), 1)
        else:
            component = self.of("vtkMRMLModelNode", "component")
            near, _ = slicer.polydata_arrays(component)
            self.assertLess(np.abs(near.mean(axis=0) - np.median(self.cut, axis=0)).max(), 30)

    def check_deviation(self, surface: object, points: np.ndarray) -> None:
        from vtk.util import numpy_support

        array = surface.GetPolyData().GetPointData().GetArray("deviation_mm")
        deviation = numpy_support.vtk_to_numpy(array)
        self.assertEqual(len(deviation), len(points))
        known = np.isfinite(deviation)
        self.assertGreater(known.sum(), 20)
        self.assertLess(np.abs(deviation[known]).max(), 100)
        self.assertEqual(surface.GetDisplayNode().shown["scalar"], "deviation_mm")
        self.cut = points[known]

    def check_path(self, points: np.ndarray) -> None:
        """The reamer has been at the bone that it has cut."""
        path = self.of("vtkMRMLModelNode", "tool path")
        places, order = slicer.polydata_arrays(path)
        trace = files.read_table(self.client.get_trace(self.session))
        np.testing.assert_allclose(places, np.stack([-trace["tool_x_mm"], -trace["tool_y_mm"], trace["tool_z_mm"]], 1), atol=1e-4)
        np.testing.assert_array_equal(order, np.arange(len(places)))
        distance = np.linalg.norm(points - places[-1], axis=1).min()
        self.assertLess(distance, 5.0)

    def check_tables(self) -> None:
        trace = self.of("vtkMRMLTableNode", "trace")
        session = self.client.get_session(self.session)
        self.assertEqual(trace.GetNumberOfRows(), session["tick"])
        depth = trace.GetTable().GetColumnByName("tool_depth_mm")
        self.assertGreater(max(depth.GetValue(i) for i in range(depth.GetNumberOfTuples())), 0)
        score = self.of("vtkMRMLTableNode", "score").GetTable()
        told = self.client.get_score(self.session)
        self.assertEqual(score.GetNumberOfRows(), 1 + len(told["metrics"]))
        names, values = (score.GetColumnByName(name) for name in ("metric", "value"))
        for i, metric in enumerate(told["metrics"], 1):
            self.assertEqual(names.GetValue(i), metric["name"])
            if metric["value"] is not None:
                self.assertAlmostEqual(float(values.GetValue(i)), metric["value"], delta=1e-5 * max(1, abs(metric["value"])))
            else:
                self.assertIn("missing: ", values.GetValue(i))

    def test_a_long_trace_is_thinned(self) -> None:
        with unittest.mock.patch.object(bench, "MAX_TRACE_ROWS", 100):
            loaded = self.logic.bench.load_session(self.session)
        self.assertLessEqual(len(loaded.path), 101)
        self.assertGreater(len(loaded.path), 50)

    def test_buttons_do_it(self) -> None:
        slicer.install_openigtlink(True)
        widget = Ream.ReamWidget(parent())
        widget.setup()
        ui = widget.ui
        ui.urlLineEdit.text, ui.tokenLineEdit.text = self.url, self.token
        ui.connectButton.click()
        ui.sessionComboBox.choose(self.session)
        ui.loadSessionButton.click()
        self.assertEqual(slicer.util.errors, [])
        self.assertTrue(ui.statusLabel.text)
        ui.portSpinBox.value = self.address["openigtlink_port"]
        ui.watchButton.click()
        connector = self.logic_of(widget).connector
        self.assertEqual(connector.server, ("127.0.0.1", self.address["openigtlink_port"]))
        self.assertTrue(connector.active and widget.timer.active)
        self.arrive_and_arrange(widget)
        ui.watchButton.click()
        self.assertFalse(connector.active or widget.timer.active)
        widget.cleanup()

    @staticmethod
    def logic_of(widget: object) -> object:
        return widget.logic

    def arrive_and_arrange(self, widget: object) -> None:
        """What the extension makes of the server's messages is put together."""
        self.assertFalse(nodes.arrange_live())
        reamer = slicer.mrmlScene.AddNewNodeByClass("vtkMRMLModelNode", "Reamer")
        place = slicer.mrmlScene.AddNewNodeByClass("vtkMRMLLinearTransformNode", "ReamerToRas")
        widget.timer.emit("timeout()")
        self.assertEqual(reamer.GetTransformNodeID(), place.GetID())
        slicer.mrmlScene.AddNewNodeByClass("vtkMRMLModelNode", "Bone")
        slicer.mrmlScene.AddNewNodeByClass("vtkMRMLLinearTransformNode", "BoneToRas")
        self.assertTrue(nodes.arrange_live())

    def test_the_server_sends_what_is_arranged(self) -> None:
        """By the protocol's own bytes: a header of 58 bytes, then the body; a TRANSFORM has twelve floats."""
        session = self.client.create_session({"case": "demo", "script": "short", "device": "script"})["id"]
        heard: dict[str, tuple[str, bytes]] = {}
        wanted = {*nodes.LIVE, *nodes.LIVE.values()}
        with socket.create_connection(("127.0.0.1", self.address["openigtlink_port"]), timeout=300) as line:
            self.client.start_session(session)
            stream = line.makefile("rb")
            until = time.monotonic() + 300
            while not wanted <= heard.keys() and time.monotonic() < until:
                head = stream.read(58)
                _, kind, name, _, size, _ = struct.unpack(">H12s20sQQQ", head)
                heard[name.rstrip(b"\0").decode()] = (kind.rstrip(b"\0").decode(), stream.read(size))
        self.assertEqual({name: heard[name][0] for name in wanted}, {
            "Reamer": "POLYDATA", "Bone": "POLYDATA", "ReamerToRas": "TRANSFORM", "BoneToRas": "TRANSFORM"})  # fmt: skip
        matrix = np.array(struct.unpack(">12f", heard["ReamerToRas"][1])).reshape(4, 3).T
        trace = files.read_table(self.client.get_trace(self.session, stride=1))
        first = np.array([trace[f"tool_{axis}_mm"][0] for axis in "xyz"])
        # The same script begins at the same place; it is some mm from there at most while the session is young.
        self.assertLess(np.abs(matrix[:, 3] - turned(first)).max(), 10)
        self.client.stop_session(session)

    def test_what_is_refused_is_said(self) -> None:
        with self.assertRaises(ClientError):
            Ream.ReamLogic().connect("127.0.0.1:8080")
        with self.assertRaisesRegex(ClientError, "ream user token"):
            Ream.ReamLogic().connect(self.url)
        with self.assertRaisesRegex(ClientError, "connect to a server first"):
            Ream.ReamLogic().loadCase("demo")
        with self.assertRaisesRegex(ClientError, "no-such"):
            self.logic.loadSession("no-such")


class AloneTest(unittest.TestCase):
    """Without a server."""

    def test_frames(self) -> None:
        np.testing.assert_array_equal(frames.ras_from_lps([[1, 2, 3], [-4, 5, 6]]), [[-1, -2, 3], [4, -5, 6]])
        np.testing.assert_array_equal(frames.lps_from_ras(frames.ras_from_lps([1.5, 2, 3])), [1.5, 2, 3])
        with self.assertRaises(ValueError):
            frames.ras_from_lps([1, 2])
        # No mirror: what is right-handed stays so.
        self.assertAlmostEqual(np.linalg.det(frames.ras_from_lps(np.eye(3))), 1)

    def test_slicers_own_test_passes(self) -> None:
        Ream.Ream(parent())
        Ream.ReamTest().runTest()

    def test_damaged_files_are_refused(self) -> None:
        head = b"ply\nformat binary_little_endian 1.0\nelement vertex 3\n" + b"".join(
            b"property float %s\n" % axis for axis in (b"x", b"y", b"z")
        )
        faces = b"element face 1\nproperty list uchar int vertex_indices\nend_header\n"
        body = struct.pack("<9f", *range(9)) + struct.pack("<B3i", 3, 0, 1, 2)
        mesh = files.read_ply(head + faces + body)
        self.assertEqual(mesh.triangles.tolist(), [[0, 1, 2]])
        self.assertIsNone(mesh.normals)
        for wrong in (
            b"",
            head,
            head + faces,
            head + faces + body[:-1],
            head + faces + body + b"x",
            head + faces + body[:36] + struct.pack("<B3i", 3, 0, 1, 3),
            head + faces + body[:36] + struct.pack("<B3i", 4, 0, 1, 2),
            head.replace(b" x", b" q") + faces + body,
            head.replace(b"float", b"half") + faces + body,
            head.replace(b"binary_little_endian", b"ascii") + faces + body,
        ):
            with self.subTest(wrong=wrong), self.assertRaises(files.FileError):
                files.read_ply(wrong)
        for wrong in (b"", bytes(84) + b"x", bytes(80) + struct.pack("<I", 2) + bytes(50)):
            with self.assertRaises(files.FileError):
                files.read_stl(wrong)
        for wrong in (b"a,b\n1\n2,3\n", b"a,b\n1,x\n"):
            with self.assertRaises(files.FileError):
                files.read_table(wrong)

    def test_an_stl_is_read(self) -> None:
        corners = np.array([[[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 0, 0], [0, 1, 0], [0, 0, 1]]], "<f4")
        body = b"".join(struct.pack("<3f", 0, 0, 0) + one.tobytes() + b"\0\0" for one in corners)
        mesh = files.read_stl(bytes(80) + struct.pack("<I", 2) + body)
        self.assertEqual(len(mesh.vertices), 4)
        np.testing.assert_array_equal(mesh.vertices[mesh.triangles], corners)

    def test_landmarks_that_need_more_are_refused(self) -> None:
        with self.assertRaisesRegex(ClientError, "radius"):
            bench.landmarks_from({"humeral head": [0, 0, 0]}, {})
        with self.assertRaisesRegex(ClientError, "needs all of"):
            bench.landmarks_from({"biconcavity ridge": [0, 0, 0]}, {})
        sent = bench.landmarks_from(
            {"humeral head": [1, 2, 3]}, {"humeral_head": {"centre_mm": [0, 0, 0], "radius_mm": 24}, "walch": "B2"}
        )
        self.assertEqual(sent, {"humeral_head": {"centre_mm": [-1, -2, 3], "radius_mm": 24}, "walch": "B2"})

    def test_it_needs_no_package_of_ours(self) -> None:
        """Slicer's Python has NumPy and VTK: everything that needs no scene is imported without `ream`."""
        code = "import sys; sys.modules['ream'] = None; from ReamLib import bench, files, frames; print(bench.Bench('http://x'))"
        environment = {"PATH": os.environ["PATH"], "PYTHONPATH": str(MODULE), "PYTHONDONTWRITEBYTECODE": "1"}
        subprocess.run([sys.executable, "-c", code], check=True, env=environment, capture_output=True)

    def test_slicers_older_python_reads_it(self) -> None:
        """Slicer 5 has Python 3.9: no match, and no X | Y outside of annotations, which are not evaluated."""
        checked = 0
        for path in (*MODULE.glob("*.py"), *MODULE.glob("ReamLib/*.py")):
            text = path.read_text()
            tree = ast.parse(text, feature_version=(3, 9))
            annotated = {id(part) for node in ast.walk(tree) for kind in ("annotation", "returns")
                         if getattr(node, kind, None) is not None for part in ast.walk(getattr(node, kind))}  # fmt: skip
            if annotated:
                self.assertTrue("from __future__ import annotations" in text, path)
            for node in ast.walk(tree):
                if isinstance(node, ast.BinOp) and isinstance(node.op, ast.BitOr) and id(node) not in annotated:
                    names = {part.id for part in ast.walk(node) if isinstance(part, ast.Name)}
                    self.assertFalse(names & {"str", "int", "float", "bytes", "dict", "list", "None"}, f"{path}:{node.lineno}")
            checked += 1
        self.assertEqual(checked, 8)


if __name__ == "__main__":
    unittest.main()
