"""What a small fault looks like: a few bytes of a source file, and what stands there instead."""

import ast
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import pairwise

NEGATED = {
    ast.Lt: ("<", ">="),
    ast.LtE: ("<=", ">"),
    ast.Gt: (">", "<="),
    ast.GtE: (">=", "<"),
    ast.Eq: ("==", "!="),
    ast.NotEq: ("!=", "=="),
    ast.Is: ("is", "is not"),
    ast.IsNot: ("is not", "is"),
    ast.In: ("in", "not in"),
    ast.NotIn: ("not in", "in"),
}
NEIGHBOUR = {"<": "<=", "<=": "<", ">": ">=", ">=": ">"}
"""One more or one less; tried where whole numbers are compared, for reals are never just equal."""
ARITHMETIC = {
    ast.Add: ("+", "-"),
    ast.Sub: ("-", "+"),
    ast.Mult: ("*", "/"),
    ast.Div: ("/", "*"),
    ast.FloorDiv: ("//", "*"),
    ast.Mod: ("%", "+"),
    ast.Pow: ("**", "*"),
}
FUNCTIONS = {
    "min": "max",
    "max": "min",
    "sin": "cos",
    "cos": "sin",
    "ceil": "floor",
    "floor": "ceil",
    "any": "all",
    "all": "any",
    "abs": "",
}
SKIPPED = ("annotation", "returns", "decorator_list")
"""Fields of a node in which a fault would change nothing that runs, or only what a class is."""
TOLERANCE = 1e-4
"""Numbers below are tolerances: half as much again would hardly be a fault, a thousand times is."""


@dataclass(frozen=True, slots=True)
class Edit:
    """The bytes from `start` to `end` of a source replaced."""

    operator: str
    start: int
    end: int
    text: str

    def apply(self, source: bytes) -> bytes:
        """The source with the fault in it."""
        return source[: self.start] + self.text.encode() + source[self.end :]


def edits(source: bytes) -> list[Edit]:
    """Every small fault there can be, in the order of the source."""
    found = _Walk(source)
    found.below(ast.parse(source))
    return sorted(set(found.edits), key=lambda edit: (edit.start, edit.end, edit.text))


class _Walk:
    def __init__(self, source: bytes) -> None:
        self.source = source
        self.starts = [0]
        for line in source.splitlines(keepends=True):
            self.starts.append(self.starts[-1] + len(line))
        self.edits: list[Edit] = []
        self.assigned: set[str] = set()

    def below(self, node: ast.AST) -> None:
        """The faults of all that a node is made of."""
        for field, value in ast.iter_fields(node):
            for child in value if isinstance(value, list) else [value]:
                if isinstance(child, ast.AST) and field not in SKIPPED:
                    self.visit(child)

    def visit(self, node: ast.AST) -> None:
        """The faults of a node and of all that it is made of."""
        match node:
            case ast.Raise() | ast.JoinedStr() | ast.Assert() | ast.keyword(arg="strict"):
                return  # what a message says, and what only guards
            case ast.FunctionDef(args=arguments):
                outside = self.assigned
                named = [*arguments.posonlyargs, *arguments.args, *arguments.kwonlyargs]
                self.assigned = {argument.arg for argument in named}
                self.below(node)
                self.assigned = outside
                return
            case ast.Subscript(slice=ast.Constant(value=int(index)) as at):
                self.replace("index", at, str(index + 1))
                self.visit(node.value)
                return
        self.edits += [edit for edit in self.of(node) if edit.start < edit.end]
        self.below(node)
        if isinstance(node, ast.Assign) and isinstance(node.targets[0], ast.Name):
            self.assigned.add(node.targets[0].id)

    def of(self, node: ast.AST) -> Iterator[Edit]:
        """The faults of one node."""
        match node:
            case ast.Compare():
                yield from self._compared(node)
            case ast.BinOp(left=left, op=op, right=right) if type(op) in ARITHMETIC:
                if not any(isinstance(side, ast.JoinedStr) for side in (left, right)):
                    old, new = ARITHMETIC[type(op)]
                    yield self._between("arithmetic", left, right, old, new)
                    if old in "+-*":
                        yield self._whole("drop a term", node, self._text(left))
            case ast.BoolOp(op=op, values=values):
                old, new = ("and", "or") if isinstance(op, ast.And) else ("or", "and")
                for one, other in pairwise(values):
                    yield self._between("and, or", one, other, old, new)
                for value in values:
                    yield self._whole("drop a condition", value, str(old == "and"))
            case ast.UnaryOp(op=ast.USub() | ast.Not(), operand=operand):
                yield self._whole("drop a sign", node, self._text(operand))
            case ast.Constant(value=bool(value)):
                yield self._whole("constant", node, str(not value))
            case ast.Constant(value=int() | float() as value):
                for number in _numbers(value):
                    yield self._whole("constant", node, repr(number))
            case ast.Call(func=ast.Name(id=name) as called) if name in FUNCTIONS:
                yield self._whole("function", called, FUNCTIONS[name])
            case ast.If(test=test) | ast.While(test=test) | ast.IfExp(test=test):
                if isinstance(test, ast.Name | ast.Attribute | ast.Call):
                    yield self._whole("negate", test, f"not {self._text(test)}")
            case ast.AugAssign() | ast.Expr(value=ast.Call()):
                yield self._whole("drop a statement", node, "pass")
            case ast.Assign(targets=[ast.Subscript()]):
                yield self._whole("drop a statement", node, "pass")
            case ast.Assign(targets=[ast.Name(id=name)]) if name in self.assigned:
                yield self._whole("drop a statement", node, "pass")
            case ast.Break():
                yield self._whole("break, continue", node, "continue")
            case ast.Continue():
                yield self._whole("break, continue", node, "break")
        if isinstance(node, ast.For | ast.While):
            last, margin = node.body[-1], " " * node.body[0].col_offset
            if not isinstance(last, ast.Return | ast.Break | ast.Continue | ast.Raise):
                text = self.source[slice(*self._span(last))].decode()
                yield self._whole("loop once", last, f"{text}\n{margin}break")

    def _compared(self, node: ast.Compare) -> Iterator[Edit]:
        sides = [node.left, *node.comparators]
        for (left, right), op in zip(pairwise(sides), node.ops, strict=True):
            old, new = NEGATED[type(op)]
            yield self._between("comparison", left, right, old, new)
            if old in NEIGHBOUR and (_is_whole(left) or _is_whole(right)):
                yield self._between("comparison", left, right, old, NEIGHBOUR[old])

    def replace(self, operator: str, node: ast.AST, text: str) -> None:
        """Note one fault."""
        self.edits.append(self._whole(operator, node, text))

    def _whole(self, operator: str, node: ast.AST, text: str) -> Edit:
        return Edit(operator, *self._span(node), text)

    def _between(self, operator: str, left: ast.AST, right: ast.AST, old: str, new: str) -> Edit:
        start, end = self._span(left)[1], self._span(right)[0]
        at = self.source.find(old.encode(), start, end)
        return Edit(operator, at, at + len(old), new)

    def _text(self, node: ast.AST) -> str:
        text = self.source[slice(*self._span(node))].decode()
        return text if isinstance(node, ast.Name | ast.Constant | ast.Call) else f"({text})"

    def _span(self, node: ast.AST) -> tuple[int, int]:
        place: ast.expr = node  # type: ignore[assignment]
        assert place.end_lineno is not None
        assert place.end_col_offset is not None
        start = self.starts[place.lineno - 1] + place.col_offset
        return start, self.starts[place.end_lineno - 1] + place.end_col_offset


def _is_whole(node: ast.AST) -> bool:
    match node:
        case ast.Constant(value=value):
            return isinstance(value, int)
        case ast.Call(func=ast.Name(id=name)):
            return name == "len"
    return False


def _numbers(value: float) -> list[float]:
    if isinstance(value, int):
        return [value + 1] if value in (0, 1) else [value + 1, 0]
    if value == 0.0:
        return [1.0]
    return [value * (1e3 if value < TOLERANCE else 1.5), 0.0]
