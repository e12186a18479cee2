"""How kernels and their pieces are compiled: without what only costs compile time.

numba optimises every function on its own, three times over, and turns it into machine code. A piece is inlined
wherever it is used, where LLVM optimises it again, and nothing ever calls it otherwise: it is left as it is. A kernel
is optimised once, and loops are not turned into vectors, because the kernels' vectors are written out.
"""

from __future__ import annotations

import gc
from typing import Any

from numba.core.codegen import JITCodeLibrary
from numba.core.compiler import CompilerBase, DefaultPassBuilder
from numba.core.compiler_machinery import register_pass
from numba.core.typed_passes import NativeLowering

# Kernels hold no closures, no exceptions with arguments, no expressions of whole arrays, no context managers.
_NOT_NEEDED = {
    "WithLifting", "InlineClosureLikes", "RewriteSemanticConstants", "RewriteDynamicRaises",
    "MakeFunctionToJitFunction", "InlineInlinables", "FindLiterallyCalls", "LiteralUnroll",
    "LiteralPropagationSubPipelinePass", "InlineOverloads", "NopythonRewrites", "DumpParforDiagnostics",
    "NoPythonSupportedFeatureValidation", "AnnotateTypes", "DeadBranchPrune",
}  # fmt: skip


class KernelLibrary(JITCodeLibrary):
    """LLVM code that is optimised once."""

    def _optimize_functions(self, ll_module: Any) -> None:
        ll_module.data_layout = self._codegen._data_layout

    def _optimize_final_module(self) -> None:
        made = self._codegen._module_pass_manager(loop_vectorize=False, slp_vectorize=False)
        if isinstance(made, tuple):  # numba 0.62 and later: passes and their builder
            made[0].run(self._final_module, made[1])
        else:
            made.run(self._final_module)


class PieceLibrary(KernelLibrary):
    """LLVM code to be linked into others, just as lowering wrote it."""

    def _optimize_final_module(self) -> None:
        """The kernel that takes it in does that."""

    def _finalize_final_module(self) -> None:
        self._finalize_dynamic_globals()
        self._finalized = True


@register_pass(mutates_CFG=True, analysis_only=False)
class KernelLowering(NativeLowering):
    """numba's lowering into a `KernelLibrary`."""

    _name = "kernel_lowering"

    def run_pass(self, state: Any) -> bool:
        """Always changes the state."""
        state.library = KernelLibrary(state.targetctx.codegen(), state.func_id.func_qualname)
        state.library.enable_object_caching()
        return super().run_pass(state)


@register_pass(mutates_CFG=True, analysis_only=False)
class PieceLowering(NativeLowering):
    """numba's lowering into a `PieceLibrary`, without machine code."""

    _name = "piece_lowering"

    def run_pass(self, state: Any) -> bool:
        """Lower, and let callers find the result; always changes the state."""
        state.library = PieceLibrary(state.targetctx.codegen(), state.func_id.func_qualname)
        state.flags.no_compile = True
        super().run_pass(state)
        state.library.finalize()
        # numba names a function by its entry for Python, which is a built-in one; this one refuses to be called
        entry = [state.func_id.func_qualname].index
        state["cr"] = state["cr"]._replace(cfunc=entry)
        state.targetctx.insert_user_function(entry, state["cr"].fndesc, [state.library])
        return True


class KernelCompiler(CompilerBase):
    """numba's own pipeline with another last step, and without the steps for what no kernel contains."""

    lowering: type = KernelLowering

    def compile_extra(self, func: Any) -> Any:
        """Compile without collecting garbage meanwhile: numba's many objects would be walked over again and again."""
        collecting = gc.isenabled()
        gc.disable()  # under numba's lock of the compiler, so no two threads change it at once
        try:
            return super().compile_extra(func)
        finally:
            if collecting:
                gc.enable()

    def define_pipelines(self) -> list:
        """The passes."""
        pipeline = DefaultPassBuilder.define_nopython_pipeline(self.state)
        needed = [(one, text) for one, text in pipeline.passes if one.__name__ not in _NOT_NEEDED]
        pipeline.passes = [(self.lowering if one is NativeLowering else one, text) for one, text in needed]
        pipeline.finalize()
        return [pipeline]


class PieceCompiler(KernelCompiler):
    """The same for pieces."""

    lowering = PieceLowering
