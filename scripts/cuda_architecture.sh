#!/bin/sh
# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Prints the architecture of the CUDA device of this machine, as CMAKE_CUDA_ARCHITECTURES
# expects it (for example 90); nothing where there is no device. (nvidia-smi prints its errors, too.)

architecture=$(nvidia-smi --query-gpu=compute_cap --format=csv,noheader 2> /dev/null | head -n 1 | tr -d .)
case $architecture in
  '' | *[!0-9]*) ;;
  *) echo "$architecture" ;;
esac
