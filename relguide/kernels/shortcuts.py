"""What numba does to no end while it compiles, left out: a tenth of the time it takes.

It runs its passes over the declarations of functions, whose code is elsewhere, each with a manager
of its own. And where it lists the variables of a statement it asks of each value whether it is one
of several abstract classes; most values are of few types, which are looked up here.
"""

from typing import Any

from numba.core import codegen as numba_codegen
from numba.core import ir as numba_ir

codegen: Any = numba_codegen
ir: Any = numba_ir
_WITHOUT = frozenset((str, int, float, bool, type(None), ir.Loc, ir.Const, ir.Global, ir.FreeVar))
"""Types of values that hold no variable."""


def _optimize_functions(self: Any, module: Any) -> None:
    """As numba's, for functions that have code."""
    module.data_layout = self._codegen._data_layout
    for function in module.functions:
        if not function.is_declaration:
            passes, builder = self._codegen._function_pass_manager()
            passes.run(function, builder)


def _list_variables(self: Any, value: Any) -> list[Any]:
    """As numba's."""
    if type(value) in _WITHOUT:
        return []
    if isinstance(value, ir.Var):
        return [value]
    if isinstance(value, ir.Inst):
        found: list[Any] = value.list_vars()
        return found
    values = value.values() if isinstance(value, dict) else value
    if isinstance(value, (dict, list, tuple)):
        return [found for one in values for found in _list_variables(self, one)]
    return []


codegen.CPUCodeLibrary._optimize_functions = _optimize_functions
ir.Inst._rec_list_vars = _list_variables
