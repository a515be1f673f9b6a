"""A result as one binary message for the live view: shapes once, poses compact, facts as plain arrays.

Little-endian throughout. A fixed head, a JSON header that names the arrays, then the arrays, each beginning
on a multiple of 16 bytes so that a reader wraps them where they lie:

.. code-block:: text

    0   "BRSV"
    4   u32 version of the format
    8   u32 bytes of the header, a multiple of 4
    12  u32 bytes of the whole message
    16  header: JSON, padded with spaces
    …   arrays, at the offsets that the header gives

``docs/live-view-format.md`` describes every key and array.
"""

from __future__ import annotations

import json
import math
import struct
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from brisance.errors import InputError
from brisance.formats.packed.batches import Batch, batches, shape_key
from brisance.formats.packed.cast import Cast
from brisance.formats.packed.facts import FACTS, facts, front_table, look_numbers, pulses
from brisance.formats.packed.poses import MOST_POSES, ROW, Poses, pack_poses

if TYPE_CHECKING:
    from brisance.model import Scene
    from brisance.result import Result

MAGIC = b"BRSV"
VERSION = 1
ALIGNMENT = 16

PIECES_A_ROW = 64
"""Pieces in one row of the piece table, each four texels of four numbers."""

MOST_PIECES = 50_000
"""Pieces beyond which neither a wait nor a picture would be called live."""

NEVER = 1e30
"""Stands for infinity [s] where shaders read it."""

_TYPES = {"float32": "f32", "uint32": "u32", "int8": "i8"}

Array = NDArray[Any]


def check_shown(scene: Scene) -> None:
    """Raise :class:`InputError` if a recording of the scene is more than the live view can hold."""
    _check(scene.time.frames, scene.piece_count)


def _check(frames: int, pieces: int) -> None:
    if pieces > MOST_PIECES:
        raise InputError(
            f"{pieces:,} pieces are more than the live view shows ({MOST_PIECES:,}); lower their number."
        )
    if frames * pieces > MOST_POSES:
        raise InputError(
            f"{frames:,} frames of {pieces:,} pieces are more than the live view shows "
            f"({MOST_POSES:,} poses); lower time.duration, time.frame_rate or the number of pieces."
        )


# Masses and places of absurd size overflow to infinity, which is shown as such: no reason to fail.
@np.errstate(over="ignore", invalid="ignore")
def pack(result: Result, *, known: str = "", extra: Mapping[str, Any] | None = None) -> bytes:
    """The message of a result.

    ``known`` is the ``geometry`` key of a message that the receiver still holds: equal shapes are then left
    out. ``extra`` is added to the header. Raises :class:`InputError` beyond :data:`poses.MOST_POSES` poses.
    """
    _check(len(result.times), len(result.bodies))
    arrays: dict[str, Array] = {}
    cast = Cast(result)
    poses = pack_poses(cast.positions, cast.orientations)
    arrays["poses"] = poses.table
    looks, numbers = look_numbers(cast.materials)
    arrays["pieces"] = _piece_table(cast, poses, numbers)
    arrays["facts"] = facts(result)
    arrays["pulses"] = pulses(result)
    arrays["fronts"] = front_table(result)
    clear = np.array([look["opacity"] < 1.0 for look in looks], dtype=np.bool_)[numbers]
    key = shape_key(cast.meshes, clear)
    shapes = [] if key == known else batches(cast.meshes, clear)
    header = {
        **_header(result),
        "looks": looks,
        "geometry": key,
        "batches": None
        if key == known
        else [_describe(shapes, arrays, index) for index in range(len(shapes))],
        **(extra or {}),
    }
    return assemble(header, arrays)


def assemble(header: Mapping[str, Any], arrays: Mapping[str, Array]) -> bytes:
    """Lay header and arrays out as one message."""
    layout = {}
    end = 0
    for name, array in arrays.items():
        layout[name] = {"type": _TYPES[array.dtype.name], "at": end, "shape": list(array.shape)}
        end = -(-(end + array.nbytes) // ALIGNMENT) * ALIGNMENT
    text = json.dumps({**header, "arrays": layout}, ensure_ascii=False, allow_nan=False).encode()
    # Offsets count from the end of the header, whose length then need not be known to write it.
    text += b" " * (-len(text) % ALIGNMENT)
    parts = [struct.pack("<4sIII", MAGIC, VERSION, len(text), 16 + len(text) + end), text]
    for array in arrays.values():
        data = np.ascontiguousarray(array, dtype=array.dtype.newbyteorder("<")).tobytes()
        parts += [data, b"\0" * (-len(data) % ALIGNMENT)]
    return b"".join(parts)


def read(message: bytes) -> tuple[dict[str, Any], dict[str, Array]]:
    """Header and arrays of a message, as the viewer reads them. Raises ValueError for anything else."""
    if len(message) < 16:
        raise ValueError("too short for a message of the live view")
    magic, version, size, total = struct.unpack_from("<4sIII", message)
    if magic != MAGIC or version != VERSION or total != len(message):
        raise ValueError("not a whole message of the live view in this version")
    header = json.loads(message[16 : 16 + size])
    types = {short: np.dtype(name).newbyteorder("<") for name, short in _TYPES.items()}
    arrays = {
        name: np.frombuffer(
            message, types[place["type"]], math.prod(place["shape"]), 16 + size + place["at"]
        ).reshape(place["shape"])
        for name, place in header["arrays"].items()
    }
    return header, arrays


def _header(result: Result) -> dict[str, Any]:
    scene = result.scene
    return {
        "name": scene.name,
        "seed": scene.seed,
        "frames": len(result.times),
        "frame_rate": result.frame_rate,
        "step_s": result.step_s,
        "row": ROW,
        "pieces_a_row": PIECES_A_ROW,
        "ground_m": None if scene.ground is None else scene.ground.height,
        "facts": list(FACTS),
        "names": list(result.bodies.names),
        "sources": [
            {"name": source.name, "material": source.material, "start": source.start, "stop": source.stop}
            for source in result.sources
        ],
        "charges": [
            {
                "position_m": list(charge.position),
                "tnt_mass_kg": charge.mass * charge.factor,
                "time_s": charge.time,
                "burst": charge.burst,
            }
            for charge in scene.charges
        ],
        "warnings": list(result.warnings),
        "timing_s": result.timing_s,
    }


def _piece_table(cast: Cast, poses: Poses, looks: NDArray[np.int64]) -> NDArray[np.float32]:
    """(rows, PIECES_A_ROW, 16): what the vertex shader asks about a piece, four texels of four numbers."""
    count = len(cast.meshes)
    rows = max(1, -(-count // PIECES_A_ROW))
    table = np.zeros((rows * PIECES_A_ROW, 16), dtype=np.float32)
    own = table[:count]
    own[:, 0:3] = poses.low
    own[:, 3] = np.where(np.isfinite(cast.arrival_s), cast.arrival_s, -1.0)
    own[:, 4:7] = poses.size
    own[:, 7] = poses.offset
    own[:, 8] = poses.first
    own[:, 9] = poses.count
    own[:, 10] = looks
    own[:, 11] = _chance(count)
    own[:, 12] = np.clip(cast.shown_from_s, -NEVER, NEVER)
    own[:, 13] = np.clip(cast.shown_until_s, -NEVER, NEVER)
    return table.reshape(rows, PIECES_A_ROW, 16)


def _chance(count: int) -> NDArray[np.float64]:
    """(count,) a number in 0..1 for each piece, by which its colour differs from its neighbours'."""
    keys = np.arange(1, count + 1, dtype=np.uint64) * np.uint64(0x9E3779B97F4A7C15)
    keys ^= keys >> np.uint64(32)
    keys *= np.uint64(0xD6E8FEB86659FD93)
    return (keys >> np.uint64(40)) / float(1 << 24)


def _describe(shapes: list[Batch], arrays: dict[str, Array], index: int) -> dict[str, Any]:
    """Add the arrays of one batch and return what the header says of it."""
    shape = shapes[index]
    for name in ("position", "normal", "index", "piece"):
        arrays[f"{name}_{index}"] = getattr(shape, name)
    return {"instanced": shape.instanced, "transparent": shape.transparent, "triangles": shape.triangles}
