"""What scripts/count_results.py says of results as CTest, GoogleTest, vitest and Playwright leave them."""

import json
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

PROGRAM = Path(__file__).parents[2] / "scripts" / "count_results.py"

GTEST = """<?xml version="1.0" encoding="UTF-8"?>
<testsuites tests="5" failures="1" disabled="1" errors="0" time="0" name="AllTests">
  <testsuite name="Bone" tests="4" failures="1" disabled="1" skipped="1" errors="0" time="0">
    <testcase name="IsHard" status="run" result="completed" time="0" classname="Bone">
      <failure message="a.cpp:3&#x0A;Expected equality of these values:&#x0A;  1&#x0A;  2" type=""></failure>
    </testcase>
    <testcase name="IsWhite" status="run" result="completed" time="0" classname="Bone" />
    <testcase name="IsAlive" status="run" result="skipped" time="0" classname="Bone">
      <skipped message="a.cpp:5&#x0A;no blood here"></skipped>
    </testcase>
    <testcase name="DISABLED_Sings" status="notrun" result="suppressed" time="0" classname="Bone" />
  </testsuite>
  <testsuite name="Of/Size" tests="1" failures="0" disabled="0" skipped="0" errors="0" time="0">
    <testcase name="Is/0" value_param="1" status="run" result="completed" time="0" classname="Of/Size" />
  </testsuite>
</testsuites>
"""
FAILED_BONE = "a.cpp:3: Failure\n[  FAILED  ] Bone.IsHard (0 ms)\n\n[  FAILED  ] 1 test, listed below:\n[  FAILED  ] Bone.IsHard\n"


def ctest(*programs: tuple[str, str, str]) -> str:
    cases = "".join(
        f'<testcase name="{name}" classname="{name}" time="0" status="{status}"><system-out>{output}</system-out></testcase>'
        for name, status, output in programs
    )
    return f'<testsuite name="Linux-c++" tests="{len(programs)}">{cases}</testsuite>'


class CountResults(unittest.TestCase):
    def setUp(self) -> None:
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def leave(self, suite: str, exit_code: int, **files: str) -> None:
        (self.folder / f"{suite}.exit").write_text(str(exit_code))
        for name, text in files.items():
            path = self.folder / name.replace("__", ".").replace("_in_", "/")
            path.parent.mkdir(exist_ok=True)
            path.write_text(text)

    def count(self) -> tuple[int, str]:
        ended = subprocess.run([sys.executable, PROGRAM, self.folder], capture_output=True, text=True, check=False)
        self.assertEqual(ended.stderr, "")
        return ended.returncode, ended.stdout

    def last_line(self) -> str:
        return self.count()[1].splitlines()[-1]

    def test_nothing_at_all_has_failed(self) -> None:
        self.assertEqual(self.count()[0], 1)
        self.assertEqual(self.last_line(), "0 passed, 1 failed")

    def test_a_suite_without_results_of_its_own_is_one_test(self) -> None:
        self.leave("lint", 0)
        self.assertEqual(self.count()[0], 0)
        self.assertEqual(self.last_line(), "1 passed, 0 failed")
        self.leave("tidy", 2, tidy__log="a name is too long\n")
        code, said = self.count()
        self.assertEqual((code, said.splitlines()[-1]), (1, "1 passed, 1 failed"))
        self.assertIn("a name is too long", said)

    def test_tests_of_programs_are_counted_one_by_one_and_say_why(self) -> None:
        programs = ctest(("unit_bone", "fail", FAILED_BONE))
        self.leave("ctest", 8, ctest__xml=programs, gtest_in_unit_bone__xml=GTEST)
        code, said = self.count()
        self.assertEqual((code, said.splitlines()[-1]), (1, "2 passed, 1 failed, 2 skipped"))
        self.assertIn("FAILED Bone.IsHard\n    a.cpp:3\n    Expected equality", said)
        self.assertIn("skipped Bone.IsAlive: no blood here", said)
        self.assertIn("skipped Bone.DISABLED_Sings: disabled", said)

    def test_a_program_that_crashed_has_failed_with_what_it_said_last(self) -> None:
        lines = "\n".join(f"line {i}" for i in range(100))
        self.leave("ctest", 8, ctest__xml=ctest(("unit_bone", "run", ""), ("unit_dead", "fail", lines)),
                   gtest_in_unit_bone__xml=GTEST.replace("failure", "properties"))
        code, said = self.count()
        self.assertEqual((code, said.splitlines()[-1]), (1, "3 passed, 1 failed, 2 skipped"))
        self.assertIn("FAILED unit_dead\n    line 8", said)
        self.assertIn("line 99", said)

    def test_a_program_without_tests_has_failed(self) -> None:
        none = "[==========] 0 tests from 0 test suites ran. (0 ms total)\n"
        self.leave("ctest", 0, ctest__xml=ctest(("unit_bone", "run", ""), ("unit_none", "run", none)),
                   gtest_in_unit_bone__xml=GTEST.replace("failure", "properties"))
        code, said = self.count()
        self.assertEqual(code, 1)
        self.assertIn("FAILED unit_none: it ran no test", said)

    def test_a_program_that_ended_well_but_left_nothing_has_failed(self) -> None:
        self.leave("ctest", 0, ctest__xml=ctest(("unit_bone", "run", ""), ("unit_gone", "run", "bye")),
                   gtest_in_unit_bone__xml=GTEST.replace("failure", "properties"))
        code, said = self.count()
        self.assertEqual((code, said.splitlines()[-1]), (1, "3 passed, 1 failed, 2 skipped"))
        self.assertIn("FAILED unit_gone: left no results", said)

    def test_results_of_one_program_that_cannot_be_read_do_not_hide_the_others(self) -> None:
        self.leave("ctest", 8, ctest__xml=ctest(("unit_bone", "fail", FAILED_BONE), ("unit_half", "run", "")),
                   gtest_in_unit_half__xml="<testsuites><testsuite")
        (self.folder / "gtest" / "unit_bone.xml").write_bytes(GTEST.encode().replace(b"equality", b"\xff\xfe"))
        code, said = self.count()
        self.assertEqual((code, said.splitlines()[-1]), (1, "2 passed, 2 failed, 2 skipped"))
        self.assertIn("FAILED Bone.IsHard", said)
        self.assertIn("FAILED unit_half: left results that cannot be read", said)

    def test_a_browser_test_that_passes_only_when_run_again_has_failed(self) -> None:
        def spec(title: str, status: str, *errors: str) -> dict:
            results = [{"errors": [{"message": error} for error in errors]}]
            return {"title": title, "tests": [{"status": status, "annotations": [], "results": results}]}

        report = {"errors": [], "suites": [{"specs": [spec("reams", "expected"), spec("waits", "flaky", "too late")]}]}
        self.leave("browser", 1, browser__json=json.dumps(report))
        code, said = self.count()
        self.assertEqual((code, said.splitlines()[-1]), (1, "1 passed, 1 failed"))
        self.assertIn("FAILED waits (passed only when run again)\n    too late", said)

    def test_a_file_of_tests_that_could_not_be_read_has_failed(self) -> None:
        files = [{"name": "a.test.ts", "status": "failed", "message": "no such module", "assertionResults": []}]
        self.leave("vitest", 1, vitest__json=json.dumps({"testResults": files}))
        code, said = self.count()
        self.assertEqual(code, 1)
        self.assertIn("FAILED a.test.ts: no such module", said)

    def test_results_that_cannot_be_read_have_failed(self) -> None:
        self.leave("ctest", 0, ctest__xml="<testsuite>")
        self.assertEqual(self.last_line(), "0 passed, 1 failed")


if __name__ == "__main__":
    unittest.main()
