#!/usr/bin/env bash
# Puts every shader, pipeline and strategy through Chromium's WebGPU in a page without a window, does the same without a browser on the same rasteriser, SwiftShader, and compares what both
# report. See crates/web and docs/real-gpus.md.
#
# It installs what it lacks: Debian's chromium, the Rust target of browsers (by rustup), and wasm-bindgen of the version in Cargo.lock, which stays in target/web-tools.
# Exit status: 0 both report the same; 1 they do not, or it failed; 3 what it needs is not there and cannot be installed.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

readonly TARGET=wasm32-unknown-unknown
readonly FOLDER=target/web
readonly SWIFTSHADER=/usr/lib/chromium/libvk_swiftshader.so
# Until the page must have reported.
readonly SECONDS_OF_A_PAGE=${SECONDS_OF_A_PAGE:-600}
CARGO="${CARGO:-cargo}"
export NODEVICE_SELECT="${NODEVICE_SELECT:-1}"

say() {
    echo "web.sh: ${SECONDS} s: $*"
}

fail() {
    say "$1" >&2
    exit 3
}

# apt ARGUMENT...: what apt-get says matters only where it fails, which the caller says.
apt() {
    local root=()
    if [ "$(id -u)" -ne 0 ]; then root=(sudo -n); fi
    "${root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -qq -o DPkg::Lock::Timeout=120 "$@" >/dev/null 2>&1
}

see_to_browser() {
    if command -v chromium >/dev/null && [ -e "$SWIFTSHADER" ]; then return; fi
    command -v apt-get >/dev/null || fail "chromium is missing, and there is no apt-get to install it"
    say "installing chromium"
    apt install -y --no-install-recommends chromium || { apt update && apt install -y --no-install-recommends chromium; } ||
        fail "apt-get could not install chromium: install it as root, then run this again"
}

see_to_target() {
    if [ -d "$(rustc --print sysroot)/lib/rustlib/$TARGET" ]; then return; fi
    say "adding the target $TARGET"
    rustup target add "$TARGET" >/dev/null 2>&1 || fail "rustup could not add $TARGET"
}

# The glue between a page and a program must be of the version that the program was compiled with.
see_to_glue() {
    local version
    version=$(sed -n '/^name = "wasm-bindgen"$/{n;s/version = "\(.*\)"/\1/p}' Cargo.lock)
    readonly GLUE=target/web-tools/bin/wasm-bindgen
    if [ "$("$GLUE" --version 2>/dev/null)" = "wasm-bindgen $version" ]; then return; fi
    say "compiling wasm-bindgen $version"
    # Its own lock file names a version that was withdrawn. Without optimisation it is there in a third of the time.
    "$CARGO" install -q --debug wasm-bindgen-cli --version "$version" --root target/web-tools --force ||
        fail "wasm-bindgen-cli $version could not be compiled"
}

page() {
    local server browser status=0
    rm -rf "$FOLDER"
    mkdir -p "$FOLDER"
    "$GLUE" --target web --no-typescript --out-dir "$FOLDER" "target/$TARGET/debug/antumbra-web.wasm"
    cp crates/web/index.html "$FOLDER"
    timeout "$SECONDS_OF_A_PAGE" python3 scripts/web_server.py "$FOLDER" "$work/port" "$work/page.json" >"$work/progress" &
    server=$!
    while [ ! -s "$work/port" ]; do sleep 0.1; done
    mkdir "$work/profile"
    chromium --headless --no-sandbox --disable-quic --no-first-run --disable-background-networking --disable-component-update --disable-sync \
        --user-data-dir="$work/profile" --enable-unsafe-webgpu --use-webgpu-adapter=swiftshader --enable-logging=stderr \
        "http://127.0.0.1:$(cat "$work/port")/index.html" >"$work/chromium" 2>&1 &
    browser=$!
    wait "$server" || status=$?
    kill "$browser" 2>/dev/null || true
    wait "$browser" 2>/dev/null || true
    if [ "$status" -ne 0 ]; then
        say "the page failed; it was at: $(tail -1 "$work/progress")" >&2
        head -c 4000 "$work/page.json" 2>/dev/null >&2 || true
        grep -E "CONSOLE|GPU" "$work/chromium" | tail -20 >&2 || true
        return 1
    fi
}

natively() {
    cat >"$work/swiftshader.json" <<END
{"file_format_version": "1.0.0", "ICD": {"library_path": "$SWIFTSHADER", "api_version": "1.1.0"}}
END
    VK_DRIVER_FILES="$work/swiftshader.json" target/debug/antumbra-web SwiftShader >"$work/native.json" 2>"$work/native" || {
        tail -20 "$work/native" >&2
        return 1
    }
}

# What was started and still runs is ended, too: a browser writes into its folder to the last.
finish() {
    local running
    running=$(jobs -p)
    # shellcheck disable=SC2086 # Numbers, of which there may be none.
    if [ -n "$running" ]; then kill $running 2>/dev/null || true; fi
    wait 2>/dev/null || true
    rm -rf "$work" || true
}

work=$(mktemp -d)
trap finish EXIT
see_to_browser
see_to_target
see_to_glue
say "compiling"
"$CARGO" build -q --locked -p antumbra-web --target "$TARGET"
# With the features of the tests, which are compiled already where those have run. A test of a program compiles the program.
"$CARGO" test -q --workspace --locked --no-run --test without_browser
say "in a page, and without a browser beside it"
natively &
beside=$!
page
say "$(stat -c %s "$FOLDER/antumbra-web_bg.wasm") bytes of WebAssembly"
wait "$beside"
say "comparing"
python3 scripts/web_compare.py "$work/page.json" "$work/native.json"
say "both report the same"
