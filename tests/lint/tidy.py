#!/usr/bin/env python3
"""tidy.py BUILD JOBS FILE... -- clang-tidy on each file as BUILD/compile_commands.json compiles it; prints what it finds.
The engine's sources get the static analyzer as well.

Sources of a folder are looked at together, up to a dozen in a unit: their headers cost ten times what they cost themselves.
Those that cannot share a unit, since both define a name of their own, go into different ones. What a unit was found to
hold is kept in BUILD/tidy under the hash of its preprocessed text, comments and all, and of what configures clang-tidy: a
second run looks only at what has changed.
"""
import hashlib
import json
import re
import shlex
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from itertools import groupby
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent.parent
FINDING = re.compile(r"^(?:\S+: )?(?:warning|error): .*", re.M)
MOST = 12


def flags(command: dict) -> list[str]:
    words = shlex.split(command["command"])
    return words[1:words.index("-o")]


class Unit:
    """Sources one after the other, as if they were one."""

    def __init__(self, work: Path, options: list[str], files: list[str]):
        self.options = [*options, "-I", str(Path(files[0]).parent)]
        texts = [Path(file).read_text() for file in files]
        self.lines = [(file, number) for file, text in zip(files, texts) for number in range(1, text.count("\n") + 1)]
        text = "".join(texts)
        self.path = work / (hashlib.sha256("".join([*files, *options]).encode()).hexdigest()[:16] + ".cpp")
        self.path.write_text(text)

    def compile(self, *how: str) -> subprocess.CompletedProcess:
        return subprocess.run(["clang++", *self.options, "-w", *how, self.path], capture_output=True, text=True)

    def at_home(self, text: str) -> str:
        """Places in the unit become places in its sources."""
        def place(match):
            file, number = self.lines[int(match[1]) - 1]
            return f"{file}:{number}"
        return re.sub(rf"^{re.escape(str(self.path))}:(\d+)", place, text, flags=re.M)

    def apart(self, files: list[str]) -> list[str]:
        """Which of the files must leave for the rest to compile, as far as the compiler blames them."""
        text = self.path.read_bytes()
        kept = self.path.with_name(hashlib.sha256(text + " ".join(self.options).encode()).hexdigest() + ".json")
        if not kept.exists():
            tried = self.compile("-fsyntax-only", "-ferror-limit=0")
            wrong = self.at_home(tried.stderr)
            blamed = [f for f in files[1:] if re.search(rf"^{re.escape(f)}:\d+:\d+: (?:fatal )?error", wrong, re.M)]
            kept.write_text(json.dumps([] if tried.returncode == 0 else blamed or files[1:]))
        return json.loads(kept.read_text())

    def findings(self) -> str:
        preprocessed = self.compile("-E", "-C").stdout
        analyzed = ["--checks=clang-analyzer-*"] if "-ffreestanding" in self.options else []
        key = preprocessed + (ROOT / ".clang-tidy").read_text() + "".join(analyzed)
        kept = self.path.with_name(hashlib.sha256(key.encode()).hexdigest() + ".txt")
        if not kept.exists():
            run = subprocess.run(["clang-tidy", "--quiet", *analyzed, self.path, "--", *self.options], capture_output=True,
                                 text=True)
            text = "".join(f"{line}\n" for line in FINDING.findall(self.at_home(run.stdout))).replace(f"{ROOT}/", "")
            if run.returncode != 0 and not text:
                return f"error: clang-tidy ends with {run.returncode} on {self.path} [clang-tidy]\n"
            kept.write_text(text)
        return kept.read_text()


def units(work: Path, commands: list[dict]) -> list[Unit]:
    """Files of the same folder and the same flags, together as far as they compile together."""
    def kind(command):
        return str(Path(command["file"]).parent), flags(command)
    made = []
    for (_, options), group in groupby(sorted(commands, key=kind), key=kind):
        left = [c["file"] for c in group]
        while left:
            taken, left = left[:MOST], left[MOST:]
            while len(taken) > 1:
                blamed = Unit(work, options, taken).apart(taken)
                if not blamed:
                    break
                left = blamed + left
                taken = [f for f in taken if f not in blamed]
            made.append(Unit(work, options, taken))
    return made


def main():
    build, jobs = Path(sys.argv[1]).resolve(), int(sys.argv[2])
    work = build / "tidy"
    work.mkdir(exist_ok=True)
    commands = {c["file"]: c for c in json.loads((build / "compile_commands.json").read_text())}
    made = units(work, [commands[str(ROOT / file)] for file in sys.argv[3:]])
    with ThreadPoolExecutor(jobs) as pool:
        for text in pool.map(Unit.findings, made):
            print(text, end="", flush=True)


if __name__ == "__main__":
    main()
