#!/usr/bin/env python3
"""speed.py BENCH.json OUT.md -- docs/SPEED.md: one run of urad_bench as ratios, with the error beside each time.

Times are of one core, and of no other machine; ratios within a group compare what ran in the same minute.
"""
import json
import sys
from pathlib import Path

SECONDS = {"ns": 1e-9, "us": 1e-6, "ms": 1e-3, "s": 1}

# group, what its times are of, the row that ratios are by, counters: (name in the benchmark, heading)
RELATIVE = [("rel_median", "median"), ("rel_p95", "p95"), ("rel_p99", "p99"), ("rms", "RMS of F")]
GROUPS = [
    ("pair/cube", "A pair of cube7", "lambert:3", RELATIVE + [("m0_instructions", "M0 instructions")]),
    ("pair/free", "A pair of free quads", "lambert:3", RELATIVE),
    ("pair/room", "A pair of walls of a room", "lambert:3", RELATIVE),
    ("rows", "All 86,436 factors of cube7", "lambert:3, double, every pair", [("rms", "RMS of F"), ("max", "worst")]),
    ("hemicube/cube7", "A shot in cube7", "64", [("f_std", "std of F"), ("b_rms", "B rms"), ("m0_shot", "M0 instructions")]),
    ("hemicube/cornell", "A shot in the Cornell box", "64", [("f_std", "std of F"), ("b_rms", "B rms")]),
    ("solve/cube7", "Light of cube7 to 1 %", "hemicube:64", [("b_rms", "B rms"), ("b_max", "B worst"), ("ram", "bytes of RAM"), ("shots", "shots")]),
    ("solve/cornell", "Light of the Cornell box to 1 %", "hemicube:64", [("b_rms", "B rms"), ("b_max", "B worst"), ("ram", "bytes of RAM"), ("shots", "shots")]),
]


def time_text(seconds: float) -> str:
    for unit, scale in (("s", 1), ("ms", 1e-3), ("us", 1e-6)):
        if seconds >= scale:
            return f"{seconds / scale:.3g} {unit}"
    return f"{seconds * 1e9:.3g} ns"


def number(value: float | None) -> str:
    if value is None:
        return "-"
    return f"{value:,.0f}" if value >= 100 else f"{value:.2g}"


def table(runs: dict, group: str, base: str, counters: list) -> str:
    rows = {name.removeprefix(group + "/").removesuffix("/iterations:1"): run
            for name, run in runs.items() if name.startswith(group + "/")}
    text = "| way | time | by that of " + base + " | " + " | ".join(heading for _, heading in counters) + " |\n"
    text += "| --- |" + " ---: |" * (len(counters) + 2) + "\n"
    for name, run in rows.items():
        cells = [name, time_text(run["seconds"]), f"{run['seconds'] / rows[base]['seconds']:.2g}"]
        text += "| " + " | ".join(cells + [number(run.get(counter)) for counter, _ in counters]) + " |\n"
    return text


def goals(runs: dict) -> str:
    def rows(most_rms: float, wanted: str) -> tuple:
        """The fastest of the cube's rows that is accurate enough."""
        return min((run["seconds"], name) for name, run in runs.items()
                   if name.startswith("rows/") and wanted in name and run["rms"] <= most_rms)

    lambert = runs["rows/lambert:3, double, every pair"]["seconds"]
    fast, fast_name = rows(1e-6, "lanes")
    auto, auto_name = rows(5e-6, "each pair once")
    reference = runs["pair/free/reference"]["seconds"]
    lines = [
        ("all factors of cube7, RMS <= 1e-6, one core, no pose table, by Lambert's formula at 3 x 3 points", ">= 10 times faster",
         f"{lambert / fast:.0f} times: {time_text(fast)} (`{fast_name}`)", lambert / fast >= 10),
        ("a factor by auto without lanes, cube RMS <= 5e-6", "<= 100 ns",
         f"{auto / 86436 * 1e9:.0f} ns (`{auto_name}`)", auto / 86436 <= 100e-9),
        ("the reference, free quads", "<= 15 us", time_text(reference), reference <= 15e-6),
    ]
    text = "| what | goal | measured | met |\n| --- | --- | --- | --- |\n"
    for what, goal, measured, met in lines:
        text += f"| {what} | {goal} | {measured} | {'yes' if met else '**no**'} |\n"
    return text


def main() -> None:
    data = json.loads(Path(sys.argv[1]).read_text())
    runs = {}
    for run in data["benchmarks"]:
        runs[run["name"]] = run | {"seconds": run["cpu_time"] * SECONDS[run["time_unit"]]}
    context = data["context"]
    text = f"""# Speed on a host

Written by `./run bench` (bench/speed.py) from one run on one core at {context["mhz_per_cpu"]:,} MHz, the error beside each time. Ratios are what
carries over to other machines. Instructions on chips are counted one by one: [BUDGET.md](BUDGET.md), [METHODS.md](METHODS.md), where
the figures of other programs stand, too. lambert, gauss, kernel and moment are in double, one pair at a time, moments and all; fixed, net, auto,
hemicube and hybrid are the engine's integers; legacy is the network of 1996.

## Goals

{goals(runs)}
Why auto takes what it takes without lanes, and what was tried: docs/DESIGN.md, "One pair on a host".
"""
    for group, title, base, counters in GROUPS:
        text += f"\n## {title}\n\n`{group}`\n\n{table(runs, group, base, counters)}"
    Path(sys.argv[2]).write_text(text)


if __name__ == "__main__":
    main()
