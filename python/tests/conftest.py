"""Ctrl-C as it is at a terminal.

A shell without job control starts background jobs with it ignored, and what they start inherits that: tests
that press Ctrl-C would then wait for nothing.
"""

import signal

if signal.getsignal(signal.SIGINT) is signal.SIG_IGN:
    signal.signal(signal.SIGINT, signal.default_int_handler)
