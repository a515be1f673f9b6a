"""The command's first lines: from here on Ctrl-C ends it cleanly, also while the rest is being loaded."""

from brisance.interrupt import end_on_ctrl_c

end_on_ctrl_c()


def main() -> int:
    """Load the command and run it; returns its exit code."""
    from brisance.cli.main import main as command

    return command()


if __name__ == "__main__":
    raise SystemExit(main())
