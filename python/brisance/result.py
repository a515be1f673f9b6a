"""What a simulation gives back: the poses of every piece at every frame, and facts about each piece."""

from __future__ import annotations

import time
from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from brisance.errors import InputError
from brisance.model import Scene, Window
from brisance.piece import PieceMesh

TIMINGS = ("load", "occlusion", "fracture", "dynamics", "write", "total")
USD_SUFFIXES = (".usd", ".usda", ".usdc", ".usdz")


@dataclass(frozen=True)
class Source:
    """Which bodies came from one object of the scene: those from ``start`` up to, not including, ``stop``."""

    name: str
    material: str
    start: int
    stop: int


@dataclass(frozen=True, eq=False)
class Pane:
    """What became of the pane of a window. Lengths [m] in the pane's own frame."""

    name: str
    """Name of the window."""
    window: Window
    """The window as the scene has it."""
    fate: Literal["holds", "fails", "in pieces"]
    """holds; fails under the load; in pieces before the blast came."""
    failure_time_s: float | None
    """When it failed [s]; None if it did not."""
    failure_place_m: tuple[float, float] | None
    """Where it failed; None if it did not."""
    peak_pressure_pa: float
    """Highest mean pressure on it from one charge [Pa]."""
    peak_stress_pa: float
    """Greatest stress in it until it failed [Pa]."""
    strength_pa: float
    """Stress at which it fails [Pa]."""
    start: int
    """Its pieces are the bodies from here …"""
    stop: int
    """… up to, not including, this one."""
    staying: int
    """How many of them stay where they are, in the frame or on an interlayer."""
    mean_area_m2: float
    """Mean area of its pieces' faces [m²]."""
    frame_impulse_n_s: tuple[float, float, float]
    """Impulse that the pane's edges and the frame took, of all that the blast gave its pieces [N s]."""
    mesh: PieceMesh
    """The whole pane about the window's position, before it breaks."""
    deflection: NDArray[np.float64]
    """Of each point of the mesh, how far it moves along the pane's own +z under a pressure of 1 Pa [m/Pa]."""
    amplitude: NDArray[np.float64]
    """(F,) how far it bends at each frame, as the pressure that would bend it as far at rest [Pa]."""

    broken_at_s: float
    """When it stops being seen as one whole [s]: when it fails, or when the front comes to one that was in
    pieces before; infinite for one that holds.
    """


@dataclass(frozen=True, eq=False)
class Bodies:
    """Facts about each of the B pieces, as arrays in the order of the bodies."""

    names: Sequence[str]
    """Unique name of each piece."""
    source: Sequence[str]
    """Name of the object it came from."""
    mass_kg: NDArray[np.float64]
    """(B,) mass [kg]."""
    frontal_area_m2: NDArray[np.float64]
    """(B,) open area it turns to the nearest charge [m²]."""
    distance_m: NDArray[np.float64]
    """(B,) from the nearest charge to its centre of mass [m]."""
    arrival_time_s: NDArray[np.float64]
    """(B,) when the first front reaches it [s of scene time]."""
    peak_overpressure_pa: NDArray[np.float64]
    """(B,) highest incident overpressure on any of its panels [Pa]."""
    peak_load_pa: NDArray[np.float64]
    """(B,) highest load on any of its panels [Pa]."""
    impulse_n_s: NDArray[np.float64]
    """(B, 3) impulse the blast gave it [N s]."""
    attenuation: NDArray[np.float64]
    """(B,) part of the load that reaches it; 1 is unsheltered."""
    launch_speed_m_s: NDArray[np.float64]
    """(B,) its speed when its loading ends [m/s]."""
    free_time_s: NDArray[np.float64]
    """(B,) when a piece of a pane was free [s]; not a number where it stays, and for other pieces."""
    rest_time_s: NDArray[np.float64]
    """(B,) when it comes to rest for good [s]: 0 where it never moves, NaN where it never rests."""
    final_position_m: NDArray[np.float64]
    """(B, 3) centre of mass in the last frame [m]."""

    def __len__(self) -> int:
        return len(self.names)


@dataclass(eq=False)
class Result:
    """One simulated scene. F frames, B bodies; bodies are in the order of the scene's objects."""

    scene: Scene
    """The scene it came from."""
    times: NDArray[np.float64]
    """(F,) time of each frame [s]."""
    positions: NDArray[np.float32]
    """(F, B, 3) centre of mass of each body in the world [m]."""
    orientations: NDArray[np.float32]
    """(F, B, 4) rotation from body to world, unit quaternion w, x, y, z."""
    meshes: list[PieceMesh]
    """One mesh a body, in the body's frame; identical pieces share the same object."""
    sources: list[Source]
    """The object each run of bodies came from."""
    bodies: Bodies
    """Facts about each body."""
    step_s: float
    """Step of the integration [s]."""
    panes: list[Pane] = field(default_factory=list)
    """What became of the panes of windows."""
    warnings: list[str] = field(default_factory=list)
    """One sentence for each approximation that was made."""
    timing_s: dict[str, float] = field(default_factory=dict)
    """Seconds spent in load (building the scene), occlusion, fracture, dynamics, write, and in total."""

    @property
    def frame_rate(self) -> float:
        """Frames a second of scene time [1/s]."""
        return self.scene.time.frame_rate

    def front_radius(self, charge_index: int) -> NDArray[np.float64]:
        """(F,) radius [m] of one charge's shock front at each frame; 0 before it detonates."""
        from brisance import _engine
        from brisance.curve_table import curve_source

        charge, air = self.scene.charges[charge_index], self.scene.air
        return _engine.front_radius(
            mass=charge.mass,
            times=self.times - charge.time,
            tnt_equivalence=charge.factor,
            burst=charge.burst,
            source=curve_source(charge.curves, base_folder=self.scene.base_folder),
            pressure=air.pressure,
            temperature=air.temperature,
        )

    def report(self) -> dict[str, Any]:
        """Every fact about the run as plain numbers, text and lists, ready for JSON."""
        from brisance.formats.report import report

        return report(self)

    def write(self, path: Path | str, *, layout: str = "auto") -> None:
        """Write the result; the suffix says what: .usd, .usda, .usdc or .usdz the animation, .json the
        report.

        ``layout`` concerns USD: ``"prims"`` is one prim a piece, ``"instancer"`` one compact array a frame,
        ``"auto"`` chooses by the number of pieces.
        """
        started = time.perf_counter()
        check_output(path)
        if Path(path).suffix.lower() == ".json":
            from brisance.formats.report import write_report

            write_report(self, path)
        else:
            from brisance.formats.usd import write_usd

            write_usd(self, path, layout=layout)
        spent = time.perf_counter() - started
        for name in ("write", "total"):
            self.timing_s[name] = self.timing_s.get(name, 0.0) + spent


def check_output(path: Path | str) -> None:
    """Raise :class:`InputError` unless a result can be written to ``path``: a known suffix, a writable
    folder.
    """
    from brisance.formats.atomic import check_writable

    suffix = check_writable(path).suffix.lower()
    if suffix not in (*USD_SUFFIXES, ".json"):
        known = ", ".join(USD_SUFFIXES)
        raise InputError(
            f"{path} has no suffix that names a format; end it in {known} (animation) or .json (report)."
        )
