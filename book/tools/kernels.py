"""The kernels of `rosmini lab`: those of Jupyter, with advice on rosmini's magics before rosmini is loaded."""

from __future__ import annotations

from typing import TYPE_CHECKING

from jupyter_client.kernelspec import NATIVE_KERNEL_NAME, KernelSpecManager

if TYPE_CHECKING:
    from jupyter_client.kernelspec import KernelSpec


class Kernels(KernelSpecManager):
    """Starts Python's kernel with the extension `rosmini.notebook.unknown_magics`."""

    def get_kernel_spec(self, kernel_name: str) -> KernelSpec:
        """Return how to start a kernel."""
        spec = super().get_kernel_spec(kernel_name)
        if kernel_name == NATIVE_KERNEL_NAME:
            spec.argv = [*spec.argv, "--IPKernelApp.extra_extensions=rosmini.notebook.unknown_magics"]
        return spec
