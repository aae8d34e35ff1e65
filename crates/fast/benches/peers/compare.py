"""Times the peers and ours in turn and prints the ratios, ours to theirs, with their spread.

What runs on one thread is timed by the processor's time, which other programs on the machine disturb
less; what runs on more, by the clock.
"""

import argparse
import os
import platform
import statistics
import subprocess
import sys
import tempfile
import time

import numpy as np

sys.path.insert(0, os.path.dirname(__file__))


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--ours", required=True, help="the program of benches/peers.rs")
    parser.add_argument("--rounds", type=int, default=7)
    parser.add_argument("--photons", type=int, default=4_000_000)
    parser.add_argument("--triangles", type=int, nargs="+", default=[5_000, 60_000, 1_000_000])
    parser.add_argument("--rays", type=int, default=500_000)
    arguments = parser.parse_args()
    print(f"{time.strftime('%Y-%m-%d')}, {platform.machine()}, {processor()}, {os.cpu_count()} cores")
    print(f"median [least .. greatest] of {arguments.rounds} rounds")
    photons(arguments)
    for triangles in arguments.triangles:
        builds = mesh(arguments, triangles)
    report("its build", "s", "Embree", builds)


def processor():
    try:
        names = [line for line in open("/proc/cpuinfo") if line.startswith("model name")]
        return names[0].split(":")[1].strip()
    except (OSError, IndexError):
        return platform.processor() or "unknown processor"


def ours(arguments, *words):
    run = subprocess.run(
        [arguments.ours, *map(str, words)], capture_output=True, text=True, check=True
    )
    return [float(word) for word in run.stdout.split()]


def photons(arguments):
    import drjit as dr
    import mitsuba_photons

    scene = mitsuba_photons.load()
    count = arguments.photons

    def theirs(seed, clock=time.perf_counter):
        start = clock()
        stored = mitsuba_photons.trace(*scene, count, seed)
        dr.eval(stored)
        dr.sync_thread()
        return (clock() - start) / count * 1e9, int(stored[0])

    for threads in dict.fromkeys([1, os.cpu_count()]):
        dr.set_thread_count(threads)
        clock = time.process_time if threads == 1 else time.perf_counter
        # The first two runs compile and load.
        theirs(1), theirs(2)
        rounds = []
        for number in range(arguments.rounds):
            time_theirs, stored_theirs = theirs(3 + number, clock)
            # Their threads look for more work for a while before they sleep.
            time.sleep(0.3)
            time_ours, stored_ours = ours(arguments, "photons", count, threads)
            assert abs(stored_theirs - stored_ours) < 10 * (2 * count * 0.0502) ** 0.5, (
                stored_theirs,
                stored_ours,
            )
            rounds.append((time_ours, time_theirs))
        report(f"photon, {threads} thread(s)", "ns", "Mitsuba", rounds)


def mesh(arguments, triangles):
    import embree_mesh

    corners, origins, directions = embree_mesh.mesh_and_rays(triangles, arguments.rays)
    embree = embree_mesh.Embree(corners)
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "mesh")
        with open(path, "wb") as file:
            np.array([len(corners), len(origins)], np.uint64).tofile(file)
            corners.tofile(file)
            origins.tofile(file)
            directions.tofile(file)
        rounds, builds = [], []
        for _ in range(arguments.rounds):
            time_theirs, hits = embree.closest(origins, directions)
            build, time_ours, found = ours(arguments, "mesh", path)
            # Their test is not watertight in the same way: a few rays along edges may differ.
            assert abs(found - np.count_nonzero(hits >= 0)) <= 1e-4 * len(origins)
            rounds.append((time_ours, time_theirs * 1e9))
            builds.append((build, embree.build_seconds))
    report(f"closest hit, {len(corners)} triangles", "ns", "Embree", rounds)
    return builds


def report(what, unit, peer, rounds):
    def spread(values):
        return f"{statistics.median(values):.3g} [{min(values):.3g} .. {max(values):.3g}]"

    mine, theirs = zip(*rounds)
    ratios = [a / b for a, b in rounds]
    print(f"{what}: ours {spread(mine)} {unit}, {peer} {spread(theirs)} {unit}, ratio {spread(ratios)}")


if __name__ == "__main__":
    main()
