"""The compiled engine: keyword-only functions, numpy in and out, SI units."""

from collections.abc import Callable, Mapping
from typing import Any, Literal, Self, TypeAlias, final

from numpy import bool_, float32, float64, int64, uint32
from numpy.typing import ArrayLike, NDArray

_Burst: TypeAlias = Literal["air", "surface"]
_Pulse: TypeAlias = Literal["friedlander", "triangle-duration", "triangle-impulse"]
_Source: TypeAlias = str | Mapping[str, NDArray[float64]]

__all__ = [
    "Recording",
    "Scene",
    "attenuation",
    "curves",
    "explosives",
    "face_history",
    "front_radius",
    "mass_properties",
    "pulse",
    "rankine_hugoniot",
    "reflection_chart",
    "reflection_coefficient",
    "ring_values",
    "sphere_pixels",
    "unfolded_sphere",
]

def curves(
    *,
    mass: float,
    distance: NDArray[float64],
    tnt_equivalence: float = 1.0,
    burst: _Burst = "air",
    source: _Source | None = None,
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
    shape: _Pulse = "friedlander",
    times: NDArray[float64],
    negative: tuple[float, float] | None = None,
) -> dict[str, Any]: ...
def front_radius(
    *,
    mass: float,
    times: NDArray[float64],
    tnt_equivalence: float = 1.0,
    burst: _Burst = "air",
    source: _Source | None = None,
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
    source: _Source | None = None,
    pressure: float = 101325.0,
    temperature: float = 288.15,
    pulse: _Pulse = "friedlander",
    negative_phase: bool = False,
) -> NDArray[float64]: ...
def mass_properties(*, vertices: NDArray[float64], triangles: NDArray[int64]) -> dict[str, Any]: ...
def attenuation(
    *,
    blocking: ArrayLike,
    separation: ArrayLike,
    offset: float,
    slope: float,
    exponent: float,
    power: float,
) -> NDArray[float64]: ...
def ring_values(*, shape: NDArray[bool_]) -> NDArray[uint32]: ...
def sphere_pixels(*, directions: NDArray[float64], resolution: int) -> NDArray[int64]: ...
def unfolded_sphere(*, resolution: int) -> NDArray[float64]: ...

@final
class Scene:
    def __new__(
        cls,
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
        pulse: _Pulse,
        negative_phase: bool,
        occlusion: Mapping[str, bool | int | float | str],
        damping_factor: float,
        rotation_factor: float,
    ) -> Self: ...
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
        occludes: bool,
        can_rotate: bool,
        friction: float,
        drag_coefficient: float,
        lift_coefficient: float | None,
    ) -> None: ...
    def add_mesh(
        self,
        *,
        vertices: NDArray[float64],
        triangles: NDArray[int64],
        position: tuple[float, float, float],
        orientation: tuple[float, float, float, float],
        mass: float,
        anchored: bool,
        occludes: bool,
        can_rotate: bool,
        friction: float,
        drag_coefficient: float,
        lift_coefficient: float | None,
    ) -> None: ...
    def centres_of_mass(self) -> NDArray[float64]: ...
    def middles(self) -> NDArray[float64]: ...
    def seen_from(self, charge: int) -> tuple[NDArray[int64], NDArray[float64]]: ...
    def shelter(self, charge: int) -> dict[str, NDArray[float64]]: ...
    def simulate(
        self, *, threads: int | None = None, progress: Callable[[int, int], None] | None = None
    ) -> Recording: ...

@final
class Recording:
    @property
    def times(self) -> NDArray[float64]: ...
    @property
    def positions(self) -> NDArray[float32]: ...
    @property
    def orientations(self) -> NDArray[float32]: ...
    @property
    def mass_kg(self) -> NDArray[float64]: ...
    @property
    def frontal_area_m2(self) -> NDArray[float64]: ...
    @property
    def distance_m(self) -> NDArray[float64]: ...
    @property
    def arrival_time_s(self) -> NDArray[float64]: ...
    @property
    def peak_overpressure_pa(self) -> NDArray[float64]: ...
    @property
    def peak_load_pa(self) -> NDArray[float64]: ...
    @property
    def impulse_n_s(self) -> NDArray[float64]: ...
    @property
    def attenuation(self) -> NDArray[float64]: ...
    @property
    def launch_speed_m_s(self) -> NDArray[float64]: ...
    @property
    def rest_time_s(self) -> NDArray[float64]: ...
    @property
    def step_s(self) -> float: ...
    @property
    def warnings(self) -> list[str]: ...
    @property
    def timing_s(self) -> dict[str, float]: ...
