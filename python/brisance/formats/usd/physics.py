"""UsdPhysics on the pieces, so that a downstream engine can take over.

Every piece is a rigid body with its mass, its centre of mass at its own origin and a convex collider. The
bodies are *kinematic*: a simulator follows the recorded keys, and whatever else it simulates is pushed by
them. To hand the pieces over, start at the last frame and set ``physics:kinematicEnabled`` to false:
``physics:velocity`` and ``physics:angularVelocity`` hold their motion at that moment, so they fly on as they
flew. (A simulator reads these two only from bodies that are not kinematic.)
"""

from __future__ import annotations

from pxr import Gf, Sdf

from brisance.formats.usd.authoring import apply, attribute, define

GRAVITY = 9.80665
"""Acceleration of gravity [m/s²]."""

_T = Sdf.ValueTypeNames


def author_scene(world: Sdf.PrimSpec) -> None:
    """Author the physics scene, which says which way and how hard gravity pulls."""
    scene = define(world, "PhysicsScene", "PhysicsScene")
    attribute(scene, "physics:gravityDirection", _T.Vector3f, Gf.Vec3f(0, -1, 0))
    attribute(scene, "physics:gravityMagnitude", _T.Float, GRAVITY)


def author_body(
    prim: Sdf.PrimSpec,
    *,
    mass: float,
    velocity: Gf.Vec3f | None = None,
    spin: Gf.Vec3f | None = None,
    inertia: tuple[Gf.Vec3f, Gf.Quatf] | None = None,
) -> None:
    """Make a Mesh a rigid body, as :func:`author_kind` says, of a mass [kg].

    ``velocity`` [m/s] and ``spin`` [degrees/s], in the parent's axes, are those at the last frame.
    ``inertia`` holds the principal moments [kg m²] and the rotation from their axes to the body's; left out,
    a simulator takes the collider's.
    """
    author_kind(prim)
    author_mass(prim, mass)
    if inertia is not None:
        attribute(prim, "physics:diagonalInertia", _T.Float3, inertia[0])
        attribute(prim, "physics:principalAxes", _T.Quatf, inertia[1])
    if velocity is not None:
        attribute(prim, "physics:velocity", _T.Vector3f, velocity)
    if spin is not None:
        attribute(prim, "physics:angularVelocity", _T.Vector3f, spin)


def author_kind(prim: Sdf.PrimSpec) -> None:
    """Author what all pieces have in common: kinematic bodies with convex colliders, bound to materials."""
    apply(
        prim,
        "MaterialBindingAPI",
        "PhysicsRigidBodyAPI",
        "PhysicsMassAPI",
        "PhysicsCollisionAPI",
        "PhysicsMeshCollisionAPI",
    )
    attribute(prim, "physics:kinematicEnabled", _T.Bool, True)
    attribute(prim, "physics:centerOfMass", _T.Point3f, Gf.Vec3f(0))
    attribute(prim, "physics:approximation", _T.Token, "convexHull", uniform=True)


def author_mass(prim: Sdf.PrimSpec, mass: float) -> None:
    """Author the mass of a body [kg]."""
    attribute(prim, "physics:mass", _T.Float, mass)


def author_static_collider(prim: Sdf.PrimSpec) -> None:
    """Make a Mesh something to fall on: its triangles collide and never move."""
    apply(prim, "MaterialBindingAPI", "PhysicsCollisionAPI", "PhysicsMeshCollisionAPI")
    attribute(prim, "physics:approximation", _T.Token, "none", uniform=True)
