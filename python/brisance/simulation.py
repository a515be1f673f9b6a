"""From a scene to a result: build the engine's scene, run it, gather what it gives back."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from contextlib import ExitStack
from dataclasses import dataclass
from types import TracebackType
from typing import Any, Self

import numpy as np
from numpy.typing import NDArray

from brisance import _engine
from brisance.curve_table import curve_source
from brisance.errors import InputError
from brisance.idle_keys import idle_keys
from brisance.interrupt import if_stopped, restore_terminal
from brisance.memory import check_fits, most_pieces
from brisance.model import AnyObject, Scene, Window
from brisance.naming import naming
from brisance.objects import pieces
from brisance.piece import PieceSet
from brisance.placement import check_charges, ground_warnings
from brisance.result import Bodies, Result, Source
from brisance.windows import broken_panes, whole_pane

MAX_STEPS = 10**10
"""Steps of integration beyond which a run would take days, so that the step is surely a slip."""
PATIENCE = 1.0
"""Seconds after which a long run begins to show its progress."""


@dataclass(frozen=True, eq=False)
class Built:
    """A scene ready to run: the engine's own and the pieces it was given, in order."""

    engine: _engine.Scene
    sets: list[PieceSet]
    """One an object: its pieces, or of a window those of its frame."""
    windows: list[Window]
    """The windows; whole panes stand after all other bodies, and after a run their pieces."""
    warnings: list[str]

    panes: list[PieceSet]
    """One a window: its pane in one piece."""

    @property
    def standing(self) -> list[PieceSet]:
        """What stands before the blast, in the engine's order: all pieces of objects, then whole panes."""
        return [*self.sets, *self.panes]

    @property
    def names(self) -> list[str]:
        """Name of every body that is no piece of a pane, in order."""
        return [name for group in self.sets for name in group.names]


def simulate(
    scene: Scene, *, progress: bool | Callable[[int, int], None] = False, threads: int | None = None
) -> Result:
    """Simulate a scene.

    ``progress`` true shows a bar on stderr once the run has taken a second; a function is called every
    twentieth of a second with the frames done and all frames, 0 of 0 while the loads are worked out, and
    whatever it raises ends the run. ``threads`` bounds the threads used, 1 or more; the result is the same to
    the last bit whatever it is. Raises :class:`InputError` where the scene cannot be run: files that are
    missing, or more frames and pieces than memory holds, which is found out before any work.
    """
    if threads is not None and threads < 1:
        raise InputError(f"threads must be 1 or more, not {threads}.")
    started = time.perf_counter()
    check_fits(scene.time.frames, scene.piece_count)
    _check_step(scene)
    built = build(scene)
    ready = time.perf_counter()
    with _Progress(progress is True) as bar, naming(built.names, built.windows):
        told = progress if callable(progress) else bar.update if progress else None
        recording = built.engine.simulate(
            threads=threads,
            most_pieces=most_pieces(scene.time.frames, len(built.names)),
            progress=told,
        )
    result = _result(scene, built, recording)
    result.timing_s = {
        **recording.timing_s,
        "load": ready - started + recording.timing_s.get("load", 0.0),
        "total": time.perf_counter() - started,
    }
    return result


def build(scene: Scene) -> Built:
    """Hand a scene to the engine. Raises :class:`InputError` for whatever the engine or an object refuses."""
    air, loading, ground = scene.air, scene.loading, scene.ground
    try:
        engine = _engine.Scene(
            pressure=air.pressure,
            temperature=air.temperature,
            ground=(ground.height, ground.friction) if ground else None,
            duration=scene.time.end,
            frame_rate=scene.time.frame_rate,
            step=scene.time.step,
            mode=loading.mode,
            clearing=loading.clearing,
            drag=loading.drag,
            pulse=loading.pulse,
            negative_phase=loading.negative_phase,
            occlusion=scene.occlusion.model_dump(),
            damping_factor=scene.dynamics.damping_factor,
            rotation_factor=scene.dynamics.rotation_factor,
            contacts=scene.dynamics.contacts,
            until_rest=scene.time.until_rest,
        )
        for number, charge in enumerate(scene.charges):
            engine.add_charge(
                mass=charge.mass,
                tnt_equivalence=charge.factor,
                position=charge.position,
                burst=charge.burst,
                time=charge.time,
                gain=charge.gain,
                source=_source(scene, number),
            )
        sets = [pieces(obj, base_folder=scene.base_folder, seed=seed) for obj, seed in _seeded(scene)]
        for group in sets:
            if group.add_to is not None:
                group.add_to(engine)
        centres = engine.centres_of_mass()
    except ValueError as error:
        raise InputError(str(error)) from error
    check_charges(scene, sets)
    windows = [obj for obj in scene.objects if isinstance(obj, Window)]
    panes = [whole_pane(window, scene) for window in windows]
    warnings = [*_warnings(scene, sets), *ground_warnings(scene, sets, centres)]
    built = Built(engine, sets, windows, warnings, panes)
    _check_names(built.standing)
    return built


def _seeded(scene: Scene) -> Iterator[tuple[AnyObject, int]]:
    """Objects, each window with a seed of its own, the first one with the scene's."""
    seed = scene.seed
    for obj in scene.objects:
        yield obj, seed
        seed = (seed + isinstance(obj, Window)) % 2**63


def _source(scene: Scene, number: int) -> str | dict[str, NDArray[np.float64]]:
    try:
        return curve_source(scene.charges[number].curves, base_folder=scene.base_folder)
    except InputError as error:
        raise InputError(f"charge.{number}: {error}") from None


def _check_step(scene: Scene) -> None:
    step, duration = scene.time.step, scene.time.end
    if step is not None and step * MAX_STEPS < duration:
        raise InputError(
            f"time.step must be at least {duration / MAX_STEPS:.3g} s for a duration of {duration:g} s, "
            f"not {step:g}; leave it out to have it chosen."
        )


def _check_names(sets: list[PieceSet]) -> None:
    """Pieces go by name in every output, so no two may share one (a block may be called what a brick is)."""
    owner: dict[str, str] = {}
    for group in sets:
        for name in group.names:
            if name in owner:
                raise InputError(
                    f"{group.name}: its piece {name!r} has the name of a piece of {owner[name]}; "
                    "rename one of the objects."
                )
            owner[name] = group.name


def _warnings(scene: Scene, sets: list[PieceSet]) -> list[str]:
    warnings = [warning for group in sets for warning in group.warnings]
    warnings += idle_keys(scene)
    if scene.ground is None and not all(obj.anchored for obj in scene.objects):
        warnings.append("The scene has no [ground], so nothing stops what falls.")
    if not sets:
        warnings.append("The scene has no object for the blast to act on.")
    return warnings


def _result(scene: Scene, built: Built, recording: _engine.Recording) -> Result:
    panes = broken_panes(built.windows, built.panes, recording, start=len(built.names))
    _check_names([*built.sets, *(group for group, _ in panes)])
    sets = [*(group for group in built.sets if len(group)), *(group for group, _ in panes)]
    sources, start = [], 0
    for group in sets:
        sources.append(Source(group.name, group.material, start, start + len(group)))
        start += len(group)
    bodies = Bodies(
        names=[name for group in sets for name in group.names],
        source=[group.name for group in sets for _ in group.names],
        mass_kg=recording.mass_kg,
        frontal_area_m2=recording.frontal_area_m2,
        distance_m=recording.distance_m,
        arrival_time_s=recording.arrival_time_s,
        peak_overpressure_pa=recording.peak_overpressure_pa,
        peak_load_pa=recording.peak_load_pa,
        impulse_n_s=recording.impulse_n_s,
        attenuation=recording.attenuation,
        launch_speed_m_s=recording.launch_speed_m_s,
        free_time_s=recording.free_time_s,
        rest_time_s=recording.rest_time_s,
        final_position_m=recording.positions[-1].astype(np.float64),
    )
    pane_warnings = [warning for group, _ in panes for warning in group.warnings]
    return Result(
        scene=scene,
        times=recording.times,
        positions=recording.positions,
        orientations=recording.orientations,
        meshes=[mesh for group in sets for mesh in group.meshes],
        sources=sources,
        bodies=bodies,
        step_s=recording.step_s,
        panes=[pane for _, pane in panes],
        warnings=list(dict.fromkeys([*built.warnings, *pane_warnings, *recording.warnings])),
    )


class _Progress:
    """A bar on stderr that appears only when the work has taken longer than a moment."""

    def __init__(self, wanted: bool) -> None:
        self._wanted = wanted
        self._started = time.perf_counter()
        self._bar: Any = None
        self._task: Any = None
        self._stack = ExitStack()

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._stack.close()

    def update(self, done: int, total: int) -> None:
        """Show that ``done`` of ``total`` parts are done; nothing before there is a total."""
        if total == 0:
            return
        if self._bar is None:
            if not self._wanted or time.perf_counter() - self._started < PATIENCE:
                return
            from rich.console import Console
            from rich.progress import Progress

            console = Console(stderr=True)
            self._bar = Progress(console=console, transient=True, disable=not console.is_terminal)
            self._task = self._bar.add_task("simulating", total=total)
            if console.is_terminal:
                self._stack.enter_context(if_stopped(restore_terminal))
            self._stack.enter_context(self._bar)
        self._bar.update(self._task, completed=done, total=total)
