"""Loops of C++ sources: where they are, how they nest, and how often each can run."""
import re
from dataclasses import dataclass
from pathlib import Path


@dataclass
class Loop:
    file: str
    line: int
    begin: int  # offsets, header and body
    end: int
    header: str
    body: str
    limit: str | None = None  # of a counted loop: what the counter is compared with
    bound: dict | None = None


def blank_comments(text: str) -> str:
    """The same length, without comments and strings."""
    pattern = r"//[^\n]*|/\*.*?\*/|\"(?:\\.|[^\"\\\n])*\"|'(?:\\.|[^'\\\n])'"
    return re.sub(pattern, lambda m: re.sub(r"[^\n]", " ", m[0]), text, flags=re.S)


def matching(text: str, at: int) -> int:
    """One past the bracket that closes the one at `at`."""
    depth = 0
    for k in range(at, len(text)):
        depth += (text[k] in "([{") - (text[k] in ")]}")
        if depth == 0:
            return k + 1
    raise ValueError("brackets do not match")


def _blank(text, at):
    return at + len(text[at:]) - len(text[at:].lstrip())


def _statement_end(text: str, at: int) -> int:
    at = _blank(text, at)
    if text[at] == "{":
        return matching(text, at)
    if word := re.match(r"(for|while|if|switch)\b", text[at:]):
        end = _statement_end(text, matching(text, text.index("(", at)))
        after = _blank(text, end)
        return _statement_end(text, after + 4) if word[1] == "if" and text.startswith("else", after) else end
    while text[at] != ";":
        at = matching(text, at) if text[at] in "([{" else at + 1
    return at + 1


def _counted_limit(header: str, body: str) -> str | None:
    """of `for (T k = A; k < E; ++k)`, counters either way and by any step, when the body leaves k alone."""
    parts = header.split(";")
    if len(parts) != 3:
        return None
    steps = re.findall(r"(?:\+\+|--)(\w+)|(\w+)(?:\+\+|--)|(\w+) (?:\+=|-=) \w", parts[2])
    for k in (next(filter(None, groups)) for groups in steps):
        limit = re.search(rf"(?:^|&& )\s*{k} (?:<=|<|>=|>|!=) ([^&]+?)\s*(?:$|&&)", parts[1].strip())
        written = rf"\b{k}\s*(?:[-+*/|&^]|<<|>>)?=(?!=)|(?:\+\+|--){k}\b|\b{k}(?:\+\+|--)|&{k}\b"
        if limit and not re.search(written, body):
            first = re.search(rf"\b{k} = ([^,]+)", parts[0])
            reached = first[1] if limit[1] == "0" and first else limit[1]
            return str(int(reached) + 1) if reached.isdigit() and "=" in limit[0] else reached
    return None


def find_loops(path: Path, name: str) -> list[Loop]:
    text = blank_comments(path.read_text())
    loops, closed_do = [], set()
    for match in re.finditer(r"\b(for|while|do)\b", text):
        at, line = match.start(), text.count("\n", 0, match.start()) + 1
        if match[1] == "do":
            end = _statement_end(text, match.end())
            tail = text.index("while", end)
            closed_do.add(tail)
            condition = text[text.index("(", tail):matching(text, text.index("(", tail))]
            loops.append(Loop(name, line, at, end, "do while " + condition, text[match.end():end]))
        elif at not in closed_do:
            open_ = text.index("(", at)
            close = matching(text, open_)
            end = _statement_end(text, close)
            header, body = " ".join(text[open_ + 1:close - 1].split()), text[close:end]
            limit = _counted_limit(header, body) if match[1] == "for" else None
            loops.append(Loop(name, line, at, end, f"{match[1]} ({header})", body, limit))
    return loops


def body_range(text: str, line: int, column: int) -> tuple[int, int]:
    """Offsets of the function whose name stands at a place of blank_comments(text), its braces included."""
    at = sum(len(row) + 1 for row in text.split("\n")[:line - 1]) + column - 1
    begin = at
    while True:
        while text[at] not in "({;":
            at += 1
        before = text[begin:at].rstrip()
        member = text[at] == "{" and re.search(r"[:,]\s*\w+$", before) and re.search(r"\)[^{]*:", before)
        if text[at] == ";":
            return begin, at
        if text[at] == "{" and not member:
            return begin, matching(text, at)
        at = matching(text, at)
