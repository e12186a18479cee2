"""The splat renderer: OpenGL 3.3 core through moderngl, knows no Qt. Also used off screen by exports and tests.

Order of a frame: textures (only what changed) -> drawing order -> PROJECT -> SPLAT -> RESOLVE (shaders.py). Rules for
widgets are in splat_view.py; here the only one is that the owner has made the context current.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import moderngl
import numpy as np

from genmojo_core.clip.cameras import View
from genmojo_core.errors import GenmojoError
from genmojo_studio.view3d import shaders
from genmojo_studio.view3d.colouring import palette_rgb, value_bounds
from genmojo_studio.view3d.gl_pieces import (
    bind,
    is_software,
    jacobian_limits,
    matrix,
    release_target,
    set_uniform,
    straight,
)
from genmojo_studio.view3d.look import Look, Mode, ObjectTable, object_table
from genmojo_studio.view3d.orbit import next_pose
from genmojo_studio.view3d.order import EXACT_UP_TO, Sorter, back_to_front
from genmojo_studio.view3d.quality import FULL, Picture, Quality
from genmojo_studio.view3d.scene_textures import TEXELS, SceneTextures, nearest, rows_of
from genmojo_studio.view3d.snapshot import SceneSnapshot

_VALUE = {  # what PROJECT puts into a splat's channels
    Mode.RGB: 0, Mode.ELLIPSOIDS: 0, Mode.CENTRES: 0, Mode.OPACITY: 0, Mode.INSTANCE_SOFT: 1, Mode.DEPTH: 2,
    Mode.DEPTH_MEDIAN: 2, Mode.FLOW: 3, Mode.NORMAL: 4, Mode.RESIDUAL: 5,
}  # fmt: skip
_SHOW = {Mode.DEPTH: 1, Mode.DEPTH_MEDIAN: 1, Mode.RESIDUAL: 1, Mode.FLOW: 2, Mode.NORMAL: 3, Mode.INSTANCE: 4,
         Mode.OPACITY: 5}  # fmt: skip
_STYLE = {Mode.ELLIPSOIDS: 1, Mode.CENTRES: 2}
_PREMULTIPLIED = (moderngl.ONE, moderngl.ONE_MINUS_SRC_ALPHA)
_BISECTIONS = 5  # each narrows the median depth to a fifth
DOT_PIXELS = 1.6


class SplatRenderer:
    """Draws snapshots. All methods need the context current; one thread.

    Args:
        ctx: moderngl context, OpenGL 3.3 core or later.
        wake: called from the sorting thread when a better order is ready (large scenes); must only schedule a redraw.
        exact_up_to: splats up to which every frame is sorted exactly before it is drawn.
    """

    def __init__(self, ctx: Any, wake: Callable[[], None] | None = None, exact_up_to: int = EXACT_UP_TO) -> None:
        if ctx.version_code < 330:
            offered = f"this driver offers OpenGL {ctx.version_code / 100:.1f}, 3.3 is needed"
            raise GenmojoError("missing_package", offered, "3D view", "the processor draws instead")
        self.ctx = ctx
        self.name = str(ctx.info["GL_RENDERER"])
        self.is_software = is_software(self.name)
        self.exact_up_to = exact_up_to
        self.order_is_exact = True
        self._project = ctx.program(shaders.WHOLE_TARGET, shaders.PROJECT)
        self._splat = ctx.program(shaders.SPLAT_VERTEX, shaders.SPLAT_FRAGMENT)
        self._resolve = ctx.program(shaders.WHOLE_TARGET, shaders.RESOLVE)
        self._narrow = ctx.program(shaders.WHOLE_TARGET, shaders.NARROW)
        self._keep = ctx.program(shaders.WHOLE_TARGET, shaders.KEEP_BEST)
        self._median = ctx.program(shaders.WHOLE_TARGET, shaders.MEDIAN)
        programs = (self._project, self._splat, self._resolve, self._narrow, self._keep, self._median)
        self._arrays = {program: ctx.vertex_array(program, []) for program in programs}
        self._palette = ctx.texture((256, 1), 3, (palette_rgb() * 255).round().astype(np.uint8).tobytes(), alignment=1)
        self._empty_layers = nearest(ctx.texture_array((1, 1, 1), 4, dtype="f4"))
        self._sorter = Sorter(wake)
        self._scene: SceneTextures | None = None
        self._work: Any = None
        self._targets: dict[str, Any] = {}
        self._drawn_order: tuple[object, np.ndarray] | None = None
        self._shuffle: np.ndarray = np.zeros(0, np.int64)
        self._table: tuple[object, ObjectTable] | None = None

    # ---- what to draw -------------------------------------------------------------------------------------------

    def upload(self, snapshot: SceneSnapshot) -> None:
        """Take a snapshot; textures are kept where sizes fit."""
        if len(snapshot) > TEXELS * self.ctx.info["GL_MAX_TEXTURE_SIZE"]:
            raise GenmojoError("budget", f"{len(snapshot)} Gaussians are more than this driver can hold", "3D view")
        if self._scene is not None and self._scene.fits(snapshot):
            self._scene.upload(snapshot)
        else:
            self._drop_scene()
            self._scene = SceneTextures(self.ctx, snapshot)
            textures = [nearest(self.ctx.texture((TEXELS, rows_of(len(snapshot))), 4, dtype="f4")) for _ in range(3)]
            self._work = self.ctx.framebuffer(textures)
        if len(self._shuffle) != len(snapshot):
            self._shuffle = np.random.default_rng(0).permutation(len(snapshot))
        self._table, self._drawn_order = None, None

    def set_residuals(self, values: np.ndarray) -> None:
        """One number per splat (N,), shown by Mode.RESIDUAL."""
        if self._scene is not None:
            self._scene.write_scalars(values)

    def prefetch(self) -> bool:
        """Bring one more frame to the GPU; False where all that fit are there."""
        t = self._scene.missing() if self._scene is not None else None
        if self._scene is None or t is None:
            return False
        self._scene.layer(t)
        return self._scene.missing() is not None

    # ---- drawing ------------------------------------------------------------------------------------------------

    def draw(self, view: View, look: Look, t: float | None = None, quality: Quality = FULL) -> None:
        """Draw into the renderer's own target: the mode's sums for `view` at time t (None: the snapshot's frame).

        Args:
            view: camera and size in pixels; with `quality.scale` < 1 fewer pixels are drawn of the same picture.
            t: 0..T-1, between frames interpolated; without known frames always the snapshot's.
        """
        if quality.scale != 1.0:
            view = view.resized(*quality.size(view.width, view.height))
        target = self._target("sums", (view.width, view.height))
        self.ctx.enable_only(moderngl.BLEND)
        self.ctx.blend_func = _PREMULTIPLIED
        self.ctx.blend_equation = moderngl.FUNC_ADD
        target.use()
        target.clear(0.0, 0.0, 0.0, 0.0)
        scene = self._scene
        if scene is None or len(scene.snapshot) == 0:
            return
        count = self._prepare(scene, view, look, self._time(scene, t, look), quality)
        if look.mode == Mode.INSTANCE:
            self._draw_objects(scene, view, count)
        elif look.mode == Mode.DEPTH_MEDIAN:
            self._draw_median(scene, view, count)
        else:
            self._project_all(scene, _VALUE[look.mode], count)
            self._splats(target, count, _STYLE.get(look.mode, 0))

    def resolve(self, target: Any, look: Look, bounds: tuple[float, float]) -> None:
        """Colour the last `draw` into a framebuffer of any size whose first row is at the bottom (a screen)."""
        self._resolve_into(target, look, bounds)

    def picture(self, view: View, look: Look, t: float | None = None) -> Picture:
        """Draw off screen at full quality and read the sums back."""
        self.draw_exactly(view, look, t)
        data = np.frombuffer(self._targets["sums"].read(components=4, dtype="f4"), np.float32)
        return Picture(data.reshape(view.height, view.width, 4)[::-1].copy(), self.order_is_exact)

    def image(self, view: View, look: Look, t: float | None = None) -> np.ndarray:  # (H, W, 4) uint8
        """An image as the screen shows it, row 0 at the top; straight alpha where the look has no backdrop."""
        self.draw_exactly(view, look, t)
        target = self._target("image", (view.width, view.height), dtype="f1")
        self._resolve_into(target, look, look.value_range or self.measure(look))
        data = np.frombuffer(target.read(components=4), np.uint8).reshape(view.height, view.width, 4)[::-1]
        return data.copy() if look.backdrop is not None else straight(data)

    def draw_exactly(self, view: View, look: Look, t: float | None = None) -> None:
        """Draw with this camera's own order, however large the scene: for screenshots, videos and measurements."""
        most, self.exact_up_to = self.exact_up_to, 1 << 62
        try:
            self.draw(view, look, t)
        finally:
            self.exact_up_to = most

    def measure(self, look: Look) -> tuple[float, float]:
        """Lowest and highest value of the last `draw`, for a colour scale (2nd and 98th percentile where covered)."""
        target = self._targets["sums"]
        data = np.frombuffer(target.read(components=4, dtype="f4"), np.float32).reshape(-1, 4)
        return value_bounds(data, look.mode)

    def release(self) -> None:
        """Stop the sorting thread and free everything on the GPU; the renderer cannot be used afterwards."""
        self._sorter.stop()
        self._drop_scene()
        for target in self._targets.values():
            release_target(target)
        self._targets = {}
        for program, array in self._arrays.items():
            array.release()
            program.release()
        self._palette.release()
        self._empty_layers.release()

    # ---- pieces -------------------------------------------------------------------------------------------------

    def _time(self, scene: SceneTextures, t: float | None, look: Look) -> float:
        """The time to draw, inside the clip."""
        if scene.snapshot.frames is None or t is None:
            return float(scene.snapshot.frame)
        return float(min(max(t, 0.0), scene.snapshot.T - 1))

    def _prepare(self, scene: SceneTextures, view: View, look: Look, t: float, quality: Quality) -> int:
        """Order, object table and uniforms for a frame; the number of splats to draw."""
        table = self._objects(scene, look)
        order = self._order(scene, view, table, t, quality)
        scene.write_order(order)
        first = int(t)
        layers = (scene.layer(first), scene.layer(first + 1) if t > first else scene.layer(first))
        if look.mode == Mode.FLOW:
            after = min(t + 1, scene.snapshot.T - 1) if scene.snapshot.frames is not None else t
            scene.write_next(after, scene.positions(after))
        p = self._project
        set_uniform(p, "camera", matrix(view.world_to_camera))
        set_uniform(p, "next_camera", matrix(next_pose(scene.snapshot.cameras, view, t)))
        set_uniform(p, "lens", (view.fx, view.fy, view.cx, view.cy))
        set_uniform(p, "limits", jacobian_limits(view))
        set_uniform(p, "range", (view.near, view.far, view.dilation))
        set_uniform(p, "splat_scale", look.splat_scale)
        set_uniform(p, "thinning", float(quality.stride) ** 0.5)
        set_uniform(p, "size", (float(view.width), float(view.height)))
        set_uniform(p, "layers", layers)
        set_uniform(p, "between", t - first)
        set_uniform(p, "count", len(order))
        set_uniform(self._splat, "size", (float(view.width), float(view.height)))
        set_uniform(self._splat, "dot_size", DOT_PIXELS * max(1.0, view.height / 720))
        return len(order)

    def _objects(self, scene: SceneTextures, look: Look) -> ObjectTable:
        """The object table, worked out and written where the look has changed."""
        key = (look.show_background, look.solo, tuple(sorted(look.objects.items())), look.explode)
        if self._table is None or self._table[0] != key:
            self._table = (key, object_table(scene.snapshot, look))
            scene.write_objects(self._table[1])
        return self._table[1]

    def _order(self, scene: SceneTextures, view: View, table: ObjectTable, t: float, quality: Quality) -> np.ndarray:
        """Rows of the shown splats, farthest first; for a large scene the newest order there is."""
        owner = scene.snapshot.object_index
        drawn = table.shown[owner] & scene.snapshot.is_sound
        rows = np.flatnonzero(drawn)
        if quality.stride > 1:
            rows = self._shuffle[:: quality.stride]
            rows = np.sort(rows[drawn[rows]])
        row = view.world_to_camera[2].astype(np.float32)
        depth = scene.positions(t)[rows] @ row[:3] + (table.offset @ row[:3])[owner[rows]]
        if len(rows) <= self.exact_up_to:
            self.order_is_exact = True
            return rows[back_to_front(depth)].astype(np.uint32)
        key = (table.shown.tobytes(), quality.stride)
        self._sorter.request(key, rows, depth)
        ready = self._sorter.take() or self._drawn_order
        self.order_is_exact = False
        if ready is None or ready[0] != key:
            ready = (key, rows[back_to_front(depth)].astype(np.uint32))
        self._drawn_order = ready
        return ready[1]

    def _project_all(self, scene: SceneTextures, value: int, count: int) -> None:
        """PROJECT: fill the work buffer's first `count` texels."""
        names = {"order": scene.order, "places": scene.places, "turns": scene.turns, "sizes": scene.sizes,
                 "colours": scene.colours, "objects": scene.objects, "scalars": scene.scalars,
                 "next_places": scene.next_places}  # fmt: skip
        arrays = scene.layers or [self._empty_layers] * 4
        names |= dict(zip(("layer_places", "layer_turns", "layer_sizes", "layer_colours"), arrays, strict=True))
        bind(self._project, names)
        set_uniform(self._project, "mode", value)
        self._work.use()
        self._work.viewport = (0, 0, TEXELS, rows_of(count))
        self.ctx.disable(moderngl.BLEND)
        self._arrays[self._project].render(moderngl.TRIANGLES, vertices=3)
        self.ctx.enable(moderngl.BLEND)

    def _splats(self, target: Any, count: int, style: int, bracket: Any = None) -> None:
        """SPLAT: blend `count` splats of the work buffer into a target."""
        place, shape, value = self._work.color_attachments
        bind(self._splat, {"place": place, "shape": shape, "value": value, "bracket": bracket or place})
        set_uniform(self._splat, "style", style)
        target.use()
        if count:
            self._arrays[self._splat].render(moderngl.TRIANGLE_STRIP, vertices=4, instances=count)

    def _draw_objects(self, scene: SceneTextures, view: View, count: int) -> None:
        """The object with the largest share of every pixel: three shares a pass, the best kept."""
        size = (view.width, view.height)
        shares, result = self._target("shares", size), self._targets["sums"]
        best = [self._target("best0", size), self._target("best1", size)]
        objects = len(scene.snapshot.object_ids)
        for turn, first in enumerate(range(0, objects, 3)):
            self._project_all(scene, 10 + first, count)
            shares.clear(0.0, 0.0, 0.0, 0.0)
            self._splats(shares, count, 0)
            into = result if first + 3 >= objects else best[turn % 2]
            self._whole(self._keep, into, {"shares": shares.color_attachments[0],
                        "best": best[(turn + 1) % 2].color_attachments[0]}, first=first)  # fmt: skip

    def _draw_median(self, scene: SceneTextures, view: View, count: int) -> None:
        """Median depth by search: the light absorbed in front of four depths at once, five times."""
        size = (view.width, view.height)
        near, far = self._depth_range(scene, view)
        brackets = [self._target("bracket0", size), self._target("bracket1", size)]
        absorbed = self._target("shares", size)
        self._project_all(scene, 2, count)
        brackets[0].clear(near, far, 0.0, 0.0)
        for turn in range(_BISECTIONS):
            now, after = brackets[turn % 2], brackets[(turn + 1) % 2]
            absorbed.clear(0.0, 0.0, 0.0, 0.0)
            self.ctx.blend_func = (moderngl.ONE, moderngl.ONE)
            self._splats(absorbed, count, 3, now.color_attachments[0])
            self.ctx.blend_func = _PREMULTIPLIED
            textures = {"absorbed": absorbed.color_attachments[0], "bracket": now.color_attachments[0]}
            self._whole(self._narrow, after, textures)
        found = brackets[_BISECTIONS % 2].color_attachments[0]
        cell = (far - near) / 5.0**_BISECTIONS
        self._whole(self._median, self._targets["sums"], {"bracket": found}, none_from=far - 0.5 * cell)

    def _depth_range(self, scene: SceneTextures, view: View) -> tuple[float, float]:
        """Depths of the nearest and farthest splat in front of the camera."""
        row = view.world_to_camera[2]
        z = scene.snapshot.positions @ row[:3].astype(np.float32) + np.float32(row[3])
        z = z[(z >= view.near) & (z <= view.far)]
        return (float(z.min()) * 0.999, float(z.max()) * 1.001) if len(z) else (view.near, view.far)

    def _whole(self, program: Any, target: Any, textures: dict[str, Any], **uniforms: Any) -> None:
        """Run a program over every pixel of a target, without blending."""
        bind(program, textures)
        for name, value in uniforms.items():
            set_uniform(program, name, value)
        target.use()
        self.ctx.disable(moderngl.BLEND)
        self._arrays[program].render(moderngl.TRIANGLES, vertices=3)
        self.ctx.enable(moderngl.BLEND)

    def _resolve_into(self, target: Any, look: Look, bounds: tuple[float, float]) -> None:
        """RESOLVE the last sums into a target."""
        sums = self._targets["sums"].color_attachments[0]
        sums.filter = (moderngl.LINEAR, moderngl.LINEAR)
        objects = self._scene.objects if self._scene is not None else self._palette
        backdrop = (0.0, 0.0, 0.0, 0.0) if look.backdrop is None else (*look.backdrop, 1.0)
        self._whole(
            self._resolve, target, {"sums": sums, "palette": self._palette, "objects": objects},
            show=_SHOW.get(look.mode, 0), backdrop=backdrop, bounds=bounds,
            target_size=(float(target.width), float(target.height)),
        )  # fmt: skip

    def _target(self, name: str, size: tuple[int, int], dtype: str = "f4") -> Any:
        """A framebuffer of the renderer's own with one texture of four channels; made again where its size changes."""
        found = self._targets.get(name)
        if found is None or found.size != size:
            if found is not None:
                release_target(self._targets.pop(name))
            if max(size) > self.ctx.info["GL_MAX_TEXTURE_SIZE"]:
                raise GenmojoError("budget", f"a picture of {size[0]} x {size[1]} pixels is more than this driver "
                                   "draws", "3D view", "choose a smaller size")  # fmt: skip
            found = self.ctx.framebuffer([nearest(self.ctx.texture(size, 4, dtype=dtype))])
            self._targets[name] = found
        return found

    def _drop_scene(self) -> None:
        """Free the snapshot's textures."""
        if self._scene is not None:
            self._scene.release()
            release_target(self._work)
            self._scene = None
