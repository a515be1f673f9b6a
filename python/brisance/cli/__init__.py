"""The ``brisance`` command, one file a subcommand. Results go to stdout, progress and errors to stderr."""
