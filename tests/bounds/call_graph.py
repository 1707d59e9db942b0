"""Call graphs as g++ writes them (-fcallgraph-info=su): functions, their frames, and who calls whom from where."""
import re
from dataclasses import dataclass, field
from pathlib import Path

INDIRECT = "__indirect_call"


@dataclass
class Function:
    name: str
    signature: str = ""
    file: str = ""
    line: int = 0
    column: int = 0
    frame: int | None = None  # bytes; None: declared only
    calls: list = field(default_factory=list)  # (callee's title, file, line, column)

    @property
    def short(self) -> str:
        """The qualified name without result, parameters and anonymous namespaces."""
        text = re.sub(r"\{anonymous\}::|\[with .*\]|constexpr |static ", "", self.signature)
        text = re.sub(r"\((?!\))[^()]*(\([^()]*\)[^()]*)*\)( const)?", "()", text)
        return text.split("()")[0].split(" ")[-1].lstrip("*&") + ("::lambda" if "<lambda" in text else "")


def _place(text):
    match = re.fullmatch(r"(.*):(\d+):(\d+)", text)
    return (match[1], int(match[2]), int(match[3])) if match else ("", 0, 0)


def read(folder: Path) -> dict[str, Function]:
    """All functions by title. Those of one translation unit alone have its path in their title."""
    functions: dict[str, Function] = {}
    for path in sorted(folder.glob("*.ci")):
        for line in path.read_text().splitlines():
            line = re.sub(r"(_ZN\w*)C1E", r"\1C2E", line)  # two names of one constructor
            if line.startswith("node:"):
                title, label = re.match(r'node: \{ title: "([^"]*)" label: "([^"]*)"', line).groups()
                function = functions.setdefault(title, Function(title.split(":")[-1]))
                parts = label.split("\\n")
                if "shape : ellipse" in line:
                    function.signature = function.signature or parts[0]
                    continue
                function.signature = parts[0]
                function.file, function.line, function.column = _place(parts[1])
                bytes_, kind = re.match(r"(\d+) bytes \((.*?)\)", parts[2]).groups()
                if kind != "static":
                    raise SystemExit(f"{parts[0]}: its frame is {kind}, not static: no bound of the stack")
                function.frame = max(function.frame or 0, int(bytes_))
            elif line.startswith("edge:"):
                caller, callee = re.match(r'edge: \{ sourcename: "([^"]*)" targetname: "([^"]*)"', line).groups()
                label = re.search(r'label: "([^"]*)"', line)
                place = _place(label[1]) if label else ("", 0, 0)
                functions.setdefault(caller, Function(caller.split(":")[-1])).calls.append((callee, *place))
    return functions


def resolve_indirect(functions, sites: dict[str, list[str]]):
    """Replaces calls through pointers by calls of what they may reach: sites[caller] are names of functions."""
    by_short: dict[str, list[str]] = {}
    for title, function in functions.items():
        if function.frame is not None:
            by_short.setdefault(function.short, []).append(title)
    for function in functions.values():
        if not any(call[0] == INDIRECT for call in function.calls):
            continue
        if function.short not in sites:
            raise SystemExit(f"{function.short} calls through a pointer; say in calls.txt whom")
        targets = [title for name in sites[function.short] for title in by_short.get(name, [])]
        if not targets:
            raise SystemExit(f"calls.txt: nothing is called {sites[function.short]}")
        calls = []
        for call in function.calls:
            calls += [(t, *call[1:], True) for t in targets] if call[0] == INDIRECT else [call]
        function.calls = calls


def in_order(functions) -> list[str]:
    """Callees before callers. Exits where a function can reach itself."""
    order, state = [], {}
    for root in functions:
        stack = [(root, iter(functions[root].calls))]
        if state.get(root):
            continue
        state[root] = 1
        while stack:
            title, calls = stack[-1]
            for callee, *_ in calls:
                if state.get(callee) == 1:
                    raise SystemExit(f"recursion: {functions[callee].signature} is reached from itself")
                if callee in functions and not state.get(callee):
                    state[callee] = 1
                    stack.append((callee, iter(functions[callee].calls)))
                    break
            else:
                state[title] = 2
                order.append(title)
                stack.pop()
    return order
