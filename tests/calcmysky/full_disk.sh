#!/bin/sh
# A disk that fills up, and one that is read-only: a sentence, the old model, no debris.
#
#   full_disk.sh CALCMYSKY SHOWMYSKY ONE.atmo OTHER.atmo
#
# Disks are small tmpfs, mounted in a namespace of their own: where the system allows no namespaces, the exit code is 77.
set -eu
if [ "${1:-}" != --inside ]; then
    unshare --user --map-root-user --mount true 2> /dev/null || { echo "SKIPPED: unshare may make no namespaces here"; exit 77; }
    exec unshare --user --map-root-user --mount "$0" --inside "$@"
fi
calcmysky=$2 showmysky=$3 one=$4 other=$5
disk=$(mktemp -d)
trap 'umount "$disk" 2> /dev/null; rmdir "$disk"' EXIT
mount -t tmpfs -o size=2m tmpfs "$disk" 2> /dev/null || { echo "SKIPPED: no tmpfs can be mounted here"; exit 77; }
compute() { "$calcmysky" "$1" --out-dir "$disk/model" --quality draft --only moments,transmittance -q; }
sums() { (cd "$disk/model" && find . -type f -exec sha256sum {} + | sort); }
fails() { # fails DESCRIPTION "words of the message" "what may lie on the disk"
    if compute "$1" 2> "$disk.log"; then
        echo "$1 was written to a disk that takes nothing."
        exit 1
    fi
    grep -q "$2" "$disk.log" || { cat "$disk.log"; exit 1; }
    rm "$disk.log"
    [ "$(sums)" = "$before" ] || { echo "The old model was changed."; exit 1; }
    [ "$(ls -A "$disk")" = "$3" ] || { ls -A "$disk"; exit 1; }
    "$showmysky" info "$disk/model" > /dev/null
}

if ! message=$(compute "$one" 2>&1); then
    case $message in *"context can be made"*) echo "SKIPPED: $message"; exit 77 ;; esac
    echo "$message"
    exit 1
fi
before=$(sums)
for left in 0 4 60 100; do # kB, so that different files meet the end
    head -c $(($(stat -f -c %a "$disk") * $(stat -f -c %S "$disk") - left * 1024)) /dev/zero > "$disk/ballast"
    fails "$other" "No space left on device" "$(printf 'ballast\nmodel')"
    rm "$disk/ballast"
done
mount -o remount,ro "$disk"
fails "$other" "Read-only file system" model
mount -o remount,rw "$disk"
compute "$other"
[ "$(sums)" != "$before" ]
echo "A full disk and a read-only one left the old model as it was."
