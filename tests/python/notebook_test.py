"""examples/notebook.ipynb, run as a notebook is, with Debian's Jupyter tools."""
import os
import sys
import tempfile
from pathlib import Path

for module, package in (("nbclient", "nbclient"), ("nbformat", "nbformat"), ("ipykernel", "ipykernel"), ("numpy", "numpy")):
    try:
        __import__(module)
    except ImportError:
        print(f"SKIPPED: needs Debian's python3-{package}")
        sys.exit(0)

import nbformat
from jupyter_client import KernelManager
from jupyter_client.kernelspec import KernelSpec
from nbclient import NotebookClient


class ThisPython(KernelManager):
    """Whatever other kernels the user has installed."""

    @property
    def kernel_spec(self):
        return KernelSpec(argv=[sys.executable, "-Xfrozen_modules=off", "-m", "ipykernel_launcher", "-f", "{connection_file}"],
                          display_name="this Python", language="python")


notebook = nbformat.read(Path(os.environ["GYROSTAT_SOURCE_DIR"]) / "examples/notebook.ipynb", as_version=4)
code = [cell for cell in notebook.cells if cell.cell_type == "code"]
assert all(not cell.outputs and cell.execution_count is None for cell in code), "it is kept without outputs"
with tempfile.TemporaryDirectory(prefix="gyrostat_notebook_") as folder:
    os.environ |= {"IPYTHONDIR": folder, "JUPYTER_RUNTIME_DIR": folder, "JUPYTER_CONFIG_DIR": folder}
    NotebookClient(notebook, timeout=300, kernel_manager_class=ThisPython,
                   resources={"metadata": {"path": folder}}).execute()
    assert (Path(folder) / "runs/warm_up/store.db").exists()

shown = ["".join(str(data) for output in cell.outputs for data in output.get("data", {}).values()) for cell in code]
pictures = [html.count("data:image/svg+xml") for html in shown]
assert sum(count > 0 for count in pictures) >= 3, pictures
ranking = next(html for cell, html in zip(code, shown) if cell.source.startswith("gyrostat.rank"))
assert all(method in ranking for method in ("none", "kf", "mine", "sr_ukf", "oracle")), ranking[:2000]
printed = "".join(output.get("text", "") for output in code[-1].outputs)
assert printed.startswith("mine against kf: "), printed
print(f"{len(code)} cells ran; {sum(pictures)} pictures; {printed.strip()}")
