#!/usr/bin/env bash
# completion.sh COMPLETION: what bash offers after the beginnings of some commands.
set -u
# shellcheck source=/dev/null
source "$1"
cd "$(mktemp -d)" || exit 1
trap 'rm -rf "$PWD"' EXIT
touch first.toml notes.txt
mkdir results
wrong=0

# offers LINE WORD...: after LINE exactly these words are offered, in any order.
offers() {
  local line=$1
  shift
  COMP_LINE=$line COMP_POINT=${#line}
  read -ra COMP_WORDS <<< "$line"
  [[ $line == *' ' ]] && COMP_WORDS+=('')
  COMP_CWORD=$((${#COMP_WORDS[@]} - 1))
  _tourmaline 2> /dev/null
  local found expected
  found=$(printf '%s\n' "${COMPREPLY[@]}" | sort)
  expected=$(printf '%s\n' "$@" | sort)
  [[ $found == "$expected" ]] && return
  echo "after '$line': offered ${found//$'\n'/ }, expected ${expected//$'\n'/ }"
  wrong=1
}

offers 'tourmaline mat' materials
offers 'tourmaline --v' --version
offers 'tourmaline run ' first.toml results
offers 'tourmaline run -q fi' first.toml
offers 'tourmaline run first.toml --ou' --output
offers 'tourmaline run first.toml -o ' results
offers 'tourmaline figures results --format s' svg
offers 'tourmaline materials BaTiO3-L' BaTiO3-Liu2014
offers 'tourmaline materials --file ' first.toml results
offers 'tourmaline run first.toml --set conta' contact.
offers 'tourmaline run first.toml --set contact.f' contact.foundation_displacement= contact.friction. contact.friction=
offers 'tourmaline run first.toml --set contact.friction.' contact.friction.law= contact.friction.bound= contact.friction.coefficient. \
  contact.friction.coefficient= contact.friction.cohesion= contact.friction.limit=
offers 'tourmaline run first.toml --set "boundary[2].tr' 'boundary[2].traction='
offers 'tourmaline run first.toml --set solver.method=' condensed monolithic
offers 'tourmaline run first.toml --set region[3].material.symmetry=c' cubic
offers 'tourmaline sweep first.toml --columns sl' slip
offers 'tourmaline sweep first.toml --columns slip,max:friction_d' friction_dissipation
offers 'tourmaline sweep first.toml --columns slip,me' slip,mean:
exit $wrong
