"""Sums the results that scripts/test left in a folder; the last line printed is the total.

A suite is known by its <suite>.exit file (the exit code of its program). Suites that leave a results file are
counted test by test; the others (formatting, lint) count as one test each. When a suite failed and no test says why,
what it said last (<suite>.log) is printed once more before the totals, as a long log is often cut at its beginning.
Exit 1 when anything failed, when a suite ran no test, or when a program failed although its tests say they passed.
"""

import json
import re
import sys
import xml.etree.ElementTree as ElementTree
from dataclasses import dataclass, field
from pathlib import Path


@dataclass
class Counts:
    passed: int = 0
    failed: list[str] = field(default_factory=list)
    # It failed and no test says why: what it said last does.
    unexplained: bool = False
    skipped: list[str] = field(default_factory=list)


def read_ctest(path: Path) -> Counts:
    counts = Counts()
    for case in ElementTree.parse(path).getroot().iter("testcase"):
        name = case.get("name", "?")
        output = case.findtext("system-out") or ""
        if case.get("status") == "run":
            counts.passed += 1
        elif case.get("status") == "disabled" or is_gtest_skip(case, output):
            counts.skipped.append(f"{name}: {gtest_skip_reason(output)}")
        else:
            counts.failed.append(name)
    return counts


def is_gtest_skip(case: ElementTree.Element, output: str) -> bool:
    return case.find("skipped") is not None and "[  SKIPPED ]" in output


def gtest_skip_reason(output: str) -> str:
    reason = re.search(r": Skipped\n(.+)", output)
    return reason.group(1).strip() if reason else "disabled"


def read_vitest(path: Path) -> Counts:
    counts = Counts()
    for file in json.loads(path.read_text())["testResults"]:
        cases = file["assertionResults"]
        if file["status"] == "failed" and not any(case["status"] == "failed" for case in cases):
            counts.failed.append(f"{file['name']}: {file.get('message', 'could not run')}")
        for case in cases:
            if case["status"] == "passed":
                counts.passed += 1
            elif case["status"] == "failed":
                counts.failed.append(case["fullName"])
            else:
                counts.skipped.append(f"{case['fullName']}: {case['status']}")
    return counts


def read_browser(path: Path) -> Counts:
    counts = Counts()
    report = json.loads(path.read_text())
    for error in report.get("errors", []):
        counts.failed.append(error.get("message", "browser run failed").splitlines()[0])
    suites = list(report["suites"])
    while suites:
        suite = suites.pop()
        suites += suite.get("suites", [])
        for spec in suite.get("specs", []):
            for test in spec["tests"]:
                add_browser_test(counts, spec["title"], test)
    return counts


def add_browser_test(counts: Counts, title: str, test: dict) -> None:
    if test["status"] == "expected":
        counts.passed += 1
    elif test["status"] == "skipped":
        reasons = [note.get("description", "") for note in test.get("annotations", [])]
        counts.skipped.append(f"{title}: {'; '.join(filter(None, reasons)) or 'no reason given'}")
    else:
        counts.failed.append(title + (" (passed only when run again)" if test["status"] == "flaky" else ""))


READERS = {
    "ctest": ("ctest.xml", read_ctest),
    "vitest": ("vitest.json", read_vitest),
    "browser": ("browser.json", read_browser),
}


def read_suite(folder: Path, suite: str) -> Counts:
    exit_code = int((folder / f"{suite}.exit").read_text())
    if suite not in READERS:
        return Counts(passed=1) if exit_code == 0 else Counts(failed=[f"exit code {exit_code}"], unexplained=True)
    file_name, read = READERS[suite]
    try:
        counts = read(folder / file_name)
    except (OSError, ValueError, KeyError, ElementTree.ParseError) as error:
        return Counts(failed=[f"left no readable results ({error})"], unexplained=True)
    if exit_code != 0 and not counts.failed:
        counts.failed.append(f"its program ended with exit code {exit_code}")
        counts.unexplained = True
    if counts.passed == 0 and not counts.failed:
        counts.failed.append("it ran no test")
    return counts


LAST_LINES = 100
LONGEST_LINE = 500


def print_last_words(folder: Path, suite: str) -> None:
    log = folder / f"{suite}.log"
    if not log.is_file():
        return
    print(f"== what {suite} said last")
    for line in log.read_text(errors="replace").splitlines()[-LAST_LINES:]:
        print(line[:LONGEST_LINE])


def main() -> int:
    folder = Path(sys.argv[1])
    suites = sorted(path.stem for path in folder.glob("*.exit"))
    read = {suite: read_suite(folder, suite) for suite in suites}
    for suite, counts in read.items():
        if counts.unexplained:
            print_last_words(folder, suite)
    print("== results")
    seconds = {path.stem: path.read_text().strip() for path in folder.glob("*.seconds")}
    print("seconds: " + ", ".join(f"{name} {taken}" for name, taken in sorted(seconds.items())))
    passed = failed = skipped = 0
    for suite, counts in read.items():
        print(f"{suite}: {counts.passed} passed, {len(counts.failed)} failed, {len(counts.skipped)} skipped")
        for line in counts.skipped:
            print(f"  skipped {line}")
        for line in counts.failed:
            print(f"  FAILED {line}")
        passed += counts.passed
        failed += len(counts.failed)
        skipped += len(counts.skipped)
    if not suites:
        failed = 1
    print(f"{passed} passed, {failed} failed" + (f", {skipped} skipped" if skipped else ""))
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
