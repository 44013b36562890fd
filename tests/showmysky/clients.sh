#!/usr/bin/env bash
# Installs the library to a fresh place, then configures, builds and runs the example clients against it alone.
#     clients.sh CMAKE BUILD CLIENTS MODEL SCRATCH
set -euo pipefail
cmake=$1 build=$2 clients=$3 model=$4 scratch=$5

rm -rf "$scratch"
"$cmake" --install "$build" --prefix "$scratch/installed" > /dev/null
"$cmake" -S "$clients" -B "$scratch/build" -DCMAKE_PREFIX_PATH="$scratch/installed" -DCMAKE_BUILD_TYPE=Release > "$scratch/log"
"$cmake" --build "$scratch/build" >> "$scratch/log" || { cat "$scratch/log"; exit 1; }
library=$(find "$scratch/installed" -name 'libShowMySky.so.0')

run() { # a client without OpenGL says so with 77: skipped, not passed
    local code=0
    "$@" || code=$?
    [ $code = 77 ] && { echo "SKIPPED: no OpenGL 3.3 context"; exit 0; }
    return $code
}
run "$scratch/build/linked" "$model"
run "$scratch/build/haze" "$model" "$scratch/haze.ppm"
run "$scratch/build/opened" "$library" "$model"
"$scratch/installed/bin/showmysky" --version

# Nothing but the public interface is visible. The standard library's own templates, instantiated here, are no concern.
leaked=$(nm -DC --defined-only "$library" | grep -E ' [TVWBD] ' | grep -vE 'showmysky|std::|__gnu_cxx|^[0-9a-f ]+ [A-Z] _(init|fini)$' || true)
[ -z "$leaked" ] || { echo "visible by mistake:"; echo "$leaked" | head; exit 1; }
if command -v pkg-config > /dev/null; then
    PKG_CONFIG_PATH=$(dirname "$(find "$scratch/installed" -name showmysky.pc)") pkg-config --cflags --libs showmysky
fi
