"""The exceptions Brisance raises on purpose: one tree, one sentence each.

Whatever can be traced to what the user gave (a file, a key, a flag) is an :class:`InputError`; the command
line prints its sentence and exits with 2. Any other exception is a bug.
"""

from __future__ import annotations


class BrisanceError(Exception):
    """Base of every exception that Brisance raises on purpose. Its text is one sentence."""

    exit_code = 1
    """What the command line exits with."""


class InputError(BrisanceError):
    """What the user gave is wrong. The sentence names file or key, what is wrong and what would be right."""

    exit_code = 2
