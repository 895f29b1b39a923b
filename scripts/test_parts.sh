#!/bin/sh
# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Of test.sh, which reads it: how long its parts take, and what they need. It uses the variables root, build and all_parts
# and the function fail of test.sh.

# Typical seconds of each part on two processors, from which the time left is guessed.
seconds_of()
{
  case $1 in
    style) echo 15 ;;
    configure) echo 40 ;;
    release) echo 525 ;;
    bits) echo 55 ;;
    asan) echo 350 ;;
    cost) echo 75 ;;
    tsan) echo 90 ;;
    fuzz) echo 25 ;;
    cuda) echo 210 ;;
    benchmark) echo 90 ;;
    doc) echo 10 ;;
    *) fail "unknown part $1; choose of $all_parts" ;;
  esac
}

python_packages='pybind11-dev python3-numpy python3-dev'
mpi_packages='libopenmpi-dev openmpi-bin libboost-mpi-dev'

install_mpi()
{
  # shellcheck disable=SC2086
  "$root/scripts/install_dependencies.sh" $mpi_packages ||
    echo "not all can be installed: many processes are not tested"
}

# install PART: what it needs beside CGAL and its companions
install()
{
  case $1 in
    style) "$root/scripts/install_dependencies.sh" clang-format clang-tidy python3 ;;
    release) "$root/scripts/install_dependencies.sh" gnuplot-nox libjs-three help2man ||
      echo "not all can be installed: pictures or --view are not tested, or the manual page not built"
      # shellcheck disable=SC2086
      "$root/scripts/install_dependencies.sh" $python_packages ||
        echo "not all can be installed: the Python module is not tested"
      install_mpi
      "$root/scripts/install_playwright.sh" "$build/playwright" ||
        echo "playwright-core cannot be installed: clicks on the page of --view are not tested" ;;
    benchmark) "$root/scripts/install_dependencies.sh" xz-utils ;;
    bits | tsan | fuzz) "$root/scripts/install_dependencies.sh" clang libclang-rt-dev ;;
    asan)
      # shellcheck disable=SC2086
      "$root/scripts/install_dependencies.sh" clang libclang-rt-dev libjs-three $python_packages
      install_mpi ;;
    cost) "$root/scripts/install_dependencies.sh" valgrind ;;
    cuda) install_mpi ;;
  esac
}
