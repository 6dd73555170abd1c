#!/usr/bin/env bash
# Sees to a Vulkan adapter, and does something only where none is found: on Debian and its kin it installs Mesa's drivers,
# lavapipe (Vulkan on the CPU) among them. With --with-egl it sees to EGL and Mesa's software OpenGL as well, for the tests
# that run on a second backend. Builds nothing, asks nothing, and says in one line what it did.
#
# Exit status: 0 there is an adapter, or this system is left to its owner; 1 there is none and none could be installed; 2 wrong usage.
set -euo pipefail

readonly VULKAN_PACKAGES=(libvulkan1 mesa-vulkan-drivers)
readonly EGL_PACKAGES=(libegl1 libgles2 libgl1-mesa-dri)

usage() {
    echo "usage: scripts/vulkan.sh [--with-egl]"
}

say() {
    echo "vulkan.sh: $*"
}

fail() {
    say "$*" >&2
    exit 1
}

# --- what is on this machine ---------------------------------------------------------------------------------------------------

# The loader's cache, one line a library. ldconfig lies in /sbin, which an ordinary user may not have on the PATH.
cached_libraries() {
    PATH="$PATH:/usr/sbin:/sbin" ldconfig -p 2>/dev/null || true
}

# The folders a library may lie in when the cache does not know it (NixOS, musl, a LD_LIBRARY_PATH).
library_folders() {
    tr ':' '\n' <<<"${LD_LIBRARY_PATH:-}"
    printf '%s\n' /usr/lib /usr/lib64 /lib /lib64 /usr/local/lib /usr/lib/*-linux-* /usr/local/lib/*-linux-* /run/opengl-driver/lib
}

# has_library NAME: can a program load NAME by its bare name?
has_library() {
    local folder
    case "$(cached_libraries)" in
    *"$1"*) return 0 ;;
    esac
    while IFS= read -r folder; do
        if [ -n "$folder" ] && [ -e "$folder/$1" ]; then return 0; fi
    done <<<"$(library_folders)"
    return 1
}

# The folders and files in which the Vulkan loader looks for drivers, in its own order; VK_DRIVER_FILES replaces them all.
driver_manifests() {
    local place
    while IFS= read -r place; do
        if [ -d "$place" ]; then
            for place in "$place"/*.json; do
                if [ -r "$place" ]; then echo "$place"; fi
            done
        elif [ -n "$place" ] && [ -r "$place" ]; then
            echo "$place"
        fi
    done <<<"$(driver_places)"
}

driver_places() {
    local chosen="${VK_DRIVER_FILES:-${VK_ICD_FILENAMES:-}}" base
    if [ -n "$chosen" ]; then
        tr ':' '\n' <<<"$chosen"
        return
    fi
    tr ':' '\n' <<<"${VK_ADD_DRIVER_FILES:-}"
    {
        tr ':' '\n' <<<"${XDG_CONFIG_HOME:-${HOME:-}/.config}"
        tr ':' '\n' <<<"${XDG_CONFIG_DIRS:-/etc/xdg}"
        printf '%s\n' /usr/local/etc /etc
        tr ':' '\n' <<<"${XDG_DATA_HOME:-${HOME:-}/.local/share}"
        tr ':' '\n' <<<"${XDG_DATA_DIRS:-/usr/local/share:/usr/share}"
        printf '%s\n' /usr/local/share /usr/share /run/opengl-driver/share
    } | while IFS= read -r base; do
        if [ -n "$base" ]; then echo "$base/vulkan/icd.d"; fi
    done
}

# driver_loads MANIFEST: does the library that the manifest names exist?
driver_loads() {
    local library
    library=$(sed -n 's/.*"library_path"[[:space:]]*:[[:space:]]*"\([^"]*\)".*/\1/p' "$1" | sed -n 1p)
    case "$library" in
    '') return 1 ;;
    /*) [ -e "$library" ] ;;
    */*) [ -e "$(dirname "$1")/$library" ] ;;
    *) has_library "$library" ;;
    esac
}

# driver_has_device MANIFEST: a driver that draws on the CPU always has one; any other needs a graphics device it may open.
driver_has_device() {
    local device
    case "$(basename "$1")" in
    *lvp* | *lavapipe* | *swiftshader*) return 0 ;;
    esac
    for device in /dev/dri/renderD* /dev/nvidiactl /dev/dxg /dev/kgsl-3d0 /dev/mali0; do
        if [ -r "$device" ]; then return 0; fi
    done
    return 1
}

# Prints the manifest of the first driver that would answer; fails where there is none, or no loader.
vulkan_driver() {
    local manifest
    has_library libvulkan.so.1 || return 1
    while IFS= read -r manifest; do
        if [ -n "$manifest" ] && driver_loads "$manifest" && driver_has_device "$manifest"; then
            echo "$manifest"
            return 0
        fi
    done <<<"$(driver_manifests)"
    return 1
}

has_egl() {
    local driver
    has_library libEGL.so.1 && has_library libGLESv2.so.2 && has_library libEGL_mesa.so.0 || return 1
    for driver in /usr/lib/*-linux-*/dri /usr/lib/dri /usr/lib64/dri /run/opengl-driver/lib/dri; do
        if [ -e "$driver/swrast_dri.so" ]; then return 0; fi
    done
    return 1
}

# --- installing ----------------------------------------------------------------------------------------------------------------

# as_root COMMAND...: a password is asked only of somebody at a terminal.
as_root() {
    if [ "$(id -u)" -eq 0 ]; then
        "$@"
    elif [ -t 0 ]; then
        sudo "$@"
    else
        sudo -n "$@"
    fi
}

# apt ARGUMENT...: what apt-get says matters only where it fails.
apt() {
    local output
    output=$(as_root env DEBIAN_FRONTEND=noninteractive apt-get -qq -o DPkg::Lock::Timeout=120 -o Dpkg::Use-Pty=0 "$@" 2>&1) || {
        printf '%s\n' "$output" >&2
        return 1
    }
}

known_to_apt() {
    local package
    for package in "$@"; do
        [ -n "$(apt-cache show --no-all-versions "$package" 2>/dev/null)" ] || return 1
    done
}

# apt_install PACKAGE...: package lists that are missing or out of date are fetched first, and only then. A source of packages that
# cannot be reached need not be the one that has ours, so a failed update is said and no reason to stop.
apt_install() {
    if [ "$(id -u)" -ne 0 ] && ! command -v sudo >/dev/null; then
        say "installing needs root, and there is no sudo" >&2
        return 1
    fi
    if known_to_apt "$@" && apt install -y --no-install-recommends "$@" 2>/dev/null; then return 0; fi
    apt update || true
    apt install -y --no-install-recommends "$@"
}

see_to_vulkan() {
    local driver
    if driver=$(vulkan_driver); then
        say "Vulkan is there ($driver); nothing to do"
        return
    fi
    if [ -n "${VK_DRIVER_FILES:-${VK_ICD_FILENAMES:-}}" ] && has_library libvulkan.so.1; then
        fail "VK_DRIVER_FILES or VK_ICD_FILENAMES names no driver that is there: correct the variable, or unset it"
    fi
    if ! command -v apt-get >/dev/null; then
        say "no Vulkan adapter found, and no apt-get to install one. Install the Vulkan loader and Mesa's lavapipe by this system's own means" \
            "(Fedora: vulkan-loader mesa-vulkan-drivers; Arch: vulkan-icd-loader vulkan-swrast; Alpine: vulkan-loader mesa-vulkan-swrast;" \
            "openSUSE: libvulkan1 libvulkan_lvp; NixOS: hardware.graphics.enable)" >&2
        exit 1
    fi
    say "no Vulkan adapter found: installing ${VULKAN_PACKAGES[*]}"
    apt_install "${VULKAN_PACKAGES[@]}" ||
        fail "apt-get could not install ${VULKAN_PACKAGES[*]} (see above): install them as root, then run this again"
    driver=$(vulkan_driver) ||
        fail "${VULKAN_PACKAGES[*]} are installed, and still no driver manifest names a library that is there: run 'vulkaninfo --summary' to see why"
    say "Vulkan is there now ($driver)"
}

# The second backend is wanted, not needed: what cannot be installed is said, and the tests on it stay out.
see_to_egl() {
    if has_egl; then
        return
    fi
    if ! command -v apt-get >/dev/null; then
        say "no software OpenGL found: for the tests on that backend install Mesa's EGL, OpenGL ES and DRI drivers; going on without" >&2
        return
    fi
    say "no software OpenGL found: installing ${EGL_PACKAGES[*]}"
    apt_install "${EGL_PACKAGES[@]}" ||
        say "apt-get could not install ${EGL_PACKAGES[*]} (see above); going on without" >&2
}

main() {
    local with_egl=no
    case "${1:-}" in
    '') ;;
    --with-egl) with_egl=yes ;;
    -h | --help)
        usage
        exit 0
        ;;
    *)
        usage >&2
        exit 2
        ;;
    esac
    case "$(uname -s)" in
    Linux) ;;
    *)
        say "$(uname -s) brings its own graphics interface; nothing to do"
        exit 0
        ;;
    esac
    see_to_vulkan
    if [ "$with_egl" = yes ]; then see_to_egl; fi
}

main "$@"
