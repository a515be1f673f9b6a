"""Figure 2.3: a detonation front with its reaction zone and the flow that follows, pressure over distance."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from brisance import _engine
from brisance.figures import style
from brisance.figures.figure import Figure, Table, whole

if TYPE_CHECKING:
    from matplotlib.figure import Figure as Picture

RUN = 0.02
"""How far the front has run from the plane of initiation [m]."""

REACTION_TIME = 5e-7
"""Time in which a particle reacts [s]: longer than TNT's, so that the zone can be seen."""


def compute() -> Table:
    """Pressure [Pa] over place [m] at one moment: still explosive, reaction zone, following flow."""
    zone = _engine.reaction_zone(reaction_time=REACTION_TIME, velocity=np.ones(1), progress=[0.0], points=200)
    end = RUN - float(zone["distance_m"][-1])
    places = np.linspace(0.0, 1.0, 300)
    flow = _engine.following_flow(place=places, products="ideal", geometry="plane")
    ahead = np.array([RUN, 1.25 * RUN])
    still = np.zeros(2)
    parts = [
        (end * places, flow["pressure_pa"], flow["velocity_m_s"], np.ones(300), 2.0),
        (RUN - zone["distance_m"][::-1], zone["pressure_pa"][::-1], zone["velocity_m_s"][::-1],
         zone["progress"][::-1], 1.0),
        (ahead, still, still, still, 0.0),
    ]  # fmt: skip
    return {
        "x_m": np.concatenate([part[0] for part in parts]),
        "pressure_pa": np.concatenate([part[1] for part in parts]),
        "velocity_m_s": np.concatenate([part[2] for part in parts]),
        "progress": np.concatenate([part[3] for part in parts]),
        "zone": np.concatenate([np.full(len(part[0]), part[4]) for part in parts]),
    }


def draw(picture: Picture, data: Table) -> None:
    axes = picture.subplots()
    column = {key: np.asarray(values, dtype=float) for key, values in data.items()}
    millimetres, gigapascals = 1e3 * column["x_m"], 1e-9 * column["pressure_pa"]
    reacting = column["zone"] == 1.0
    start, front = millimetres[reacting][0], millimetres[reacting][-1]
    axes.axvspan(start, front, color=style.AMBER, alpha=0.18, linewidth=0)
    axes.plot(millimetres, gigapascals, color=style.INK)
    spike, end = gigapascals[reacting][-1], gigapascals[reacting][0]
    axes.plot([front, start], [spike, end], "o", color=style.ORANGE, markersize=5)
    note: dict[str, Any] = {"textcoords": "offset points", "va": "center"}
    axes.annotate("von Neumann spike", (front, spike), xytext=(8, 0), **note)
    axes.annotate("Chapman–Jouguet", (start, end), xytext=(-8, 6), ha="right", **note)
    axes.annotate("D →", (front, 0.5 * spike), xytext=(8, 0), **note)
    height = 1.1 * spike
    for x, text in (
        (0.5 * start, "following flow"),
        (0.5 * (start + front), "reaction\nzone"),
        (0.5 * (front + millimetres[-1]), "explosive\nat rest"),
    ):
        axes.text(x, height, text, ha="center", va="center", color=style.GREY)
    axes.set_title("TNT as an ideal gas; its reaction slowed down so that the zone can be seen")
    axes.set_xlabel("distance from the plane of initiation [mm]")
    axes.set_ylabel("pressure [GPa]")
    axes.set_xlim(0.0, millimetres[-1])
    axes.set_ylim(0.0, 1.2 * spike)


FIGURE = Figure(
    name="2.3",
    title="Figure 2.3  A detonation front and its reaction zone",
    compute=compute,
    draw=draw,
    table=whole,
)
