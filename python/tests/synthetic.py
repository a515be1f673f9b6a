"""Results made by hand, for tests of what comes after the simulation: boxes thrown on known parabolas."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from brisance.model import Charge, Ground, Scene, Time
from brisance.piece import PieceMesh
from brisance.result import Bodies, Result, Source

FACTS = (
    "mass_kg",
    "frontal_area_m2",
    "distance_m",
    "arrival_time_s",
    "peak_overpressure_pa",
    "peak_load_pa",
    "attenuation",
    "launch_speed_m_s",
    "free_time_s",
    "rest_time_s",
)


class SyntheticResult(Result):
    """A result that needs no engine: its shock fronts travel at a constant speed."""

    def front_radius(self, charge_index: int) -> NDArray[np.float64]:
        """Twice the speed of sound, from the moment of detonation."""
        return np.maximum(0.0, 680.0 * (self.times - self.scene.charges[charge_index].time))


def box_mesh(
    size: tuple[float, float, float] = (0.32, 0.16, 0.10),
    *,
    broken: Sequence[int] = (),
    uvs: bool = True,
) -> PieceMesh:
    """A box about its centre [m]: faces -x, +x, -y, +y, -z, +z; those in ``broken`` form a group."""
    corners = np.array([(x, y, z) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)], dtype=np.float32)
    loops = [0, 1, 3, 2, 4, 6, 7, 5, 0, 4, 5, 1, 2, 3, 7, 6, 0, 2, 6, 4, 1, 5, 7, 3]
    square = np.tile(np.array([(0, 0), (1, 0), (1, 1), (0, 1)], dtype=np.float32), (6, 1))
    return PieceMesh(
        points=corners * (np.array(size, dtype=np.float32) / 2),
        face_counts=np.full(6, 4, dtype=np.int32),
        face_indices=np.array(loops, dtype=np.int32),
        uvs=square if uvs else None,
        groups={"broken": np.array(broken, dtype=np.int32)} if broken else {},
    )


def flights(
    bodies: int, frames: int, *, frame_rate: float, seed: int = 1
) -> tuple[NDArray[np.float32], NDArray[np.float32]]:
    """Poses of bodies that stand still for a fifth of the time and then fly off, tumbling.

    Returns (frames, bodies, 3) positions [m] and (frames, bodies, 4) unit quaternions, w first.
    """
    random = np.random.default_rng(seed)
    start = random.uniform((-5, 0, -1), (5, 5, 1), size=(bodies, 3))
    velocity = random.uniform((-2, 0, 5), (2, 6, 25), size=(bodies, 3))
    spin = random.normal(size=(bodies, 3)) * 8
    time = np.maximum(0.0, (np.arange(frames) - frames // 5) / frame_rate)[:, None, None]
    positions = start + velocity * time + np.array([0, -4.9, 0]) * time**2
    rate = np.linalg.norm(spin, axis=1, keepdims=True)
    half = rate * time / 2
    orientations = np.concatenate([np.cos(half), np.sin(half) * (spin / rate)], axis=2)
    return positions.astype(np.float32), orientations.astype(np.float32)


def synthetic_result(
    *,
    bodies: int = 6,
    frames: int = 21,
    frame_rate: float = 50.0,
    sources: Sequence[tuple[str, str, int]] | None = None,
    meshes: list[PieceMesh] | None = None,
    names: list[str] | None = None,
    ground: bool = True,
    charges: Sequence[Charge] = (Charge(mass=100, position=(0, 0.3, -15)),),
) -> SyntheticResult:
    """A result of thrown boxes.

    ``sources`` are (name, material, pieces) of each object, one brick wall when left out; ``meshes`` one a
    piece, one shared brick when left out. Even pieces weigh 10 kg and never rest, odd ones weigh 5 kg and
    rest at 0.25 s.
    """
    sources = [("wall", "brick", bodies)] if sources is None else sources
    ends = np.cumsum([count for _, _, count in sources])
    bodies = int(ends[-1])
    owners = [name for name, _, count in sources for _ in range(count)]
    positions, orientations = flights(bodies, frames, frame_rate=frame_rate)
    even = np.arange(bodies) % 2 == 0
    columns = {name: 1.0 + number + np.arange(bodies) / 8 for number, name in enumerate(FACTS)}
    columns |= {"mass_kg": np.where(even, 10.0, 5.0), "rest_time_s": np.where(even, np.nan, 0.25)}
    duration = max(frames - 1, 0.1) / frame_rate
    return SyntheticResult(
        scene=Scene(
            name="synthetic",
            seed=7,
            time=Time(duration=duration, frame_rate=frame_rate),
            ground=Ground() if ground else None,
            charges=charges,
        ),
        times=np.arange(frames) / frame_rate,
        positions=positions,
        orientations=orientations,
        meshes=meshes if meshes is not None else [box_mesh()] * bodies,
        sources=[
            Source(name, material, int(end) - count, int(end))
            for (name, material, count), end in zip(sources, ends, strict=True)
        ],
        bodies=Bodies(
            names=names or [f"{owner}_{index}" for index, owner in enumerate(owners)],
            source=owners,
            impulse_n_s=np.arange(3 * bodies, dtype=np.float64).reshape(bodies, 3),
            final_position_m=positions[-1].astype(np.float64),
            **columns,
        ),
        step_s=1e-4,
        warnings=["one approximation was made"],
    )
