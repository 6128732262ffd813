"""Tables in Markdown."""

from collections.abc import Iterable, Sequence

from quasirigid import TITLE
from records import Failure, Record, Run

TARGETS = (1e-6, 1e-9)

RUN_HEADER = (
    "program",
    "setting",
    "time (s)",
    "set-up (s)",
    "error in ω (rad/s)",
    "drift of \\|H\\|",
    "steps",
)


def markdown(header: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    """A table with its columns aligned."""
    lines = [header, *rows]
    widths = [max(len(cell) for cell in column) for column in zip(*lines, strict=True)]
    lines.insert(1, ["-" * width for width in widths])
    return "\n".join(
        "| " + " | ".join(map(str.ljust, line, widths)) + " |" for line in lines
    )


def run_table(records: Iterable[Record]) -> str:
    """All runs of a case."""
    return markdown(RUN_HEADER, map(run_row, records))


def run_row(record: Record) -> tuple[str, ...]:
    """One run as cells."""
    if isinstance(record, Failure):
        return (record.program, record.setting, record.reason, "", "", "", "")
    return (
        record.program,
        record.setting,
        shown(record.seconds, ".3g"),
        shown(record.setup_seconds, ".2f"),
        shown(record.error, ".1e"),
        shown(record.momentum_drift, ".0e"),
        shown(record.steps, "d"),
    )


def shown(value: float | None, form: str) -> str:
    """A number, or a dash for one that the program does not tell."""
    return "–" if value is None else format(value, form)


def cheapest(records: Iterable[Record], program: str, target: float) -> Run | None:
    """The cheapest run of a program that ends with an error of at most `target`."""
    good = [
        record
        for record in records
        if isinstance(record, Run)
        and record.program == program
        and record.error <= target
    ]
    return min(good, key=lambda record: record.seconds, default=None)


def target_table(records: Sequence[Record]) -> str:
    """For each program and target the cheapest run that reaches it, and how it compares."""
    header = ["program"]
    for target in TARGETS:
        header += [f"time (s) for {target:.0e}", "setting", "ratio"]
    programs = dict.fromkeys(record.program for record in records)
    rows = [[name, *target_cells(records, name)] for name in programs]
    return markdown(header, rows)


def target_cells(records: Sequence[Record], program: str) -> list[str]:
    """The cells of one program in the table of targets."""
    cells = []
    for target in TARGETS:
        found = cheapest(records, program, target)
        if found is None:
            cells += [why_not(records, program), "", ""]
            continue
        own = cheapest(records, TITLE, target)
        ratio = None if own is None else found.seconds / own.seconds
        cells += [f"{found.seconds:.3g}", found.setting, shown(ratio, ".3g")]
    return cells


def why_not(records: Iterable[Record], program: str) -> str:
    """Why a program has no run that reaches a target: the time limit, or its errors."""
    stopped = [
        record.reason
        for record in records
        if record.program == program and isinstance(record, Failure) and record.stopped
    ]
    return stopped[0] if stopped else "not reached"
