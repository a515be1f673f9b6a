"""The compiled engine: keyword-only functions, numpy in and out, SI units."""

from collections.abc import Callable, Mapping
from typing import Any, Literal, TypeAlias

from numpy import bool_, float32, float64
from numpy.typing import ArrayLike, NDArray

_Burst: TypeAlias = Literal["air", "surface"]
_Source: TypeAlias = str | Mapping[str, NDArray[float64]]

def curves(
    *,
    mass: float,
    distance: NDArray[float64],
    tnt_equivalence: float = 1.0,
    burst: _Burst = "air",
    source: _Source = "kingery-bulmash",
    pressure: float = 101325.0,
    temperature: float = 288.15,
) -> dict[str, Any]: ...
def reflection_coefficient(
    *, angle_deg: ArrayLike, overpressure: ArrayLike, pressure: float = 101325.0
) -> NDArray[float64]: ...
def reflection_chart() -> dict[str, NDArray[float64]]: ...
def pulse(
    *,
    peak: float,
    duration: float,
    impulse: float,
    shape: Literal["friedlander", "triangle-duration", "triangle-impulse"] = "friedlander",
    times: NDArray[float64],
    negative: tuple[float, float] | None = None,
) -> dict[str, Any]: ...
def front_radius(
    *,
    mass: float,
    times: NDArray[float64],
    tnt_equivalence: float = 1.0,
    burst: _Burst = "air",
    source: _Source = "kingery-bulmash",
    pressure: float = 101325.0,
    temperature: float = 288.15,
) -> NDArray[float64]: ...
def rankine_hugoniot(
    *, overpressure: ArrayLike, pressure: float = 101325.0, temperature: float = 288.15, gamma: float = 1.4
) -> dict[str, NDArray[float64]]: ...
def explosives() -> list[tuple[str, float]]: ...
def face_history(
    *,
    face: Literal["front", "side", "rear"],
    mode: Literal["translational", "surface"],
    drag: Literal["thesis", "flow-relative"],
    mass: float,
    distance: float,
    angle_deg: float,
    clearing_length: float,
    drag_coefficient: float,
    times: NDArray[float64],
    tnt_equivalence: float = 1.0,
    burst: _Burst = "air",
    source: _Source = "kingery-bulmash",
    pressure: float = 101325.0,
    temperature: float = 288.15,
) -> NDArray[float64]: ...

class Scene:
    def __init__(
        self,
        *,
        pressure: float,
        temperature: float,
        ground: tuple[float, float] | None,
        duration: float,
        frame_rate: float,
        step: float | None,
        mode: Literal["translational", "surface"],
        clearing: str | float,
        drag: Literal["flow-relative", "thesis"],
        pulse: Literal["friedlander", "triangle-duration", "triangle-impulse"],
        negative_phase: bool,
        damping_factor: float,
        rotation_factor: float,
    ) -> None: ...
    def add_charge(
        self,
        *,
        mass: float,
        tnt_equivalence: float,
        position: tuple[float, float, float],
        burst: _Burst,
        time: float,
        gain: float,
        source: _Source,
    ) -> None: ...
    def add_boxes(
        self,
        *,
        size: NDArray[float64],
        position: NDArray[float64],
        orientation: NDArray[float64],
        mass: NDArray[float64],
        buried: NDArray[bool_],
        assembly: bool,
        anchored: bool,
        can_rotate: bool,
        friction: float,
        drag_coefficient: float,
        lift_coefficient: float | None,
    ) -> None: ...
    def add_mesh(
        self,
        *,
        vertices: NDArray[float64],
        triangles: NDArray[Any],
        position: tuple[float, float, float],
        orientation: tuple[float, float, float, float],
        mass: float,
        anchored: bool,
        can_rotate: bool,
        friction: float,
        drag_coefficient: float,
        lift_coefficient: float | None,
    ) -> None: ...
    def centres_of_mass(self) -> NDArray[float64]: ...
    def simulate(
        self, *, threads: int | None = None, progress: Callable[[int, int], None] | None = None
    ) -> Recording: ...

class Recording:
    times: NDArray[float64]
    positions: NDArray[float32]
    orientations: NDArray[float32]
    mass_kg: NDArray[float64]
    frontal_area_m2: NDArray[float64]
    distance_m: NDArray[float64]
    arrival_time_s: NDArray[float64]
    peak_overpressure_pa: NDArray[float64]
    peak_load_pa: NDArray[float64]
    impulse_n_s: NDArray[float64]
    attenuation: NDArray[float64]
    launch_speed_m_s: NDArray[float64]
    rest_time_s: NDArray[float64]
    step_s: float
    warnings: list[str]
    timing_s: dict[str, float]
