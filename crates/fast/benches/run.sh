#!/bin/sh
# Measures everything that docs/speed.md shows, and keeps it in results/. Needs what peers/run.sh
# and instructions.py need. On a busy machine: chrt -f 10 crates/fast/benches/run.sh
set -eu
cd "$(dirname "$0")/../../.."
benches=crates/fast/benches
cargo build --release -p photon-mapping-toolkit
cargo build --release --example golden_check
cargo bench -p photon-mapping-fast --bench stages >"$benches/results/stages.txt.new"
mv "$benches/results/stages.txt.new" "$benches/results/stages.txt"
python3 "$benches/program.py"
"$benches/peers/run.sh"
python3 "$benches/instructions.py"
