"""Throw the same shards in our contacts and in two other engines, in one run: PyBullet and Rapier.

A square metre of glass of 6 mm, broken by us, is thrown down at 10 m/s from half a metre above the ground
and followed for 120 frames of 1/60 s (24 for 10 000 pieces, without PyBullet's sub-steps there, which would
take hours). Each frame is sixteen steps of two sub-steps in every engine, as ours takes them in a run. All
three have the same convex parts, masses, moments, poses, velocities, friction and bounce. The pieces are the
engine's own, from ``benches/thrown_shards.rs``, which also measures ours: the contact world alone, without
loads, air or recording. What counts is the processor time of the steps, so that whatever else the machine
does matters little: all three run on one core. Making the bodies is printed beside it.

PyBullet: rigid bodies in maximal coordinates, its 50 iterations in each sub-step; the row "of 1/240 s" has
no sub-steps, which is how PyBullet is mostly run. Rapier: two solver iterations a step, which are its
sub-steps, on one thread like the others, its unit of length 5 cm like ours.

Then a thousand shards are thrown down at 10, 100 and 300 m/s, to see which fall through the floor.

Run with ``.venv/bin/python benches/contact_rivals.py [--pieces 100 1000] [--frames 120]``. ``make bench``
installs the rivals; one that is missing is left out. Exits with 1 where a target is missed: three times as
fast as PyBullet and no slower than Rapier at 1 000 pieces, nothing of ours below the floor.
"""

from __future__ import annotations

import argparse
import json
import math
import resource
import subprocess
import sys
import time
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from functools import cache
from importlib.util import find_spec
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

ROOT = Path(__file__).resolve().parent.parent
EXAMPLE = ROOT / "target" / "release" / "examples" / "thrown_shards"

THICKNESS = 0.006
SUBSTEPS = 2
STEPS_A_FRAME = 16
FRAME_RATE = 60
GRAVITY = 9.80665
FRICTION = 0.5
RESTITUTION = 0.2
BOUNCE_SPEED = 0.3
"""Slower impacts do not bounce [m/s]."""
UNIT = 0.05
"""Rapier's unit of length, on which its tolerances hang [m]."""
CALM = 0.05
"""A piece slower than this counts as still [m/s]."""
USUAL_STEPS = 4
"""Steps a frame with which PyBullet is mostly run."""
MANY = 10_000
"""From this many pieces on, a fifth of the frames has to do, and PyBullet with sub-steps is left out."""
LEAST_BEFORE_BULLET = 3.0
LEAST_BEFORE_RAPIER = 1.0

Shard = dict[str, Any]


@dataclass(frozen=True)
class Outcome:
    """What an engine made of the shards."""

    make_s: float
    """Processor time of making the bodies [s]."""
    step_s: float
    """Processor time of all steps [s]."""
    heights: list[float]
    """Height of each piece's centre of mass in the end [m]."""
    asleep: int | None
    """How many sleep; None where the engine does not say."""
    still: int
    """How many are slower than CALM, asleep or not."""

    @property
    def below(self) -> int:
        """Pieces whose centre of mass ended below the floor, or is not a number."""
        return sum(not height > 0.0 for height in self.heights)


def ours(
    pieces: int, velocity: tuple[float, float, float], steps: int, rate: float
) -> tuple[list[Shard], Outcome]:
    """Break a pane and throw it; return the shards as they were thrown, and what became of them."""
    numbers = [pieces, THICKNESS, *velocity]
    before = children_s()
    subprocess.run([EXAMPLE, *map(str, numbers), "0", str(rate)], check=True, stdout=subprocess.DEVNULL)
    made = children_s()
    run = subprocess.run(
        [EXAMPLE, *map(str, numbers), str(steps), str(rate)], check=True, capture_output=True, text=True
    )
    # What the steps take is what the same run takes more than one without any.
    stepped = children_s() - made - (made - before)
    found = json.loads(run.stdout)
    end = found["ours"]
    still = count_still(end["speed_m_s"])
    return found["shards"], Outcome(end["make_s"], stepped, end["height_m"], end["asleep"], still)


def children_s() -> float:
    """Processor time of all processes started and ended so far [s]."""
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    return usage.ru_utime + usage.ru_stime


def count_still(speeds: Iterable[float]) -> int:
    """How many speeds [m/s] are below CALM."""
    return sum(speed < CALM for speed in speeds)


def bullet(shards: list[Shard], steps: int, rate: float, substeps: int) -> Outcome:
    """Throw the shards in PyBullet."""
    import pybullet

    pybullet.connect(pybullet.DIRECT)
    pybullet.setGravity(0.0, -GRAVITY, 0.0)
    pybullet.setPhysicsEngineParameter(
        fixedTimeStep=1.0 / rate,
        numSubSteps=substeps,
        restitutionVelocityThreshold=BOUNCE_SPEED,
        deterministicOverlappingPairs=0,
    )
    # Bullet multiplies the friction and the restitution of two bodies.
    surface = {"lateralFriction": math.sqrt(FRICTION), "restitution": math.sqrt(RESTITUTION)}
    started = time.process_time()
    floor = pybullet.createCollisionShape(pybullet.GEOM_BOX, halfExtents=[500.0, 10.0, 500.0])
    ground = pybullet.createMultiBody(0.0, floor, -1, [0.0, -10.0, 0.0], useMaximalCoordinates=True)
    pybullet.changeDynamics(ground, -1, **surface)
    bodies = []
    with TemporaryDirectory() as folder:
        for index, shard in enumerate(shards):
            path = Path(folder) / f"{index}.obj"
            path.write_text(as_wavefront(shard["parts"]), encoding="ascii")
            shape = pybullet.createCollisionShape(pybullet.GEOM_MESH, fileName=str(path))
            place = (shard["position_m"], shard["orientation_xyzw"])
            body = pybullet.createMultiBody(shard["mass_kg"], shape, -1, *place, useMaximalCoordinates=True)
            pybullet.changeDynamics(
                body,
                -1,
                # Moments alone would set the mass to zero.
                mass=shard["mass_kg"],
                localInertiaDiagonal=shard["moments_kg_m2"],
                linearDamping=0.0,
                angularDamping=0.0,
                activationState=pybullet.ACTIVATION_STATE_ENABLE_SLEEPING,
                **surface,
            )
            pybullet.resetBaseVelocity(body, shard["velocity_m_s"], shard["spin_rad_s"])
            bodies.append(body)
    made = time.process_time()
    for _ in range(steps):
        pybullet.stepSimulation()
    stepped = time.process_time()
    heights = [pybullet.getBasePositionAndOrientation(body)[0][1] for body in bodies]
    still = count_still(math.hypot(*pybullet.getBaseVelocity(body)[0]) for body in bodies)
    pybullet.disconnect()
    return Outcome(made - started, stepped - made, heights, None, still)


def as_wavefront(parts: list[list[list[float]]]) -> str:
    """Convex parts as objects of an OBJ file. Bullet takes the hull of each: faces only name its corners."""
    lines, first = [], 1
    for index, points in enumerate(parts):
        lines.append(f"o part{index}")
        lines += [f"v {x:.9g} {y:.9g} {z:.9g}" for x, y, z in points]
        lines += [f"f {first} {first + k} {first + k + 1}" for k in range(1, len(points) - 1)]
        first += len(points)
    return "\n".join(lines) + "\n"


def rapier(shards: list[Shard], steps: int, rate: float, substeps: int) -> Outcome:
    """Throw the shards in Rapier."""
    import rapier3d

    world = rapier3d.PhysicsWorld(gravity=(0.0, -GRAVITY, 0.0))
    world.set_num_threads(1)
    settings = world.integration_parameters
    settings.dt = 1.0 / rate
    settings.num_solver_iterations = substeps
    settings.length_unit = UNIT
    started = time.process_time()
    surface = {"friction": FRICTION, "restitution": RESTITUTION}
    ground = world.add_body(rapier3d.RigidBody.fixed(translation=(0.0, -10.0, 0.0)))
    world.add_collider(rapier3d.Collider.cuboid(500.0, 10.0, 500.0, **surface), parent=ground)
    bodies, refused = [], 0
    for shard in shards:
        x, y, z, w = shard["orientation_xyzw"]
        place = rapier3d.Isometry3(tuple(shard["position_m"]), rapier3d.Rotation3.from_quaternion(w, x, y, z))
        mass = rapier3d.MassProperties((0.0, 0.0, 0.0), shard["mass_kg"], tuple(shard["moments_kg_m2"]))
        builder = rapier3d.RigidBody.dynamic(
            position=place, linvel=tuple(shard["velocity_m_s"]), angvel=tuple(shard["spin_rad_s"])
        ).additional_mass_properties(mass)
        body = world.add_body(builder)
        for points in shard["parts"]:
            try:
                hull = rapier3d.Collider.convex_hull(points, density=0.0, **surface)
            except rapier3d.MeshConversionError:
                refused += 1
                continue
            world.add_collider(hull, parent=body)
        bodies.append(body)
    made = time.process_time()
    for _ in range(steps):
        world.step()
    stepped = time.process_time()
    if refused:
        print(f"Rapier makes no hull of {refused} convex parts: their bodies go without these")
    ends = [world.rigid_bodies.get(body) for body in bodies]
    still = count_still(math.hypot(end.linvel.x, end.linvel.y, end.linvel.z) for end in ends)
    heights = [end.translation.y for end in ends]
    asleep = sum(end.is_sleeping for end in ends)
    return Outcome(made - started, stepped - made, heights, asleep, still)


Throw = Callable[[list[Shard], int, float, int], Outcome]
RIVALS: dict[str, tuple[str, Throw]] = {"PyBullet": ("pybullet", bullet), "Rapier": ("rapier3d", rapier)}


@cache
def installed() -> dict[str, Throw]:
    """The other engines that are here; says once which are not."""
    missing = [package for package, _ in RIVALS.values() if find_spec(package) is None]
    if missing:
        print(f"not measured: {', '.join(missing)} (pip install {' '.join(missing)})")
    return {name: throw for name, (package, throw) in RIVALS.items() if package not in missing}


def line(name: str, frames: int, outcome: Outcome, own: Outcome) -> str:
    """One row of the table."""
    count = len(outcome.heights)
    asleep = "-" if outcome.asleep is None else str(outcome.asleep)
    cost = 1e6 * outcome.step_s / (count * frames)
    return (
        f"{count:6d} {frames:7d}  {name:22s} {outcome.step_s:8.3f} {cost:8.1f} "
        f"{outcome.step_s / own.step_s:6.2f} {outcome.below:6d} {asleep:>7s} {outcome.still:6d} "
        f"{outcome.make_s:7.2f}"
    )


def race(counts: list[int], most_frames: int) -> list[str]:
    """Print the table of all engines at all counts; return which targets are missed."""
    rate = float(STEPS_A_FRAME * FRAME_RATE)
    print(f"frames of 1/{FRAME_RATE} s, {STEPS_A_FRAME} steps a frame, {SUBSTEPS} sub-steps a step")
    print("pieces  frames  engine                  steps s  us/piece  times  below  asleep  still  make s")
    print("                                                  a frame   ours")
    missed = []
    for count in counts:
        frames = most_frames if count < MANY else math.ceil(most_frames / 5)
        steps = STEPS_A_FRAME * frames
        shards, own = ours(count, (0.0, -10.0, 0.0), steps, rate)
        print(line("ours", frames, own, own), flush=True)
        if own.below:
            missed.append(f"{own.below} of ours below the floor")
        for name, (throw, steps_a_frame, substeps, least) in runs().items():
            if count >= MANY and throw is bullet and substeps:
                continue
            outcome = throw(shards, steps_a_frame * frames, float(steps_a_frame * FRAME_RATE), substeps)
            print(line(name, frames, outcome, own), flush=True)
            if count == 1000 and outcome.step_s < least * own.step_s:
                missed.append(f"{name} takes {outcome.step_s / own.step_s:.2f} times ours, not {least:g}")
    return missed


def runs() -> dict[str, tuple[Throw, int, int, float]]:
    """What is measured beside ours: engine, steps a frame, sub-steps, least multiple of our time."""
    every = {
        "PyBullet": (bullet, STEPS_A_FRAME, SUBSTEPS, LEAST_BEFORE_BULLET),
        f"PyBullet of 1/{USUAL_STEPS * FRAME_RATE} s": (bullet, USUAL_STEPS, 0, 0.0),
        "Rapier": (rapier, STEPS_A_FRAME, SUBSTEPS, LEAST_BEFORE_RAPIER),
    }
    here = installed().values()
    return {name: run for name, run in every.items() if run[0] in here}


def tunnelling(frames: int) -> list[str]:
    """Throw a thousand shards at the floor faster and faster; return which targets are missed."""
    print("\nThrown down, one step a frame in the rivals, sixteen in ours: how many end below")
    missed = []
    for speed in (10.0, 100.0, 300.0):
        velocity = (0.0, -speed, 0.3 * speed)
        rate = float(STEPS_A_FRAME * FRAME_RATE)
        shards, own = ours(1000, velocity, STEPS_A_FRAME * frames, rate)
        counts = {"ours": own.below}
        for name, throw in installed().items():
            counts[name] = throw(
                shards, frames, float(FRAME_RATE), 0 if name == "PyBullet" else SUBSTEPS
            ).below
            finely = throw(shards, STEPS_A_FRAME * frames, rate, SUBSTEPS).below
            counts[f"{name} in our steps"] = finely
        print(
            f"{speed:4.0f} m/s, {len(shards)} pieces: {', '.join(f'{k} {v}' for k, v in counts.items())}",
            flush=True,
        )
        if own.below:
            missed.append(f"{own.below} of ours below the floor at {speed:g} m/s")
    return missed


def main() -> int:
    parser = argparse.ArgumentParser(description="The same shards in three engines.")
    parser.add_argument("--pieces", type=int, nargs="+", default=[100, 1_000, 10_000])
    parser.add_argument("--frames", type=int, default=120)
    options = parser.parse_args()
    build = [
        "cargo",
        "build",
        "--release",
        "--quiet",
        "--package",
        "brisance-engine",
        "--example",
        "thrown_shards",
    ]
    subprocess.run(build, check=True, cwd=ROOT)
    missed = race(options.pieces, options.frames) + tunnelling(options.frames // 2)
    print("\n" + ("; ".join(missed) + ": MISSED" if missed else "all targets met"))
    return 1 if missed else 0


if __name__ == "__main__":
    sys.exit(main())
