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


class ArgumentError(InputError):
    """One argument is wrong. A command tells it by the option's name, a scene file by the key's."""

    def __init__(self, argument: str, text: str) -> None:
        super().__init__(f"{argument} {text}")
        self.argument = argument
        """Name of the argument in Python."""
        self.text = text
        """The rest of the sentence."""
