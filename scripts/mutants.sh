#!/usr/bin/env bash
# Shows that each safety is needed: takes them away one at a time and runs the test that has to fail. A mutation that survives has no test.
#
#     scripts/mutants.sh              all mutations of scripts/mutants.list
#     scripts/mutants.sh WORD...      those whose names contain one of these texts
#     scripts/mutants.sh --table      the table of docs/mutants.md
#
# All of them are built at once, into a copy of the tree: an expression in Rust becomes a choice that an environment variable makes, and a piece of WGSL is replaced when its module is made. So
# there is one build, and a mutation costs its test.
#
# Exit status: 0 every mutation was killed; 1 one survived, or its test ran out of time; 2 wrong usage; 3 a mutation does not apply, the copy does not build, or a test fails without a mutation.
set -euo pipefail

root=$(cd "$(dirname "$0")/.." && pwd)
readonly root
readonly list=$root/scripts/mutants.list
readonly work=$root/target/mutants
readonly tree=$work/tree
# A target folder of its own: artefacts are named by their place in the workspace, so those of the copy would be taken for the tree's.
export CARGO_TARGET_DIR=$work/target CARGO_TERM_COLOR=never
# What a test says matters, and not from where.
export RUST_BACKTRACE=0
# Seconds that a test may take. A mutation that makes it take longer counts as one that survives.
readonly patience=${MUTANTS_PATIENCE:-600}

say() {
    echo "mutants.sh: $*"
}

fail() {
    say "$1" >&2
    exit 3
}

names=() reasons=() files=() olds=() news=() tests=()
read_list() {
    local line key value at=-1 number=0
    while IFS= read -r line || [ -n "$line" ]; do
        number=$((number + 1))
        case $line in '' | '#'*) continue ;; esac
        key=${line%%:*} value=${line#*:}
        value=${value# }
        case $key in
        mutation) at=$((at + 1)) names[at]=$value reasons[at]='' files[at]='' olds[at]='' news[at]='' tests[at]='' ;;
        why) reasons[at]=$value ;;
        file) files[at]=$value ;;
        old) olds[at]=$value ;;
        new) news[at]=$value ;;
        test) tests[at]=$value ;;
        *) fail "$list:$number: no such key: $key" ;;
        esac
    done <"$list"
    for at in "${!names[@]}"; do
        if [ -z "${files[at]}" ] || [ -z "${olds[at]}" ] || [ -z "${tests[at]}" ]; then fail "${names[at]}: file, old or test is missing"; fi
    done
}

table() {
    local at
    echo '| taken away or made wrong | why it must not be | where | killed by |'
    echo '|---|---|---|---|'
    for at in "${!names[@]}"; do
        echo "| ${names[at]} | ${reasons[at]} | \`${files[at]}\` | \`${tests[at]}\` |"
    done
}

# replaced FILE OLD NEW: its text with the one place replaced.
replaced() {
    local text rest
    text=$(<"$1")
    rest=${text/"$2"/}
    if [ "$text" = "$rest" ]; then fail "$1 has no such place: $2"; fi
    if [[ $rest == *"$2"* ]]; then fail "$1 has several such places: $2"; fi
    printf '%s\n' "${text/"$2"/"$3"}"
}

# Puts all mutations into a new copy, and then what differs into the one that is built, so that cargo builds no more than that.
make_tree() {
    local fresh=$work/fresh at file choice
    rm -rf "$fresh"
    mkdir -p "$fresh" "$tree"
    cd "$root"
    git ls-files -z --cached --others --exclude-standard | while IFS= read -r -d '' file; do
        if [ -f "$file" ]; then cp --parents "$file" "$fresh"; fi
    done
    for at in "${!names[@]}"; do
        file=$fresh/${files[at]}
        if [[ $file == *.wgsl ]]; then
            replaced "$file" "${olds[at]}" "${news[at]}" >/dev/null
            continue
        fi
        choice="(if { static IS: ::std::sync::LazyLock<bool> = ::std::sync::LazyLock::new(|| ::std::env::var(\"MUTANT\").is_ok_and(|name| name == \"${names[at]}\")); *IS } { ${news[at]} } else { ${olds[at]} })"
        replaced "$file" "${olds[at]}" "$choice" >"$work/mutated.rs"
        cp "$work/mutated.rs" "$file"
    done
    file=$fresh/shaders/src/lib.rs
    replaced "$file" 'job.source.as_ref().into()' 'mutated(job.source.as_ref()).into()' >"$work/mutated.rs"
    cat >>"$work/mutated.rs" <<'END'
fn mutated(text: &str) -> String {
    match (std::env::var("MUTANT_OLD"), std::env::var("MUTANT_NEW")) {
        (Ok(old), Ok(new)) => text.replace(&old, &new),
        _ => text.to_owned(),
    }
}
END
    cp "$work/mutated.rs" "$file"
    cd "$fresh"
    find . -type f -print0 | while IFS= read -r -d '' file; do
        if cmp -s "$file" "$tree/$file"; then continue; fi
        mkdir -p "$tree/${file%/*}"
        # A fresh time: cargo goes by it.
        cp "$file" "$tree/$file"
    done
    cd "$tree"
    find . -type f -print0 | while IFS= read -r -d '' file; do
        if [ ! -e "$fresh/$file" ]; then rm "$file"; fi
    done
    rm -rf "$fresh"
}

# The programs of the tests: a name, its program and the folder that it is run in.
declare -A programs=() folders=()
readonly packages=(cull strategies scene terrain)
build() {
    local arguments=(--lib) line name program source binary
    for name in "${packages[@]}"; do arguments+=(--package "antumbra-$name"); done
    while IFS= read -r name; do
        if [[ $name != antumbra_* ]]; then arguments+=(--test "$name"); fi
    done < <(for at in "${!tests[@]}"; do echo "${tests[at]%% *}"; done | sort -u)
    say "building the tests with all mutations in them"
    cd "$tree"
    cargo test --locked --no-run "${arguments[@]}" >"$work/build.txt" 2>&1 || { tail -60 "$work/build.txt" >&2 && fail "the copy does not build"; }
    while IFS= read -r line; do
        program=${line##*\(} program=${program%\)}
        binary=${program##*/} binary=${binary%-*}
        programs[$binary]=$program
        for source in "${packages[@]}"; do
            if [ "$binary" = "antumbra_$source" ] || [ -e "$tree/crates/$source/tests/$binary.rs" ] || [ -d "$tree/crates/$source/tests/$binary" ]; then
                folders[$binary]=$tree/crates/$source
            fi
        done
    done < <(grep '^ *Executable ' "$work/build.txt")
}

# passes TEST: a test as the list names it, `PROGRAM FILTER`; or `conformance [CASE] FILTER`, which plays one case of the conformance kit to the strategies of a test.
passes() {
    local program=${1%% *} filter=${1##* } kit=()
    if [[ $1 == *'['*']'* ]]; then
        kit=${1#*\[}
        kit=("KIT_CASE=${kit%\]*}")
    fi
    if [ -z "${programs[$program]:-}" ]; then fail "there is no program $program"; fi
    cd "${folders[$program]}"
    env "${kit[@]}" timeout "$patience" "${programs[$program]}" "$filter" >"$work/log.txt" 2>&1
}

# Without a mutation each test passes, and is not empty.
check_tests() {
    local test at before
    while IFS= read -r test; do
        before=$SECONDS
        passes "$test" || { tail -40 "$work/log.txt" >&2 && fail "$test fails without a mutation"; }
        grep -q '^test result: ok\. [1-9]' "$work/log.txt" || fail "$test runs no test"
        say "passes without a mutation: $test ($((SECONDS - before)) s)"
    done < <(for at in "$@"; do echo "${tests[at]}"; done | sort -u)
}

survivors=()
try_mutation() {
    local at=$1 before=$SECONDS outcome=killed status=0
    if [[ ${files[at]} == *.wgsl ]]; then
        export MUTANT_OLD=${olds[at]} MUTANT_NEW=${news[at]}
    else
        export MUTANT=${names[at]}
    fi
    passes "${tests[at]}" || status=$?
    # What runs out of time has not been found wrong: the machine may be slow.
    case $status in
    0) outcome=SURVIVED ;;
    124) outcome='OUT OF TIME' ;;
    esac
    if [ "$outcome" != killed ]; then survivors+=("${names[at]}"); fi
    unset MUTANT MUTANT_OLD MUTANT_NEW
    say "$outcome: ${names[at]} ($((SECONDS - before)) s, ${tests[at]})"
    grep -m1 -A1 'panicked at' "$work/log.txt" | tail -1 | cut -c1-200 | sed 's/^/    /' || true
}

read_list
if [ "${1:-}" = --table ]; then
    table
    exit
fi
chosen=()
for at in "${!names[@]}"; do
    wanted=no
    if [ $# -eq 0 ]; then wanted=yes; fi
    for word in "$@"; do
        if [[ ${names[at]} == *"$word"* ]]; then wanted=yes; fi
    done
    if [ "$wanted" = yes ]; then chosen+=("$at"); fi
done
if [ ${#chosen[@]} -eq 0 ]; then
    say "no mutation's name contains any of: $*" >&2
    exit 2
fi
make_tree
build
say "built in $((SECONDS / 60)) min $((SECONDS % 60)) s"
check_tests "${chosen[@]}"
for at in "${chosen[@]}"; do try_mutation "$at"; done
say "${#chosen[@]} mutations, ${#survivors[@]} survived, $((SECONDS / 60)) min $((SECONDS % 60)) s"
for name in "${survivors[@]}"; do say "survived: $name"; done
[ ${#survivors[@]} -eq 0 ]
