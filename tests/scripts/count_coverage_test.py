"""What scripts/count_coverage.py says of counts as llvm-cov leaves them."""

import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

PROGRAM = Path(__file__).parents[2] / "scripts" / "count_coverage.py"


class CountCoverage(unittest.TestCase):
    def setUp(self):
        self.scratch = tempfile.TemporaryDirectory()
        self.addCleanup(self.scratch.cleanup)
        self.root = Path(self.scratch.name)

    def counted(self, info: str, *arguments: str) -> subprocess.CompletedProcess:
        (self.root / "tests.info").write_text(info)
        command = [sys.executable, PROGRAM, "tests.info", *arguments]
        return subprocess.run(command, cwd=self.root, capture_output=True, text=True)

    def git(self, *arguments: str) -> str:
        who = ["-c", "user.name=a", "-c", "user.email=a@b.c"]
        return subprocess.run(["git", *who, *arguments], cwd=self.root, check=True, capture_output=True, text=True).stdout.strip()

    def test_those_with_most_left_come_first_and_totals_last(self):
        info = f"SF:{self.root}/server/a.cpp\nDA:1,3\nDA:2,0\nBRDA:1,0,0,3\nBRDA:1,0,1,-\nend_of_record\n"
        info += f"SF:{self.root}/server/b.cpp\nDA:1,0\nDA:2,0\nDA:3,1\nend_of_record\n"
        done = self.counted(info)
        self.assertEqual(done.returncode, 0, done.stderr)
        first, second, lines, branches = done.stdout.splitlines()
        self.assertEqual(first.split(), ["2", "left", "of", "3", "server/b.cpp"])
        self.assertEqual(second.split(), ["1", "left", "of", "2", "server/a.cpp"])
        self.assertEqual((lines, branches), ("lines: 2 of 5, 40.0 %", "branches: 1 of 2, 50.0 %"))

    def test_a_count_below_nothing_is_a_line_that_did_not_run(self):
        done = self.counted(f"SF:{self.root}/server/a.cpp\nDA:1,{2**64 - 3}\nend_of_record\n")
        self.assertIn("lines: 0 of 1, 0.0 %", done.stdout)

    def test_a_line_that_ran_in_one_of_two_programs_has_run(self):
        done = self.counted(f"SF:{self.root}/server/a.hpp\nDA:1,0\nDA:1,4\nDA:1,0\nend_of_record\n")
        self.assertIn("lines: 1 of 1, 100.0 %", done.stdout)

    def test_nothing_counted_is_an_error(self):
        self.assertEqual(self.counted("").returncode, 1)

    def test_changed_lines_that_did_not_run_are_named(self):
        source = self.root / "server" / "a.cpp"
        source.parent.mkdir()
        source.write_text("one\ntwo\nthree\n")
        self.git("init", "-q")
        self.git("add", ".")
        self.git("commit", "-qm", "a")
        source.write_text("one\n2\nthree\nfour\n")
        info = f"SF:{self.root}/server/a.cpp\nDA:1,0\nDA:2,1\nDA:4,0\nend_of_record\n"
        done = self.counted(info, "--changed", "HEAD")
        self.assertEqual(done.returncode, 1)
        self.assertEqual(done.stdout.splitlines()[-2:], ["server/a.cpp:4: four", "1 lines changed since HEAD did not run"])
        self.assertEqual(self.counted(info.replace("DA:4,0", "DA:4,2"), "--changed", "HEAD").returncode, 0)


if __name__ == "__main__":
    unittest.main()
