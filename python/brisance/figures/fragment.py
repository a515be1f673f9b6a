"""The one fragment that figures 6.1 and 6.2 show: how it is chosen, and its triangles and panels."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import ConvexHull

from brisance.figures import cracks, style
from brisance.pane import Fracture

if TYPE_CHECKING:
    from matplotlib.axes import Axes

Array = NDArray[np.float64]

LONG = 4.0
"""How many times longer than wide the fragment is at least."""
MANY = 40
"""How many corners it has at least."""


@dataclass(frozen=True)
class Fragment:
    """One fragment, about its own centroid."""

    outline: Array
    """Corners, counter-clockwise (corners, 2) [m]."""
    area: float
    """Area [m²]."""
    triangles: Array
    """Triangles of its face (triangles, 3 corners, 2) [m]."""
    panels: Array
    """Middle [m] and area [m²] of each panel, (panels, 3)."""
    moments: Array
    """Second moments of the face [[∫x²dA, ∫xy dA], [∫xy dA, ∫y²dA]] [m⁴]."""

    @property
    def axes(self) -> Array:
        """Directions along the fragment and across it, to the left of the first, as rows."""
        x, y = np.linalg.eigh(self.moments)[1][:, 1]
        sign = -1.0 if x < 0.0 else 1.0
        return sign * np.array([[x, y], [-y, x]])

    @property
    def middle(self) -> float:
        """Half the width of the middle of its three columns of panels [m]."""
        return float(np.sqrt(np.linalg.eigvalsh(self.moments)[1] / self.area / 3.0))


def chosen() -> Fragment:
    """The most bent of the long fragments of Fig. 5.14.

    Long means at least ``LONG`` times longer than wide, with at least ``MANY`` corners and no hole; the most
    bent one fills the least of its convex hull.
    """
    broken = cracks.wiggling_and_varied()
    solids = broken.solids
    fits = (solids.aspect_ratio >= LONG) & (cracks.vertices_per_fragment(broken) >= MANY)
    fits &= broken.engine.rings_per_fragment == 1
    # In two dimensions a hull's "volume" is its area.
    filled = {i: solids.area_m2[i] / ConvexHull(broken.polygons[i][0]).volume for i in np.flatnonzero(fits)}
    return fragment(broken, min(filled, key=filled.__getitem__))


def fragment(broken: Fracture, index: int) -> Fragment:
    """One fragment of a pattern by its number."""
    solids = broken.solids
    counts = solids.counts.astype(int)
    corners, triangles = counts[:index, 0].sum(), counts[:index, 1:].sum()
    panels = int(solids.panels_per_piece[:index].sum())
    faces = solids.triangles[triangles : triangles + counts[index, 1]]
    return Fragment(
        outline=broken.polygons[index][0] - solids.centroid_m[index],
        area=float(solids.area_m2[index]),
        triangles=solids.vertices[corners + faces][:, :, :2],
        panels=solids.panels[panels : panels + int(solids.panels_per_piece[index])],
        moments=_plane_moments(broken, index),
    )


def _plane_moments(broken: Fracture, index: int) -> Array:
    """Second moments of a fragment's face, from the inertia of its prism."""
    solids = broken.solids
    inertia = solids.inertia_kg_m2[index].reshape(3, 3) * solids.area_m2[index] / solids.mass_kg[index]
    through = solids.area_m2[index] * broken.thickness**2 / 12.0
    xx, yy, xy = inertia[1, 1] - through, inertia[0, 0] - through, -inertia[0, 1]
    return np.array([[xx, xy], [xy, yy]])


def draw_outline(axes: Axes, shown: Fragment) -> None:
    """Draw the fragment's edge and fit the picture to it."""
    axes.plot(*np.vstack([shown.outline, shown.outline[:1]]).T, color=style.INK, linewidth=1.2)
    cracks.bare(axes)
