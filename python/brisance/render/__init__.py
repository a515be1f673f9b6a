"""Pictures and videos of a result, rendered by Blender from the USD file itself.

Blender runs as a module (``brisance[render]``) in a process of its own, without display or GPU. The shot is
set up for the file: a camera that has the action in view, sun and sky, ground, and materials by the names
that scene files use. The same file and arguments give the same picture.
"""

from __future__ import annotations

import shutil
import tempfile
from collections.abc import Callable, Generator, Iterator
from contextlib import ExitStack, closing, suppress
from pathlib import Path
from typing import Literal

from brisance.errors import InputError
from brisance.formats.atomic import check_writable, replacing
from brisance.interrupt import if_stopped
from brisance.render.blender import rendered, require
from brisance.render.job import Job
from brisance.render.output import Output, OutputKind

__all__ = ["SAMPLES", "Quality", "render"]

Quality = Literal["draft", "final"]

SAMPLES: dict[Quality, int] = {"draft": 2, "final": 32}
"""Light paths a pixel. Either is denoised: a draft is clean but soft in fine texture."""

Progress = Callable[[int, int], None]
"""Called with the number of finished frames and of all frames, first with none finished."""

LEAD_IN, HOLD = 0.4, 0.6
"""How long a video stands still on its first and on its last frame [s]."""


def render(
    usd: Path | str,
    output: Path | str,
    *,
    frame: int | None = None,
    camera: str = "front",
    size: tuple[int, int] = (1280, 720),
    quality: Quality | None = None,
    samples: int | None = None,
    fps: int = 25,
    motion_blur: bool = True,
    progress: Progress | None = None,
) -> list[Path]:
    """Render a USD file to a video, a picture, or a numbered sequence of pictures; returns the files written.

    ``output`` decides by its name: ``shot.mp4``, ``shot.png``, or ``frames/####.png``, where the frame's
    number replaces the hashes and a missing folder is made.
    ``frame`` is the one frame to render, 0 being the first; a single picture without it shows the middle of
    the clip.
    ``camera`` is ``front`` (debris comes towards it), ``side``, ``below``, or the path of a camera prim in
    the file.
    ``size`` is width and height in pixels, even for a video.
    ``quality`` is ``draft`` or ``final`` (about 8 times as long); a single picture is final and anything
    longer a draft if it is left out. ``samples`` sets the light paths a pixel directly.
    ``fps`` is how many frames a video shows a second [1/s]: a file of 100 frames a second of scene time plays
    4 times slowed at 25.

    Raises :class:`InputError` for a missing file or package, a camera or frame that is not in the file, and
    an output that cannot be written; :class:`BrisanceError` where Blender fails. Nothing half written is left
    behind.
    """
    usd, target = Path(usd), Output.of(Path(output))
    _check(target, frame=frame, size=size, samples=samples, quality=quality, fps=fps)
    require("bpy", *(["av"] if target.kind is OutputKind.VIDEO else []))
    from brisance.render.shot import prepare
    from brisance.render.stage import read_stage

    stage = read_stage(usd)
    frames = _frames(stage.frames, target, frame, usd)
    quality = quality or ("final" if target.kind is OutputKind.PICTURE else "draft")
    work = tempfile.TemporaryDirectory(prefix="brisance-render-")
    with work as folder, if_stopped(work.cleanup), ExitStack() as stack:
        job = prepare(
            stage,
            frames=frames,
            folder=Path(folder),
            camera=camera,
            size=size,
            samples=samples or SAMPLES[quality],
            motion_blur=motion_blur,
        )
        pictures = stack.enter_context(closing(_counted(job, progress)))
        if target.kind is OutputKind.VIDEO:
            return [_write_video(pictures, target.path, len(frames), size, fps)]
        return [_write_picture(picture, target.name(number)) for number, picture in pictures]


def _check(
    target: Output,
    *,
    frame: int | None,
    size: tuple[int, int],
    samples: int | None,
    quality: str | None,
    fps: int,
) -> None:
    """Refuse what can be refused before any work is done, and make the folder of a sequence."""
    width, height = size
    if not (16 <= width <= 16384 and 16 <= height <= 16384):
        raise InputError(f"size: {width}x{height} cannot be rendered; give 16 to 16384 pixels each way.")
    if samples is not None and samples < 1:
        raise InputError(f"samples: {samples} light paths a pixel are too few; give 1 or more.")
    if quality is not None and quality not in SAMPLES:
        raise InputError(f"quality: {quality} is not known; give {' or '.join(SAMPLES)}.")
    if target.kind is OutputKind.VIDEO:
        if frame is not None:
            raise InputError(
                f"frame: one frame makes no video; give {target.path.with_suffix('.png')} as output."
            )
        if width % 2 or height % 2:
            raise InputError(
                f"size: a video needs even numbers, not {width}x{height}; give "
                f"{width + width % 2}x{height + height % 2}."
            )
        if not 1 <= fps <= 240:
            raise InputError(f"fps: {fps} frames a second make no video; give 1 to 240.")
    if target.kind is OutputKind.SEQUENCE and target.path.parent.parent.is_dir():
        with suppress(OSError):
            target.path.parent.mkdir(exist_ok=True)
    check_writable(target.path)


def _frames(known: range, target: Output, frame: int | None, usd: Path) -> list[int]:
    """The frames to render: all, the one asked for, or the middle one."""
    if frame is not None and frame not in known:
        raise InputError(f"frame: {usd} has no frame {frame}; give one from {known[0]} to {known[-1]}.")
    if frame is not None:
        return [frame]
    return [known[len(known) // 2]] if target.kind is OutputKind.PICTURE else list(known)


def _counted(job: Job, progress: Progress | None) -> Generator[tuple[int, Path], None, None]:
    report = progress or (lambda done, total: None)
    total = len(job.frames)
    report(0, total)
    with closing(rendered(job)) as pictures:
        for done, item in enumerate(pictures, start=1):
            yield item
            report(done, total)


def _write_picture(picture: Path, path: Path) -> Path:
    with replacing(path) as temporary:
        shutil.copyfile(picture, temporary)
    return path


def _write_video(
    pictures: Iterator[tuple[int, Path]], path: Path, total: int, size: tuple[int, int], fps: int
) -> Path:
    from brisance.render.video import VideoWriter, read_picture

    with replacing(path) as temporary, VideoWriter(temporary, size=size, fps=fps) as video:
        for index, (_, picture) in enumerate(pictures):
            still = LEAD_IN * (index == 0) + HOLD * (index == total - 1)
            video.add(read_picture(picture), times=1 + round(still * fps))
            picture.unlink()
    return path
