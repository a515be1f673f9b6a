"""Tileable fractal noise, made once and looked up ever after.

Evaluating fractal noise at every hit of every light path takes longer than tracing the path; a
picture of it does not.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray


def fractal_noise(
    size: int, *, slope: float, smallest: float = 0.0, largest: float = 1.0, seed: int = 0
) -> NDArray[np.float32]:
    """(size, size) of noise whose edges meet, uniformly distributed over 0..1.

    Random phases under an amplitude that falls with frequency to the power ``-slope``: 1 is sandy, 2 cloudy.
    Features larger than ``largest`` and smaller than ``smallest``, as shares of the side, are left out.
    """
    frequency = np.hypot(
        np.fft.fftfreq(size, 1.0 / size)[:, None], np.fft.rfftfreq(size, 1.0 / size)[None, :]
    )
    with np.errstate(divide="ignore"):
        amplitude = np.where(frequency >= 1.0 / largest, np.maximum(frequency, 1.0) ** -slope, 0.0)
    if smallest > 0.0:
        amplitude *= np.exp(-((frequency * smallest) ** 2))
    generator = np.random.Generator(np.random.PCG64(seed))
    phase = np.exp(2j * np.pi * generator.random(frequency.shape))
    field = np.fft.irfft2(amplitude * phase, s=(size, size))
    ranks = np.empty(size * size, dtype=np.float32)
    ranks[np.argsort(field, axis=None, kind="stable")] = np.linspace(0.0, 1.0, size * size, dtype=np.float32)
    return ranks.reshape(size, size)
