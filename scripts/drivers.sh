#!/usr/bin/env bash
# Runs a command with drivers that need no GPU, beside those that `make test` has: SwiftShader, which is of another family than Mesa's, and Mesa's own under
# Khronos's validation layer, which has to say nothing. Both come with Chromium; on Debian and its kin they are installed where they are missing.
#
#     scripts/drivers.sh cargo test --package antumbra-cull --test counting
#
# Exit status: 0 the command passed with both; 1 it failed with one of them, or validation said something; 2 wrong usage; 3 the drivers are not there and cannot be installed.
set -euo pipefail

readonly PACKAGE=chromium-common
readonly FOLDER=/usr/lib/chromium
readonly SWIFTSHADER=$FOLDER/libvk_swiftshader.so
readonly VALIDATION=$FOLDER/libVkLayer_khronos_validation.so
# What naga writes and the layer objects to, and no driver known to us minds: layouts of variables in workgroups' and functions' memory, and a sample mask that is a number and not an array of one.
readonly MUTED=VUID-StandaloneSpirv-None-10684,VUID-SampleMask-SampleMask-04359

say() {
    echo "drivers.sh: $*"
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

see_to_drivers() {
    if [ -e "$SWIFTSHADER" ] && [ -e "$VALIDATION" ]; then return; fi
    command -v apt-get >/dev/null || fail "$SWIFTSHADER or $VALIDATION is missing, and there is no apt-get to install $PACKAGE"
    say "installing $PACKAGE"
    apt install -y --no-install-recommends "$PACKAGE" || { apt update && apt install -y --no-install-recommends "$PACKAGE"; } ||
        fail "apt-get could not install $PACKAGE: install it as root, then run this again"
    if ! { [ -e "$SWIFTSHADER" ] && [ -e "$VALIDATION" ]; }; then fail "$PACKAGE is installed, and $FOLDER lacks its drivers"; fi
}

# The package's own manifest names the library relative to a folder that the loader does not look in.
with_swiftshader() {
    say "SwiftShader: $*"
    cat >"$work/swiftshader.json" <<END
{"file_format_version": "1.0.0", "ICD": {"library_path": "$SWIFTSHADER", "api_version": "1.1.0"}}
END
    VK_DRIVER_FILES="$work/swiftshader.json" "$@"
}

# The layer writes to standard output, where a test's own words are held back unless it fails: so it writes to a file, which it opens anew for each of a program's instances. A pipe keeps
# what was said before.
with_validation() {
    local said="$work/said.txt" status=0
    say "validation: $*"
    mkdir "$work/layers"
    cat >"$work/layers/VkLayer_khronos_validation.json" <<END
{"file_format_version": "1.2.0", "layer": {"name": "VK_LAYER_KHRONOS_validation", "type": "GLOBAL", "library_path": "$VALIDATION",
 "api_version": "1.4.300", "implementation_version": "1", "description": "Khronos's validation layer"}}
END
    cat >"$work/vk_layer_settings.txt" <<END
khronos_validation.debug_action = VK_DBG_LAYER_ACTION_LOG_MSG
khronos_validation.report_flags = error,warn
khronos_validation.log_filename = $work/pipe
khronos_validation.message_id_filter = $MUTED
END
    mkfifo "$work/pipe"
    # Held open for writing too, so that it does not end with the first program.
    exec 9<>"$work/pipe"
    cat <&9 >"$said" &
    local reader=$!
    VK_LAYER_PATH="$work/layers" VK_INSTANCE_LAYERS=VK_LAYER_KHRONOS_validation VK_LAYER_SETTINGS_PATH="$work/vk_layer_settings.txt" \
        "$@" | tee "$work/output.txt" || status=$?
    sleep 1
    kill "$reader"
    wait "$reader" 2>/dev/null || true
    exec 9>&-
    # It says where it writes to.
    if ! grep -q "^Validation Layer Info" "$work/output.txt"; then
        say "the validation layer was not loaded" >&2
        status=1
    fi
    if [ -s "$said" ]; then
        say "validation says:" >&2
        head -c 20000 "$said" >&2
        status=1
    fi
    return "$status"
}

if [ $# -eq 0 ]; then
    echo "usage: scripts/drivers.sh COMMAND..." >&2
    exit 2
fi
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
see_to_drivers
failed=0
with_swiftshader "$@" || failed=1
with_validation "$@" || failed=1
exit "$failed"
