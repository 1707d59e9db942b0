#!/usr/bin/env python3
"""bounds.py ENGINE WORK OUT.md -- the deepest stack and the most loop passes of every entry of urad.h, without running it.

Compiles the engine for a Cortex-M0 with call graphs: -Os for the stack of what ships, -O0 for calls as the source has
them. Exits where a function can reach itself, has a frame that is not static, calls through a pointer that calls.txt does
not know, or holds a loop whose bound loops.txt does not state.
"""
import re
import shutil
import subprocess
import sys
from collections import Counter
from pathlib import Path

import call_graph
import loops

HERE = Path(__file__).resolve().parent
FLAGS = ("-mcpu=cortex-m0 -mthumb -std=c++17 -ffreestanding -fno-exceptions -fno-rtti -fno-threadsafe-statics "
         "-nostdinc++ -ffp-contract=off -ffunction-sections -fcallgraph-info=su -c").split()
# One scene to put numbers to the bounds: the cube of docs/BUDGET.md with blockers.
SCENE = dict(P=294, S=6, N=49, G=1, X=7, Y=7, B=12, V=4, W=48, M=7, R=16, C=64, Q=4, U=16, H=12, I=14, L=3, K=1000, D=8, Z=6000)


def compile_engine(engine: Path, work: Path, level: str) -> Path:
    folder = work / level
    shutil.rmtree(folder, ignore_errors=True)
    shutil.copytree(engine, folder, ignore=shutil.ignore_patterns("ports"))
    engine = folder
    if level == "O0":  # what is always inlined would not be in the graph
        for path in [*folder.glob("src/*"), *folder.glob("include/urad/*")]:
            path.write_text(path.read_text().replace("[[gnu::always_inline]]", " " * len("[[gnu::always_inline]]")))
    for source in sorted((engine / "src").glob("*.cpp")):
        target = folder / (source.stem + ".o")
        subprocess.run(["arm-none-eabi-g++", *FLAGS, f"-{level}", "-I", engine / "include", source, "-o", target],
                       check=True)
    return folder


def library_frames(names: set[str]) -> dict[str, int]:
    """Stack of what the compiler itself calls, its own calls included: all pushes and subtractions of its code."""
    path = subprocess.run("arm-none-eabi-gcc -mcpu=cortex-m0 -mthumb -print-libgcc-file-name".split(),
                          capture_output=True, text=True, check=True).stdout.strip()
    libc = subprocess.run("arm-none-eabi-gcc -mcpu=cortex-m0 -mthumb -print-file-name=libc.a".split(),
                          capture_output=True, text=True, check=True).stdout.strip()
    code: dict[str, list[str]] = {}
    for library in (path, libc):
        if not Path(library).is_file():
            continue  # no C library: the caller brings memcpy and memset
        text = subprocess.run(["arm-none-eabi-objdump", "-d", library], capture_output=True, text=True).stdout
        for name, body in re.findall(r"^[0-9a-f]+ <(\w+)>:\n((?:.+\n)*)", text, re.M):
            code.setdefault(name, body.splitlines())

    def frame(name, above=()):
        total, deepest = 0, 0
        for line in code.get(name, []):
            if push := re.search(r"\tpush\t\{(.*)\}", line):
                total += 4 * sum(1 + (int(b[1:]) - int(a[1:])) if b else 1
                                 for a, b in re.findall(r"(\w+)(?:-(\w+))?", push[1]))
            elif sub := re.search(r"\tsub\tsp, #(\d+)", line):
                total += int(sub[1])
            elif (call := re.search(r"\t(?:bl|b\.n|b\.w)\t\w+ <(\w+)>", line)) and call[1] not in (name, *above):
                deepest = max(deepest, frame(call[1], (name, *above)))
        return total + deepest

    return {name: frame(name) for name in names if name in code}


def read_table(name: str) -> list[list[str]]:
    rows = (line.split("#")[0].strip() for line in (HERE / name).read_text().splitlines())
    return [[cell.strip() for cell in row.split("|")] for row in rows if row]


# ---- how often: polynomials in the sizes of a scene, {(symbols): factor} ----------------------------------------------

def polynomial(text: str) -> dict:
    sum_ = Counter()
    for term in text.split("+"):
        factor, symbols = 1, []
        for word in term.split():
            if word.isdigit():
                factor *= int(word)
            elif word in SCENE:
                symbols.append(word)
            else:
                raise SystemExit(f"loops.txt: {word} in '{text}' is no number and none of {' '.join(SCENE)}")
        sum_[tuple(sorted(symbols))] += factor
    return dict(sum_)


def times(a: dict, b: dict) -> dict:
    product = Counter()
    for s, x in a.items():
        for t, y in b.items():
            product[tuple(sorted(s + t))] += x * y
    return dict(product)


def most(a: dict, b: dict) -> dict:
    return {s: max(a.get(s, 0), b.get(s, 0)) for s in {*a, *b}}


def written(p: dict) -> str:
    """Of highest degree, then what no other term can cover."""
    def covered(s):
        return any(s != t and not Counter(s) - Counter(t) and p[t] >= 1 for t in p)
    terms = sorted((s for s in p if not covered(s)), key=lambda s: (-len(s), s))
    return " + ".join(" ".join([*([f"{p[s]:,}"] if p[s] > 1 or not s else []), *s]) for s in terms) or "0"


def value(p: dict) -> int:
    total = 0
    for symbols, factor in p.items():
        for symbol in symbols:
            factor *= SCENE[symbol]
        total += factor
    return total


class LoopCount:
    """Passes of all loops, from the call graph without optimization and the loops of the source."""

    def __init__(self, engine: Path, functions):
        self.functions = functions
        self.text, self.loops, self.ranges = {}, {}, {}
        rows = read_table("loops.txt")
        self.stated = {(row[0], row[1]): row[2] for row in rows}
        self.used = set()
        for path in [*sorted((engine / "src").glob("*.*")), *sorted((engine / "include/urad").glob("*.hpp"))]:
            name = path.name
            self.text[name] = loops.blank_comments(path.read_text())
            self.loops[name] = loops.find_loops(path, name)
        for title, function in functions.items():
            if function.frame is not None and Path(function.file).name in self.text:
                name = Path(function.file).name
                self.ranges[title] = (name, *loops.body_range(self.text[name], function.line, function.column))
        self.assign()

    def bound_of(self, loop: loops.Loop) -> dict:
        if loop.limit and loop.limit.isdigit():
            return polynomial(loop.limit)
        for key in ((loop.file, loop.header), (loop.file, loop.limit), ("*", loop.limit)):
            if key[1] and key in self.stated and (key[0] != "*" or loop.limit):
                self.used.add(key)
                return polynomial(self.stated[key])
        self.missing.append(f"{loop.file}:{loop.line} | {loop.limit or loop.header}")
        return {(): 1}

    def assign(self):
        """Every loop to the innermost function around it; what lies in none runs in the compiler only."""
        self.missing, self.at_compile_time, self.own = [], [], {}
        for name, found in self.loops.items():
            for loop in found:
                around = [(end - begin, title) for title, (file, begin, end) in self.ranges.items()
                          if file == name and begin <= loop.begin < end]
                if not around:
                    self.at_compile_time.append(loop)
                    continue
                loop.bound = self.bound_of(loop)
                smallest = min(around)[0]
                for size, title in around:
                    if size == smallest:
                        self.own.setdefault(title, []).append(loop)
        if self.missing:
            raise SystemExit("loops.txt states no bound for\n" + "\n".join(self.missing))
        if unused := [key for key in self.stated if key not in self.used]:
            raise SystemExit("loops.txt: no loop is\n" + "\n".join(" | ".join(key) for key in unused))

    def nest(self, title, name, offset) -> dict:
        product = {(): 1}
        for loop in self.own.get(title, []):
            if loop.file == name and loop.begin < offset < loop.end:
                product = times(product, loop.bound)
        return product

    def offset(self, name, line, column) -> int:
        return sum(len(row) + 1 for row in self.text[name].split("\n")[:line - 1]) + column - 1

    def passes(self, order) -> dict:
        total = {}
        for title in order:
            sum_, either = Counter(), {}
            for loop in self.own.get(title, []):
                sum_.update(times(self.nest(title, loop.file, loop.begin), loop.bound))
            for callee, file, line, column, *through_pointer in self.functions[title].calls:
                if callee not in total:
                    continue
                name = Path(file).name
                nest = self.nest(title, name, self.offset(name, line, column)) if name in self.text else {(): 1}
                if through_pointer:
                    either = most(either, times(nest, total[callee]))
                else:
                    sum_.update(times(nest, total[callee]))
            sum_.update(either)
            total[title] = dict(sum_)
        return total


def stacks(functions, order, library) -> dict:
    """title -> (bytes, path of titles)"""
    deepest = {}
    for title in order:
        function = functions[title]
        own = function.frame if function.frame is not None else library.get(title)
        if own is None:
            raise SystemExit(f"{title}: the size of its frame is known to nobody")
        below = max((deepest[call[0]] for call in function.calls if call[0] in deepest), default=(0, ()))
        deepest[title] = (own + below[0], (title, *below[1]))
    return deepest


def main():
    engine, work, out = map(Path, sys.argv[1:4])
    sites = {row[0]: row[1].split() for row in read_table("calls.txt")}
    shipped = call_graph.read(compile_engine(engine, work, "Os"))
    call_graph.resolve_indirect(shipped, sites)
    outside = {t for t, f in shipped.items() if f.frame is None and t != call_graph.INDIRECT}
    # Libraries of other folders define what one folder only declares.
    library = library_frames({t for t in outside if not t.startswith("_ZN")})
    shipped.pop(call_graph.INDIRECT, None)
    deepest = stacks(shipped, call_graph.in_order(shipped), library)
    plain = call_graph.read(compile_engine(engine, work, "O0"))
    call_graph.resolve_indirect(plain, sites)
    plain.pop(call_graph.INDIRECT, None)
    count = LoopCount(engine, plain)
    passes = count.passes(call_graph.in_order(plain))
    entries = sorted(t for t, f in shipped.items() if re.fullmatch(r"urad_\w+", t) and f.frame is not None)
    in_code = sum(len(found) for found in count.loops.values()) - len(count.at_compile_time)
    counted = sum(loop.limit is not None for found in count.loops.values() for loop in found if loop.bound)
    lines = [
        f"{sum(f.frame is not None for f in shipped.values())} functions for a Cortex-M0 at -Os, {len(entries)} entries: "
        "no function reaches itself, every frame is static.",
        f"{in_code} loops: {counted} count to a limit and leave their counter alone, {in_code - counted} have bound and "
        "reason in tests/bounds/loops.txt;",
        f"{len(count.at_compile_time)} more run in compilers and exporters only. Passes: the sum over all loops below an "
        "entry, each run to its end, whatever its run of",
        "factors holds; of the polynomial, the terms that no other covers, and its value for a scene with",
        " ".join(f"{symbol} = {value:,}" for symbol, value in SCENE.items()) + " (tests/bounds/loops.txt names them).",
        "",
        "| entry | stack, bytes | most of it in | passes of loops, at most | in that scene |",
        "| --- | --: | --- | --- | --: |",
    ]
    for entry in entries:
        bytes_, path = deepest[entry]
        widest = max(path, key=lambda t: shipped[t].frame or 0)
        lines.append(f"| {entry} | {bytes_:,} | {shipped[widest].short} ({shipped[widest].frame or 0:,}) | {written(passes[entry])} | "
                     f"{value(passes[entry]):,} |")
    out.parent.mkdir(parents=True, exist_ok=True)
    out.write_text("\n".join(lines) + "\n")
    worst = max(entries, key=lambda e: deepest[e][0])
    print(f"{len(entries)} entries, deepest stack {deepest[worst][0]} bytes ({worst}), {in_code} loops, all bounded")


if __name__ == "__main__":
    main()
