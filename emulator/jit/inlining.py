"""Functions that compiled code calls, made once: as part of what calls them, and not on their own besides.

numba optimises every function with all it calls, and makes machine code of it, before it does the same with the
function that calls it: in a tree of fifty functions the leaves are compiled five times over.  Here the functions below
an entry are only translated to LLVM's language; the entry is optimised and made machine code with all of them in it, as
it is anyway.  The machine code computes the same, as nothing here lets LLVM change a number.

This rests on the inside of numba's code generator.  Where a numba has another inside, :data:`AVAILABLE` is False and
functions are compiled numba's own way: slower, and nothing else changes.
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
    """A code generator to whom a function is not known by an address."""

    def __init__(self, generator: Any) -> None:
        self._generator = generator

    def set_env(self, name: str, environment: Any) -> None:
        """What numba puts beside the machine code of a function, which there is none of."""

    def __getattr__(self, name: str) -> Any:
        return getattr(self._generator, name)


class _Part(JITCodeLibrary):
    """A function in LLVM's language, to be linked into another."""

    @property
    def codegen(self) -> Any:
        return _NotInMemory(self._codegen)

    def _optimize_functions(self, module: Any) -> None:
        module.data_layout = self._codegen._data_layout

    def _optimize_final_module(self) -> None:
        """Left to the entry."""

    def _finalize_final_module(self) -> None:
        self._finalize_dynamic_globals()  # type: ignore[no-untyped-call]
        self._finalized = True

    def get_pointer_to_function(self, name: str) -> int:
        self._ensure_finalized()  # type: ignore[no-untyped-call]
        return 0


class _MakesPart(compiler_machinery.AnalysisPass):
    """Chooses where the code of a function goes, before it is made."""

    _name = "hull1620_makes_part"

    def __init__(self) -> None:
        compiler_machinery.AnalysisPass.__init__(self)  # type: ignore[no-untyped-call]

    def run_pass(self, state: Any) -> bool:
        if state.library is None:
            state.library = _Part(state.targetctx.codegen(), state.func_id.func_qualname)  # type: ignore[no-untyped-call]
        return False


compiler_machinery.register_pass(mutates_CFG=False, analysis_only=True)(_MakesPart)  # type: ignore[no-untyped-call]


class PartCompiler(compiler.CompilerBase):
    """numba's compiler, for functions that only compiled code calls."""

    def define_pipelines(self) -> list[Any]:
        passes = compiler.DefaultPassBuilder.define_nopython_pipeline(self.state)  # type: ignore[no-untyped-call]
        passes.add_pass_after(_MakesPart, typed_passes.AnnotateTypes)
        passes.finalize()
        return [passes]
