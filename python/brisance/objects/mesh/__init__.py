"""Any mesh file as one rigid piece: read, repaired into a closed surface, and weighed.

``file`` reads (OBJ and USD in files of their own), ``polygons`` cuts faces into triangles, ``repair`` closes
what is open or tangled with the help of ``topology``, ``close``, ``columns`` and ``measure``, ``body`` makes
the piece.
"""

from __future__ import annotations

from brisance.objects.mesh.body import MeshBody, mesh_body, mesh_pieces
from brisance.objects.mesh.measure import mesh_contains

__all__ = ["MeshBody", "mesh_body", "mesh_contains", "mesh_pieces"]
