#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Measures this folder anew, in minutes on a machine that does nothing else: measure.sh [BUILD]. Replaces results.csv,
# results.json, summary.md, pareto.svg, shadows.md, povray.txt and, in the project's README, the tables between the benchmark's marks.
# The page with all pictures, tens of megabytes, is BUILD/bench/index.html. Needs gnuplot and povray.
set -euo pipefail
here=$(realpath "$(dirname "${BASH_SOURCE[0]}")")
root=$(realpath "$here/../../..")
build=$(realpath "${1:-$root/build/release}")
readme=$root/README.md

cmake --build "$build" --target luxo_program luxo_povray_parametric
"$build/bin/luxo" bench standard -o "$build/bench"
cp "$build/bench/"{results.csv,results.json,summary.md,pareto.svg} "$here"
"$build/bin/luxo" bench shadows -o "$build/bench"
cp "$build/bench/shadows.md" "$here"
# A missed goal (exit code 6) is a result, too.
"$build/bin/luxo_povray_parametric" | tee "$here/povray.txt" || [[ ${PIPESTATUS[0]} -eq 6 ]]

# The README shows the first table of the summary, the exact picture against the mesh, and that of the shadows.
updated=$(mktemp)
trap 'rm -f "$updated"' EXIT
show() {  # MARK FILE: the file's first table, between the mark's two ends
  awk -v mark="$1" -v file="$2" '
    $0 == "<!-- " mark ": end -->" { inside = 0; ends = 1 }
    !inside { print }
    $0 == "<!-- " mark ": begin -->" {
      inside = 1
      while ((getline line < file) > 0 && line != "") { print line; ++lines }
    }
    END { exit !ends || inside || !lines }' "$readme" >"$updated"
  cat "$updated" >"$readme"
}
show bench "$here/summary.md"
show shadows "$here/shadows.md"
