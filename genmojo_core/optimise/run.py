"""The optimisation, told as events: the one way a clip becomes a scene (ARCHITECTURE.md section 2).

    run = Run(clip, plan, config)
    for event in run:
        ...
    scene = run.bake()

Reading order of the method: motion.py (initial motion), lift.py (first scene), then the loop below.
"""

from __future__ import annotations

import time
from collections.abc import Generator, Iterator, Sequence
from pathlib import Path

import torch

from genmojo_core.clip.cameras import Cameras
from genmojo_core.clip.clip import Clip
from genmojo_core.config import MOTION_SHARE, RunConfig
from genmojo_core.effects.plan import EffectPlan
from genmojo_core.errors import GenmojoError
from genmojo_core.events import (
    Checkpointed,
    Event,
    Failed,
    Finished,
    ParameterChanged,
    Preview,
    StageStarted,
    Warned,
)
from genmojo_core.optimise import call_in, checkpoint, density, parameters
from genmojo_core.optimise.absences import out_of_view
from genmojo_core.optimise.annotated import with_annotated
from genmojo_core.optimise.bake import Provenance, bake
from genmojo_core.optimise.cost import with_costs
from genmojo_core.optimise.deadline import Deadline
from genmojo_core.optimise.first_poses import Moves, first_poses, usable_motion
from genmojo_core.optimise.guard import Guard
from genmojo_core.optimise.held_out import held_frame_psnr, held_frames, without
from genmojo_core.optimise.lift import Lifted, lift, track_supervision
from genmojo_core.optimise.live import LiveFrame, live_frame
from genmojo_core.optimise.motion import ObjectMotion, initial_motion
from genmojo_core.optimise.objective import Outcome, TrackSupervision
from genmojo_core.optimise.planned import planned_clip
from genmojo_core.optimise.progress import Clock, Progress
from genmojo_core.optimise.schedule import (
    Stage,
    draw_frames,
    frames_in_play,
    make_optimiser,
    set_rates,
    stages,
    start_rate,
    wear_factor,
)
from genmojo_core.optimise.shading import start_shading, with_shade
from genmojo_core.optimise.still import objective_for, settle
from genmojo_core.optimise.targets import Targets
from genmojo_core.optimise.unseen import Moment, UnseenViews
from genmojo_core.optimise.working_space import working_space
from genmojo_core.priors.choose import choose as choose_prior
from genmojo_core.render.backend import choose
from genmojo_core.sentences import say
from genmojo_core.store.scene_file import BakedScene

SNAPSHOT_EVERY = 50  # steps
PREVIEW_EVERY = 25  # steps
PACE_EVERY = 5  # steps
CURVE = "curve.jsonl"  # in the run folder: the curve, a row a line
COST_STEP = 40  # steps of the joint stage after which effects' costs are measured, or a step later when resumed


class Run:
    """One optimisation of one clip.

    Args:
        clip: complete (estimate.complete), at the size to optimise. plan: its effects. config: presets and changes.
        run_dir: where checkpoints go; None writes none. resume: go on from run_dir's checkpoint.

    Iterating yields events and ends with Finished or Failed. `stop()` may be called from another thread or a signal
    handler: the loop ends after the present step with what it has. `bake()` works after the first Preview.
    `curve_path` says where the curve goes line by line; by default curve.jsonl in the run folder, if there is one.
    `motions`, set before, spare a run the search for the objects' motion that another of the same clip did.
    Between two events the caller may `change` a parameter, write a `checkpoint`, look at `live` Gaussians, or wait
    (with `clock.hold()` and `clock.go_on()` around it).

    Raises (on iteration):
        GenmojoError: no object in the clip ("empty"), a checkpoint that does not fit ("schema", "corrupt", "io").
    """

    def __init__(
        self, clip: Clip, plan: EffectPlan, config: RunConfig, run_dir: str | Path | None = None, resume: bool = False,
        curve_path: Path | None = None,
    ) -> None:  # fmt: skip
        self.held = held_frames(len(clip), config.held_out_every)
        self.space = working_space(clip)
        self.whole = self.space.inside(planned_clip(clip, plan))
        self.clip = without(self.whole, self.held)
        self.plan, self.config = plan, config
        self.run_dir = None if run_dir is None else Path(run_dir)
        self.resume = resume
        self.clock = Clock(config.clock)
        self.progress = Progress(config, stages(config, len(clip), plan.on("non_rigid_motion")), len(clip))
        self.progress.curve_path = curve_path or (None if self.run_dir is None else self.run_dir / CURVE)
        self.motions: list[ObjectMotion] | None = None
        self.stopped = False
        self.goal = False
        self.unseen: UnseenViews | None = None
        self.light_called_in = False
        self.step_limit: int | None = None
        self.changes: list[ParameterChanged] = []

    def stop(self) -> None:
        """Ask the loop to end after the present step."""
        self.stopped = True

    def bake(self) -> BakedScene:
        """The scene as it stands. Raises GenmojoError("empty") before the first Preview."""
        self._must_stand()
        config = {**self.config.to_json(), "input": self.clip.path, "guesses": list(self.clip.guesses)}
        if self.changes:
            config["changes"] = [change.to_json() for change in self.changes]
        metrics = {"steps": float(self.progress.step), "seconds": self.clock.now()[0]}
        provenance = Provenance(config, with_shade(self.plan, self.scene).to_json(), self.progress.curve, metrics)
        judged = None if self.unseen is None else self.unseen.supervised()
        return self.space.outside(bake(self.scene, self.clip, provenance, judged))

    def live(self, t: int) -> LiveFrame:
        """The Gaussians of frame t as they stand. Raises GenmojoError("empty") before the first Preview."""
        self._must_stand()
        return self.space.outside_live(live_frame(self.scene, t))

    def cameras(self) -> Cameras:
        """The clip's cameras at the optimised size. Raises GenmojoError("empty") before the first Preview."""
        self._must_stand()
        return self.space.outside_cameras(self.scene.cameras)

    def change(self, name: str, value: float) -> ParameterChanged:
        """Set a parameter of `parameters.PARAMETERS` from the next step on. Raises GenmojoError("argument")."""
        new = parameters.checked(name, value)
        if name == parameters.STEP_LIMIT:
            old = float(self.progress.total if self.step_limit is None else self.step_limit)
            self.step_limit = int(new)
        else:
            old = parameters.get(self.config, name)
            self.config = self.progress.config = parameters.put(self.config, name, new)
            if hasattr(self, "objective"):
                self.objective.weights = self.config.weights
            for group in self.optimiser.param_groups if hasattr(self, "optimiser") else ():
                group["start_lr"] = start_rate(group["kind"], self.config.rates)
        self.changes.append(ParameterChanged(*self.clock.now(), self.progress.step, name, old, new))
        return self.changes[-1]

    def add_point(self, **figures: float) -> None:
        """A point of the accuracy-against-time curve, with further figures of this moment; scoring takes no time.

        Raises GenmojoError("io") where the curve's file cannot be written.
        """
        self.clock.hold()
        if self.held:
            deform = self.progress.stages[-1].deform
            figures["psnr_held_frames"] = held_frame_psnr(self.objective, self.whole, self.held, deform)
        self.progress.point(self.clock, len(self.scene), **figures)
        self.clock.go_on()

    def timed_steps(self, count: int) -> list[tuple[float, float]]:
        """(wall, CPU) seconds of `count` joint steps from rough poses: what a step costs here, without the motion.

        The run is spent afterwards. Raises GenmojoError("empty") as `lift`.
        """
        threads = torch.get_num_threads()
        torch.set_num_threads(1)
        try:
            self._build(lift(self.clip, self.plan, self.config, first_poses(self.clip)), [])
            self._start()
            stage, times = Stage("joint", count, len(self.clip) > 1), []
            for _ in range(count):
                before = self.clock.now()
                self.progress.advance(self._step(stage, count - 1))
                after = self.clock.now()
                times.append((after[0] - before[0], after[1] - before[1]))
            return times
        finally:
            torch.set_num_threads(threads)

    def checkpoint(self) -> Checkpointed | None:
        """Write a checkpoint now; None before the first step or without a run folder. Raises GenmojoError("io")."""
        return next(self._checkpoint(), None) if hasattr(self, "guard") else None

    def __iter__(self) -> Iterator[Event]:
        """The events; see the class."""
        # torch's own threads wait actively for one another: on a busy machine a step takes ten times as long with two
        # of them as with one. The kernels that matter bring threads that sleep (kernels/threads.py).
        threads = torch.get_num_threads()
        torch.set_num_threads(1)
        events = self._events()
        try:
            while True:
                with torch.autocast("cpu", enabled=False), torch.autocast("cuda", enabled=False):  # float32 (N25)
                    event = next(events, None)
                if event is None:
                    return
                yield event
        finally:
            events.close()
            torch.set_num_threads(threads)

    def _events(self) -> Generator[Event, None, None]:
        torch.manual_seed(self.config.seed)
        if self.resume and self.run_dir is None:
            raise GenmojoError("argument", "there is no run folder to resume from", "--resume", "give --run-dir")
        yield StageStarted(*self.clock.now(), "first scene", 0, "every object where its pixels are")
        self._build(lift(self.clip, self.plan, self.config, first_poses(self.clip)), [])
        yield Preview(*self.clock.now(), "first scene", 0, self.reference, self._reference_psnr())
        yield StageStarted(*self.clock.now(), "motion", 0, "following every object through the clip")
        motions = self.motions or initial_motion(self.clip, deadline=self._motion_deadline())
        self.motions = motions
        if any(motion.hurried for motion in motions):
            yield Warned(*self.clock.now(), "motion_cut", say("motion_cut"))
        motions, doubts = usable_motion(self.clip, motions)
        for message in doubts:
            yield Warned(*self.clock.now(), "motion_not_found", message)
        motions = with_annotated(self.clip, out_of_view(self.clip, motions))
        planned, self.plan = self.plan, call_in.bending(self.clip, self.plan, motions, self.config.motion_bases)
        if self.plan is not planned:
            self.progress.stages = stages(self.config, len(self.clip), True)
            yield call_in.changed(self, "non_rigid_motion")
        lifted = lift(self.clip, self.plan, self.config, motions)
        for message in lifted.warnings:
            yield Warned(*self.clock.now(), "object_not_visible", message)
        self._build(lifted, track_supervision(lifted, motions) if self.plan.on("track_supervision") else [])
        yield from start_shading(self)
        yield from settle(self)
        yield from self._ask_prior(lifted, motions)
        self._start()
        yield Preview(*self.clock.now(), "motion", self.progress.step, self.reference, self._reference_psnr())
        try:
            for stage in self.progress.stages:
                yield from self._stage(stage)
                if self._over():
                    break
        except GenmojoError as error:
            yield Failed(*self.clock.now(), self.progress.step, error.code, error.sentence())
            return
        yield from self._checkpoint()
        reason = "interrupted" if self.stopped else "budget" if self.progress.out_of_time(self.clock) else "done"
        reason = "goal" if self.goal else reason
        yield Finished(*self.clock.now(), self.progress.step, reason, {"psnr_held_out": self.progress.psnr()})

    def _must_stand(self) -> None:
        if not hasattr(self, "scene"):
            raise GenmojoError("empty", "there is no scene yet", self.clip.name, "let the run reach its first preview")

    def _motion_deadline(self) -> Deadline:
        """The initial motion takes at most a share of the budget, and ends when the run is stopped."""
        left = MOTION_SHARE * self.config.budget_seconds - self.clock.this_run()
        now = time.process_time if self.config.clock == "cpu" else time.perf_counter
        return Deadline(now() + left, lambda: self.stopped, now)

    def _build(self, lifted: Lifted, tracks: list[TrackSupervision]) -> None:
        """The scene and what it is compared with."""
        self.scene = lifted.scene
        self.reference = sorted(o.ref_frame for o in self.scene.objects)[len(self.scene.objects) // 2]
        self.targets = Targets(self.clip, lifted.rows, self.config.held_out_share, self.config.seed)
        self.objective = objective_for(self)(self.scene, self.targets, self.plan, self.config.weights,
                                             choose(self.config.device), tracks, self.config.neighbours)  # fmt: skip
        self.generator = torch.Generator().manual_seed(self.config.seed)

    def _ask_prior(self, lifted: Lifted, motions: Sequence[Moves]) -> Iterator[Event]:
        """Gaussians for sides that no frame shows, if the plan has them drawn; says for what the prior is off."""
        prior = choose_prior(self.config.prior) if self.plan.on("unseen_views") else None
        if prior is None:
            return
        self.unseen = UnseenViews(prior, self.clip, self.config, lifted, motions, self.objective.splat)
        self.objective.refresh_neighbours()
        for message in self.unseen.notes():
            yield Warned(*self.clock.now(), "prior", message)

    def _start(self) -> None:
        """Optimiser and guard, and the checkpoint if there is one to resume."""
        self.watch = call_in.light_watch(self)
        if self.resume and self.run_dir is not None and checkpoint.peek(self.run_dir).get("light_called_in"):
            call_in.simulate_light(self, ("light_before", {}))
        self.optimiser = make_optimiser(self.scene, self.config)
        if self.resume and self.run_dir is not None:
            meta, state = checkpoint.load(self.run_dir, self.scene, self.optimiser)
            self.progress.restore(meta)
            self.clock.add(meta["seconds"], meta["cpu_seconds"])
            self.generator.set_state(torch.tensor(meta["generator"], dtype=torch.uint8))
            self._new_statistics()
            checkpoint.restore_working_state(self.statistics, self.objective, state)
        else:
            self._new_statistics()
        self.guard = Guard(self.scene, self.optimiser)

    def _reference_psnr(self) -> float:
        """Foreground PSNR of the reference frame in dB."""
        with torch.no_grad():
            outcome = self.objective.evaluate([self.reference], False, self.generator)
        return outcome.foreground[0][1] if outcome.foreground else 0.0

    def _stage(self, stage: Stage) -> Iterator[Event]:
        """Steps of one stage, with density control, snapshots, previews and checkpoints in between."""
        start = self.progress.begin(stage)
        if start >= stage.steps:
            return
        yield StageStarted(*self.clock.now(), stage.name, stage.steps, "")
        self.progress.score_rest(self.objective, self.held, stage.deform, self.clock)
        i = start
        while i < stage.steps:
            for message in self.guard.quarantine():
                yield Warned(*self.clock.now(), "not_finite", message)
            outcome = self._step(stage, i)
            for message in [*self.guard.news(), *(self.unseen.news() if self.unseen is not None else [])]:
                yield Warned(*self.clock.now(), "not_finite", message)
            i += 1
            if self.config.paced and (i < PACE_EVERY or i % PACE_EVERY == 0):
                stage = self.progress.pace(stage, i, self.clock)
            if self.progress.advance(outcome):
                self.add_point()
            yield self.progress.event(self.clock, len(self.scene))
            yield from call_in.change_effects(self, stage, outcome)
            if stage.deform and i == max(COST_STEP, start + 1):
                frames = list(range(min(self.config.frames_per_step, len(self.clip))))
                self.plan = with_costs(self.plan, self.objective, frames)
            if i % self.config.densify_every == 0 and i < 0.8 * stage.steps:
                self._control_density()
            if self.progress.step % SNAPSHOT_EVERY == 0:
                for model in self.scene.objects:
                    model.placement.limit_dolly(model.ref_frame)
                self.guard.snapshot()
            if self.progress.step % PREVIEW_EVERY == 0 and outcome.foreground:
                frame, psnr = outcome.foreground[-1]
                yield Preview(*self.clock.now(), stage.name, self.progress.step, frame, psnr)
            if self.progress.checkpoint_due(self.clock):
                yield from self._checkpoint()
            if self._over():
                return

    def _step(self, stage: Stage, i: int) -> Outcome:
        """One optimiser step."""
        share = i / stage.steps if stage.deform else 0.1
        share = share if len(self.clip) > 1 else 1.0
        candidates = frames_in_play(len(self.clip), self.reference, share, self.held)
        frames = draw_frames(candidates, self.config.frames_per_step, self.config.seed, self.progress.step)
        wear = wear_factor(self.progress.step, len(self.clip), self.config.frames_per_step)
        set_rates(self.optimiser, self.progress.fraction(self.clock), self.guard.rate * wear)
        self.optimiser.zero_grad(set_to_none=True)
        outcome = self.objective.evaluate(frames, stage.deform, self.generator)
        if self.unseen is not None:
            moment = Moment(self.progress.step / self.progress.total, stage.deform, self.progress.step)
            self.unseen.add_to(outcome, moment, self.config.weights.unseen, self.generator)
        outcome.loss.backward()
        verdict = self.guard.judge(outcome.loss, outcome.parts)
        if verdict == "rollback":
            self.guard.rollback()
        elif verdict == "step":
            for gaussians, statistics in self.statistics:
                if gaussians.means.grad is not None:
                    statistics.add(gaussians.means.grad)
            self.optimiser.step()
        return outcome

    def _control_density(self) -> None:
        """Grow and prune every object's Gaussians; the background keeps its own."""
        for gaussians, statistics in self.statistics:
            density.control(gaussians, statistics, self.config.gaussians_per_object, self.optimiser, self.generator)
        self.after_change()

    def after_change(self) -> None:
        """What depends on which Gaussians there are."""
        self.objective.refresh_neighbours()
        self._new_statistics()
        self.guard.snapshot()

    def _new_statistics(self) -> None:
        self.statistics = [(o.gaussians, density.GradientStatistics(len(o.gaussians))) for o in self.scene.objects]

    def _over(self) -> bool:
        limit = self.step_limit is not None and self.progress.step >= self.step_limit
        self.goal = self.goal or self.progress.goal_reached()
        return self.stopped or limit or self.goal or self.progress.out_of_time(self.clock)

    def _checkpoint(self) -> Iterator[Checkpointed]:
        if self.run_dir is None:
            return
        wall, cpu = self.clock.now()
        meta = {**self.progress.state(), "seconds": wall, "cpu_seconds": cpu,
                "generator": self.generator.get_state().tolist(),
                "light_called_in": self.light_called_in}  # fmt: skip
        path = checkpoint.save(self.run_dir, self.scene, self.optimiser, meta,
                               checkpoint.working_state(self.statistics, self.objective))  # fmt: skip
        self.progress.checkpointed(self.clock)
        yield Checkpointed(*self.clock.now(), self.progress.step, str(path))
