"""One module for each program; each has `run(case, setting)`."""
