"""3D Slicer's module Ream: cases, sessions and plans of a ream server, and a running session by OpenIGTLink."""

import pathlib
import tempfile
import urllib.parse

import numpy as np
import qt
import slicer
from ReamLib import nodes
from ReamLib.bench import LABELS, Bench, LoadedCase, LoadedSession, Plan, in_ras
from ReamLib.client import ClientError
from ReamLib.files import Mesh
from slicer.ScriptedLoadableModule import (
    ScriptedLoadableModule,
    ScriptedLoadableModuleLogic,
    ScriptedLoadableModuleTest,
    ScriptedLoadableModuleWidget,
)

OPENIGTLINK_PORT = 18944


class Ream(ScriptedLoadableModule):
    def __init__(self, parent):
        ScriptedLoadableModule.__init__(self, parent)
        self.parent.title = "Ream"
        self.parent.categories = ["Orthopedics"]
        self.parent.dependencies = []
        self.parent.contributors = ["the authors of ream"]
        self.parent.helpText = (
            "Loads cases and sessions of a <b>ream</b> server, sends landmarks and plans to it, and watches a running "
            "session by OpenIGTLink. For research and training; not a medical device."
        )
        self.parent.acknowledgementText = ""


class ReamWidget(ScriptedLoadableModuleWidget):
    """Connects buttons with the logic. Says what failed in a window."""

    def setup(self):
        ScriptedLoadableModuleWidget.setup(self)
        form = slicer.util.loadUI(self.resourcePath("UI/Ream.ui"))
        self.layout.addWidget(form)
        self.ui = slicer.util.childWidgetVariables(form)
        form.setMRMLScene(slicer.mrmlScene)
        self.logic = ReamLogic()
        self.ui.urlLineEdit.text = qt.QSettings().value("Ream/url", "http://127.0.0.1:8080")
        self.ui.landmarksLabel.text = "Labels: " + ", ".join(LABELS)
        for button, work in (
            (self.ui.connectButton, self.onConnect),
            (self.ui.loadCaseButton, self.onLoadCase),
            (self.ui.loadSessionButton, self.onLoadSession),
            (self.ui.sendLandmarksButton, self.onSendLandmarks),
            (self.ui.suggestPlanButton, self.onSuggestPlan),
            (self.ui.sendPlanButton, self.onSendPlan),
        ):
            button.connect("clicked(bool)", work)
        self.ui.watchButton.connect("toggled(bool)", self.onWatch)
        # What OpenIGTLink brings is arranged as soon as it is there, also when a new session brings it again.
        self.timer = qt.QTimer()
        self.timer.setInterval(500)
        self.timer.connect("timeout()", nodes.arrange_live)
        self.setConnected(False)

    def cleanup(self):
        self.timer.stop()
        self.logic.stopWatching()

    def setConnected(self, connected):
        for part in (self.ui.casesButton, self.ui.planButton, self.ui.sessionsButton):
            part.enabled = connected

    def onConnect(self, _checked=False):
        self.setConnected(False)
        self.ui.statusLabel.text = ""
        with slicer.util.tryWithErrorDisplay("The server cannot be used.", waitCursor=True):
            self.ui.statusLabel.text = self.logic.connect(self.ui.urlLineEdit.text, self.ui.tokenLineEdit.text)
            qt.QSettings().setValue("Ream/url", self.ui.urlLineEdit.text)
            self.fill(self.ui.caseComboBox, self.logic.bench.cases())
            self.fill(self.ui.sessionComboBox, self.logic.bench.sessions())
            self.fill(self.ui.reamerComboBox, [(name, name) for name in self.logic.bench.reamers()])
            self.setConnected(True)

    @staticmethod
    def fill(box, items):
        box.clear()
        for identity, words in items:
            box.addItem(words, identity)

    def onLoadCase(self, _checked=False):
        with slicer.util.tryWithErrorDisplay("The case cannot be loaded.", waitCursor=True):
            for node in self.logic.loadCase(self.ui.caseComboBox.currentData):
                if node.IsA("vtkMRMLMarkupsFiducialNode"):
                    self.ui.landmarksSelector.setCurrentNode(node)
                elif node.IsA("vtkMRMLMarkupsLineNode"):
                    self.ui.planSelector.setCurrentNode(node)
            slicer.util.resetThreeDViews()

    def onLoadSession(self, _checked=False):
        with slicer.util.tryWithErrorDisplay("The session cannot be loaded.", waitCursor=True):
            missing = self.logic.loadSession(self.ui.sessionComboBox.currentData)
            self.ui.statusLabel.text = "\n".join(missing) or "all of the session is loaded"
            slicer.util.resetThreeDViews()

    def onSendLandmarks(self, _checked=False):
        with slicer.util.tryWithErrorDisplay("The landmarks were not sent.", waitCursor=True):
            count = self.logic.sendLandmarks(self.ui.caseComboBox.currentData, self.ui.landmarksSelector.currentNode())
            self.ui.statusLabel.text = f"{count} landmarks sent"

    def onSuggestPlan(self, _checked=False):
        with slicer.util.tryWithErrorDisplay("There is no suggestion.", waitCursor=True):
            targets = {"reamer": self.ui.reamerComboBox.currentData, "depth_mm": self.ui.depthSpinBox.value}
            node, warnings = self.logic.suggestPlan(self.ui.caseComboBox.currentData, targets)
            self.ui.planSelector.setCurrentNode(node)
            self.ui.statusLabel.text = "\n".join(warnings) or "suggested; nothing is saved yet"

    def onSendPlan(self, _checked=False):
        with slicer.util.tryWithErrorDisplay("The plan was not sent.", waitCursor=True):
            warnings = self.logic.sendPlan(
                self.ui.caseComboBox.currentData, self.ui.planSelector.currentNode(), self.ui.reamerComboBox.currentData
            )
            self.ui.statusLabel.text = "\n".join(["the plan is saved", *warnings])

    def onWatch(self, checked):
        with slicer.util.tryWithErrorDisplay("The session cannot be watched."):
            if checked:
                self.logic.watch(self.ui.urlLineEdit.text, self.ui.portSpinBox.value)
                self.timer.start()
            else:
                self.timer.stop()
                self.logic.stopWatching()
        self.ui.watchButton.checked = self.logic.connector is not None


class ReamLogic(ScriptedLoadableModuleLogic):
    """What the module does, for scripts, too. Raises ReamLib.client.ClientError with a sentence about what to do."""

    def __init__(self):
        ScriptedLoadableModuleLogic.__init__(self)
        self.bench = None
        self.connector = None

    def connect(self, url, token=""):
        """url: such as http://127.0.0.1:8080. token: of `ream user token`. Returns who is connected, in words."""
        bench = Bench(url, token)
        words = bench.check()
        self.bench = bench
        return words

    def loadCase(self, case):
        """The nodes of a case, by its id."""
        # Slicer has read the file when loadVolume() returns.
        with tempfile.TemporaryDirectory(prefix="ream-") as folder:
            return nodes.show_case(self._server().load_case(case, pathlib.Path(folder)))

    def loadSession(self, session):
        """Loads a session that has ended, by its id. Returns sentences about what it does not have."""
        loaded = self._server().load_session(session)
        nodes.show_session(loaded)
        return loaded.missing

    def sendLandmarks(self, case, node):
        """Replaces a case's landmarks by those of a points list. Returns how many."""
        places = nodes.landmarks_of(self._chosen(node, "a points list"))
        nodes.require_of(node, case)
        self._server().send_landmarks(case, places)
        return len(places)

    def suggestPlan(self, case, targets):
        """A line node for the server's suggestion, and its warnings. targets: as POST plan/proposal takes them."""
        plan, warnings = self._server().propose_plan(case, targets)
        return nodes.belong(nodes.plan_node(f"{case} suggested plan", plan), case), warnings

    def sendPlan(self, case, node, reamer):
        """Replaces a case's plan by a line. reamer: where the line does not come from a plan. Returns warnings."""
        plan = nodes.plan_from(self._chosen(node, "a line"))
        nodes.require_of(node, case)
        return self._server().send_plan(case, plan.entry, plan.end, {"reamer": reamer, **plan.settings})

    def watch(self, url, port=OPENIGTLINK_PORT):
        """Watches what runs on a server that was started with --openigtlink PORT."""
        self.stopWatching()
        self.connector = nodes.watch(urllib.parse.urlsplit(url.strip()).hostname or "localhost", int(port))

    def stopWatching(self):
        if self.connector is not None:
            nodes.stop_watching(self.connector)
            self.connector = None

    def _server(self):
        if self.bench is None:
            raise ClientError("connect to a server first")
        return self.bench

    @staticmethod
    def _chosen(node, what):
        if node is None:
            raise ClientError(f"choose {what} first")
        return node


class ReamTest(ScriptedLoadableModuleTest):
    """Needs no server: made-up things of known places, as nodes."""

    def setUp(self):
        slicer.mrmlScene.Clear()

    def runTest(self):
        self.setUp()
        self.test_case_is_in_ras()
        self.setUp()
        self.test_session_is_in_ras()

    @staticmethod
    def tetrahedron():
        corners = np.array([[0, 0, 0], [10, 0, 0], [0, 20, 0], [0, 0, 30]], np.float32)
        return in_ras(Mesh(corners, np.array([[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]]), None))

    def test_case_is_in_ras(self):
        """A point 10 mm to the patient's left, 20 behind and 30 above is at (-10, -20, 30)."""
        entry, end = np.array([-1.0, -2.0, 3.0]), np.array([-1.0, -2.0, 5.0])
        case = LoadedCase("x", "x", None, self.tetrahedron(), {"trigonum": entry}, Plan(entry, end, {"reamer": "r"}))
        bone, landmarks, plan = nodes.show_case(case)
        bounds = [0.0] * 6
        bone.GetPolyData().GetBounds(bounds)
        np.testing.assert_allclose(bounds, [-10, 0, -20, 0, 0, 30])
        np.testing.assert_allclose(nodes.landmarks_of(landmarks)["trigonum"], entry)
        read = nodes.plan_from(plan)
        np.testing.assert_allclose(np.array([read.entry, read.end]), [entry, end])
        self.assertEqual(read.settings, {"reamer": "r"})
        self.delayDisplay("The case is in RAS")

    def test_session_is_in_ras(self):
        path, thrust = np.array([[0.0, 0, 0], [0, 0, 1], [0, 0, 2]]), np.array([0.0, 10, 20])
        score = [["metric", "value"], ["overall", "90"]]
        session = LoadedSession("s", self.tetrahedron(), np.zeros(4), {"thrust_n": thrust}, path, score, None, [])
        surface, line, trace, table = nodes.show_session(session)
        self.assertEqual(surface.GetPolyData().GetNumberOfPolys(), 4)
        self.assertEqual(line.GetPolyData().GetNumberOfLines(), 1)
        self.assertEqual((trace.GetNumberOfRows(), table.GetNumberOfRows()), (3, 1))
        self.delayDisplay("The session is in RAS")
