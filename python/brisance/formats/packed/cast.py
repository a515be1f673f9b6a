"""Everything that is to be seen: the pieces, and the panes that are whole until they break.

A pane is in pieces from the first frame on as far as the engine is concerned, and its cracks would show. So
the whole pane stands beside them: it is seen until the pane breaks, and its pieces from then on. It is shown
flat.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from brisance.piece import PieceMesh

if TYPE_CHECKING:
    from brisance.result import Result


class Cast:
    """All that is drawn: pieces first, in the order of the bodies, then whole panes."""

    positions: NDArray[np.float32]
    """(F, N, 3) [m]."""
    orientations: NDArray[np.float32]
    """(F, N, 4) unit quaternions, w first."""
    meshes: list[PieceMesh]
    materials: list[str]
    arrival_s: NDArray[np.float64]
    """(N,) when the first front comes; not finite where none does, and for whole panes."""
    shown_from_s: NDArray[np.float64]
    shown_until_s: NDArray[np.float64]
    """(N,) when each is seen; infinite for always and for never."""

    def __init__(self, result: Result) -> None:
        pieces = len(result.bodies)
        panes = result.panes
        self.positions, self.orientations = result.positions, result.orientations
        self.meshes = [*result.meshes, *(pane.mesh for pane in panes)]
        owners = [source.material for source in result.sources for _ in range(source.start, source.stop)]
        self.materials = [*owners, *("glass" for _ in panes)]
        self.arrival_s = np.append(result.bodies.arrival_time_s, np.full(len(panes), np.nan))
        self.shown_from_s = np.full(pieces + len(panes), -np.inf)
        self.shown_until_s = np.full(pieces + len(panes), np.inf)
        if not panes:
            return
        for number, pane in enumerate(panes, start=pieces):
            self.shown_from_s[pane.start : pane.stop] = pane.broken_at_s
            self.shown_until_s[number] = pane.broken_at_s
        places = np.array([pane.window.position for pane in panes], dtype=np.float32)
        turns = np.array([pane.window.orientation() for pane in panes], dtype=np.float32)
        frames = len(result.times)
        self.positions = np.concatenate([result.positions, np.tile(places, (frames, 1, 1))], axis=1)
        self.orientations = np.concatenate([result.orientations, np.tile(turns, (frames, 1, 1))], axis=1)
