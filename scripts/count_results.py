"""Sums the results that scripts/test left in a folder; the last line printed is the total.

A suite is known by its <suite>.exit file (the exit code of its program). Suites that leave a results file are
counted test by test; the others (formatting, lint) count as one test each. When a suite failed and no test says why,
what it said last (<suite>.log) is printed once more before the totals, as a long log is often cut at its beginning.
Below each test that failed stand the first lines of what it found.
Exit 1 when anything failed, when a suite ran no test, or when a program failed although its tests say they passed.
"""

import json
import re
import sys
import xml.etree.ElementTree as ElementTree
from dataclasses import dataclass, field
from pathlib import Path


LONGEST_LINE = 500
LINES_OF_A_FAILURE = 12
COLOURS = re.compile(r"\x1b\[[0-9;]*m")


@dataclass
class Counts:
    passed: int = 0
    # Names of tests, each with the first lines of why.
    failed: list[str] = field(default_factory=list)
    # It failed and no test says why: what it said last does.
    unexplained: bool = False
    skipped: list[str] = field(default_factory=list)


def with_reasons(name: str, reasons: list[str]) -> str:
    """The name of a test that failed, and below it what it found: the same number of lines for each reason."""
    lines = [name]
    for reason in reasons:
        said = [line.rstrip() for line in COLOURS.sub("", reason).splitlines() if line.strip()]
        lines += ["    " + line[:LONGEST_LINE] for line in said[: max(2, LINES_OF_A_FAILURE // len(reasons))]]
    return "\n".join(lines)


def read_ctest(path: Path) -> Counts:
    """CTest says which programs ended well; what their tests found is in gtest/ beside its file."""
    counts = Counts()
    found = path.parent / "gtest"
    for results in sorted(found.glob("*.xml")):
        read_gtest(results, counts)
    explained = {name.splitlines()[0] for name in counts.failed}
    for case in ElementTree.parse(path).getroot().iter("testcase"):
        program, output = case.get("name", "?"), case.findtext("system-out") or ""
        if case.get("status") == "run":
            if NO_TESTS in output:
                counts.failed.append(f"{program}: it ran no test")
            elif not (found / f"{program}.xml").is_file():
                counts.failed.append(f"{program}: left no results")
            continue
        named = FAILED_TESTS.findall(output)
        if not named or not explained.issuperset(named):
            # It did not live to write down what its tests found.
            counts.failed.append(with_reasons(program, gtest_failures(output) or ["\n".join(output.splitlines()[-LINES_OF_A_FAILURE:])]))
    return counts


NO_TESTS = "[==========] 0 tests from 0 test suites ran."
FAILED_TESTS = re.compile(r"^\[  FAILED  \] ([\w/]+\.[\w/]+)", re.M)


def read_gtest(path: Path, counts: Counts) -> None:
    try:
        # What a test says of bytes that are no text is written down as it is.
        root = ElementTree.fromstring(path.read_bytes().decode("utf-8", "replace"))
    except ElementTree.ParseError as error:
        counts.failed.append(f"{path.stem}: left results that cannot be read ({error})")
        return
    for case in root.iter("testcase"):
        name = f"{case.get('classname')}.{case.get('name')}"
        failures = [failure.get("message") or failure.text or "" for failure in case.iter("failure")]
        skipped = case.find("skipped")
        if failures:
            counts.failed.append(with_reasons(name, failures))
        elif skipped is not None:
            reason = (skipped.get("message") or "").strip().splitlines()
            counts.skipped.append(f"{name}: {reason[-1] if reason else 'no reason given'}")
        elif case.get("status") == "notrun":
            counts.skipped.append(f"{name}: disabled")
        else:
            counts.passed += 1


def gtest_failures(output: str) -> list[str]:
    return [said.split("\n\n")[0] for said in re.findall(r"^(\S+:\d+: Failure\n.*?)(?=^\[|^\S+:\d+: Failure|\Z)", output, re.M | re.S)]


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
                counts.failed.append(with_reasons(case["fullName"], case.get("failureMessages", [])))
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
        errors = [error.get("message", "") for result in test["results"] for error in result.get("errors", [])]
        again = " (passed only when run again)" if test["status"] == "flaky" else ""
        counts.failed.append(with_reasons(title + again, errors))


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
