"""USD files: every visible mesh of the stage, in metres with Y up, at its first time sample."""

from __future__ import annotations

import math
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
from pxr import Gf, Tf, Usd, UsdGeom

from brisance.objects.mesh.polygons import Indices, Points, PolygonMesh, merged


def read_usd(path: Path) -> PolygonMesh:
    """All meshes of the stage as one, their transforms, ``metersPerUnit`` and ``upAxis`` applied.

    Native instances and point instancers are followed; meshes that are invisible or of purpose ``guide`` or
    ``proxy`` are passed over. Raises :class:`ValueError` if USD cannot open the file.
    """
    try:
        stage = Usd.Stage.Open(str(path))
    except Tf.ErrorException as error:
        raise ValueError("USD cannot open it") from error
    to_scene = _metres_y_up(stage)
    time = Usd.TimeCode.EarliestTime()
    meshes = [
        _mesh(UsdGeom.Mesh(prim), time).transformed(to_scene @ world)
        for prim, world in _placed_meshes(stage.GetPseudoRoot(), time, np.eye(4))
    ]
    return merged(meshes) if meshes else PolygonMesh(np.empty((0, 3)), *np.empty((2, 0), np.int64))


def _metres_y_up(stage: Usd.Stage) -> Points:
    unit = UsdGeom.GetStageMetersPerUnit(stage)
    if not (math.isfinite(unit) and unit > 0.0):
        raise ValueError(f"its metersPerUnit is {unit}; it has to be above 0")
    matrix: Points = np.diag([unit, unit, unit, 1.0])
    if UsdGeom.GetStageUpAxis(stage) == UsdGeom.Tokens.z:
        y_from_z = np.array([[1.0, 0, 0, 0], [0, 0, 1.0, 0], [0, -1.0, 0, 0], [0, 0, 0, 1.0]])
        matrix = y_from_z @ matrix
    return matrix


def _placed_meshes(root: Usd.Prim, time: Usd.TimeCode, above: Points) -> Iterator[tuple[Usd.Prim, Points]]:
    """Mesh prims under ``root`` with their transforms to the stage, ``above`` being put over all of them."""
    walk = iter(Usd.PrimRange(root, Usd.TraverseInstanceProxies()))
    cache = UsdGeom.XformCache(time)
    for prim in walk:
        imageable = UsdGeom.Imageable(prim)
        if imageable and not _is_shown(imageable, time):
            walk.PruneChildren()
            continue
        if prim.IsA(UsdGeom.PointInstancer):
            world = above @ _matrix(cache.GetLocalToWorldTransform(prim))
            yield from _instanced(UsdGeom.PointInstancer(prim), time, world, cache)
            walk.PruneChildren()
        elif prim.IsA(UsdGeom.Mesh):
            yield prim, above @ _matrix(cache.GetLocalToWorldTransform(prim))


def _is_shown(imageable: UsdGeom.Imageable, time: Usd.TimeCode) -> bool:
    purpose = imageable.GetPurposeAttr().Get()
    hidden = imageable.GetVisibilityAttr().Get(time) == UsdGeom.Tokens.invisible
    return not hidden and purpose not in (UsdGeom.Tokens.guide, UsdGeom.Tokens.proxy)


def _instanced(
    instancer: UsdGeom.PointInstancer, time: Usd.TimeCode, world: Points, cache: UsdGeom.XformCache
) -> Iterator[tuple[Usd.Prim, Points]]:
    """The meshes of a point instancer's prototypes, once for each instance."""
    stage = instancer.GetPrim().GetStage()
    prototypes = [stage.GetPrimAtPath(path) for path in instancer.GetPrototypesRel().GetTargets()]
    numbers = instancer.GetProtoIndicesAttr().Get(time) or []
    transforms = instancer.ComputeInstanceTransformsAtTime(
        time, time, UsdGeom.PointInstancer.IncludeProtoXform, UsdGeom.PointInstancer.IgnoreMask
    )
    for number, transform in zip(numbers, transforms, strict=True):
        prototype = prototypes[number]
        # The instance transform holds the prototype's own; what is above the prototype has no part in it.
        from_stage = np.linalg.inv(_matrix(cache.GetLocalToWorldTransform(prototype)))
        yield from _placed_meshes(prototype, time, world @ _matrix(transform) @ from_stage)


def _matrix(matrix: Gf.Matrix4d) -> Points:
    """A matrix of column vectors from one of row vectors."""
    return np.array(matrix, np.float64).reshape(4, 4).T


def _mesh(mesh: UsdGeom.Mesh, time: Usd.TimeCode) -> PolygonMesh:
    """A mesh prim in its own frame, its holes and wrong faces left out."""
    points = _array(mesh.GetPointsAttr(), time, np.float64, (-1, 3))
    counts = _array(mesh.GetFaceVertexCountsAttr(), time, np.int64)
    indices = _array(mesh.GetFaceVertexIndicesAttr(), time, np.int64)
    where = mesh.GetPath()
    if counts.sum() != len(indices) or (counts < 0).any():
        raise ValueError(f"the face counts of {where} do not add up to its {len(indices)} indices")
    if len(indices) and (indices.min() < 0 or indices.max() >= len(points)):
        raise ValueError(f"a face of {where} names a vertex that is not among its {len(points)}")
    scheme = mesh.GetSubdivisionSchemeAttr()
    warnings: tuple[str, ...] = ()
    if scheme.HasAuthoredValue() and scheme.Get() != UsdGeom.Tokens.none:
        warnings = ("its subdivision surface is taken as its control cage",)
    polygons = PolygonMesh(points, counts, indices, _texture_coordinates(mesh, time, indices), warnings)
    kept = np.ones(len(counts), bool)
    holes = _array(mesh.GetHoleIndicesAttr(), time, np.int64)
    kept[holes[(holes >= 0) & (holes < len(counts))]] = False
    left_handed = mesh.GetOrientationAttr().Get() == UsdGeom.Tokens.leftHanded
    return polygons.select(kept, turned=np.full(len(counts), left_handed))


def _array(attribute: Usd.Attribute, time: Usd.TimeCode, kind: type, shape: tuple[int, ...] = (-1,)) -> Any:
    """The value of an array attribute; an empty array where there is none."""
    value = attribute.Get(time)
    return np.array([] if value is None else value, kind).reshape(shape)


def _texture_coordinates(mesh: UsdGeom.Mesh, time: Usd.TimeCode, indices: Indices) -> Points | None:
    """(corners, 2) of the primvar ``st``, or of the first other one of the role of texture coordinates."""
    primvars = UsdGeom.PrimvarsAPI(mesh).GetPrimvarsWithValues()
    named = [primvar for primvar in primvars if primvar.GetPrimvarName() in ("st", "UVMap", "map1")]
    others = [primvar for primvar in primvars if str(primvar.GetTypeName()).startswith("texCoord2")]
    per_point = (UsdGeom.Tokens.vertex, UsdGeom.Tokens.varying)
    for primvar in [*named, *others]:
        values: Points = np.array(primvar.ComputeFlattened(time), np.float64)
        if values.ndim != 2 or values.shape[1] != 2:
            continue
        if primvar.GetInterpolation() == UsdGeom.Tokens.faceVarying and len(values) == len(indices):
            return values
        if primvar.GetInterpolation() in per_point and indices.max(initial=-1) < len(values):
            return values[indices]
    return None
