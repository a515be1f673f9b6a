"""The live view: a page in the browser that shows a scene, and a server on this machine that simulates it.

.. code-block:: text

    page ── GET /api/schema, /api/scenes[/NAME] ──►  what can be turned, what can be opened
         ── WebSocket /api/live ──────────────────►  scene in, progress, one binary recording out
         ── POST /api/save/FORMAT ────────────────►  scene in, a file out

The server trusts nobody but the page it served itself: see :mod:`brisance.view.guard` for who may ask and
:mod:`brisance.view.folder` for what may be read. A request carries the whole scene, so the server keeps no
state but the runs that are under way.
"""
