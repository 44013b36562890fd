#!/usr/bin/env bash
# `showmysky render` as people call it: pictures, frames, and what it says to mistakes.
#     render.sh SHOWMYSKY MODEL SCRATCH
set -euo pipefail
showmysky=$1 model=$2 scratch=$3
rm -rf "$scratch"
mkdir -p "$scratch"
cd "$scratch"

fail() { echo "$1"; exit 1; }
size_of() { od -An -tu1 -j16 -N8 "$1" | awk '{ print $3 * 256 + $4 "x" $7 * 256 + $8 }'; } # of a PNG, from its header

"$showmysky" render "$model" -o day.png --size 320x200 --pitch 30 --sun-zenith 30 > log 2>&1 || { cat log; fail "no picture"; }
[ "$(size_of day.png)" = 320x200 ] || fail "the picture has the wrong size"
"$showmysky" render "$model" -o sky.exr --size 64x32 --projection fisheye --fov 180 --pitch 90 > /dev/null
[ "$(od -An -tx1 -N4 sky.exr | tr -d ' ')" = 762f3101 ] || fail "sky.exr is no OpenEXR file"
"$showmysky" render "$model" -o frame.png --size 64x32 --animate sun-zenith=88..92:3 > /dev/null
[ -f frame-0000.png ] && [ -f frame-0002.png ] && [ ! -f frame-0003.png ] || fail "frames are missing"
cmp -s frame-0000.png frame-0002.png && fail "the Sun did not move"

# Options change the picture they say they change.
for option in "--altitude 9000" "--mirror" "--layers single" "--hide-scatterer aerosols" "--source textures" "--exposure -4" \
              "--tone-mapping reinhard" "--yaw 40" "--layers zero,sun,single,multiple"; do
    # shellcheck disable=SC2086 # one word per part
    "$showmysky" render "$model" -o other.png --size 320x200 --pitch 30 --sun-zenith 30 $option > log 2>&1 || { cat log; fail "$option"; }
    cmp -s day.png other.png && fail "$option changed nothing"
done

refused() { # refused "part of the sentence" options...
    local code=0 words=$1
    shift
    "$showmysky" render "$@" > log 2>&1 || code=$?
    [ $code = 2 ] || { cat log; fail "exit code $code, not 2: $*"; }
    grep -qF -- "$words" log || { cat log; fail "not said: $words"; }
}
refused "must end in .png or .exr" "$model" -o sky.jpg
refused "WIDTHxHEIGHT" "$model" -o sky.png --size big
refused "FROM..TO:FRAMES" "$model" -o sky.png --animate altitude=3
refused "sun-zenith" "$model" -o sky.png --animate sun=1..2:3
refused "no/such/model" no/such/model -o sky.png
refused "touches neither the air nor the camera" "$model" -o sky.png --eclipse --moon-distance 6400000
refused "There is no scatterer" "$model" -o sky.png --hide-scatterer glitter
refused "zenith angle of the Sun" "$model" -o sky.png --sun-zenith 190

# Scenes as files.
"$showmysky" render "$model" -o one.png --size 64x32 --sun-zenith 80 --projection fisheye --save-scene a.scene > /dev/null
"$showmysky" render "$model" -o two.png --size 64x32 --scene a.scene > /dev/null
cmp -s one.png two.png || fail "a saved scene draws another picture"
"$showmysky" render "$model" -o two.png --size 64x32 --sun-zenith 20 --scene a.scene > /dev/null
cmp -s one.png two.png && fail "an option did not go before the scene file"
printf 'altitude: 10\nsun-zenit: 3\n' > b.scene
refused "b.scene:2:1: there is no setting \`sun-zenit\`" "$model" -o sky.png --scene b.scene

code=0
"$showmysky" rendr "$model" > log 2>&1 || code=$?
[ $code = 2 ] && grep -qF 'Did you mean `render`?' log || { cat log; fail "a misspelt subcommand: exit code $code"; }
