"""The compiled engine: keyword-only functions, numpy in and out, SI units."""

from collections.abc import Callable, Mapping
from typing import Any, Literal, Self, TypeAlias, final

from numpy import bool_, float32, float64, int64, uint32
from numpy.typing import ArrayLike, NDArray

_Burst: TypeAlias = Literal["air", "surface"]
_Pulse: TypeAlias = Literal["friedlander", "triangle-duration", "triangle-impulse"]
_Source: TypeAlias = str | Mapping[str, NDArray[float64]]

__all__ = [
    "FracturePattern",
    "Pane",
    "Pieces",
    "Recording",
    "Scene",
    "attenuation",
    "crack_time",
    "critical_length",
    "curves",
    "detonation_hugoniot",
    "energy_release",
    "explosives",
    "face_history",
    "following_flow",
    "fracture",
    "fracture_stages",
    "front_radius",
    "hydrocode_case",
    "hydrocode_charge",
    "inert_hugoniot",
    "mass_properties",
    "material",
    "materials",
    "mean_fragment_area",
    "mean_fragment_velocity",
    "pressure_impulse",
    "pulse",
    "rankine_hugoniot",
    "reaction_zone",
    "reflection_chart",
    "reflection_coefficient",
    "ring_values",
    "sphere_pixels",
    "structure_reaches",
    "structure_response",
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
def structure_response(
    *,
    mass: float,
    stiffness: float,
    damping: float = 0.0,
    yield_resistance: float | None = None,
    peak_force: float = 0.0,
    duration: float = ...,
    pulse: str = "triangle",
    decay: float = 0.0,
    table: tuple[NDArray[float64], NDArray[float64]] | None = None,
    step: float | None = None,
    end: float | None = None,
) -> dict[str, Any]: ...
def pressure_impulse(
    *,
    mass: float,
    stiffness: float,
    limit: float,
    damping: float = 0.0,
    yield_resistance: float | None = None,
    pulse: str = "triangle",
    decay: float = 0.0,
    shortest: float = 0.01,
    longest: float = 100.0,
    points: int = 41,
) -> dict[str, Any]: ...
def structure_reaches(
    *,
    mass: float,
    stiffness: float,
    limit: float,
    peak_force: float,
    duration: float,
    damping: float = 0.0,
    yield_resistance: float | None = None,
    pulse: str = "triangle",
    decay: float = 0.0,
) -> bool: ...
def detonation_hugoniot(
    *, relative_volume: NDArray[float64], products: str = "jwl", front_velocity: float | None = None
) -> dict[str, Any]: ...
def inert_hugoniot(
    *,
    velocity: ArrayLike,
    density: float = 8930.0,
    sound_speed: float = 3940.0,
    slope: float = 1.489,
    curvature: float = 0.0,
) -> dict[str, NDArray[float64]]: ...
def reaction_zone(
    *,
    reaction_time: float,
    velocity: NDArray[float64],
    progress: list[float],
    front_velocity: float | None = None,
    points: int = 200,
) -> dict[str, Any]: ...
def following_flow(
    *, place: NDArray[float64], products: str = "jwl", geometry: str = "spherical"
) -> dict[str, Any]: ...
def hydrocode_case(
    *,
    case: str,
    geometry: str = "plane",
    scheme: str = "godunov",
    cells: int = 400,
    courant: float | None = None,
    end: float | None = None,
    viscosity: tuple[float, float] | None = None,
) -> dict[str, Any]: ...
def hydrocode_charge(
    *,
    mass: float,
    distance: NDArray[float64],
    geometry: str = "spherical",
    scheme: str = "godunov",
    product_cells: int | None = None,
    air_cells: int | None = None,
    courant: float | None = None,
    start: str = "detonation",
    end: float = 0.0,
    pressure: float = 101325.0,
    temperature: float = 288.15,
) -> dict[str, Any]: ...
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
        contacts: bool,
        until_rest: bool,
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
        behaviour: Mapping[str, Any],
        mortar: tuple[float, float, float] | None = None,
    ) -> int | None: ...
    def add_mesh(
        self,
        *,
        vertices: NDArray[float64],
        triangles: NDArray[int64],
        position: tuple[float, float, float],
        orientation: tuple[float, float, float, float],
        mass: float,
        behaviour: Mapping[str, Any],
    ) -> None: ...
    def add_window(
        self,
        *,
        outline: list[NDArray[float64]],
        thickness: float,
        position: tuple[float, float, float],
        orientation: tuple[float, float, float, float],
        strength: float,
        recipe: Mapping[str, Any],
        release: Literal["as it cracks", "all at once"],
        bite: float | None,
        facade: float,
        assembly: int | None,
        behaviour: Mapping[str, Any],
    ) -> None: ...
    def centres_of_mass(self) -> NDArray[float64]: ...
    def standing(self) -> dict[str, NDArray[float64]]: ...
    def seen_from(self, charge: int) -> tuple[NDArray[int64], NDArray[float64]]: ...
    def shelter(self, charge: int) -> dict[str, NDArray[float64]]: ...
    def simulate(
        self,
        *,
        threads: int | None = None,
        most_pieces: int | None = None,
        progress: Callable[[int, int], None] | None = None,
    ) -> Recording: ...

@final
class Pane:
    @property
    def fate(self) -> Literal["holds", "fails", "in pieces"]: ...
    @property
    def failure_time_s(self) -> float | None: ...
    @property
    def failure_place_m(self) -> tuple[float, float] | None: ...
    @property
    def peak_pressure_pa(self) -> float: ...
    @property
    def peak_stress_pa(self) -> float: ...
    @property
    def staying(self) -> int: ...
    @property
    def warnings(self) -> list[str]: ...
    @property
    def pattern(self) -> FracturePattern: ...
    @property
    def pieces(self) -> Pieces: ...
    @property
    def frequency_rad_s(self) -> float: ...
    @property
    def stress_per_pressure(self) -> float: ...
    def deflection(self, places: NDArray[float64]) -> NDArray[float64]: ...
    def amplitude(self, times: list[float]) -> NDArray[float64]: ...

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
    def held_back_n_s(self) -> NDArray[float64]: ...
    @property
    def free_time_s(self) -> NDArray[float64]: ...
    @property
    def panes(self) -> list[Pane]: ...
    @property
    def step_s(self) -> float: ...
    @property
    def warnings(self) -> list[str]: ...
    @property
    def timing_s(self) -> dict[str, float]: ...

def fracture(*, outline: list[NDArray[float64]], recipe: Mapping[str, Any]) -> FracturePattern: ...
def fracture_stages(outline: list[NDArray[float64]], pattern: FracturePattern) -> tuple[float, float]: ...

@final
class FracturePattern:
    def __len__(self) -> int: ...
    @property
    def critical_length_m(self) -> float: ...
    @property
    def nuclei(self) -> int: ...
    @property
    def seconds(self) -> float: ...
    @property
    def vertices(self) -> NDArray[float64]: ...
    @property
    def ring_vertices(self) -> NDArray[uint32]: ...
    @property
    def on_border(self) -> NDArray[bool_]: ...
    @property
    def ring_sizes(self) -> NDArray[uint32]: ...
    @property
    def rings_per_fragment(self) -> NDArray[uint32]: ...
    @property
    def closed_at_m(self) -> NDArray[float64]: ...
    @property
    def crack_ends(self) -> NDArray[float64]: ...
    @property
    def crack_growth_m(self) -> NDArray[float64]: ...
    @property
    def crack_parents(self) -> NDArray[int64]: ...
    @property
    def crack_tips(self) -> NDArray[uint32]: ...
    def pieces(self, *, thickness: float, density: float) -> Pieces: ...

@final
class Pieces:
    def __len__(self) -> int: ...
    @property
    def seconds(self) -> float: ...
    @property
    def vertices(self) -> NDArray[float64]: ...
    @property
    def uv(self) -> NDArray[float64]: ...
    @property
    def triangles(self) -> NDArray[uint32]: ...
    @property
    def counts(self) -> NDArray[uint32]: ...
    @property
    def area_m2(self) -> NDArray[float64]: ...
    @property
    def centroid_m(self) -> NDArray[float64]: ...
    @property
    def aspect_ratio(self) -> NDArray[float64]: ...
    @property
    def mass_kg(self) -> NDArray[float64]: ...
    @property
    def inertia_kg_m2(self) -> NDArray[float64]: ...
    @property
    def panels(self) -> NDArray[float64]: ...
    @property
    def panels_per_piece(self) -> NDArray[uint32]: ...

def crack_time(growth: ArrayLike, *, terminal_speed: float, critical_length: float) -> NDArray[float64]: ...
def materials() -> list[str]: ...
def material(name: str) -> dict[str, float | None]: ...
def critical_length(*, material: str, stress: float) -> float: ...
def energy_release(*, material: str, stress: float, length: float) -> float: ...
def mean_fragment_area(*, pressure: float) -> tuple[float, bool]: ...
def mean_fragment_velocity(*, pressure: float, thickness: float) -> float: ...
