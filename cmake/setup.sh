# shellcheck shell=bash
# What ./demo and ./check share: packages, configuration, build. To be sourced from the top of the tree by bash.
# Says each step in one line; the rest goes to build/log, and its end is shown where a step fails.

log=build/log
mkdir -p build
: > "$log"

step() { # step "What is done" command...
    printf '%s ... ' "$1"
    shift
    local start=$SECONDS
    if "$@" >> "$log" 2>&1; then
        printf 'done (%d s)\n' $((SECONDS - start))
    else
        printf 'failed\n\n'
        tail -n 40 "$log"
        printf '\nThe whole log: %s\n' "$log"
        exit 1
    fi
}

missing_packages() {
    local package
    grep -v '^#' cmake/packages.txt | while read -r package; do
        [ "$(dpkg-query -W -f='${db:Status-Status}' "$package" 2>/dev/null)" = installed ] || echo "$package"
    done
}

install_packages() {
    local as_root=()
    [ "$(id -u)" = 0 ] || as_root=(sudo)
    # Lists may be older than the archive: a second try with fresh ones.
    "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y --no-install-recommends "$@" ||
        { "${as_root[@]}" apt-get update &&
          "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y --no-install-recommends "$@"; }
}

ensure_packages() {
    if ! command -v dpkg-query > /dev/null || ! command -v apt-get > /dev/null; then
        echo "This is not Debian: nothing is installed; cmake/packages.txt names what is needed."
        return
    fi
    local missing
    missing=$(missing_packages | tr '\n' ' ')
    [ -n "$missing" ] || return 0
    if [ "$(id -u)" != 0 ] && ! command -v sudo > /dev/null; then
        echo "These packages are missing, and installing them needs root: run as root"
        echo "    apt-get install $missing"
        exit 1
    fi
    [ "$(id -u)" = 0 ] || sudo -v || exit 1 # asks for the password here, not inside the log
    # shellcheck disable=SC2086 # one word per package
    step "Installing ${missing% }" install_packages $missing
}

# build PRESET [target...]: configures where needed and builds.
build() {
    local preset=$1
    shift
    step "Configuring ($preset)" cmake --preset "$preset"
    step "Building" cmake --build --preset "$preset" ${1:+--target "$@"}
}
