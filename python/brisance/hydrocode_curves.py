"""The blast curves that ``curves = "hydrocode"`` uses, computed by our own hydrocode.

``write`` makes the table that the engine carries (``engine/data/hydrocode_curves.csv``): one kilogram of TNT
in free air at sea level, from just outside the charge to 40 m/kg^(1/3). It takes some ten seconds. The same
settings give the same table, digit for digit, on every machine.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from brisance import _engine

PRODUCT_CELLS = 400
AIR_CELLS = 600
COURANT = 0.8
RANGE = (0.06, 40.0)
PER_DECADE = 30
"""Settings of the table: cells in the products and in the air, Courant number, scaled distances."""

COLUMNS = {
    "scaled_distance_m_kg13": "distance_m",
    "overpressure_pa": "overpressure_pa",
    "dynamic_pressure_pa": "dynamic_pressure_pa",
    "front_velocity_m_s": "front_velocity_m_s",
    "duration_s_kg13": "duration_s",
    "impulse_pa_s_kg13": "impulse_pa_s",
    "arrival_time_s_kg13": "arrival_time_s",
}
"""Columns of the table, and what the hydrocode calls them; for one kilogram the two are the same numbers."""


def compute(
    scaled_distance: NDArray[np.float64], *, product_cells: int = PRODUCT_CELLS, air_cells: int = AIR_CELLS
) -> dict[str, NDArray[np.float64]]:
    """The curves at scaled distances [m/kg^(1/3)]."""
    flow = _engine.hydrocode_charge(
        mass=1.0,
        distance=scaled_distance,
        product_cells=product_cells,
        air_cells=air_cells,
        courant=COURANT,
    )
    return {name: np.asarray(flow[source], dtype=np.float64) for name, source in COLUMNS.items()}


def distances() -> NDArray[np.float64]:
    """The table's scaled distances [m/kg^(1/3)], rounded to what the file holds."""
    low, high = RANGE
    count = round(PER_DECADE * np.log10(high / low)) + 1
    return np.array([float(f"{value:.5g}") for value in np.geomspace(low, high, count)])


def write(path: Path) -> None:
    """Compute the table and write it to ``path``, its settings in the lines that begin with #."""
    from brisance.formats.atomic import check_writable, write_text

    check_writable(path)
    curves = compute(distances())
    lines = [
        "# Blast of 1 kg of TNT in free air at sea level, by the one-dimensional hydrocode of Brisance.",
        f"# Scheme: godunov. Start: detonation. Cells: {PRODUCT_CELLS} in the products, {AIR_CELLS} in the "
        f"air. Courant number: {COURANT}.",
        "# Recompute with: brisance theory hydrocode --curve-table FILE",
        ",".join(curves),
    ]
    lines += [",".join(f"{value:.7g}" for value in row) for row in zip(*curves.values(), strict=True)]
    write_text(path, "\n".join(lines) + "\n")
