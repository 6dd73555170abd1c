#!/usr/bin/env bash
# Checks what the facade promises of its features: each compiles alone and all together, without a warning; without any there is no C++
# dependency, no file loader and no command line; and a program outside the workspace builds without a C++ compiler, and runs.
#
# Exit status: 0 all of it holds; 1 something does not, and the last line says what.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

# As in the Makefile: Mesa complains where there is no desktop.
export NODEVICE_SELECT="${NODEVICE_SELECT:-1}"

# What is done, and the seconds since the start.
say() {
    echo "features.sh: ${SECONDS} s: $*"
}

fail() {
    say "$*" >&2
    exit 1
}

# The features, from the manifest: the keys of its table [features], without the default.
features() {
    sed -n '/^\[features\]$/,/^\[/s/^\([a-z-]*\) = .*/\1/p' Cargo.toml | grep -v '^default$'
}

# crates FEATURES: the names of all crates that are compiled for the facade with these features alone.
crates() {
    cargo tree --locked -p antumbra --no-default-features --features "$1" -e normal,build --prefix none | awk '{ print $1 }' | sort -u
}

# lacks FEATURES CRATE...: none of these crates is compiled.
lacks() {
    local with="$1" found crate
    shift
    found=$(crates "$with")
    for crate in "$@"; do
        if grep -qx "$crate" <<<"$found"; then
            fail "the facade with the features '$with' compiles $crate: cargo tree -p antumbra --no-default-features --features '$with' -e normal,build -i $crate"
        fi
    done
}

readonly CPP=(cc cmake cxx meshopt nv-flip nv-flip-sys)
readonly FILES=(antumbra-formats gltf tobj ply-rs-bw stl_io tiff zip image png)
readonly PROGRAM=(clap indicatif tracing-subscriber antumbra-cli)

say "what is compiled"
lacks "" antumbra-draw antumbra-strategies "${CPP[@]}" "${FILES[@]}" "${PROGRAM[@]}"
lacks "strategies,draw" "${CPP[@]}" "${FILES[@]}" "${PROGRAM[@]}"
lacks "formats,terrain" "${CPP[@]}" "${PROGRAM[@]}"

# Clippy, since it makes errors of warnings in this workspace's crates alone, and shares with `make lint` what is compiled.
check() {
    say "$1"
    shift
    cargo clippy --locked -q "$@" -- -D warnings
}

check "no feature" -p antumbra --no-default-features
check "no feature, with the examples and tests that need none" -p antumbra --no-default-features --all-targets
for feature in $(features); do
    check "the feature $feature alone" -p antumbra --no-default-features --features "$feature"
done
check "all features, with examples and tests" -p antumbra --all-features --all-targets
for crate in antumbra-scene antumbra-terrain antumbra-subsurface; do
    check "$crate without its features" -p "$crate" --no-default-features
done

# With all features it is a step of its own.
say "documentation without features, with the default ones"
for features in --no-default-features ""; do
    RUSTDOCFLAGS=-Dwarnings cargo doc --locked -q -p antumbra --no-deps ${features:+"$features"}
done

say "a program outside the workspace, without a C++ compiler"
minimal="${CARGO_TARGET_DIR:-$PWD/target}/minimal"
CARGO_PROFILE_DEV_DEBUG=none CC=/bin/false CXX=/bin/false cargo build --locked -q --manifest-path examples/minimal/Cargo.toml --target-dir "$minimal"
minimal="$minimal/debug/antumbra-minimal"
if outcome=$("$minimal" 2>&1); then
    grep -qE '^4 of 41 balls are drawn$' <<<"$outcome" || fail "the program prints: $outcome"
    say "it runs: $outcome"
elif grep -q "no adapter" <<<"$outcome"; then
    say "it builds; there is no Vulkan adapter to run it on"
else
    fail "the program fails: $outcome"
fi
say "all of it holds"
