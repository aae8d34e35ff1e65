#!/usr/bin/env bash
# Lints the prose of the pages with proselint: `bash .ci/prose.sh`. Blocks of code are left out.
# `.ci/prose-exceptions` excuses findings: a part of their line, a tab, and the reason.
set -euo pipefail
root=$(cd "$(dirname "$0")/.." && pwd)
cd "$root"
skip() { echo "SKIPPED: $*"; exit 0; }
environment=target/proselint
if [ ! -x "$environment/bin/proselint" ]; then
    command -v python3 >/dev/null || skip "no python3 to install proselint"
    python3 -m venv "$environment" >/dev/null 2>&1 || skip "python3 has no venv with pip"
    "$environment/bin/pip" install --quiet proselint==0.16.0 || skip "proselint could not be installed"
fi
copy=$(mktemp -d)
trap 'rm -rf "$copy"' EXIT
git ls-files '*.md' ':!golden' | while read -r page; do
    mkdir -p "$copy/$(dirname "$page")"
    # Empty lines stand for code, so that numbers of lines stay.
    awk '/^```/ { code = !code; print ""; next } { print code ? "" : $0 }' "$page" >"$copy/$page"
done
findings=$(cd "$copy" && find . -name '*.md' -print0 | sort -z |
    xargs -0 "$root/$environment/bin/proselint" check 2>&1 | sed "s|^$copy/||; s|^\./||" |
    sed 's/\x1b\[[0-9;]*m//g' | grep -E '^[^ ]+\.md:[0-9]+' |
    grep -vFf <(grep -v '^#' "$root/.ci/prose-exceptions" | cut -f1)) || true
if [ -n "$findings" ]; then
    echo "$findings"
    exit 1
fi
echo "no findings"
