"""``brisance run``: simulate a scene."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

if TYPE_CHECKING:
    from brisance.model import Scene
    from brisance.result import Pane, Result

MANY_POSES = 1_000_000
"""Frames times pieces from which on writing takes long enough to be announced."""


def run(
    scene: Annotated[Path, typer.Argument(metavar="SCENE", help="Scene file (.toml).")],
    output: Annotated[
        Path | None,
        typer.Option(
            "-o",
            "--output",
            metavar="OUT",
            help="Animation to write: .usdc, .usda, .usd, .usdz, .glb, or .html, a page that shows it.",
        ),
    ] = None,
    report: Annotated[
        Path | None, typer.Option(metavar="R.json", help="Report to write: every fact about every piece.")
    ] = None,
    changes: Annotated[
        list[str] | None,
        typer.Option("--set", metavar="KEY=VALUE", help="Change a key of the scene; may be repeated."),
    ] = None,
    frames: Annotated[int | None, typer.Option(min=1, metavar="N", help="Only the first N frames.")] = None,
    threads: Annotated[
        int | None, typer.Option(min=1, metavar="N", help="Threads to use; the result does not depend on it.")
    ] = None,
    quiet: Annotated[bool, typer.Option("--quiet", "-q", help="Print nothing but errors.")] = False,
) -> None:
    """Simulate a scene and write its animation and report.

    \b
    Example:
      brisance run scenes/brick_wall.toml -o wall.usdc --report wall.json --set charge.0.mass=50
    """
    from brisance.errors import InputError
    from brisance.formats.atomic import check_writable
    from brisance.result import ANIMATION_SUFFIXES, check_output
    from brisance.scene_file import load, named_in_errors
    from brisance.simulation import simulate

    if output is not None:
        if check_writable(output).suffix.lower() not in ANIMATION_SUFFIXES:
            raise InputError(
                f"-o {output}: an animation is USD, glTF or a page, so give a name that ends in .usdc (or "
                ".usda, .usd, .usdz), .glb or .html."
            )
        check_output(output)
    if report is not None:
        if report.suffix.lower() != ".json":
            raise InputError(f"--report {report}: a report is JSON, so give a name that ends in .json.")
        check_output(report)
    loaded = load(scene, changes or ())
    if frames is not None:
        loaded = first_frames(loaded, frames)
    with named_in_errors(scene):
        result = simulate(loaded, progress=not quiet, threads=threads)
    for path in (output, report):
        if path is not None:
            if not quiet and result.positions.shape[0] * result.positions.shape[1] > MANY_POSES:
                typer.echo(f"writing {path}", err=True)
            result.write(path)
    if not quiet:
        typer.echo(summary(result, output=output, report=report))


def first_frames(scene: Scene, frames: int) -> Scene:
    """The scene, ended after its first ``frames`` frames (numbered from 0)."""
    if frames >= scene.time.frames:
        return scene
    # The first frame is at time 0; a tenth of a frame's time still rounds to no second frame.
    duration = max(frames - 1, 0.1) / scene.time.frame_rate
    return scene.model_copy(update={"time": scene.time.model_copy(update={"duration": duration})})


def _fate(pane: Pane, *, until: float) -> str:
    """What became of a pane, in a line."""
    from brisance.cli.table import count

    pieces = count(pane.stop - pane.start, "piece")
    if pane.fate == "holds":
        return (
            f"{pane.name} holds: {pane.peak_stress_pa / 1e6:.1f} MPa at most, and it can take "
            f"{pane.strength_pa / 1e6:.1f} MPa"
        )
    load = f"under {pane.peak_pressure_pa / 1e3:.1f} kPa"
    if pane.fate == "in pieces":
        return f"{pane.name} is in {pieces}, thrown {load}"
    if (pane.failure_time_s or 0.0) > until:
        return f"{pane.name} breaks {load} after these frames, {1e3 * (pane.failure_time_s or 0.0):.2f} ms in"
    stay = f", of which {pane.staying:,} stay" if pane.staying else ""
    return f"{pane.name} breaks {load} after {1e3 * (pane.failure_time_s or 0.0):.2f} ms into {pieces}{stay}"


def summary(result: Result, *, output: Path | None, report: Path | None) -> str:
    """What happened, in a few lines."""
    import numpy as np

    from brisance.cli.table import count

    bodies, time = result.bodies, result.scene.time
    lines = [
        f"{result.scene.name}: {count(len(bodies), 'piece')}, {count(len(result.times), 'frame')} "
        f"({result.times[-1]:g} s at {time.frame_rate:g} frames/s), step {1e3 * result.step_s:.3g} ms, "
        f"simulated in {result.timing_s['total'] - result.timing_s.get('write', 0.0):.3f} s"
    ]
    reached = np.isfinite(bodies.arrival_time_s)
    if reached.any():
        first = int(np.argmin(np.where(reached, bodies.arrival_time_s, np.inf)))
        fastest = int(np.argmax(np.nan_to_num(bodies.launch_speed_m_s)))
        lines.append(
            f"first reached: {bodies.names[first]} after {1e3 * bodies.arrival_time_s[first]:.2f} ms, "
            f"by {bodies.peak_overpressure_pa[first] / 1e3:.1f} kPa"
        )
        lines.append(f"fastest piece: {bodies.names[fastest]} at {bodies.launch_speed_m_s[fastest]:.2f} m/s")
    elif len(bodies):
        lines.append("the blast reaches no piece within these frames")
    lines += [_fate(pane, until=float(result.times[-1])) for pane in result.panes]
    lines += [f"warning: {warning}" for warning in result.warnings]
    lines += [
        f"{what}: {path}" for what, path in (("animation", output), ("report", report)) if path is not None
    ]
    if output is None and report is None:
        lines.append(
            "nothing written; add -o wall.usdc for the animation or --report wall.json for the facts"
        )
    return "\n".join(lines)
