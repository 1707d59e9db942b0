"""Mutants of a C++ source: one operator or one constant changed. Sources are clang-formatted: binary operators have a
blank on either side, and nothing else has."""
import re
from dataclasses import dataclass
from pathlib import Path

ARITHMETIC = {"+": "-", "-": "+", "*": "+", "/": "*", "%": "*", "<<": ">>", ">>": "<<", "&": "|", "|": "&", "^": "|",
              "+=": "-=", "-=": "+=", "*=": "+=", "<<=": ">>=", ">>=": "<<=", "&=": "|=", "|=": "&=", "^=": "|="}
COMPARISON = {"<": "<=", "<=": "<", ">": ">=", ">=": ">", "==": "!=", "!=": "=="}


@dataclass(frozen=True)
class Mutant:
    file: str
    line: int
    column: int
    kind: str
    old: str
    new: str
    text: str  # the line as it was, stripped

    def apply(self, source: str) -> str:
        rows = source.split("\n")
        row = rows[self.line - 1]
        assert row.startswith(self.old, self.column)
        rows[self.line - 1] = row[:self.column] + self.new + row[self.column + len(self.old):]
        return "\n".join(rows)

    @property
    def name(self) -> str:
        return f"{self.file}:{self.line}:{self.column + 1} {self.old} -> {self.new}"


def _blank(text: str) -> str:
    """Without comments, strings, preprocessor lines, assertions of types, promises to sanitizers and sizes of arrays that
    are declared: nobody looks into more room."""
    pattern = (r"//[^\n]*|/\*.*?\*/|\"(?:\\.|[^\"\\\n])*\"|^#[^\n]*|\b(?:static_assert|expect)\((?:[^()]|\([^()]*\))*\);|"
               r"\btemplate <[^\n]*>|^using [^\n]*|^ *[\w:]+ (?:\w+(?:\[\d+\])+(?:, )?)+;")
    return re.sub(pattern, lambda m: re.sub(r"[^\n]", " ", m[0]), text, flags=re.S | re.M)


def mutants_of(path: Path) -> list[Mutant]:
    source = path.read_text()
    rows, found = source.split("\n"), []
    for number, row in enumerate(_blank(source).split("\n"), 1):
        def add(kind, column, old, new):
            found.append(Mutant(path.name, number, column, kind, old, new, rows[number - 1].strip()))
        for match in re.finditer(r"(?<= )([-+*/%&|^<>=!]+)(?= |$)", row):
            op = match[1]
            if op in ARITHMETIC:
                add("arithmetic", match.start(1), op, ARITHMETIC[op])
            elif op in COMPARISON:
                add("comparison", match.start(1), op, COMPARISON[op])
        for match in re.finditer(r"(?<![\w.'])(0x[0-9A-Fa-f]+|\d+)([uUlL]*)(?![\w.'])", row):
            value = int(match[1], 0)
            changed = f"{value + 1:#x}" if match[1].startswith("0x") else str(value + 1)
            add("constant", match.start(1), match[0], changed + match[2])
    return found
