#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The exact picture of the torus against POV-Ray's `parametric` object: parametric.sh [BUILD [SIDE [BANDS]]].
# Exit code 0 when luxo is at least 5,000 times as fast at an error at most 1e-4 times as large, 6 when it is not.
# Needs povray; about half a minute.
set -euo pipefail
build=$(realpath "${1:-$(dirname "${BASH_SOURCE[0]}")/../../../build/release}")
cmake --build "$build" --target luxo_povray_parametric >&2
exec "$build/bin/luxo_povray_parametric" "${@:2}"
