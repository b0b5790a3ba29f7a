#!/bin/sh
# Writes all of results/ again. Two to five minutes.
cd "$(dirname "$0")" || exit 1
export OPENBLAS_NUM_THREADS=1
for case in cases/*.toml; do
    name=$(basename "$case" .toml)
    case $name in
        barber-leaves-*) options="--every 100000" ;;
        barber-*) options="--every 50" ;;
        friction-heat-half-space) options="--every 4" ;;
        *) options="--starts 6" ;;
    esac
    [ "$name" = barber-warm ] && options="--every 10"
    # shellcheck disable=SC2086
    python3 contact_exchange.py "$case" "results/$name.json" $options > /dev/null || echo "$name failed"
    case $name in
        pressed-exchange-constant | capacitor-constant | arch | block-turned | bilateral-heated)
            python3 contact_exchange.py "$case" "results/$name.lumped.json" --lumped > /dev/null || echo "$name failed" ;;
    esac
done
