#!/usr/bin/env bash
# Runs cargo for crates/bevy, a workspace of its own, with a Rust that compiles Bevy 0.20: `scripts/bevy.sh test --locked`. Without arguments it says which.
# Bevy asks for Rust 1.97.1. A nightly of 1.97 compiles it as well, and is told not to mind.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../crates/bevy"

# minor TOOLCHAIN: the second number of its version, 0 where it is not installed.
minor() {
    rustc "$@" --version 2>/dev/null | sed -n 's/^rustc 1\.\([0-9]*\)\..*/\1/p' || true
}

toolchain=""
for candidate in "" "+stable" "+nightly"; do
    # A word each, or none.
    # shellcheck disable=SC2086
    version=$(minor $candidate)
    if [ "${version:-0}" -ge 97 ]; then
        toolchain="cargo${candidate:+ $candidate}"
        break
    fi
done

if [ -z "$toolchain" ]; then
    echo "crates/bevy: skipped. Bevy 0.20 needs Rust 1.97, and none is installed: rustup toolchain install nightly" >&2
    exit 3
fi
if [ $# -eq 0 ]; then
    echo "crates/bevy is compiled by: $toolchain ($(rustc ${toolchain#cargo} --version))"
    exit 0
fi
verb=$1
shift
exec $toolchain "$verb" --ignore-rust-version "$@"
