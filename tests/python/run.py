"""Runs the tests of the Python package and writes what each found where GTEST_OUTPUT says (xml:FILE), in the form that
scripts/count_results.py reads.
"""

import faulthandler
import os
import pathlib
import sys
import time
import unittest
import xml.etree.ElementTree as ElementTree


class Written(unittest.TextTestResult):
    """Keeps a testcase for each test."""

    def __init__(self, *arguments, **named) -> None:
        super().__init__(*arguments, **named)
        self.suite = ElementTree.Element("testsuite", name="python")
        self.cases: dict[str, ElementTree.Element] = {}

    def case_of(self, test) -> ElementTree.Element:
        if test.id() not in self.cases:
            name = test.id().rpartition(".")[2]
            owner = type(test).__name__
            self.cases[test.id()] = ElementTree.SubElement(self.suite, "testcase", classname=owner, name=name)
        return self.cases[test.id()]

    def startTest(self, test) -> None:
        super().startTest(test)
        self.started = time.monotonic()
        self.case_of(test)

    def stopTest(self, test) -> None:
        super().stopTest(test)
        self.case_of(test).set("time", f"{time.monotonic() - self.started:.3f}")

    def fail(self, test, words: str) -> None:
        ElementTree.SubElement(self.case_of(test), "failure", message=words)

    def addError(self, test, error) -> None:
        super().addError(test, error)
        self.fail(test, self._exc_info_to_string(error, test))

    def addFailure(self, test, error) -> None:
        super().addFailure(test, error)
        self.fail(test, self._exc_info_to_string(error, test))

    def addSubTest(self, test, subtest, error) -> None:
        super().addSubTest(test, subtest, error)
        if error is not None:
            self.fail(test, f"{subtest}: {self._exc_info_to_string(error, test)}")

    def addSkip(self, test, reason: str) -> None:
        super().addSkip(test, reason)
        ElementTree.SubElement(self.case_of(test), "skipped", message=reason)


def main() -> int:
    faulthandler.enable()
    tests = unittest.defaultTestLoader.discover(str(pathlib.Path(__file__).parent), pattern="*_test.py")
    result = unittest.TextTestRunner(resultclass=Written, verbosity=2).run(tests)
    kind, _, file = os.environ.get("GTEST_OUTPUT", "").partition(":")
    if kind == "xml" and file:
        pathlib.Path(file).parent.mkdir(parents=True, exist_ok=True)
        ElementTree.ElementTree(result.suite).write(file, encoding="utf-8", xml_declaration=True)
    for case in result.suite:  # as GoogleTest says it, for scripts/count_results.py
        if case.find("failure") is not None:
            print(f"[  FAILED  ] {case.get('classname')}.{case.get('name')}")
    if result.testsRun == 0:
        print("no test was found", file=sys.stderr)
        return 1
    return 0 if result.wasSuccessful() else 1


if __name__ == "__main__":
    sys.exit(main())
