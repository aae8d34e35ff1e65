#!/bin/sh
# Times Mitsuba's photon loop, Embree's closest hit and ours in turn, and prints the ratios.
# Needs Python 3.9 or newer and, the first time, PyPI. Arguments go to compare.py, see --help.
set -eu
cd "$(dirname "$0")/../../../.."
environment=${PEERS_ENVIRONMENT:-target/peers}
if [ ! -x "$environment/bin/python" ]; then
    python3 -m venv "$environment"
fi
"$environment/bin/python" -c 'import mitsuba, embreex, numpy' 2>/dev/null ||
    "$environment/bin/pip" install --quiet -r crates/fast/benches/peers/requirements.txt
ours=$(cargo bench -p photon-mapping-fast --bench peers --no-run --message-format=json |
    "$environment/bin/python" -c '
import json, sys
messages = [json.loads(line) for line in sys.stdin]
print([m["executable"] for m in messages if m.get("target", {}).get("name") == "peers"][-1])')
exec "$environment/bin/python" crates/fast/benches/peers/compare.py --ours "$ours" "$@"
