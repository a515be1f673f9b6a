"""A pane of glass thrown apart by hand: real fragments with fracture surfaces, on known parabolas."""

from __future__ import annotations

import numpy as np
from synthetic import synthetic_result

import brisance as br
from brisance.model import Charge
from brisance.result import Result

WIDTH, HEIGHT = 1.6, 1.2


def shattered_pane(*, pieces: int, frames: int, frame_rate: float = 200.0) -> Result:
    """About ``pieces`` fragments that stand for a tenth of the frames and then fly towards +z, tumbling."""
    pane = br.fracture(br.Pattern(pieces=pieces), width=WIDTH, height=HEIGHT, thickness=0.006)
    count = len(pane.meshes)
    start = np.column_stack([pane.positions[:, 0] - WIDTH / 2, pane.positions[:, 1] + 0.8, np.zeros(count)])
    random = np.random.default_rng(1)
    spread = start - np.array([0.0, 0.8 + HEIGHT / 2, -2.0])
    velocity = spread / np.linalg.norm(spread, axis=1, keepdims=True) * random.uniform(4, 14, (count, 1))
    spin = random.normal(size=(count, 3)) * 9
    time = np.maximum(0.0, np.arange(frames) - frames // 10)[:, None, None] / frame_rate
    positions = start + velocity * time + np.array([0, -4.9, 0]) * time**2
    rate = np.linalg.norm(spin, axis=1, keepdims=True)
    half = rate * time / 2
    turns = np.concatenate([np.cos(half), np.sin(half) * (spin / rate)], axis=2)
    result = synthetic_result(
        frames=frames,
        frame_rate=frame_rate,
        sources=[("pane", "glass", count)],
        meshes=pane.meshes,
        charges=[Charge(mass=5, position=(0, 1.0, -4))],
    )
    result.positions = positions.astype(np.float32)
    result.orientations = turns.astype(np.float32)
    return result
