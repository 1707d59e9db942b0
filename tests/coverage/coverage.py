#!/usr/bin/env python3
"""coverage.py engine|host BUILD OUT.md -- which branches the tests took, from what the counted tests have left in BUILD.

The engine's sources and headers must have every branch taken, or an excuse in excuses.txt: gcov's branches, of an engine that
is not optimized (BUILD/tests, urad_counted). Exits where one has neither, or where an excuse is needed no more.
The host's libraries are shown: both sides of every condition of the source, as clang counts them (BUILD/coverage). What is
decided when it is compiled is none.
"""
import json
import subprocess
import sys
from collections import Counter
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent.parent


def output(*command) -> str:
    return subprocess.run(command, capture_output=True, text=True, check=True).stdout


def of_engine(counts: Path) -> dict[str, list]:
    """file -> [(line, branches, taken, executed)]"""
    text = output("gcovr", "--root", ROOT, "--filter", f"{ROOT}/firmware_style/", "--exclude-throw-branches", "--json", "-",
                  "--gcov-ignore-parse-errors", counts)
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


def of_host(build: Path) -> dict[str, tuple]:
    """file -> (branches, taken, lines, executed). A condition of a template is one, whatever it was made of."""
    merged = build / "host.profdata"
    output("llvm-profdata", "merge", "-o", merged, *sorted((build / "profiles").glob("*.profraw")))
    text = output("llvm-cov", "export", build / "tests/urad_tests", "-instr-profile", merged)
    files = {}
    for file in json.loads(text)["data"][0]["files"]:
        path = Path(file["filename"]).resolve()
        if not path.is_relative_to(ROOT / "host/lib"):
            continue
        sides, lines, text = {}, file["summary"]["lines"], path.read_text().splitlines()
        for branch in file["branches"]:
            if "if constexpr" in text[branch[0] - 1]:
                continue
            place, (true, false) = tuple(branch[:4]), branch[4:6]
            before = sides.get(place, (0, 0))
            sides[place] = (before[0] + true, before[1] + false)
        taken = sum((true > 0) + (false > 0) for true, false in sides.values())
        files[str(path.relative_to(ROOT))] = (2 * len(sides), taken, lines["count"], lines["covered"])
    return files


def in_all(files) -> tuple[int, int, int, int]:
    return tuple(sum(column) for column in zip(*files))


def share(part: int, whole: int) -> str:
    return f"{100 * part / whole:.2f} %" if whole else "-"


def excuses() -> dict:
    """(file, text of the line) -> (branches, reason)"""
    rows = [line.split(" | ") for line in (HERE / "excuses.txt").read_text().splitlines() if line and line[0] != "#"]
    return {(row[0].strip(), row[1].strip()): (int(row[2]), row[3].strip()) for row in rows}


def engine_report(build: Path) -> tuple[list, list]:
    """Rows of its table; what is wrong."""
    engine = of_engine(build / "tests/CMakeFiles/urad_counted.dir")
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
    branches, taken, lines, executed = in_all(
        (row[1], row[2], 1, row[3]) for rows in engine.values() for row in rows)
    reasons = sum(used.values()) + promises
    rows = [
        "| what | branches | taken by tests | excused | goal | lines run |",
        "| --- | --: | --: | --: | --: | --: |",
        f"| firmware_style | {branches:,} | {share(taken, branches)} | {reasons} | 100 % with the excused "
        f"({share(taken + reasons, branches)}) | {share(executed, lines)} |",
        "",
        f"{promises} of the excused are sides of `expect(...)`: promises of callers, which trap in checked builds "
        "and are no code in others.",
    ]
    if missing:
        lacking = Counter(Path(row.split(":")[0]).name for row in missing)
        rows += ["", "| file of the engine | lines with a branch that no test takes, and no excuse |", "| --- | --: |"]
        rows += [f"| {file} | {count} |" for file, count in lacking.most_common()]
    if used:
        rows += ["", "| excused branch of the engine | why no test can take it |", "| --- | --- |"]
        rows += [f"| {file}: `{text}` | {excused[file, text][1]} |".replace("||", "\\|\\|")
                 for file, text in sorted(used)]
    return rows, missing + [f"excuses.txt: needed no more: {' | '.join(key)}" for key in excused if key not in used]


def host_report(build: Path) -> tuple[list, list]:
    host = of_host(build / "coverage")
    folders = {file.rsplit("/", 1)[0] for file in host}
    rows = ["| what | branches | taken by tests | goal | lines run |", "| --- | --: | --: | --: | --: |"]
    for folder in ["host/lib", *sorted(folders)]:
        branches, taken, lines, executed = in_all(
            counts for file, counts in host.items() if file.startswith(folder + "/"))
        rows.append(f"| {folder} | {branches:,} | {share(taken, branches)} | {'90 %' if folder == 'host/lib' else '-'} | "
                    f"{share(executed, lines)} |")
    return rows, []


def main():
    part, build, out = sys.argv[1], Path(sys.argv[2]), Path(sys.argv[3])
    rows, wrong = engine_report(build) if part == "engine" else host_report(build)
    out.parent.mkdir(parents=True, exist_ok=True)
    out.write_text("\n".join(rows) + "\n")
    print("\n".join(rows[:3]))
    if wrong:
        raise SystemExit("\n".join(wrong))


if __name__ == "__main__":
    main()
