#!/usr/bin/env bash
# installed.sh BUILD: installs into an empty folder; program, cases and materials work from there, and so does the
# example of a program that is built against the library.
set -euo pipefail
build=$1
source=$(cd "$(dirname "$0")/../.." && pwd)
root=$(mktemp -d)
trap 'rm -rf "$root"' EXIT
cmake --install "$build" --prefix "$root/usr" > "$root/install.log"

cd "$root"
usr/bin/tourmaline check usr/share/doc/tourmaline/cases/ouafik-2020/conductive.toml > check.txt
# The file of materials is what the program knows.
diff <(usr/bin/tourmaline materials) <(usr/bin/tourmaline materials --file usr/share/tourmaline/materials.toml)
diff <(usr/bin/tourmaline materials PZT-4 | tail -n +2) \
  <(usr/bin/tourmaline materials PZT-4 --file usr/share/tourmaline/materials.toml | tail -n +2)

cmake -S "$source/examples/directional_friction" -B example -DCMAKE_PREFIX_PATH="$root/usr" > configure.log 2>&1 \
  || { cat configure.log; exit 1; }
cmake --build example > build.log 2>&1 || { cat build.log; exit 1; }
bash "$source/tests/packaging/own_symbols.sh" example/directional_friction
example/directional_friction usr/share/tourmaline/cases/ouafik-2020/conductive.toml result
test -s result/summary.json
