"""Running contestants in alternation, and ratios of what they took."""
import dataclasses
import os
import statistics
import subprocess
import sys
import tempfile
import time


class Failure(Exception):
    """A contestant did not run."""


@dataclasses.dataclass
class Run:
    seconds: float
    peak_bytes: int  # of memory; no less than this script's own, which the system counts in


def run_process(command):
    """A whole process, start-up included, its output thrown away."""
    command = [str(word) for word in command]
    with tempfile.TemporaryFile() as messages:
        actions = [(os.POSIX_SPAWN_OPEN, 1, os.devnull, os.O_WRONLY, 0),
                   (os.POSIX_SPAWN_DUP2, messages.fileno(), 2)]
        begin = time.perf_counter()
        process = os.posix_spawnp(command[0], command, os.environ, file_actions=actions)
        _, status, usage = os.wait4(process, 0)
        seconds = time.perf_counter() - begin
        if os.waitstatus_to_exitcode(status) != 0:
            messages.seek(0)
            raise Failure(f"{' '.join(command[:4])} ...: {messages.read().decode(errors='replace').strip()}")
    return Run(seconds, usage.ru_maxrss * 1024)


def run_yardstick(command):
    """Seconds that a yardstick reports of itself, its start-up left out."""
    words = [str(word) for word in command]
    # One OpenMP thread in each of the threads that the yardstick makes itself.
    environment = {**os.environ, "OMP_NUM_THREADS": "1"}
    done = subprocess.run(words, capture_output=True, text=True, env=environment)
    if done.returncode != 0:
        raise Failure(done.stderr.strip() or f"{words[0]} fails")
    return statistics.median(float(line) for line in done.stdout.split())


def alternate(contestants, rounds):
    """{name: seconds of each round}; every contestant once a round, in rotated order, after an
    untimed round that brings the files into the page cache."""
    names = list(contestants)
    times = {name: [] for name in names}
    for contestant in contestants.values():
        contestant()
    for turn in range(rounds):
        for place in range(len(names)):
            name = names[(place + turn) % len(names)]
            times[name].append(contestants[name]())
    return times


class OneProcessor:
    """Within this context, this process and those it starts share one processor."""

    def __enter__(self):
        self.allowed = os.sched_getaffinity(0)
        os.sched_setaffinity(0, {max(self.allowed)})

    def __exit__(self, *_):
        os.sched_setaffinity(0, self.allowed)


@dataclasses.dataclass
class Row:
    """One line of the table: `values` of all rounds against a bound."""
    work: str
    against: str
    values: list
    bound: float | None = None
    unit: str = "ratio"    # ratio (ours / theirs), gain (times as fast), ms, s, MB
    at_least: bool = False  # the bound is from below

    def median(self):
        return statistics.median(self.values)

    def holds(self):
        if self.bound is None:
            return None
        return self.median() >= self.bound if self.at_least else self.median() <= self.bound

    def cells(self):
        verdict = {True: "yes", False: "**no**", None: ""}[self.holds()]
        bound = "" if self.bound is None else f"{'≥' if self.at_least else '≤'} {self.text(self.bound)}"
        extremes = [self.text(value) for value in (min(self.values), self.median(), max(self.values))]
        return [self.work, self.against, *extremes, bound, verdict]

    def text(self, value):
        if self.unit == "ratio":
            return f"1/{1 / value:.3g}" if value < 0.667 else f"{value:.2f} x"
        return f"{value:.2f} x" if self.unit == "gain" else f"{value:.3g} {self.unit}"


HEAD = ["work", "against", "min", "median", "max", "bound", "holds"]


def markdown(rows):
    lines = [HEAD, ["---"] * len(HEAD)] + [row.cells() for row in rows]
    return "\n".join("| " + " | ".join(cells) + " |" for cells in lines) + "\n"


def ratios(ours, theirs):
    """Of the same round each, so that what slows both leaves them as they are."""
    return [a / b for a, b in zip(ours, theirs)]


def report(row):
    print("  " + " | ".join(row.cells()), file=sys.stderr, flush=True)
    return row
