"""The windows of a run: their panes before it, and what has become of them after it."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from brisance import _engine
from brisance.model import Scene, Window
from brisance.piece import PieceSet
from brisance.result import Pane


def whole_pane(window: Window, scene: Scene) -> PieceSet:
    """The pane of a window in one piece."""
    from brisance.objects.window import glazing, whole_mesh

    name = window.name or window.kind
    mesh = whole_mesh(glazing(window, base_folder=scene.base_folder).rings, window.thickness)
    return PieceSet(name=name, material="glass", names=[name], meshes=[mesh])


def broken_panes(
    windows: list[Window], panes: list[PieceSet], recording: _engine.Recording, *, start: int
) -> list[tuple[PieceSet, Pane]]:
    """The pieces of each window, whose pane was one of ``panes`` before, and what became of that pane.

    ``start`` is the number of the first piece of a pane among the bodies of the recording.
    """
    if not windows:
        return []
    from brisance.objects.window import pane_pieces

    found = []
    held_back, times = recording.held_back_n_s, recording.times.tolist()
    for window, whole, after in zip(windows, panes, recording.panes, strict=True):
        group = pane_pieces(window, after, name=whole.name)
        stop = start + len(group)
        mesh = whole.meshes[0]
        taken = held_back[start:stop].sum(axis=0).tolist()
        pane = Pane(
            name=whole.name,
            window=window,
            fate=after.fate,
            failure_time_s=after.failure_time_s,
            failure_place_m=after.failure_place_m,
            peak_pressure_pa=after.peak_pressure_pa,
            peak_stress_pa=after.peak_stress_pa,
            strength_pa=window.limit,
            start=start,
            stop=stop,
            staying=after.staying,
            mean_area_m2=float(after.pieces.area_m2.mean()),
            frame_impulse_n_s=(taken[0], taken[1], taken[2]),
            mesh=mesh,
            deflection=after.deflection(mesh.points[:, :2].astype(np.float64)),
            amplitude=after.amplitude(times),
            broken_at_s=_broken_at(after, recording.arrival_time_s[start:stop]),
        )
        found.append((group, pane))
        start = stop
    return found


def _broken_at(pane: _engine.Pane, arrivals: NDArray[np.float64]) -> float:
    if pane.failure_time_s is not None:
        return pane.failure_time_s
    return float("inf") if pane.fate == "holds" else float(arrivals.min())
