#!/usr/bin/env python3
"""coverage.py BUILD OUT.md -- which branches the tests took, from the counts that an instrumented build has left in BUILD.

The engine's sources and headers must have every branch taken, or an excuse in excuses.txt. Exits where one has neither, or
where an excuse is needed no more. The host's libraries are shown, without branches that only exceptions take.
"""
import json
import subprocess
import sys
from collections import Counter
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent.parent


def counted(build: Path, *wanted: str) -> dict[str, list]:
    """file -> [(line, branches, taken, executed)]"""
    filters = [option for folder in wanted for option in ("--filter", f"{ROOT}/{folder}/")]
    text = subprocess.run(
        ["gcovr", "--root", ROOT, *filters, "--exclude-throw-branches", "--json", "-", "--gcov-ignore-parse-errors", build],
        capture_output=True, text=True, check=True).stdout
    files = {}
    for file in json.loads(text)["files"]:
        rows = []
        for line in file["lines"]:
            if line.get("gcovr/noncode"):
                continue
            branches = line["branches"]
            rows.append((line["line_number"], len(branches), sum(b["count"] > 0 for b in branches), line["count"] > 0))
        files[file["file"]] = rows
    return files


def sums(files: dict) -> tuple[int, int, int, int]:
    rows = [row for lines in files.values() for row in lines]
    return (sum(r[1] for r in rows), sum(r[2] for r in rows), len(rows), sum(r[3] for r in rows))


def share(part: int, whole: int) -> str:
    return f"{100 * part / whole:.2f} %" if whole else "-"


def excuses() -> dict:
    """(file, text of the line) -> (branches, reason)"""
    rows = [line.split(" | ") for line in (HERE / "excuses.txt").read_text().splitlines() if line and line[0] != "#"]
    return {(row[0].strip(), row[1].strip()): (int(row[2]), row[3].strip()) for row in rows}


def main():
    build, out = Path(sys.argv[1]), Path(sys.argv[2])
    engine = counted(build / "firmware_style", "firmware_style")
    host = counted(build / "host/CMakeFiles/urad_host.dir", "host/lib")
    excused, missing, used, promises = excuses(), [], {}, 0
    for file, rows in sorted(engine.items()):
        text = (ROOT / file).read_text().splitlines()
        for number, branches, taken, executed in rows:
            if taken == branches and executed:
                continue
            key = (Path(file).name, text[number - 1].strip())
            if key[1].startswith("expect("):  # traps where a caller breaks its word; no branch of other builds
                promises += branches - taken
                continue
            if key in excused and branches - taken <= excused[key][0]:
                used[key] = branches - taken
            else:
                missing.append(f"{file}:{number}: {branches - taken} of {branches} branches never taken | {key[1]}")
    unused = [" | ".join(key) for key in excused if key not in used]
    branches, taken, lines, executed = sums(engine)
    host_branches, host_taken, host_lines, host_executed = sums(host)
    reasons = sum(used.values()) + promises
    rows = [
        "| what | branches | taken by tests | excused | goal | lines run |",
        "| --- | --: | --: | --: | --: | --: |",
        f"| firmware_style | {branches:,} | {share(taken, branches)} | {reasons} | 100 % with the excused "
        f"({share(taken + reasons, branches)}) | {share(executed, lines)} |",
        f"| host/lib | {host_branches:,} | {share(host_taken, host_branches)} | - | 90 % | "
        f"{share(host_executed, host_lines)} |",
    ]
    for folder in sorted({file.rsplit("/", 1)[0] for file in host}):
        part = sums({file: r for file, r in host.items() if file.rsplit("/", 1)[0] == folder})
        rows.append(f"| {folder} | {part[0]:,} | {share(part[1], part[0])} | - | - | {share(part[3], part[2])} |")
    rows += ["", f"{promises} of the excused are sides of `expect(...)`: promises of callers, which trap in checked builds "
             "and are no code in others."]
    if missing:
        lacking = Counter(Path(row.split(":")[0]).name for row in missing)
        rows += ["", "| file of the engine | lines with a branch that no test takes, and no excuse |", "| --- | --: |"]
        rows += [f"| {file} | {count} |" for file, count in lacking.most_common()]
    if used:
        rows += ["", "| excused branch of the engine | why no test can take it |", "| --- | --- |"]
        rows += [f"| {file}: `{text}` | {excused[file, text][1]} |".replace("||", "\\|\\|")
                 for file, text in sorted(used)]
    out.parent.mkdir(parents=True, exist_ok=True)
    out.write_text("\n".join(rows) + "\n")
    print("\n".join(rows[:4]))
    if missing or unused:
        print("\n".join(missing))
        print("".join(f"excuses.txt: needed no more: {row}\n" for row in unused), end="")
        raise SystemExit(f"{len(missing)} lines of the engine have branches that no test takes")


if __name__ == "__main__":
    main()
