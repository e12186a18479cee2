"""What this is, which version, and under which licences its parts stand."""

from __future__ import annotations

from importlib import metadata

from PySide6.QtCore import qVersion
from PySide6.QtWidgets import QDialog, QDialogButtonBox, QTextBrowser, QVBoxLayout, QWidget

from genmojo_studio.translate import tr

# Package, licence, what it is used for. Taken from the packages' own licence files.
PARTS = (
    ("PySide6-Essentials", "LGPL-3.0", "Qt for Python"),
    ("pyqtgraph", "MIT", "curves"),
    ("moderngl", "MIT", "OpenGL"),
    ("numpy", "BSD-3-Clause", "arrays"),
    ("torch", "BSD-3-Clause", "optimisation (in the worker)"),
    ("numba", "BSD-2-Clause", "compiled kernels"),
    ("h5py", "BSD-3-Clause", "HDF5"),
    ("opencv-contrib-python-headless", "Apache-2.0", "images, flow"),
    ("av", "BSD-3-Clause; FFmpeg LGPL/GPL", "video"),
    ("safetensors", "Apache-2.0", "checkpoints"),
    ("tqdm", "MPL-2.0 and MIT", "progress of the command line"),
)


class About(QDialog):
    """Version and licences."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setWindowTitle(tr("About and licences"))
        self.resize(640, 520)
        text = QTextBrowser(openExternalLinks=False)
        text.setHtml(_html())
        buttons = QDialogButtonBox(QDialogButtonBox.StandardButton.Close)
        buttons.rejected.connect(self.reject)
        layout = QVBoxLayout(self)
        layout.addWidget(text)
        layout.addWidget(buttons)


def _html() -> str:
    rows = "".join(
        f"<tr><td>{name}&nbsp;&nbsp;</td><td>{_version(name)}&nbsp;&nbsp;</td><td>{licence}&nbsp;&nbsp;</td>"
        f"<td>{use}</td></tr>"
        for name, licence, use in PARTS
    )
    said = tr("The app is under the MIT licence. It contains no code of the Inria rasteriser or of CoTracker; models "
              "that you connect yourself have licences of their own.")  # fmt: skip
    return (
        f"<h2>GenMOJO Studio {_version('genmojo-studio')}</h2><p>{said}</p><p>Qt {qVersion()}</p>"
        f"<h3>{tr('Parts')}</h3><table>{rows}</table>"
    )


def _version(package: str) -> str:
    try:
        return metadata.version(package)
    except metadata.PackageNotFoundError:
        return ""
