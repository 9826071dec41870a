#!/usr/bin/env python3
"""Sums what scripts/coverage measured: FILE.info in the form of lcov -> a line a file, those with most lines left first, then totals.

With --changed COMMIT also each line of server/ that was changed since that commit and did not run; exit 1 when there are any.
"""

import argparse
import re
import subprocess
import sys
from collections import defaultdict
from pathlib import Path

# Counts are differences of counters; where threads lost some, one is a little below nothing.
LEAST_NEGATIVE = 1 << 63


def count_of(text: str) -> int:
    if text == "-":
        return 0
    count = int(text)
    return 0 if count >= LEAST_NEGATIVE else count


def read(info: Path, root: Path) -> tuple[dict[str, dict[int, int]], dict[str, dict[tuple[str, ...], int]]]:
    """Counts of lines, and of branches, by file; a file that several records name has the most of them."""
    lines: dict[str, dict[int, int]] = defaultdict(dict)
    branches: dict[str, dict[tuple[str, ...], int]] = defaultdict(dict)
    name = ""
    for row in info.read_text().splitlines():
        if row.startswith("SF:"):
            path = Path(row[3:])
            name = str(path.relative_to(root)) if path.is_relative_to(root) else str(path)
        elif row.startswith("DA:"):
            number, count = row[3:].split(",")[:2]
            lines[name][int(number)] = max(count_of(count), lines[name].get(int(number), 0))
        elif row.startswith("BRDA:"):
            *where, count = row[5:].split(",")
            branches[name][tuple(where)] = max(count_of(count), branches[name].get(tuple(where), 0))
    return lines, branches


def changed_lines(since: str):
    """File, number and text of each line of server/ that a diff adds."""
    form = ["--unified=0", "--no-ext-diff", "--src-prefix=a/", "--dst-prefix=b/"]
    diff = subprocess.run(["git", "diff", *form, since, "--", "server"], capture_output=True, text=True, check=True)
    name, number = "", 0
    for row in diff.stdout.splitlines():
        if row.startswith("+++ "):
            name = row[6:]
        elif at := re.match(r"@@ .* \+(\d+)", row):
            number = int(at.group(1))
        elif row.startswith("+"):
            yield name, number, row[1:].strip()
            number += 1


def total(what: str, counts: dict[str, dict]) -> str:
    every = [count for of_file in counts.values() for count in of_file.values()]
    ran = sum(count > 0 for count in every)
    return f"{what}: {ran} of {len(every)}, {100 * ran / max(len(every), 1):.1f} %"


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("info", type=Path)
    parser.add_argument("--changed", metavar="COMMIT")
    given = parser.parse_args()
    lines, branches = read(given.info, Path.cwd())
    if not lines:
        print(f"{given.info}: no line was counted", file=sys.stderr)
        return 1
    left = {name: sum(count == 0 for count in counts.values()) for name, counts in lines.items()}
    for name in sorted(left, key=lambda name: (-left[name], name)):
        print(f"{left[name]:6} left of {len(lines[name]):5}  {name}")
    print(total("lines", lines))
    print(total("branches", branches))
    if not given.changed:
        return 0
    missed = [row for row in changed_lines(given.changed) if lines.get(row[0], {}).get(row[1]) == 0]
    for name, number, text in missed:
        print(f"{name}:{number}: {text}")
    print(f"{len(missed)} lines changed since {given.changed} did not run")
    return 1 if missed else 0


if __name__ == "__main__":
    sys.exit(main())
