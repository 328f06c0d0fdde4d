"""A compiler pass of numba that compiles an entry function together with the functions it calls, not each separately.

By default numba optimises each function together with all functions it calls and generates machine code for it, and
then does the same with the caller.  In a tree of fifty functions, the leaves are compiled five times.  With this pass
the functions that an entry calls are only translated to LLVM's intermediate language; the entry is then compiled with
all of them, once.  The results are the same, because no option here lets LLVM change an arithmetic result.

This relies on internals of numba's code generator.  If a version of numba lacks them, :data:`AVAILABLE` is False, and
numba compiles the functions in its usual way, which is slower but gives the same results.
"""

from __future__ import annotations

from typing import Any

from numba.core import compiler, compiler_machinery, typed_passes
from numba.core.codegen import JITCodeLibrary

_INSIDE = (
    "_optimize_functions",
    "_optimize_final_module",
    "_finalize_final_module",
    "_finalize_dynamic_globals",
    "get_pointer_to_function",
    "codegen",
)
AVAILABLE = all(hasattr(JITCodeLibrary, name) for name in _INSIDE) and hasattr(typed_passes, "AnnotateTypes")


class _NotInMemory:
    """A code generator that does not load functions into memory, because they are never called directly."""

    def __init__(self, generator: Any) -> None:
        self._generator = generator

    def set_env(self, name: str, environment: Any) -> None:
        """Do nothing, because there is no machine code that would need numba's environment object."""

    def __getattr__(self, name: str) -> Any:
        return getattr(self._generator, name)


class _Part(JITCodeLibrary):
    """A function translated to LLVM's intermediate language, which is compiled together with its callers."""

    @property
    def codegen(self) -> Any:
        return _NotInMemory(self._codegen)

    def _optimize_functions(self, module: Any) -> None:
        module.data_layout = self._codegen._data_layout

    def _optimize_final_module(self) -> None:
        """Do nothing, because the code is optimised together with its caller."""

    def _finalize_final_module(self) -> None:
        self._finalize_dynamic_globals()  # type: ignore[no-untyped-call]
        self._finalized = True

    # numba asks for an address when it has compiled a function.  No address exists, and none is used.
    def get_pointer_to_function(self, name: str) -> int:
        self._ensure_finalized()  # type: ignore[no-untyped-call]
        return 0


class _MakesPart(compiler_machinery.AnalysisPass):
    """The compiler pass that stores a function's intermediate code in a library for its callers."""

    _name = "hull1620_makes_part"

    def __init__(self) -> None:
        compiler_machinery.AnalysisPass.__init__(self)  # type: ignore[no-untyped-call]

    def run_pass(self, state: Any) -> bool:
        # The later passes generate the code into this library instead of a new one that is optimised at once.
        if state.library is None:
            state.library = _Part(state.targetctx.codegen(), state.func_id.func_qualname)  # type: ignore[no-untyped-call]
        return False


compiler_machinery.register_pass(mutates_CFG=False, analysis_only=True)(_MakesPart)  # type: ignore[no-untyped-call]


class PartCompiler(compiler.CompilerBase):
    """The numba compiler for functions that are only called by other compiled functions."""

    def define_pipelines(self) -> list[Any]:
        passes = compiler.DefaultPassBuilder.define_nopython_pipeline(self.state)  # type: ignore[no-untyped-call]
        passes.add_pass_after(_MakesPart, typed_passes.AnnotateTypes)
        passes.finalize()
        return [passes]
