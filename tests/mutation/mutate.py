#!/usr/bin/env python3
"""mutate.py BUILD WORK OUT.md [--seed N] [--each N] [--minutes M] [--jobs J] [FILE...] -- changes one operator or constant of the engine at a time
and runs the tests that kernels.txt names for that file; a mutant that they let pass is a survivor.

BUILD is a release build whose test objects are linked against the engine as a shared library, so that a mutant costs its
compilation and the quickest test that fails. As in the sanitized half of `./run test`, undefined arithmetic and indices
beyond an array trap. A mutant that the compiler makes the same object code of, byte for byte, is the original and does not
count. Of every file, N mutants are drawn with a printed seed (--each 0: all), and taken in turn, one of every file after
another; when the minutes are up, those left are not counted. Survivors must be in survivors.txt, with the reason why nothing
can tell them from the original; the others are printed.
"""
import argparse
import os
import random
import re
import shutil
import subprocess
import sys
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from mutants import mutants_of

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent.parent
ENGINE = ROOT / "firmware_style"
COMPILE = ("g++ -std=c++17 -O2 -w -fPIC -ffreestanding -fno-exceptions -fno-rtti -fno-threadsafe-statics -nostdinc++ "
           "-ffp-contract=off -DURAD_CHECKED=1 -c").split()
TRAPS = "-fsanitize=undefined -fno-sanitize=vptr,null,alignment,nonnull-attribute -fsanitize-undefined-trap-on-error".split()
SECONDS = 180  # of one test file, in which a busy machine runs it; beyond, the mutant hangs
SAME = "same object code"  # instead of the test that killed it
DATA = {"cheapest_models.hpp"}  # tables of a fit: no constant is more right than its neighbour


def table(name: str) -> list[list[str]]:
    rows = (line.split(" # ")[0] for line in (HERE / name).read_text().replace("\\\n", " ").splitlines())
    return [[cell.strip() for cell in row.split(" | ")] for row in rows if row.strip() and row[0] != "#"]


def compile_source(source: Path, out: Path, *options) -> bool:
    return subprocess.run([*COMPILE, *options, "-I", ENGINE / "include", source, "-o", out], capture_output=True).returncode == 0


def engine_objects(folder: Path, *options) -> Path:
    folder.mkdir(parents=True, exist_ok=True)
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        done = list(pool.map(lambda s: compile_source(s, folder / (s.stem + ".o"), *options),
                             sorted((ENGINE / "src").glob("*.cpp"))))
    if not all(done):
        raise SystemExit("the engine does not compile")
    return folder


def compile_test(test: str, out: Path, *options) -> bool:
    """With all its inline functions: those that no test calls are not the same."""
    return subprocess.run(["g++", "-std=c++20", "-O2", "-w", "-fkeep-inline-functions", *options, "-I", ENGINE / "include",
                           "-c", ROOT / "tests" / (test + ".cpp"), "-o", out], capture_output=True).returncode == 0


def failure(test: str, command: list, folder: Path) -> str | None:
    """The test's name where its program fails, with the engine in that folder."""
    try:
        run = subprocess.run(command, env={**os.environ, "LD_LIBRARY_PATH": str(folder)}, capture_output=True,
                             timeout=SECONDS, cwd=folder)
    except subprocess.TimeoutExpired:
        return test + " (hangs)"
    return test if run.returncode != 0 else None


class Bench:
    """The engine as objects, and the test program that loads them as a library."""

    def __init__(self, build: Path, work: Path, tests: set[str], header_tests: set[str]):
        self.work, self.build = work, build
        self.plain, self.objects = engine_objects(work / "plain"), engine_objects(work / "objects", *TRAPS)
        (work / "headers").mkdir(exist_ok=True)
        for test in header_tests:
            compile_test(test, work / "headers" / (test + ".o"))
        subprocess.run(["g++", "-std=c++20", "-c", ROOT / "tests/main.cpp", "-o", work / "headers/main.o"], check=True)
        (work / "original").mkdir(exist_ok=True)
        self.link(work / "original", {})
        command = subprocess.run(["ninja", "-C", build, "-t", "commands", "tests/urad_tests"], capture_output=True,
                                 text=True, check=True).stdout.splitlines()[-1]
        command = re.sub(r"\S*/(\w+_test)\.cpp\.o", lambda m: m[0] if m[1] in tests else "", command)
        command = command.replace("-o tests/urad_tests", f"-o {work}/tests")
        command = command.replace("firmware_style/liburad.a", f"-L{work}/original -lurad")
        subprocess.run(command, shell=True, cwd=build, check=True)

    def link(self, folder: Path, replaced: dict[str, Path]):
        objects = [replaced.get(o.name, o) for o in sorted(self.objects.glob("*.o"))]
        subprocess.run(["g++", "-shared", "-nostdlib", "-Wl,-Bsymbolic", "-o", folder / "liburad.so", *objects, "-lgcc"],
                       check=True)

    def killed_by(self, folder: Path, tests: list[str]) -> str | None:
        """The first of the test files that fails; "a,b" are run together."""
        for test in tests:
            files = ",".join(f"*/{file}.cpp" for file in test.split(","))
            if killer := failure(test, [self.work / "tests", f"--source-file={files}", "--abort-after=1", "--minimal"], folder):
                return killer
        return None

    def dependents(self, header: str) -> list[Path]:
        """Sources that include a header of src, by whatever way."""
        reached, sources = {header}, set()
        while True:
            more = set()
            for path in (ENGINE / "src").iterdir():
                includes = set(re.findall(r'#include "([\w.]+)"', path.read_text()))
                if includes & reached and path.name not in reached:
                    more.add(path.name)
            if not more:
                return [ENGINE / "src" / name for name in sorted(reached) if name.endswith(".cpp")]
            reached |= more

    def run(self, mutant, folder: Path, tests: list[str]) -> str | None:
        """Who killed it; "" when it does not compile; None: nobody."""
        path = next(p for p in (ENGINE / "src" / mutant.file, ENGINE / "include/urad" / mutant.file) if p.exists())
        shutil.rmtree(folder, ignore_errors=True)
        folder.mkdir(parents=True)
        changed = folder / mutant.file
        if path.parent.name == "urad":
            return self.run_header(mutant, path, folder, tests)
        changed.write_text(mutant.apply(path.read_text()))
        sources = [path] if path.suffix == ".cpp" else self.dependents(mutant.file)
        for beside in [*sources, *(ENGINE / "src").glob("*.hpp")]:  # a quoted include looks beside the source first
            if beside != path:
                shutil.copy(beside, folder)
        replaced = {}
        for name in (source.name for source in sources):
            target = folder / Path(name).with_suffix(".o")
            if not compile_source(folder / name, target):
                return ""
            if target.read_bytes() != (self.plain / target.name).read_bytes():
                compile_source(folder / name, target, *TRAPS)
                replaced[target.name] = target
        if not replaced:
            return SAME
        self.link(folder, replaced)
        return self.killed_by(folder, tests)

    def run_header(self, mutant, path: Path, folder: Path, tests: list[str]) -> str | None:
        """Headers that hold a whole kernel: the test file itself is compiled with the mutant."""
        (folder / "urad").mkdir()
        (folder / "urad" / mutant.file).write_text(mutant.apply(path.read_text()))
        different = False
        for test in tests:
            plain, trapping, program = (folder / (test + end) for end in (".o", "_traps.o", ""))
            if not compile_test(test, plain, "-I", folder):
                return ""
            if plain.read_bytes() == (self.work / "headers" / plain.name).read_bytes():
                continue
            different = True
            compile_test(test, trapping, "-I", folder, *TRAPS)
            subprocess.run(["g++", trapping, self.work / "headers/main.o", "-o", program], check=True)
            if killer := failure(test, [program, "--abort-after=1", "--minimal"], folder):
                return killer
        return None if different else SAME


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("build", type=Path)
    parser.add_argument("work", type=Path)
    parser.add_argument("out", type=Path)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--each", type=int, default=12)
    parser.add_argument("--minutes", type=float, default=25)
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("files", nargs="*")
    options = parser.parse_intermixed_args()
    tests = {row[0]: row[1].split() for row in table("kernels.txt")}
    first = tests.pop("first")
    excused = {(row[0], row[1], row[2]): row[3] for row in table("survivors.txt")}
    sources = {p.name for p in [*(ENGINE / "src").glob("*.[ch]pp")] if mutants_of(p)}
    if unknown := sources - set(tests) - DATA:
        raise SystemExit(f"kernels.txt names no tests of {', '.join(sorted(unknown))}")
    if options.files:
        tests = {file: tests[file] for file in options.files}
    alone_files = {file for file in tests if (ENGINE / "include/urad" / file).exists()}
    linked, alone = ({t for file, names in tests.items() if (file in alone_files) == header for t in names}
                     for header in (False, True))
    linked |= set(first)
    bench = Bench(options.build.resolve(), options.work.resolve(), linked, alone)

    def seconds_of(test: str) -> float:
        start = time.monotonic()
        if bench.killed_by(bench.work / "original", [test]):
            raise SystemExit(f"{test} fails with the engine as it is")
        return time.monotonic() - start

    with ThreadPoolExecutor(options.jobs) as pool:
        seconds = dict(zip(sorted(linked), pool.map(seconds_of, sorted(linked))))
    for file in set(tests) - alone_files:
        tests[file] = [",".join(first), *sorted(set(tests[file]) - set(first), key=lambda test: seconds[test])]
    chosen, all_count = [], 0
    for file in sorted(tests):
        path = next(p for p in (ENGINE / "src" / file, ENGINE / "include/urad" / file) if p.exists())
        found = mutants_of(path)
        all_count += len(found)
        draw = random.Random(f"{options.seed} {file}")
        chosen += enumerate(draw.sample(found, min(options.each or len(found), len(found))))
    chosen = [mutant for _, mutant in sorted(chosen, key=lambda turn: turn[0])]
    print(f"seed {options.seed}: {len(chosen)} of {all_count} mutants", flush=True)

    end = time.monotonic() + 60 * options.minutes

    def judge(numbered):
        number, mutant = numbered
        if time.monotonic() > end:
            return None
        folder = bench.work / f"mutant_{number}"
        killer = bench.run(mutant, folder, tests[mutant.file])
        shutil.rmtree(folder)
        if killer is None:
            reason = excused.get((mutant.file, mutant.text, f"{mutant.old} -> {mutant.new}"))
            print(f"survives{': ' + reason if reason else ''} | {mutant.name} | {mutant.text}", flush=True)
        return mutant, killer

    with ThreadPoolExecutor(options.jobs) as pool:
        results = [result for result in pool.map(judge, enumerate(chosen)) if result]
    write(options, all_count, results, excused)


def write(options, all_count, results, excused):
    viable = [(m, k) for m, k in results if k not in ("", SAME)]
    reason = {m: excused.get((m.file, m.text, f"{m.old} -> {m.new}")) for m, k in viable if k is None}
    files = f" of {', '.join(options.files)}" if options.files else ""
    not_compiled, same = (sum(k == what for _, k in results) for what in ("", SAME))
    rows = [f"Seed {options.seed}, {'all' if not options.each else f'up to {options.each}'} mutants a file{files}, "
            f"{options.minutes:g} minutes at most: {len(results)} of {all_count:,}. {not_compiled} do not compile, "
            f"{same} have the object code of the original; neither count.", "",
            "| kind | mutants | killed | equivalent | survive | killed of those that differ | goal |",
            "| --- | --: | --: | --: | --: | --: | --: |"]
    for kind in ("arithmetic", "comparison", "constant", "all"):
        of_kind = [(m, k) for m, k in viable if kind in (m.kind, "all")]
        killed = sum(k is not None for _, k in of_kind)
        same = sum(k is None and bool(reason[m]) for m, k in of_kind)
        differ = len(of_kind) - same
        rows.append(f"| {kind} | {len(of_kind)} | {killed} | {same} | {differ - killed} | "
                    f"{100 * killed / max(differ, 1):.1f} % | {'95 %' if kind == 'all' else ''} |")
    if reason:
        rows += ["", "| survivor | line | why |", "| --- | --- | --- |"]
        rows += [f"| {m.name} | `{m.text}` | {why or 'no test tells'} |".replace("||", "\\|\\|") for m, why in reason.items()]
    options.out.parent.mkdir(parents=True, exist_ok=True)
    options.out.write_text("\n".join(rows) + "\n")
    print("\n".join(rows[:8]))


if __name__ == "__main__":
    main()
