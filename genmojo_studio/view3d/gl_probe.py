"""What OpenGL is here: a device, a program that imitates one, or nothing. Asked once per process."""

from __future__ import annotations

from enum import Enum
from functools import lru_cache

from PySide6.QtGui import QGuiApplication, QOffscreenSurface, QOpenGLContext, QSurfaceFormat

from genmojo_studio.translate import tr
from genmojo_studio.view3d.gl_pieces import is_software

_GL_RENDERER = 0x1F01


class GlKind(Enum):
    """How OpenGL 3.3 is provided."""

    MISSING = 0
    SOFTWARE = 1
    DEVICE = 2


@lru_cache(maxsize=1)
def probe() -> GlKind:
    """Make a small context and ask for its renderer's name. Needs a QGuiApplication."""
    if QGuiApplication.platformName() in ("offscreen", "minimal", "vnc", "linuxfb"):
        return GlKind.MISSING  # Qt draws no GL widgets there
    wanted = QSurfaceFormat()
    wanted.setVersion(3, 3)
    wanted.setProfile(QSurfaceFormat.OpenGLContextProfile.CoreProfile)
    context, surface = QOpenGLContext(), QOffscreenSurface()
    context.setFormat(wanted)
    if not context.create():
        return GlKind.MISSING
    surface.setFormat(context.format())
    surface.create()
    got = context.format()
    if (got.majorVersion(), got.minorVersion()) < (3, 3) or not context.makeCurrent(surface):
        return GlKind.MISSING
    try:
        name = str(context.functions().glGetString(_GL_RENDERER))
    finally:
        context.doneCurrent()
    return GlKind.SOFTWARE if is_software(name) else GlKind.DEVICE


def told(kind: GlKind) -> str:
    """What a person is told about who draws; "" for a graphics card."""
    if kind == GlKind.MISSING:
        return tr("No OpenGL here: the processor draws. Everything works, large scenes turn slower.")
    if kind == GlKind.SOFTWARE:
        return tr("OpenGL is emulated here: the processor draws directly, which is faster.")
    return ""
