#!/usr/bin/env bash
# From a bare Debian 12 or 13 (whose packages have the same names) to a hydraulic fracture:
#   contrib/quickstart.sh          install what is missing, build, run the demo, show the result
#   contrib/quickstart.sh --test   the same build, then the test suite instead of the demo
#   contrib/quickstart.sh --install-only | --build-only
# Needs root or sudo only where packages are missing. JOBS=n sets the number of compilers.
set -Eeuo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

packages=(g++ cmake ninja-build git openmpi-bin libdeal.ii-dev libmumps-dev libsuitesparse-dev
          libopenblas0-serial libboost-program-options-dev doctest-dev python3 python3-numpy python3-matplotlib
          python3-pandas)
deck=prm/kgd/toughness/cohesive_xfem.prm
output=build/demo
python=/usr/bin/python3

stage="" advice=""
begin() { stage=$1 advice=$2; printf '\n== %s\n' "$stage"; }
trap 'printf "\nquickstart: \"%s\" failed (line %s).\n%s\n" "$stage" "$LINENO" "$advice" >&2' ERR

install_packages() {
  local missing=() package
  for package in "${packages[@]}"; do
    dpkg-query -W -f '${Status}\n' "$package" 2>/dev/null | grep -q '^install ok installed' ||
      missing+=("$package")
  done
  [ ${#missing[@]} -eq 0 ] && return
  local line="apt-get install --no-install-recommends ${missing[*]}"
  begin "installing ${missing[*]}" "Run as root: apt-get update && $line"
  command -v apt-get >/dev/null || { advice="This is not Debian. Install deal.II >= 9.4 with MPI, Trilinos, p4est
and muParser, then: cmake --preset release && cmake --build build"; false; }
  local sudo=()
  [ "$(id -u)" -eq 0 ] || sudo=(sudo)
  "${sudo[@]}" apt-get update
  DEBIAN_FRONTEND=noninteractive "${sudo[@]}" ${line/install/install -y}
}

build() { # build DIRECTORY TYPE WITH_TESTS [TARGET...]
  begin "configuring $1 ($2)" "If deal.II was not found: cmake -S . -B $1 -DDEAL_II_DIR=/path/to/deal.II.
After a change of compiler or deal.II, remove $1 first."
  cmake -S . -B "$1" -G Ninja -DCMAKE_BUILD_TYPE="$2" -DBUILD_TESTING="$3" -DSTOCKWORK_PCH=ON \
    -DSTOCKWORK_FILES_PER_UNIT=15 >"$1.log" 2>&1 || { cat "$1.log"; false; }
  # One compiler needs up to 1.8 GB.
  local memory jobs=${JOBS:-$cores}
  memory=$(awk '/MemAvailable/ {print int($2 / 1800000)}' /proc/meminfo)
  [ -n "${JOBS:-}" ] || [ "$jobs" -le "$memory" ] || jobs=$((memory > 1 ? memory : 1))
  begin "building $1 ($2) with $jobs compiler(s)" "If the compiler was killed, memory ran out: JOBS=1 contrib/quickstart.sh.
Otherwise the first line with 'error:' above says what is wrong."
  # Where addresses are random, the compiler moves all of a precompiled header at each use (a tenth of its time).
  local fixed=()
  if setarch -R true 2>/dev/null; then fixed=(setarch -R); fi
  "${fixed[@]}" cmake --build "$1" -j "$jobs" ${4:+--target "${@:4}"}
}

case "${1:-}" in
  "" | --test | --install-only | --build-only) ;;
  --help | -h) sed -n '2,6s/^# //p' contrib/quickstart.sh; exit ;;
  *) printf 'quickstart: "%s" is not one of --test, --install-only, --build-only, --help.\n' "$1" >&2; exit 2 ;;
esac

cores=$(env -u OMP_NUM_THREADS -u OMP_THREAD_LIMIT nproc) # which would else believe these
export OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1

install_packages
[ "${1:-}" = --install-only ] && exit
if [ "${1:-}" = --test ]; then build build Release ON; else build build Release OFF; fi

case "${1:-}" in
  --build-only) ;;
  --test)
    begin "tests, Release" "One of them again, with what it says: ctest --test-dir build -R NAME -V"
    ctest --test-dir build --output-on-failure -j "$cores" -LE nightly
    # What deal.II's assertions can find something in; decks and scripts are as good as they were.
    build build-debug Debug ON stockwork_program loaded_once unit_tests contract_tests contract_mpi_tests taking_over springs rejecting_model
    begin "quick tests, Debug" "One of them again, with what it says: ctest --test-dir build-debug -R NAME -V"
    # Those with more than ten seconds of it there whose assertions others reach as well are left to Release.
    # (A line each and no groups in that file: beyond 32 parentheses CMake takes an expression for none.)
    ctest --test-dir build-debug --output-on-failure -j "$cores" -L quick -LE "smoke|house|nightly" \
      -E "^($(paste -s -d '|' tests/slow_in_debug.txt))\$"
    printf '\nAll tests passed.\n' ;;
  "")
    begin "running $deck" "The same by hand: build/source/stockwork $deck --output $output"
    build/source/stockwork "$deck" --set 'Resolution=coarse' --output "$output"
    begin "drawing" "Pictures need python3-numpy and python3-matplotlib; the run itself is complete."
    "$python" contrib/plot/history.py "$output"
    "$python" contrib/plot/field.py "$output" --field total_stress --component yy --mirror
    "$python" contrib/plot/profile.py "$output"
    "$python" contrib/report.py "$output"
    printf '\nPictures: %s\nFields for ParaView: %s\n' "$(echo $output/*.png)" "$(echo $output/*.pvd)" ;;
  *)
    echo "usage: contrib/quickstart.sh [--test | --install-only | --build-only]" >&2
    exit 2 ;;
esac
