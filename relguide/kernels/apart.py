"""Each kernel is machine code of its own, which its callers call and do not hold.

numba links all that a function calls into it, optimises all of that anew, and keeps all of it on
disk. So it compiles a kernel once for each of its callers, and once more for each of theirs: 150 s
of CPU time and 1.4 GB before a first plan where d_min binds. But all machine code of a process
lives in one engine, which resolves names between modules. So here a caller only declares the
kernels that it calls. It gets the code of small ones to inline, and emits none of that.

- A kernel has the same name in the machine code of every process (`distinct_names.py`).
- `_finalize` links no kernel into another, and notes each one that is called. numba follows such
  notes before it reads the caller from disk: it reads the callee first, or compiles it.
- What Python needs to call a kernel is compiled at its first call from there, and kept beside it.

numba offers no option for that, so its code generation is wrapped, for our own kernels. With a
numba that this was not tested with, nothing is wrapped, and a warning says that it takes longer.
"""

import gc
import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from importlib import import_module
from sys import modules
from threading import Lock, local
from typing import Any

import llvmlite.binding as llvm
from numba import __version__ as numba_version
from numba.core import codegen as numba_codegen
from numba.core import compiler_lock as numba_compiler_lock
from numba.core import cpu as numba_cpu
from numba.core import dispatcher as numba_dispatcher
from numba.core import lowering as numba_lowering
from numba.core.registry import cpu_target

from relguide.kernels.distinct_names import OURS

codegen: Any = numba_codegen
compiler_lock: Any = numba_compiler_lock
cpu: Any = numba_cpu
dispatcher: Any = numba_dispatcher
lowering: Any = numba_lowering

TESTED = ("0.68",)
"""The versions of numba that this was tested with."""
SMALL = 100
"""Lines of optimised code up to which a caller gets a kernel's code to inline."""
KERNEL = "kernel"
"""How a kernel is marked on disk, where numba has "object" and "bitcode"."""
COLLECT_EVERY = 100_000
"""Objects made between two collections of garbage while compiling: it finds little each time."""


class StaleCalleeError(Exception):
    """A kernel on disk calls another one under a name that this one does not have any more."""


@dataclass(frozen=True, slots=True)
class Callee:
    """A kernel that another one calls; calling this gets it ready."""

    module: str
    name: str
    types: tuple[Any, ...]
    symbol: str
    """Its name in machine code."""

    def __call__(self) -> None:
        """Read it from disk, or compile it."""
        kernel = getattr(import_module(self.module), self.name)
        if self.types not in kernel.overloads and not _read(kernel, self.types):
            with _for_kernels():
                kernel.compile(self.types)
        if kernel.overloads[self.types].fndesc.llvm_func_name != self.symbol:
            raise StaleCalleeError(self.symbol)


_state = local()
"""Whether this thread gets a kernel ready for another one, as `for_kernels`."""


@contextmanager
def _for_kernels() -> Iterator[None]:
    before = getattr(_state, "for_kernels", False)
    _state.for_kernels = True
    try:
        yield
    finally:
        _state.for_kernels = before


def _read(kernel: Any, types: tuple[Any, ...]) -> bool:
    """Read a kernel from disk, if it is there, as numba's `compile` does, but timed by nothing."""
    context = kernel.targetctx
    result = kernel._cache.load_overload(types, context)
    if result is None:
        return False
    context.insert_user_function(result.entry_point, result.fndesc, [result.library])
    kernel.add_overload(result)
    return True


# ---- what a kernel is made of ----------------------------------------------------------------


def _is_kernel(described: Any) -> bool:
    """Whether a function that numba describes is a kernel of ours."""
    module = modules.get(described.modname)
    return described.modname.startswith(OURS) and isinstance(
        getattr(module, described.qualname, None), dispatcher.Dispatcher
    )


def _get_executable(self: Any, library: Any, described: Any, environment: Any) -> Any:
    """As numba's; a kernel is made ready for compiled callers, and not for Python yet."""
    if not _is_kernel(described):
        return _get_any_executable(self, library, described, environment)
    types = tuple(described.argtypes)
    symbol = described.llvm_func_name
    library.callee = Callee(described.modname, described.qualname, types, symbol)
    if not library._finalized:
        library.finalize()
        kernel = library._final_module.get_function(symbol)
        small = described.inline or str(kernel).count("\n") <= SMALL
        library.bitcode = _to_inline(library._final_module, symbol) if small else b""
    library.codegen._engine._defined_symbols.add(symbol)
    library.codegen.set_env(self.get_env_name(described), environment)
    return library.callee  # numba looks kernels up by it, and calls none


def _finalize(self: Any) -> None:
    """As numba's, but kernels that are called are not linked in, unless they are small."""
    codegen.require_global_compiler_lock()
    self._raise_if_finalized()
    for library in dict.fromkeys(self._linking_libraries):
        callee = getattr(library, "callee", None)
        if callee is None:
            self._reload_init.update(library._reload_init)
            self._final_module.link_in(library._get_module_for_linking(), preserve=True)
            continue
        self._reload_init.add(callee)
        if library.bitcode:
            self._final_module.link_in(library._get_module_for_linking(), preserve=True)
    self._optimize_final_module()
    self._final_module.verify()
    self._finalize_final_module()


def _get_module_for_linking(self: Any) -> Any:
    """As numba's; of a small kernel, what a caller may inline."""
    callee = getattr(self, "callee", None)
    if callee is None:
        return _get_any_module_for_linking(self)
    if self._shared_module is None:
        self._shared_module = llvm.parse_bitcode(self.bitcode)
    return self._shared_module


def _to_inline(module: Any, symbol: str) -> bytes:
    """A module's function and what it calls in there, for another module that does not emit it."""
    module = module.clone()
    for function in module.functions:
        if function.name != symbol and not function.is_declaration:
            if function.linkage == llvm.Linkage.external:
                function.linkage = "linkonce_odr"
    passes = llvm.create_new_module_pass_manager()
    passes.add_global_dead_code_eliminate_pass()
    machine = cpu_target.target_context.codegen()._tm
    options = llvm.create_pipeline_tuning_options(0)
    passes.run(module, llvm.create_pass_builder(machine, options))
    module.get_function(symbol).linkage = "available_externally"  # afterwards: else it is dead
    bitcode: bytes = module.as_bitcode()
    return bitcode


def _serialize(self: Any) -> Any:
    """As numba's; of a kernel, little more than the machine code."""
    if getattr(self, "callee", None) is None:
        return _serialize_any(self)
    return self.name, KERNEL, (self._get_compiled_object(), self.bitcode)


def _unserialize(cls: Any, generator: Any, state: Any) -> Any:
    """As numba's; what a kernel's callers may inline is left until one is compiled."""
    name, kind, data = state
    if kind != KERNEL:
        return _unserialize_any(cls, generator, state)
    self = generator.create_library(name)
    self.enable_object_caching()
    machine_code, self.bitcode = data
    self._set_compiled_object(machine_code)
    self._finalize_final_module()
    return self


# ---- what Python needs to call it ------------------------------------------------------------


def _create_no_wrapper(create: Any) -> Any:
    """As numba's, but of kernels nothing is made that C or Python would call."""

    def unless_a_kernel(self: Any, *args: Any, **options: Any) -> None:
        if not _is_kernel(self.fndesc):
            create(self, *args, **options)

    return unless_a_kernel


def _add_overload(self: Any, result: Any) -> None:
    """As numba's, but Python cannot call a kernel yet."""
    if isinstance(result.entry_point, Callee):
        self.overloads[tuple(result.signature.args)] = result
    else:
        _add_any_overload(self, result)


def _get_call_template(self: Any, args: Any, kws: Any) -> Any:
    """As numba's, which asks for a kernel here that compiled code calls."""
    with _for_kernels():
        return _get_any_call_template(self, args, kws)


def _compile(self: Any, signature: Any) -> Any:
    """As numba's; for Python, also what it needs to call the kernel."""
    if getattr(_state, "for_kernels", False):
        return _compile_any(self, signature)
    with _few_collections():
        entry = _compile_any(self, signature)
        if not isinstance(entry, Callee):
            return entry
        with compiler_lock.global_compiler_lock:
            return _entry_for_python(self, self.overloads[entry.types])


def _entry_for_python(kernel: Any, result: Any) -> Any:
    if hasattr(result.library, "for_python"):  # another thread called it first at the same time
        return result.library.for_python.entry
    library = _read_wrapper(kernel, result) or _make_wrapper(kernel, result)
    types, context = tuple(result.signature.args), result.target_context
    entry = _get_any_executable(context, library, result.fndesc, result.environment)
    # numba takes none of two equal entries, and asks for one at every call
    kernel._insert([one._code for one in types], entry, False)
    library.entry = entry  # the table of entries does not keep it alive
    result.library.for_python = library
    return entry


def _read_wrapper(kernel: Any, result: Any) -> Any:
    stored = kernel._cache._cache_file.load(_wrapper_key(kernel, result))
    if stored is None or stored[0] != result.fndesc.llvm_cpython_wrapper_name:
        return None
    _, constants, library = stored
    result.environment.consts[:] = constants
    return result.codegen.unserialize_library(library)


def _make_wrapper(kernel: Any, result: Any) -> Any:
    library = result.codegen.create_library(f"{result.fndesc.qualname} for Python")
    library.enable_object_caching()
    result.target_context.refresh()  # a process that only read kernels knows of no conversions
    options = kernel.targetoptions
    # numba's context for what is read from disk counts no references to arrays
    context = result.target_context.subtarget(enable_nrt=options.get("_nrt", True))
    context.create_cpython_wrapper(
        library,
        result.fndesc,
        result.environment,  # which it may add constants to
        None,
        release_gil=options.get("nogil", False),
    )
    library.add_linking_library(cpu.rtsys.library)
    library._ensure_finalized()
    name, constants = result.fndesc.llvm_cpython_wrapper_name, list(result.environment.consts)
    stored = name, constants, library.serialize_using_object_code()
    kernel._cache._cache_file.save(_wrapper_key(kernel, result), stored)
    return library


def _wrapper_key(kernel: Any, result: Any) -> Any:
    types = ("for Python", *result.signature.args)
    return kernel._cache._index_key(types, result.codegen)


_few_lock = Lock()
_found: dict[str, Any] = {}
"""How garbage was collected before any thread compiled, and how many now do."""


@contextmanager
def _few_collections() -> Iterator[None]:
    """Collect garbage seldom, and where a program never does: compiling makes much of it."""
    with _few_lock:
        if not _found:  # the first thread that compiles: the last one restores what it found
            _found.update(threshold=gc.get_threshold(), enabled=gc.isenabled(), threads=0)
            gc.set_threshold(COLLECT_EVERY, *_found["threshold"][1:])
            gc.enable()
        _found["threads"] += 1
    try:
        yield
    finally:
        with _few_lock:
            _found["threads"] -= 1
            if not _found["threads"]:
                gc.set_threshold(*_found["threshold"])
                if not _found["enabled"]:
                    gc.disable()
                _found.clear()


_library = codegen.CPUCodeLibrary
_get_any_executable = cpu.CPUContext.get_executable
_get_any_module_for_linking = _library._get_module_for_linking
_serialize_any = _library.serialize_using_object_code
_unserialize_any = _library._unserialize.__func__
_add_any_overload = dispatcher.Dispatcher.add_overload
_get_any_call_template = dispatcher.Dispatcher.get_call_template
_compile_any = dispatcher.Dispatcher.compile

if numba_version.rpartition(".")[0] in TESTED:
    cpu.CPUContext.get_executable = _get_executable
    _library.finalize = _finalize
    _library._get_module_for_linking = _get_module_for_linking
    _library.serialize_using_object_code = _serialize
    _library._unserialize = classmethod(_unserialize)
    for _name in ("create_cpython_wrapper", "create_cfunc_wrapper"):
        _wrapped = _create_no_wrapper(getattr(lowering.BaseLower, _name))
        setattr(lowering.BaseLower, _name, _wrapped)
    dispatcher.Dispatcher.add_overload = _add_overload
    dispatcher.Dispatcher.get_call_template = _get_call_template
    dispatcher.Dispatcher.compile = _compile
else:
    warnings.warn(
        f"numba {numba_version} is not one that relguide was tested with ({', '.join(TESTED)}): "
        "it compiles kernels as numba does by itself, which takes three times as long.",
        stacklevel=2,
    )
