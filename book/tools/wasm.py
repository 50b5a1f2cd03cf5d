"""The loops that numba compiles, as one WebAssembly library for the pages of the book: `rosmini.core.geometry.wasm`.

numba's code before optimisation depends on the processor only in the layout of data, which LLVM computes. Integers and
an array's shape have 64 bits as on other machines, and addresses 32. `python -m book.tools.wasm FILE` writes the
library; it needs numba and `wasm-ld`, which is in Debian's package `lld`.
"""

from __future__ import annotations

import json
import os
import re
import shutil
import subprocess
import sys
from hashlib import sha256
from importlib import import_module
from importlib.metadata import version
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

TRIPLE = "wasm32-unknown-emscripten"
FEATURES = "+bulk-memory,+mutable-globals,+nontrapping-fptoint,+sign-ext"
LINK = ("wasm-ld", "-shared", "--experimental-pic", "--no-entry", "--allow-undefined")

CHECKOUT = Path(__file__).resolve().parents[2]
FOLDERS = ("core/geometry", "core/tf", "navigation", "sim/engine", "sim/geometry")
"""The folders of rosmini with loops, and with the functions and numbers that they use."""

MEMORY = """
declare ptr @malloc(i32)
declare void @free(ptr)
define ptr @NRT_MemInfo_alloc_aligned(i64 %size, i32 %align) {
  %small = trunc i64 %size to i32
  %whole = add i32 %small, 96
  %info = call ptr @malloc(i32 %whole)
  store i64 1, ptr %info
  %address = ptrtoint ptr %info to i32
  %end = add i32 %address, 95
  %aligned = and i32 %end, -64
  %data = inttoptr i32 %aligned to ptr
  %field = getelementptr {i64, ptr, ptr, ptr, i64}, ptr %info, i32 0, i32 3
  store ptr %data, ptr %field
  ret ptr %info
}
define void @NRT_MemInfo_call_dtor(ptr %info) {
  call void @free(ptr %info)
  ret void
}
"""
"""The two functions of numba's memory that loops with arrays of their own need; data begins at a multiple of 64."""


def library() -> Path | None:
    """Return the library, compiled once for the same sources (40 s), or None without numba or `wasm-ld`."""
    if find_spec("numba") is None or shutil.which(LINK[0]) is None:
        return None
    key = sha256(f"{version('numba')} {version('llvmlite')}".encode())
    sources = [path for folder in FOLDERS for path in (CHECKOUT / "rosmini" / folder).rglob("*.py")]
    for path in (Path(__file__), *sorted(sources)):
        key.update(path.read_bytes())
    compiled = CHECKOUT / f"book/_build/kernels-{key.hexdigest()[:16]}.wasm"
    if not compiled.exists():
        compiled.parent.mkdir(exist_ok=True)
        partial = compiled.with_suffix(f".{os.getpid()}")
        subprocess.run([sys.executable, "-m", __name__, str(partial)], cwd=CHECKOUT, check=True)
        for stale in compiled.parent.glob("kernels-*.wasm"):
            stale.unlink()
        partial.replace(compiled)
    return compiled


def loops() -> list[tuple[Callable[..., Any], Any]]:
    """Return all loops with their signatures, and let numba compile the functions that they call."""
    import numba
    from numba.extending import register_jitable

    found = []

    def record(function: Callable[..., Any], signature: Callable[[Any], Any], helpers: Any = ()) -> Any:
        for helper in helpers:
            register_jitable(helper)
        found.append((function, signature(numba)))
        return function

    machine_code: Any = import_module("rosmini.core.geometry.machine_code")
    machine_code.machine_code = record  # before the modules with loops import it
    import_module("rosmini.navigation.kernels").compile_all()
    engine = import_module("rosmini.sim.engine.kernels")
    for name in engine.PLAIN:
        engine.compiled(name)
    for module in ("engine.sweep_kernel", "geometry.raycast_numba"):
        import_module(f"rosmini.sim.{module}").compiled()
    return found


def flat(kinds: Any) -> Iterator[Any]:
    """Yield the numba types in nested tuples."""
    for kind in kinds:
        if hasattr(kind, "types"):
            yield from flat(kind.types)
        else:
            yield kind


def described(kind: Any) -> Any:
    """Return the description of a numba type: a number's code of `struct`, an array's type and dimensions, a list."""
    import numba

    if isinstance(kind, numba.types.Array):
        return [numba.np.numpy_support.as_dtype(kind.dtype).str, kind.ndim]
    if hasattr(kind, "types"):
        return [described(part) for part in kind.types]
    if kind == numba.void:
        return None
    return "d" if isinstance(kind, numba.types.Float) else "q"


def entry(name: str, compiled: str, types: list[str], kinds: list[Any], form: Any) -> str:
    """Return LLVM's text of a function that reads the arguments of a compiled loop from slots, and of its description.

    `types` are LLVM's for the arguments, `kinds` and `form` the descriptions of the arguments and the result.
    """
    body, arguments, slot = [], ["ptr %result", "ptr %error"], 0

    def load(type_: str) -> str:
        nonlocal slot
        body.append(f"%p{slot} = getelementptr i64, ptr %slots, i32 {slot}")
        body.append(f"%v{slot} = load {type_}, ptr %p{slot}")
        slot += 1
        return f"%v{slot - 1}"

    def product(*factors: str) -> str:
        total = factors[0]
        for n, factor in enumerate(factors[1:]):
            body.append(f"%m{slot}_{len(body)}_{n} = mul i64 {total}, {factor}")
            total = f"%m{slot}_{len(body) - 1}_{n}"
        return total

    for kind in kinds:
        if isinstance(kind, str):
            type_ = types[len(arguments)]
            arguments.append(f"{type_} {load(type_)}")
            continue
        size, data = kind[0][2:], load("ptr")
        shape = [load("i64") for _ in range(kind[1])]
        strides = [product(size, *shape[n + 1 :]) for n in range(kind[1])]
        arguments += ["ptr null", "ptr null", f"i64 {product(*shape)}", f"i64 {size}", f"ptr {data}"]
        arguments += [f"i64 {number}" for number in (*shape, *strides)]
    text = json.dumps({"arguments": kinds, "result": form}).replace('"', r"\22") + r"\00"
    length = len(text) - 2 * text.count("\\")
    return "\n".join(
        (
            f'@{name}_types = constant [{length} x i8] c"{text}"',
            f"declare i32 @{compiled}({', '.join(types)})",
            f"define i32 @{name}(ptr %slots) {{",
            "%error = alloca ptr",
            f"%result = getelementptr i64, ptr %slots, i32 {slot}",
            *body,
            f"%status = call i32 @{compiled}({', '.join(arguments)})",
            "ret i32 %status",
            "}",
        )
    )


def build(output: Path) -> None:
    """Compile and link the library."""
    os.environ["NUMBA_OPT"] = "0"  # LLVM optimises for WebAssembly below
    numba: Any = import_module("numba")
    llvm: Any = import_module("llvmlite.binding")
    llvm.initialize_all_targets()
    llvm.initialize_all_asmprinters()
    machine = llvm.Target.from_triple(TRIPLE).create_target_machine(features=FEATURES, opt=3, reloc="pic")
    head = f'target datalayout = "{machine.target_data}"\ntarget triple = "{TRIPLE}"\n'

    def parsed(text: str) -> Any:
        return llvm.parse_assembly(head + re.sub("^target .*$", "", text, flags=re.MULTILINE))

    whole, exported = parsed(MEMORY), set()
    for function, signature in loops():
        name, kinds = function.__name__, list(flat(signature.args))
        made = numba.njit([signature], no_cpython_wrapper=True, no_cfunc_wrapper=True)(function)
        (made,) = made.overloads.values()
        text = made.library.get_llvm_str().replace(" = common ", " = internal ")
        module = parsed(re.sub(r"@(sqrt|floor|ceil)\(", r"@llvm.\1.f64(", text))
        compiled = made.fndesc.llvm_func_name
        types = [str(argument.type) for argument in module.get_function(compiled).arguments]
        module.link_in(
            parsed(entry(name, compiled, types, [described(kind) for kind in kinds], described(signature.return_type)))
        )
        whole.link_in(module)
        exported |= {name, f"{name}_types"}
    for symbol in (*whole.functions, *whole.global_variables):
        if not symbol.is_declaration and symbol.name not in exported:
            symbol.linkage = "internal"
    passes = llvm.create_pass_builder(machine, llvm.create_pipeline_tuning_options(speed_level=3))
    passes.getModulePassManager().run(whole, passes)
    object_file = output.with_name(f"{output.name}.o")
    object_file.write_bytes(machine.emit_object(whole))
    exports = [f"--export={name}" for name in sorted(exported)]
    subprocess.run([*LINK, *exports, "-o", str(output), str(object_file)], check=True)
    object_file.unlink()


if __name__ == "__main__":
    build(Path(sys.argv[1]))
