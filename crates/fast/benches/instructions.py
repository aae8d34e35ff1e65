#!/usr/bin/env python3
"""Counts the instructions of a photon under qemu, for processors that are not at hand.

Keeps them in results/instructions.csv. Run it from the root of a clone, on Debian for x86-64 with
the packages of .ci/run for aarch64, and a C compiler.
"""
import os
import pathlib
import subprocess

BENCHES = pathlib.Path("crates/fast/benches")
PLUGIN = "target/instructions.so"
EXAMPLE = ["-p", "photon-mapping-fast", "--example", "trace_photons"]
ARM = "aarch64-unknown-linux-gnu"
# Whole pieces.
PHOTONS = 8 * 16384


def executed(emulator, program, how, photons):
    command = [*emulator, "-plugin", PLUGIN, program, how, str(photons)]
    run = subprocess.run(command, check=True, capture_output=True, text=True)
    return int(run.stderr)


def main():
    source = str(BENCHES / "instructions.c")
    subprocess.run(["cc", "-O2", "-shared", "-fPIC", source, "-o", PLUGIN], check=True)
    build = ["cargo", "build", "--release", *EXAMPLE]
    subprocess.run(build, check=True)
    environment = dict(os.environ, RUSTC="/usr/bin/rustc")
    environment["CARGO_TARGET_AARCH64_UNKNOWN_LINUX_GNU_LINKER"] = "aarch64-linux-gnu-gcc"
    for_arm = ["--target", ARM, "--target-dir", "target/aarch64"]
    subprocess.run(build + for_arm, env=environment, check=True)
    lines = ["what,instructions a photon"]
    for name, emulator, folder, widths in [
        ("x86-64", ["qemu-x86_64", "-cpu", "max"], "target", ["port", "Baseline", "Avx2"]),
        (
            "aarch64",
            ["qemu-aarch64", "-L", "/usr/aarch64-linux-gnu"],
            f"target/aarch64/{ARM}",
            ["port", "Baseline"],
        ),
    ]:
        program = f"{folder}/release/examples/trace_photons"
        for how in widths:
            once, twice = (executed(emulator, program, how, n * PHOTONS) for n in (1, 2))
            # What it takes to start is in both.
            lines.append(f"{name} {how},{(twice - once) / PHOTONS:.1f}")
            print(lines[-1])
    (BENCHES / "results/instructions.csv").write_text("\n".join(lines) + "\n")


main()
