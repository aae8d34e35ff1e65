#!/usr/bin/env bash
# Breaks one line of the port at a time, as tests/mutations.txt says, and demands that the tests named
# there fail, and no test of another section. Works on a copy; the tree stays as it is.
set -euo pipefail
root=$(cd "$(dirname "$0")/.." && pwd)
copy=$(mktemp -d)
trap 'rm -rf "$copy"' EXIT
export CARGO_TARGET_DIR="$root/target/mutations"

cp -r "$root"/{Cargo.lock,build.rs,src,tests,golden} "$copy"
# The root package alone: no workspace members.
sed 's/^members = .*/members = []/; /path = "crates\//d' "$root/Cargo.toml" >"$copy/Cargo.toml"
mkdir -p "$copy/examples"

trim() { sed 's/^ //; s/ $//' <<<"$1"; }
survivors=0 mutations=0
while IFS='|' read -r file from to test_file tests; do
    file=$(trim "$file") from=$(trim "$from") to=$(trim "$to") test_file=$(trim "$test_file")
    mutations=$((mutations + 1))
    original=$(<"$root/$file")
    if [[ $original != *"$from"* ]]; then
        echo "$file: expected '$from', found no such text" >&2
        exit 1
    fi
    # The tests of the whole take long, and fail whatever is broken.
    modules="emission storage roulette hemisphere transformation"
    [[ $test_file != whole ]] || modules=whole
    printf 'mod %s;\n' common $modules >"$copy/tests/assignment.rs"
    printf '%s\n' "${original/"$from"/"$to"}" >"$copy/$file"
    output=$(cd "$copy" && cargo test --quiet --profile dev --test assignment 2>&1 </dev/null) || true
    if grep -q '^error' <<<"$output" && ! grep -q '^test result' <<<"$output"; then
        echo "$file: '$to' does not compile" >&2
        echo "$output" >&2
        exit 1
    fi
    for test in $tests; do
        if ! grep -q "^    $test_file::$test\$" <<<"$output"; then
            echo "SURVIVED: $file: '$from' -> '$to': $test did not fail" >&2
            survivors=$((survivors + 1))
        fi
    done
    others=$(sed -n 's/^    \([a-z]*::[a-z0-9_]*\)$/\1/p' <<<"$output" | grep -v "^$test_file::" | sort -u) || true
    if [[ -n $others ]]; then
        echo "ANOTHER SECTION: $file: '$from' -> '$to': failed:" $others >&2
        survivors=$((survivors + 1))
    fi
    printf '%s\n' "$original" >"$copy/$file"
done < <(grep -v '^#' "$root/tests/mutations.txt")
echo "$mutations mutations, $survivors survivors"
((survivors == 0))
