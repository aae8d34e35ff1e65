#!/bin/sh
# Times Mitsuba's photon loop, Embree's closest hit and ours in turn, and prints the ratios.
# Needs Python 3.9 or newer on Linux and, the first time, PyPI. Arguments go to compare.py, see
# --help. DRJIT_LIBLLVM_PATH names another LLVM for Mitsuba; it must be 19 or newer.
set -eu
cd "$(dirname "$0")/../../../.."
peers=crates/fast/benches/peers
environment=${PEERS_ENVIRONMENT:-target/peers}
if ! cmp -s "$peers/requirements.txt" "$environment/requirements.txt"; then
    python3 -m venv "$environment"
    "$environment/bin/pip" install --quiet -r "$peers/requirements.txt"
    cp "$peers/requirements.txt" "$environment/requirements.txt"
fi
if [ -z "${DRJIT_LIBLLVM_PATH:-}" ]; then
    DRJIT_LIBLLVM_PATH=$(find "$(realpath "$environment")/lib" -name 'libLLVM.*' | sort | tail -1)
    export DRJIT_LIBLLVM_PATH
fi
ours=$(cargo bench -p photon-mapping-fast --bench peers --no-run --message-format=json |
    "$environment/bin/python" -c '
import json, sys
messages = [json.loads(line) for line in sys.stdin]
print([m["executable"] for m in messages if m.get("target", {}).get("name") == "peers"][-1])')
kept=crates/fast/benches/results/peers.txt
"$environment/bin/python" "$peers/compare.py" --ours "$ours" "$@" >"$kept.new"
mv "$kept.new" "$kept"
cat "$kept"
