"""Scene files: what is read, what is refused and in which words, what a change on the command line does."""

from __future__ import annotations

import math
import os
from pathlib import Path

import numpy as np
import pytest

import brisance as br
from brisance import _engine
from brisance.curve_table import curve_source
from brisance.errors import InputError
from brisance.scene_file import dump, load
from brisance.simulation import build, simulate

SCENES = Path(__file__).parents[2] / "scenes"

EXAMPLE = """
name = "brick wall"
seed = 1                      # every random draw comes from it

[time]
duration = 0.4                # s
frame_rate = 100              # frames per second of scene time (slow motion is a high rate)
step = 1e-4                   # s; optional, chosen and reported when left out

[air]                         # optional
pressure = 101325
temperature = 288.15

[ground]                      # optional: a plane y = height that bodies rest on
height = 0.0
friction = 0.6

[[charge]]                    # one or more
mass = 100                    # of the named explosive
explosive = "TNT"             # Table 2.1, or tnt_equivalence = 1.3
position = [0, 0.3, -15]
burst = "air"                 # or "surface"
time = 0                      # detonation, s
gain = 1.0                    # art direction: multiplies every load from this charge
curves = "kingery-bulmash"    # "brode", "henrych", "kinney-graham", or a CSV file

[loading]                     # optional
mode = "translational"        # or "surface"
clearing = "assembly"         # "piece", or a length in metres
drag = "flow-relative"        # or "thesis"

[occlusion]                   # optional
enabled = true
resolution = 32               # pixels along an icosahedron edge
per = "body"                  # or "panel"

[dynamics]                    # optional
damping_factor = 1.0
rotation_factor = 1.0
contacts = false              # true: pieces collide, pile up and come to rest

[[block]]                     # a box
name = "crate"
size = [1, 1, 1]
position = [2, 0.5, 0]        # centre
rotation = [0, 30, 0]         # degrees, XYZ
density = 600                 # or mass = 300
anchored = false
occludes = true
can_rotate = true
friction = 0.5
drag_coefficient = 1.05
"""

SMALL = """
[time]
duration = 0.05
frame_rate = 100
[ground]
[[charge]]
mass = 100
position = [0, 0.3, -15]
[[block]]
name = "crate"
size = [1, 1, 1]
position = [2, 0.5, 0]
mass = 300
"""


def written(folder: Path, text: str, name: str = "scene.toml") -> Path:
    path = folder / name
    path.write_text(text, encoding="utf-8")
    return path


def refusal(path: Path, *overrides: str) -> str:
    """The sentence with which a scene is refused, on loading or on running it."""
    with pytest.raises(InputError) as caught:
        simulate(load(path, overrides))
    sentence = str(caught.value)
    assert "\n" not in sentence
    assert sentence.endswith((".", "?"))
    return sentence


def test_the_documented_example_runs_as_it_stands(tmp_path: Path) -> None:
    scene = load(written(tmp_path, EXAMPLE))
    assert scene.time.frames == 41
    crate = scene.objects[0]
    assert isinstance(crate, br.Block)
    assert crate.weight == pytest.approx(600.0)
    result = simulate(scene)
    assert result.positions.shape == (41, 1, 3)
    assert result.step_s <= 1e-4
    assert result.positions[-1, 0, 2] > 0  # the charge is on the -z side


@pytest.mark.parametrize("path", sorted(SCENES.glob("*.toml")), ids=lambda path: path.stem)
def test_every_scene_that_comes_with_it_runs(path: Path) -> None:
    result = simulate(load(path))
    assert np.isfinite(result.positions).all()
    lengths = np.linalg.norm(result.orientations.astype(np.float64), axis=2)
    np.testing.assert_allclose(lengths, 1.0, atol=1e-6)  # single precision
    assert len(set(result.bodies.names)) == len(result.meshes)


def test_defaults_of_the_file_are_those_of_the_model(tmp_path: Path) -> None:
    scene = load(written(tmp_path, "[[charge]]\nmass = 2\nposition = [0, 1, 0]\n", "two_kilos.toml"))
    own = br.Scene(charges=[br.Charge(mass=2, position=(0, 1, 0))])
    assert scene.name == "two kilos"
    assert scene.model_dump(exclude={"name"}) == own.model_dump(exclude={"name"})


@pytest.mark.parametrize("path", sorted(SCENES.glob("*.toml")), ids=lambda path: path.stem)
def test_a_scene_survives_being_written_and_read(tmp_path: Path, path: Path) -> None:
    scene = load(path)
    copy = tmp_path / "copy.toml"
    dump(scene, copy)
    assert load(copy).model_dump() == scene.model_dump()


@pytest.mark.parametrize(
    ("change", "said"),
    [
        ("charge.0.mass=-1", "charge.0.mass must be greater than 0, not -1"),
        ("charge.0.mass=0", "charge.0.mass must be greater than 0, not 0"),
        ("charge.0.mass=nan", "charge.0.mass must be a finite number, not nan"),
        ("time.duration=inf", "time.duration must be a finite number, not inf"),
        ("charge.0.position=[0, nan, 0]", "charge.0.position.1 must be a finite number, not nan"),
        ('charge.0.mass="ten"', "charge.0.mass must be a number, not 'ten'"),
        ("charge.0.mass=true", "charge.0.mass must be a number, not true"),
        ("occlusion.resolution=2.5", "occlusion.resolution must be a whole number, not 2.5"),
        ("occlusion.resolution=3", "occlusion.resolution must be 4 or more, not 3"),
        ("occlusion.resolution=513", "occlusion.resolution must be 512 or less, not 513"),
        ('occlusion.parameters="best"', "occlusion.parameters"),
        ("occlusion.slope=-1", "occlusion.slope must be 0 or more, not -1"),
        ("block.0.anchored=1", "block.0.anchored must be true or false, not 1"),
        ("charge.0.mas=1", "charge.0.mas is not a known key; did you mean mass?"),
        ("charge.0.pos=[0,0,0]", "did you mean position?"),
        ("tyme.duration=1", "tyme is not a known key; did you mean time?"),
        ("block.0.size=[1, 0, 1]", "block.0.size.1 must be greater than 0, not 0"),
        ("block.0.size=[1, 1]", "block.0.size must be a list of three numbers, not [1, 1]"),
        ("charge.0.position=[2, 0.5, 0]", "charge.0.position is inside the block 'crate'"),
        ("charge.0.position=[0, -5, 0]", "charge.0.position is 5 m below the ground; raise it to 0"),
        ("charge=[]", "the scene has no charge; add one"),
        ("charge.0.explosive=TNTT", "'TNTT' that is not known; choose"),
        ("charge.0.burst=water", "charge.0.burst must be 'air' or 'surface', not 'water'"),
        (
            "charge.0.curves=kingery",
            "charge.0: curves 'kingery' is not a known source; did you mean kingery-bulmash?",
        ),
        ("charge.0.curves=none.csv", "none.csv does not exist"),
        ("block.0.density=5", "has both density and mass"),
        ("block.0.name=a/b", "without slashes"),
        ("time.duration=1e308", "time.duration must be 1e+09 or less or 'rest', not 1e+308"),
        ("brick_wall=[{rows=1000000000000, brick_mass=1}]", "brick_wall.0.rows must be 1e+06 or less"),
        ("time.step=1e-300", "time.step must be at least"),
        ("loading.clearing=-1", "loading.clearing must be"),
    ],
)
def test_a_wrong_value_is_refused_in_one_sentence(tmp_path: Path, change: str, said: str) -> None:
    path = written(tmp_path, SMALL)
    assert said in refusal(path, change)


def test_the_sentence_names_the_file_or_the_flag_at_fault(tmp_path: Path) -> None:
    path = written(tmp_path, SMALL.replace("mass = 100", "mass = -100"))
    assert refusal(path) == f"{path}: charge.0.mass must be greater than 0, not -100."
    assert refusal(path, "charge.0.mass=-5") == "--set: charge.0.mass must be greater than 0, not -5."


@pytest.mark.parametrize(
    ("change", "said"),
    [
        ("charge.5.mass=1", "the number after charge must be 0, for the file holds 1, not 5"),
        ("charge.x.mass=1", "charge is a list, so a number from 0 must follow it, not 'x'"),
        ("name.x=1", "name is a plain value"),
        ("mesh.0.mass=1", "no [[mesh]] table"),
        ("bogus", "not of the form KEY=VALUE"),
        ("=1", "not of the form KEY=VALUE"),
        ("charge..mass=1", "charge"),
        ("charge.0.mass=", "not a TOML value"),
        ("charge.0.mass=[1", "not a TOML value"),
    ],
)
def test_a_change_that_leads_nowhere_is_refused(tmp_path: Path, change: str, said: str) -> None:
    text = SMALL.replace("[time]", 'name = "small"\n[time]', 1)
    sentence = refusal(written(tmp_path, text), change)
    assert sentence.startswith("--set")
    assert said in sentence


def test_changes_apply_in_order_and_make_missing_tables(tmp_path: Path) -> None:
    path = written(tmp_path, SMALL)
    scene = load(
        path,
        [
            "charge.0.mass=50",
            "charge.0.mass=20",
            "charge.0.explosive=RDX",
            "air.pressure=9e4",
            "block.0.position=[3, 0.5, 1]",
            "name=a new name",
        ],
    )
    assert scene.charges[0].mass == 20
    assert scene.charges[0].explosive == "RDX"
    assert scene.air.pressure == 9e4
    assert scene.objects[0].position == (3, 0.5, 1)
    assert scene.name == "a new name"
    assert load(path).charges[0].mass == 100


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("[[charge]\nmass = 1\n", "is not valid TOML"),
        ("a = 1\na = 2\n", "is not valid TOML"),
        ("", "the scene has no charge"),
        ("charge = 3\n", "charge must be a list of tables, not 3"),
        (SMALL.replace("mass = 100\n", ""), "charge.0.mass is missing"),
        (SMALL + SMALL[SMALL.index("[[block]]") :], "block.1.name 'crate' is already the name of block.0"),
    ],
)
def test_a_wrong_file_is_refused(tmp_path: Path, text: str, said: str) -> None:
    assert said in refusal(written(tmp_path, text))


def test_a_file_that_cannot_be_read_is_refused(tmp_path: Path) -> None:
    assert "does not exist" in refusal(tmp_path / "none.toml")
    assert "is a directory" in refusal(tmp_path)
    binary = tmp_path / "binary.toml"
    binary.write_bytes(bytes(range(256)))
    assert "not a text file" in refusal(binary)
    if os.geteuid() != 0:
        closed = written(tmp_path, SMALL, "closed.toml")
        closed.chmod(0)
        assert "cannot be read" in refusal(closed)


def test_more_frames_than_memory_holds_are_refused_before_any_work(tmp_path: Path) -> None:
    sentence = refusal(written(tmp_path, SMALL), "time.duration=1e6", "time.frame_rate=1e6")
    # 1e12 frames of a position and a quaternion in single precision, and the frame's time.
    assert "1,000,000,000,001 frames of 1 piece" in sentence
    assert "36.0 TB of memory" in sentence
    assert "available" in sentence


def test_a_million_frames_of_a_big_wall_say_how_much_they_need(tmp_path: Path) -> None:
    wall = "[[brick_wall]]\nname = 'wall'\nrows = 300\ncolumns = 300\nbrick_mass = 10\n"
    text = SMALL[: SMALL.index("[[block]]")] + wall
    sentence = refusal(written(tmp_path, text), "time.duration=1000", "time.frame_rate=1000")
    assert "1,000,001 frames of 90,150 pieces need 2.5 TB of memory" in sentence


def test_a_distance_outside_the_curves_is_a_warning(tmp_path: Path) -> None:
    path = written(tmp_path, SMALL)
    far = simulate(load(path, ["charge.0.position=[0, 0.3, -9000]"]))
    near = simulate(load(path, ["charge.0.position=[2, 0.5, -0.51]", "charge.0.mass=1e5"]))
    inside = simulate(load(path))
    assert any("farther" in warning for warning in far.warnings)
    assert any("nearer" in warning for warning in near.warnings)
    assert inside.warnings == []


def test_python_takes_numpy_and_refuses_text() -> None:
    charge = br.Charge(mass=np.float64(3), position=np.array([0.0, 1.0, 2.0]))  # type: ignore[arg-type]
    assert charge.position == (0.0, 1.0, 2.0)
    assert isinstance(charge.mass, float)
    with pytest.raises(br.InputError, match="Charge: mass must be a number, not 'heavy'"):
        br.Charge(mass="heavy", position=(0, 0, 0))  # type: ignore[arg-type]
    with pytest.raises(br.InputError, match="did you mean mass"):
        br.Charge(mas=1, position=(0, 0, 0))  # type: ignore[call-arg]


def test_table_2_1_gives_the_equivalence_of_an_explosive() -> None:
    assert br.Charge(mass=1, position=(0, 0, 0)).factor == 1.0
    assert br.Charge(mass=1, position=(0, 0, 0), explosive="tnt").factor == 1.0
    rdx = br.Charge(mass=1, position=(0, 0, 0), explosive="rdx")
    assert rdx.factor == br.Charge(mass=1, position=(0, 0, 0), explosive="RDX").factor > 1
    with pytest.raises(br.InputError, match="both explosive and tnt_equivalence"):
        br.Charge(mass=1, position=(0, 0, 0), explosive="TNT", tnt_equivalence=1.2)


def test_scaled_charges_scale_the_blast(tmp_path: Path) -> None:
    """Hopkinson: half as far from an eighth of the charge the pressure is the same and arrives in half the
    time.
    """
    path = written(tmp_path, SMALL.replace("[ground]\n", ""))
    place = ["block.0.position=[0, 0, 0]", "block.0.size=[2e-3, 2e-3, 2e-3]", "time.duration=0.2"]
    whole = simulate(load(path, [*place, "charge.0.position=[0, 0, -20.001]", "charge.0.mass=80"]))
    eighth = simulate(load(path, [*place, "charge.0.position=[0, 0, -10.001]", "charge.0.mass=10"]))
    # The block is not scaled with the rest: the middles of its panels are up to 1 mm off the axis.
    assert eighth.bodies.peak_overpressure_pa[0] == pytest.approx(
        whole.bodies.peak_overpressure_pa[0], rel=1e-7
    )
    assert 2 * eighth.bodies.arrival_time_s[0] == pytest.approx(whole.bodies.arrival_time_s[0], rel=1e-7)
    assert math.isfinite(eighth.bodies.launch_speed_m_s[0])


def test_a_curve_table_stands_beside_the_scene(tmp_path: Path) -> None:
    """A table with the built-in curves' own numbers at its rows gives the same pressure at such a row."""
    path = written(tmp_path, SMALL)
    distances = np.array([1.0, 2.0, 4.0, 8.0])
    own = _engine.curves(mass=1.0, distance=distances)
    rows = zip(own["scaled_distance_m_kg13"], own["overpressure_pa"], strict=True)
    text = "scaled_distance_m_kg13,overpressure_pa\n" + "".join(f"{z!r},{p!r}\n" for z, p in rows)
    written(tmp_path, text.replace("np.float64(", "").replace(")", ""), "own.csv")
    from_table = _engine.curves(
        mass=1.0, distance=distances, source=curve_source("own.csv", base_folder=tmp_path)
    )
    np.testing.assert_allclose(from_table["overpressure_pa"], own["overpressure_pa"], rtol=1e-12)
    result = simulate(load(path, ["charge.0.curves=own.csv"]))
    built_in = simulate(load(path))
    # Between rows a doubling of the distance apart, straight lines in log-log stray by some per cent.
    assert result.bodies.peak_overpressure_pa[0] == pytest.approx(
        built_in.bodies.peak_overpressure_pa[0], rel=0.1
    )


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("", "has no column scaled_distance_m_kg13"),
        ("scaled_distance_m_kg13\n1\n2\n", "has no column overpressure_pa"),
        ("scaled_distance_m_kg13,overpressure_pa\n1,2\n", "has 1 rows of numbers"),
        ("scaled_distance_m_kg13,overpressure_pa\n1,2\n1,1\n", "must rise"),
        ("scaled_distance_m_kg13,overpressure_pa\n1,2\n2,x\n", "row 3: overpressure_pa must be a number"),
        ("scaled_distance_m_kg13,overpressure_pa\n1,2\n2,-1\n", "row 3: overpressure_pa must be a finite"),
        ("scaled_distance_m_kg13,overpressure_pa\n1,2\n2\n", "row 3: has 1 cells"),
        ("scaled_distance_m_kg13,overpressure_pa,pulse\n1,2,3\n2,1,3\n", "'pulse' is not a known column"),
    ],
)
def test_a_wrong_curve_table_is_refused(tmp_path: Path, text: str, said: str) -> None:
    written(tmp_path, text, "own.csv")
    sentence = refusal(written(tmp_path, SMALL), "charge.0.curves=own.csv")
    assert sentence.startswith("charge.0: ")
    assert "own.csv" in sentence
    assert said in sentence


def test_longest_counts_only_where_a_run_lasts_until_rest(tmp_path: Path) -> None:
    path = written(tmp_path, SMALL)
    both = refusal(path, "time.duration=3", "time.longest=5")
    assert both == (
        "--set: time has a longest of 5 s beside a duration of 3 s; take one of them out: "
        'longest is for duration = "rest".'
    )
    text = (
        SMALL.replace("[time]", "[time]\nlongest = 5")
        if "[time]" in SMALL
        else f"{SMALL}\n[time]\nlongest = 5\n"
    )
    assert refusal(written(tmp_path, text, "longest.toml")).startswith(
        f"{tmp_path / 'longest.toml'}: time has a longest"
    )
    with pytest.raises(InputError, match="Time has a longest of 5 s beside a duration of 1 s"):
        br.Time(longest=5)


def test_a_duration_on_the_command_line_takes_the_place_of_rest_and_its_longest() -> None:
    path = SCENES / "brick_wall_aftermath.toml"
    assert load(path, ["time.duration=2"]).time.end == 2.0
    assert refusal(path, "time.duration=2", "time=5").startswith("--set: time must be ")
    assert load(path, ["time.duration=rest"]).time.longest == load(path).time.longest == 15.0


@pytest.mark.parametrize(
    ("scene", "changes", "warnings"),
    [
        ("brick_wall_aftermath.toml", [], []),
        (
            "brick_wall_aftermath.toml",
            ["dynamics.contacts=false"],
            ["wall: its mortar binds nothing, for its bricks do not touch; set dynamics.contacts = true."],
        ),
        ("brick_wall.toml", [], []),
        ("tempered_door.toml", [], []),
        (
            "tempered_door.toml",
            ["window.0.frame=false"],
            ["{0}: bite counts for nothing without a frame; set frame = true."],
        ),
        (
            "tempered_door.toml",
            ["window.0.frame=false", "window.0.frame_material=wood"],
            ["{0}: bite and frame_material count for nothing without a frame; set frame = true."],
        ),
        ("window_thesis.toml", [], []),
        (
            "window_thesis.toml",
            ["window.0.strength=1e7"],
            [
                "{0}: strength counts for nothing, for the pane is in pieces before the blast; set "
                'release = "as it cracks".'
            ],
        ),
    ],
)
def test_keys_that_count_for_nothing_are_warned_of(
    scene: str, changes: list[str], warnings: list[str]
) -> None:
    loaded = load(SCENES / scene, changes)
    found = [warning for warning in build(loaded).warnings if "nothing" in warning]
    assert found == [warning.format(loaded.objects[0].name) for warning in warnings]
