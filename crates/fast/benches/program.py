#!/usr/bin/env python3
"""Measures the program as a user runs it, and keeps the numbers in results/program.csv.

Run it from the root of a clone, on Unix, after
cargo build --release -p photon-mapping-toolkit && cargo build --release --example golden_check
"""
import json
import os
import pathlib
import statistics
import subprocess
import sys
import tempfile
import time

import room

RENDER = [str(pathlib.Path("target/release/photon-mapping").absolute()), "render", "--quiet"]
PORT = [str(pathlib.Path("target/release/examples/golden_check").absolute())]
MILLION = 1_000_000


def run(command, threads=2):
    """Seconds by the clock, seconds of processor time, and MB of memory of one run."""
    start = time.monotonic()
    environment = dict(os.environ, RAYON_NUM_THREADS=str(threads))
    process = subprocess.Popen(command, env=environment, stdout=subprocess.DEVNULL)
    _, status, used = os.wait4(process.pid, 0)
    if status != 0:
        sys.exit(f"{command} failed")
    # Linux counts in KiB, macOS in bytes.
    unit = 1 if sys.platform == "darwin" else 1024
    return time.monotonic() - start, used.ru_utime + used.ru_stime, used.ru_maxrss * unit / 1e6


def together(command, count):
    """Seconds by the clock until `count` runs of one thread each, started at once, have ended."""
    start = time.monotonic()
    environment = dict(os.environ, RAYON_NUM_THREADS="1")
    runs = [
        subprocess.Popen(command, env=environment, stdout=subprocess.DEVNULL) for _ in range(count)
    ]
    if any([process.wait() for process in runs]):
        sys.exit(f"{command} failed")
    return time.monotonic() - start


def rooms(folder, keep):
    """The same photons in rooms of few and of many triangles."""
    photons = 4 * MILLION
    model = pathlib.Path(folder, "room.obj")
    command = RENDER + ["--scene", str(model), "--light", room.LIGHT]
    few = command + ["--count-only", "--photons"]
    # Lanes trace the first room. The tree of the second fits the caches.
    for edge in (2, 3, 177):
        name = f"room of {room.write(model, edge)} triangles"
        summary = json.loads(subprocess.check_output(few + ["1000000", "--json"]))
        # No photon leaves the room, and all of its hits but the first are stored.
        keep(f"{name}: rays a photon", [1 + summary["stored"] / summary["emitted"]])
        commands = [
            few + ["1"],
            few + [str(photons)],
            command + ["--photons", str(photons), "--out", folder],
        ]
        reading, *kinds = zip(*([run(command) for command in commands] for _ in range(5)))
        keep(f"{name}: read and build (s)", [seconds for _, seconds, _ in reading])
        for kind, runs in zip(("count only", "list and picture"), kinds):
            pairs = zip(runs, reading)
            a_photon = [1e9 * (run[1] - reading[1]) / photons for run, reading in pairs]
            keep(f"{name}: {kind} (ns a photon)", a_photon)
            keep(f"{name}: {kind} (MB)", [memory for *_, memory in runs])


def main():
    rows = []

    def keep(name, numbers):
        spread = [statistics.median(numbers), min(numbers), max(numbers)]
        rows.append([name, *(f"{number:.4g}" for number in spread), str(len(numbers))])
        print(",".join(rows[-1]))

    with tempfile.TemporaryDirectory() as folder:
        out = ["--out", folder]
        small = RENDER + ["--photons", "1000", *out]
        run(small)  # reads the program from disk
        keep("1000 photons (ms)", [1e3 * run(small)[0] for _ in range(41)])
        keep("1000000 photons (ms)", [1e3 * run(RENDER + out)[0] for _ in range(41)])
        count = RENDER + ["--count-only", "--photons"]
        ratios = []
        for _ in range(11):
            two_threads = run(count + [str(20 * MILLION)])[0]
            ratios.append(two_threads / together(count + [str(10 * MILLION)], 2))
        keep("2 threads beside two runs (ratio)", ratios)
        for photons in (10 * MILLION, 100 * MILLION):
            for name, command in [
                ("count only", count + [str(photons)]),
                ("list and picture", RENDER + ["--photons", str(photons), *out]),
            ]:
                _, seconds, memory = run(command)
                keep(f"{photons} photons: {name} (MB)", [memory])
                keep(f"{photons} photons: {name} (ns a photon)", [1e9 * seconds / photons])
            size = sum(file.stat().st_size for file in pathlib.Path(folder).iterdir())
            keep(f"{photons} photons: on disk (MB)", [size / 1e6])
        keep("the port (s)", [run(PORT, 1)[1] for _ in range(11)])
        rooms(folder, keep)
    lines = [",".join(row) for row in [["what", "median", "least", "greatest", "runs"], *rows]]
    results = pathlib.Path("crates/fast/benches/results/program.csv")
    results.write_text("\n".join(lines) + "\n")


main()
