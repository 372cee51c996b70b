# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The nvm authors
"""Where the command ``nvm`` begins: outside the package, whose imports take long enough for a Ctrl-C."""

import os
import signal


def main() -> int:
    """Runs the command; an interruption while it is imported ends it as one of what it does would."""
    before = signal.getsignal(signal.SIGINT)
    if before is signal.default_int_handler:  # not where it is ignored, as behind nohup
        signal.signal(signal.SIGINT, lambda *_: os._exit(130))
    from nvm.cli import main as run

    if before is signal.default_int_handler:
        signal.signal(signal.SIGINT, before)
    return run()
